// Figures and fields from made-up results.

#include "comparisons/reports/figures.h"

#include "comparisons/reports/files.h"
#include "comparisons/reports/gnuplot.h"
#include "comparisons/reports/plot.h"
#include "comparisons/reports/vtu.h"
#include "unit/reports/sample.h"

#include <gtest/gtest.h>

#include <unistd.h>

using namespace comparisons::reports;

namespace {

bool contains(const std::string &text, const std::string &part) { return text.find(part) != std::string::npos; }

const GnuplotFigure *find(const std::vector<GnuplotFigure> &figures, const std::string &name) {
  for (const GnuplotFigure &figure : figures)
    if (figure.name == name)
      return &figure;
  return nullptr;
}

} // namespace

TEST(Figures, by_what_the_results_contain) {
  const Results results = reports_sample::results();
  const auto figures = gnuplot_figures(results, "no such folder");
  const auto *cost = find(figures, "cantilever-convergence-displacement_l2_relative-cost");
  ASSERT_NE(cost, nullptr);
  EXPECT_TRUE(contains(cost->data, "0.168291 # 16x4"));
  EXPECT_TRUE(contains(cost->script, "set logscale xy"));
  EXPECT_TRUE(contains(cost->script, "title 'weak1 order=4, 16x4: refused'")) << "what is not drawn is named";
  EXPECT_TRUE(contains(cost->script, "broken | *odd*"));
  const auto *convergence = find(figures, "cantilever-convergence-displacement_l2_relative-convergence");
  ASSERT_NE(convergence, nullptr);
  // weak1 of order 2 has the slope 2: from h to 2 h the triangle rises by 4.
  EXPECT_TRUE(contains(convergence->data, "# slope 2\n")) << convergence->data;
  ASSERT_NE(find(figures, "cantilever-scene-phases"), nullptr);
  EXPECT_EQ(find(figures, "cantilever-order-jitter_0.25-displacement_l2_relative-cost"), nullptr) << "one cell";
  EXPECT_EQ(gnuplot_figures(results, "no such folder").front().script, figures.front().script);
}

TEST(Figures, profiles_stand_beside_the_exact_curve) {
  std::string folder = (std::filesystem::temp_directory_path() / "petrov_figures_XXXXXX").string();
  ASSERT_NE(::mkdtemp(folder.data()), nullptr);
  write_file_atomically(std::filesystem::path(folder) / "u2_bottom.csv",
                        "x1,x2,u2,exact_u2\n0,0,0,0\n0.5,0,-1,-1.25\n1,0,-2,-2.5\n");
  const auto figures = gnuplot_figures(reports_sample::results(), folder);
  const auto *profile = find(figures, "cantilever-scene-u2_bottom-u2");
  ASSERT_NE(profile, nullptr);
  EXPECT_EQ(profile->data, "# exact\n0 0\n0.5 -1.25\n1 -2.5\n\n\n# weak1, 16x4\n0 0\n0.5 -1\n1 -2\n\n\n");
  std::filesystem::remove_all(folder);
}

TEST(Figures, ticks_are_powers_of_ten_or_finer) {
  EXPECT_EQ(logarithmic_ticks(0.05, 20).size(), 3u); // 0.1, 1, 10
  EXPECT_EQ(logarithmic_ticks(1.5, 30), (std::vector<double>{2, 5, 10, 20}));
  EXPECT_LE(logarithmic_ticks(1e-15, 1).size(), 9u);
}

TEST(Figures, a_table_that_is_none_is_left_out) {
  EXPECT_EQ(parse_number_table("a,b\n1,2\n3,x\n").n_rows(), 0u);
  EXPECT_EQ(parse_number_table("a,b\n1\n").n_rows(), 0u);
  EXPECT_EQ(parse_number_table("a,b\n1,2\n").n_rows(), 1u);
  EXPECT_EQ(parse_number_table("").n_rows(), 0u);
}

TEST(Fields, do_not_fit_are_refused) {
  FieldGrid grid{{{0, 0}, {1, 0}, {0, 1}}, {{0, 1, 2}}, {}};
  EXPECT_THROW(vtu_text(grid, {{"u", {"1", "2"}, {1, 2, 3}}}), std::invalid_argument);
  const std::string text = vtu_text(grid, {{"u", {"1", "2"}, {1, 2, 3, 4, 5, 6}}, {"h", {}, {0.1, 0.2, 0.3}}});
  EXPECT_TRUE(contains(text, "Name=\"u\" NumberOfComponents=\"3\"")) << text;
  EXPECT_TRUE(contains(text, "1 2 0\n3 4 0\n5 6 0\n"));
  EXPECT_TRUE(contains(field_table(grid, {{"h", {}, {0.1, 0.2, 0.3}}}), "x1,x2,h\n0,0,0.1\n"));
}
