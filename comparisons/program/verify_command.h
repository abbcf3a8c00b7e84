#pragma once

#include "comparisons/hard_cases/matrix.h"
#include "comparisons/study/catalogue.h"

#include <string>
#include <vector>

namespace comparisons::program {

struct VerifyOptions {
  bool quick = false; ///< under a minute
  bool list = false;  ///< the table of cases alone, nothing is run
  bool quiet = false;
  std::vector<std::string> cases;   ///< parts of "family: name"
  std::vector<std::string> methods; ///< parts of labels
  std::string json;                 ///< file to write; empty: none
  double max_seconds = hard_cases::seconds_of_a_cell;
};

/// `petrov verify`: the matrix of hard cases x methods, each cell in a process of its own.
/// @return all_as_expected if no cell fails, cell_failed if one does, usage_error if nothing is selected, interrupted
int verify(const VerifyOptions &options, const study::Catalogue &catalogue);

} // namespace comparisons::program
