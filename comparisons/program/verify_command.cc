#include "comparisons/program/verify_command.h"

#include "comparisons/hard_cases/case_table.h"
#include "comparisons/program/interrupt.h"
#include "comparisons/program/options.h"
#include "comparisons/reports/files.h"

#include <fmt/format.h>

#include <cstdio>

namespace comparisons::program {

int verify(const VerifyOptions &options, const study::Catalogue &catalogue) {
  const auto cases =
      hard_cases::select(hard_cases::case_table(catalogue), {options.cases, options.methods, options.quick});
  if (cases.empty()) {
    fmt::print(stderr, "error: no hard case is selected; `petrov verify --list` shows all\n");
    return usage_error;
  }
  if (options.list) {
    fmt::print("{}", hard_cases::list_text(cases));
    return all_as_expected;
  }
  const Interrupt interrupt;
  hard_cases::MatrixOptions matrix{
      .max_seconds = options.max_seconds, .stop_requested = Interrupt::requested, .progress = {}};
  if (!options.quiet)
    matrix.progress = [](const std::string &line) { fmt::print(stderr, "{}\n", line); };
  const auto cells = hard_cases::run_matrix(cases, matrix);
  fmt::print("{}", hard_cases::text_report(cases, cells));
  if (!options.json.empty())
    reports::write_file_atomically(options.json, hard_cases::json_report(cases, cells).dump(2) + "\n");
  if (Interrupt::requested())
    return interrupted;
  return hard_cases::counts(cells).at("fails") == 0 ? all_as_expected : cell_failed;
}

} // namespace comparisons::program
