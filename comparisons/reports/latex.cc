#include "comparisons/reports/latex.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace comparisons::reports {

namespace {

template <typename... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <typename... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

/// Width of the lines, in the letters of a table's font: where prose columns have to break.
constexpr std::size_t letters_per_line = 150;
constexpr double widest = 23.5; ///< cm

/// Code points beyond ASCII that appear in scenes and papers; Latin letters with accents LaTeX knows itself.
std::string beyond_ascii(std::uint32_t code, std::string_view bytes) {
  constexpr std::array<std::pair<std::uint32_t, const char *>, 32> names{
      {{0x3b1, "alpha"},       {0x3b2, "beta"},    {0x3b3, "gamma"},  {0x3b4, "delta"}, {0x3b5, "epsilon"},
       {0x3b6, "zeta"},        {0x3b7, "eta"},     {0x3b8, "theta"},  {0x3ba, "kappa"}, {0x3bb, "lambda"},
       {0x3bc, "mu"},          {0x3bd, "nu"},      {0x3be, "xi"},     {0x3c0, "pi"},    {0x3c1, "rho"},
       {0x3c3, "sigma"},       {0x3c4, "tau"},     {0x3c6, "phi"},    {0x3c7, "chi"},   {0x3c8, "psi"},
       {0x3c9, "omega"},       {0x394, "Delta"},   {0x3a3, "Sigma"},  {0x3a9, "Omega"}, {0x2264, "leq"},
       {0x2265, "geq"},        {0x2248, "approx"}, {0x221e, "infty"}, {0xd7, "times"},  {0xb1, "pm"},
       {0x2192, "rightarrow"}, {0xb7, "cdot"}}};
  for (const auto &[value, name] : names)
    if (code == value)
      return fmt::format("$\\{}$", name);
  if (code == 0xb5)
    return "$\\mu$";
  if (code >= 0xc0 && code <= 0x17f && code != 0xf7)
    return std::string(bytes);
  if (code == 0x2013 || code == 0x2014 || code == 0x2212)
    return "--";
  if (code == 0x2019)
    return "'";
  return "?";
}

std::string column_letters(const Table &table) {
  std::vector<std::size_t> widths;
  std::size_t fixed = 0;
  std::size_t prose = 0;
  for (std::size_t j = 0; j < table.columns().size(); ++j) {
    std::size_t width = 4;
    for (const auto &row : table.rows())
      width = std::max(width, display_width(row[j]));
    widths.push_back(width);
    (table.columns()[j].prose ? prose : fixed) += width + 3;
  }
  std::string letters;
  for (std::size_t j = 0; j < widths.size(); ++j) {
    const Column &column = table.columns()[j];
    if (!column.prose || fixed + prose <= letters_per_line) {
      letters += column.align == Align::right ? 'r' : 'l';
      continue;
    }
    const double share = static_cast<double>(widths[j]) / static_cast<double>(prose);
    const double room = std::max(0.25, 1 - static_cast<double>(fixed) / letters_per_line);
    letters += fmt::format(">{{\\raggedright\\arraybackslash}}p{{{:.1f}cm}}", std::max(1.6, widest * room * share));
  }
  return letters;
}

std::vector<std::string> lines_of(const std::string &text) {
  std::vector<std::string> lines(1);
  for (const char c : text)
    if (c == '\n')
      lines.emplace_back();
    else
      lines.back() += c;
  return lines;
}

/// Heads of several lines stand on the rule, as in the text.
std::string head_rows(const Table &table) {
  std::size_t height = 1;
  for (const Column &column : table.columns())
    height = std::max(height, lines_of(column.header).size());
  std::string rows;
  for (std::size_t i = 0; i < height; ++i) {
    for (std::size_t j = 0; j < table.columns().size(); ++j) {
      const auto lines = lines_of(table.columns()[j].header);
      const std::size_t empty = height - lines.size();
      rows += (j > 0 ? " & " : "") + (i < empty ? std::string() : latex_escaped(lines[i - empty]));
    }
    rows += " \\\\\n";
  }
  return rows;
}

/// A negative number has a minus sign, not a hyphen.
std::string entry(const std::string &text) {
  const bool negative = text.size() > 1 && text[0] == '-' && text.find_first_not_of("0123456789.e+-") == text.npos;
  return negative ? "$-$" + latex_escaped(std::string_view(text).substr(1)) : latex_escaped(text);
}

std::string latex_table(const Table &table) {
  const std::string head = head_rows(table);
  std::string text =
      fmt::format("{{\\footnotesize\\setlength{{\\tabcolsep}}{{4pt}}\n\\begin{{longtable}}[l]{{@{{}}{}@{{}}}}\n"
                  "\\toprule\n{}\\midrule\n\\endfirsthead\n\\toprule\n{}\\midrule\n\\endhead\n"
                  "\\bottomrule\n\\endlastfoot\n",
                  column_letters(table), head, head);
  for (const auto &row : table.rows()) {
    for (std::size_t j = 0; j < row.size(); ++j)
      text += (j > 0 ? " & " : "") + entry(row[j]);
    text += " \\\\\n";
  }
  return text + "\\end{longtable}}\n";
}

std::string heading(const Heading &given) {
  constexpr std::array<const char *, 3> commands{"section", "subsection", "subsubsection"};
  const auto level = static_cast<std::size_t>(std::clamp(given.level, 1, 3) - 1);
  return fmt::format("\\{}*{{{}}}\n", commands[level], latex_escaped(given.text));
}

std::string items(const std::vector<std::string> &texts, int first_number) {
  std::string text = "\\begin{itemize}\n";
  int number = first_number;
  for (const std::string &item : texts)
    text += first_number > 0 ? fmt::format("\\item[{{[{}]}}] {}\n", number++, latex_escaped(item))
                             : fmt::format("\\item {{}}{}\n", latex_escaped(item));
  return text + "\\end{itemize}\n";
}

} // namespace

