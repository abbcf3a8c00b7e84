#include "comparisons/study/catalogue.h"

#include "comparisons/benchmarks/benchmark_table.h"
#include "comparisons/reports/reports.h"
#include "comparisons/study/effect_table.h"

#include "meshless/basis/basis_table.h"
#include "meshless/kernels/kernel_table.h"

namespace comparisons::study {

Catalogue shipped_catalogue() { return {methods::method_table(), benchmarks::benchmark_table()}; }

scene::Vocabulary vocabulary_of(const Catalogue &catalogue) {
  scene::Vocabulary vocabulary;
  for (const auto &method : catalogue.methods)
    vocabulary.methods.push_back(method.description);
  for (const auto &benchmark : catalogue.benchmarks)
    vocabulary.benchmarks.push_back(benchmark.description);
  vocabulary.effects = effect_table();
  for (const auto &kernel : meshless::kernels::kernel_table())
    vocabulary.kernels.push_back({std::string(kernel.name), std::string(kernel.meaning)});
  for (const auto &basis : meshless::basis::basis_table())
    vocabulary.bases.push_back({std::string(basis.name), std::string(basis.meaning)});
  const std::map<std::string, std::string> meanings{{"text", "aligned tables"},
                                                    {"md", "tables in Markdown"},
                                                    {"csv", "one row a cell and quantity"},
                                                    {"json", "everything, results.json"},
                                                    {"tex", "tables for LaTeX (booktabs)"},
                                                    {"html", "a page to read and explore, report.html"},
                                                    {"figures", "figures by gnuplot: script, data, SVG, PDF"},
                                                    {"vtu", "fields of the solutions for ParaView"}};
  for (const auto &format : reports::report_formats()) {
    const auto found = meanings.find(format);
    vocabulary.formats.push_back({format, found == meanings.end() ? "" : found->second});
  }
  return vocabulary;
}

} // namespace comparisons::study
