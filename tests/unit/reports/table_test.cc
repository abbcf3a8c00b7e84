#include "comparisons/reports/table.h"

#include <gtest/gtest.h>

#include <sstream>

using namespace comparisons::reports;

namespace {

Table example() {
  Table table({{"method", Align::left}, {"u L2\nrelative"}, {"remark", Align::left, true}});
  table.add_row({"strong", "1.7e-01", "short"});
  table.add_row({"weak1", "1.0e-02", "a remark that goes on for longer than the terminal is wide"});
  return table;
}

std::size_t longest_line(const std::string &text) {
  std::istringstream lines(text);
  std::size_t longest = 0;
  for (std::string line; std::getline(lines, line);)
    longest = std::max(longest, display_width(line));
  return longest;
}

} // namespace

TEST(Table, TextIsAligned) {
  EXPECT_EQ(render_text({example()}, 100),
            "            u L2\n"
            "method  relative  remark\n"
            "------  --------  ----------------------------------------------------------\n"
            "strong   1.7e-01  short\n"
            "weak1    1.0e-02  a remark that goes on for longer than the terminal is wide\n");
}

TEST(Table, ProseIsBrokenToTheWidth) {
  EXPECT_EQ(render_text({example()}, 40), "            u L2\n"
                                          "method  relative  remark\n"
                                          "------  --------  ----------------------\n"
                                          "strong   1.7e-01  short\n"
                                          "weak1    1.0e-02  a remark that goes on\n"
                                          "                  for longer than the\n"
                                          "                  terminal is wide\n");
}

TEST(Table, ALongWordKeepsItsColumn) {
  Table table({{"remark", Align::left, true}, {"n"}});
  table.add_row({"a_word_longer_than_the_width and more", "1"});
  EXPECT_EQ(render_text({table}, 20), "remark                        n\n"
                                      "----------------------------  -\n"
                                      "a_word_longer_than_the_width  1\n"
                                      "and more\n");
}

TEST(Table, MarkdownEscapesWhatItWouldRead) {
  Table table({{"a|b", Align::left}, {"n"}});
  table.add_row({"x_y *z* <b> `c`", "_1_"});
  EXPECT_EQ(render_markdown({table}), "| a\\|b | n |\n| --- | ---: |\n| x_y \\*z\\* \\<b> \\`c\\` | \\_1\\_ |\n");
}

TEST(Table, RowsOfTheWrongLengthAreAProgrammingError) {
  Table table({{"a"}, {"b"}});
  EXPECT_THROW(table.add_row({"1"}), std::logic_error);
}

TEST(Table, ColumnsWithoutEntriesGo) {
  Table table({{"a"}, {"b"}, {"c"}});
  table.add_row({"-", "-", "1"});
  table.add_row({"-", "-", "-"});
  table.drop_columns_without("-");
  ASSERT_EQ(table.columns().size(), 2u);
  EXPECT_EQ(table.columns()[0].header, "a");
  EXPECT_EQ(table.columns()[1].header, "c");
  EXPECT_EQ(table.rows()[0], (std::vector<std::string>{"-", "1"}));
}

TEST(Table, WidthCountsCharactersNotBytes) {
  EXPECT_EQ(display_width("ρ > 3.5"), 7u);
  EXPECT_EQ(wrap("ρρρ ρρρ", 7), (std::vector<std::string>{"ρρρ ρρρ"}));
  EXPECT_EQ(wrap("one verylongword two", 5), (std::vector<std::string>{"one", "verylongword", "two"}));
  EXPECT_EQ(wrap("", 5), (std::vector<std::string>{""}));
}

TEST(Document, BlocksInBothForms) {
  const Document document{Heading{1, "Title"}, Paragraph{"Some words."}, Alarm{"Look here"}, Bullets{{"a", "b"}},
                          Notes{1, {"first"}}};
  EXPECT_EQ(render_text(document), "Title\n=====\n\nSome words.\n\n*** Look here\n\n- a\n- b\n\n[1] first\n");
  EXPECT_EQ(render_markdown(document), "# Title\n\nSome words.\n\n**Look here**\n\n- a\n- b\n\n- \\[1\\] first\n");
}

TEST(Document, ParagraphsKeepTheWidth) {
  std::string words;
  for (int i = 0; i < 100; ++i)
    words += "word ";
  EXPECT_LE(longest_line(render_text({Paragraph{words}, Alarm{words}, Bullets{{words}}, Notes{1, {words}}}, 60)), 60u);
}