std::string latex_escaped(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    if (c >= 0xc0) {
      const std::size_t n = c >= 0xf0 ? 4 : c >= 0xe0 ? 3 : 2;
      std::uint32_t code = c & (0xff >> (n + 1));
      for (std::size_t k = 1; k < n && i + k < text.size(); ++k)
        code = (code << 6) | (static_cast<unsigned char>(text[i + k]) & 0x3f);
      result += beyond_ascii(code, text.substr(i, n));
      i += n - 1;
    } else if (c >= 0x80 || (c < 0x20 && c != '\n'))
      result += '?';
    else if (std::string_view("#$%&_{}").find(text[i]) != std::string_view::npos)
      result += fmt::format("\\{}", text[i]);
    else if (c == '\\')
      result += "\\textbackslash{}";
    else if (c == '~')
      result += "\\textasciitilde{}";
    else if (c == '^')
      result += "\\textasciicircum{}";
    else if (c == '<' || c == '>' || c == '|')
      result += fmt::format("${}$", text[i]);
    else if (c == '"')
      result += "{\\char34}";
    else
      result += c == '\n' ? ' ' : text[i];
  }
  return result;
}

std::string render_latex(const Document &document) {
  std::string text = "% Needs the packages booktabs, longtable and array.\n";
  for (const Block &block : document)
    text +=
        '\n' + std::visit(Overloaded{[](const Heading &given) { return heading(given); },
                                     [](const Paragraph &paragraph) { return latex_escaped(paragraph.text) + '\n'; },
                                     [](const Alarm &alarm) { return "\\textbf{" + latex_escaped(alarm.text) + "}\n"; },
                                     [](const Bullets &bullets) {
                                       return bullets.items.empty() ? std::string() : items(bullets.items, 0);
                                     },
                                     [](const Notes &notes) {
                                       return notes.items.empty() ? std::string() : items(notes.items, notes.first);
                                     },
                                     [](const Table &table) { return latex_table(table); }},
                          block);
  return text;
}

std::string latex_article(const Results &results, const std::string &tables) {
  return fmt::format("% Made by {} {}; pdflatex this file.\n"
                     "\\documentclass[10pt,a4paper,landscape]{{article}}\n"
                     "\\usepackage[T1]{{fontenc}}\n\\usepackage[margin=2cm]{{geometry}}\n"
                     "\\usepackage{{array,booktabs,longtable}}\n\\setlength{{\\parindent}}{{0pt}}\n\\sloppy\n"
                     "\\begin{{document}}\n\\input{{{}}}\n\\end{{document}}\n",
                     latex_escaped(results.program.name), latex_escaped(results.program.version), tables);
}

} // namespace comparisons::reports
