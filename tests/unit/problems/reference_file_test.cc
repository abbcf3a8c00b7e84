// Solutions at points from a file, and what is wrong with files that are none.

#include "comparisons/problems/reference_file.h"

#include <gtest/gtest.h>

namespace {

using namespace comparisons::problems;

std::string fault_of(const std::string &text) {
  try {
    parse_reference_csv(text, "there.csv");
  } catch (const CsvError &error) {
    return error.what();
  }
  return {};
}

TEST(ReferenceFile, holds_a_solution_at_its_points) {
  const auto file =
      parse_reference_csv("# from elsewhere\nu2,x,y,u1,s11,s22,s12\n2,0,1,3,5,6,7\n-2,1,1,-3,-5,-6,-7\n", "there.csv");
  const auto solution = known_at_points(file, 4, {0, 0});
  ASSERT_NE(solution.only_at, nullptr);
  EXPECT_EQ(solution.only_at->weights, (std::vector<double>{2, 2}));
  const std::vector<Point2> points{{1, 1}, {0, 1}};
  std::vector<Vector2> u(2);
  std::vector<Stress2> s(2);
  solution.displacement(points, u);
  solution.stress(points, s);
  EXPECT_EQ(u[0], (Vector2{-3, -2}));
  EXPECT_EQ(u[1], (Vector2{3, 2}));
  EXPECT_EQ(s[0], (Stress2{-5, -6, -7}));
  const std::vector<Point2> elsewhere{{0.5, 1}};
  EXPECT_THROW(solution.displacement(elsewhere, std::span(u).first(1)), std::logic_error);
}

TEST(ReferenceFile, may_have_weights_and_no_stress) {
  const auto solution = known_at_points(parse_reference_csv("x,y,u1,u2,weight\n0,0,1,1,.5\n", "there.csv"), 4, {0});
  EXPECT_EQ(solution.only_at->weights, (std::vector<double>{.5}));
  EXPECT_FALSE(solution.stress);
}

TEST(ReferenceFile, says_what_is_wrong) {
  const auto mentions = [](const std::string &text, const std::string &part) {
    EXPECT_NE(fault_of(text).find(part), std::string::npos) << fault_of(text);
  };
  mentions("x,y,u1\n0,0,1\n", "there.csv:1:1: the column u2 is missing; a reference needs x, y, u1, u2");
  mentions("x,y,u1,u2,s11\n0,0,1,1,1\n", "s11, s22 and s12 are given together or not at all");
  mentions("x,y,u1,u2,weight\n0,0,1,1,0\n", "there.csv:2:9: weight is 0; it must be greater than 0");
  mentions("x,y,u1,u2\n0,0,1,1\n0,0,2,2\n", "there.csv:3:1: the point (0, 0) stands on line 2 already");
  mentions("x,y,u1,u2\n0,0,1,inf\n", "u2 is inf; it must be finite");
  mentions("x,y,u1,u2\n", "the file has no points after its line of names");
}

} // namespace
