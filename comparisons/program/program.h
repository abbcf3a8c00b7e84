#pragma once

#include "comparisons/study/catalogue.h"

#include <string>

namespace comparisons::program {

/// The program `petrov` with its commands; returns the exit code.
int run_program(int argc, const char *const *argv, const study::Catalogue &catalogue);

/// An executable of one benchmark, `compare_<case>`: `petrov compare <case>` with the same options.
int run_comparison(const std::string &benchmark, int argc, const char *const *argv, const study::Catalogue &catalogue);

} // namespace comparisons::program
