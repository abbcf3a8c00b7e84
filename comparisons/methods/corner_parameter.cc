#include "comparisons/methods/corner_parameter.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace comparisons::methods {

namespace {

using meshless::elasticity::strong_form::CornerRule;

std::vector<std::string> split(const std::string &text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);)
    parts.push_back(part);
  return parts;
}

std::vector<std::string> words(const std::string &text) {
  std::vector<std::string> result;
  std::istringstream stream(text);
  for (std::string word; stream >> word;)
    result.push_back(word);
  return result;
}

std::string names_of(const std::vector<problems::Corner> &corners) {
  std::string names;
  for (const auto &corner : corners)
    names += (names.empty() ? "" : ", ") + corner.name;
  return names;
}

} // namespace

std::vector<CornerRule> read_corner_rules(const std::string &text, const std::vector<problems::Corner> &corners) {
  std::vector<CornerRule> rules;
  std::vector<std::string> seen;
  for (const auto &part : split(text, ',')) {
    const auto colon = split(part, ':');
    const auto name = colon.empty() ? std::vector<std::string>{} : words(colon[0]);
    const auto conditions = colon.size() == 2 ? words(colon[1]) : std::vector<std::string>{};
    if (name.size() != 1 || conditions.size() != 2)
      throw std::invalid_argument(
          fmt::format("'{}' is no corner rule; write a corner and two conditions, such as \"NE: s11 s12\"", part));
    const auto corner = std::find_if(corners.begin(), corners.end(), [&](const auto &c) { return c.name == name[0]; });
    if (corner == corners.end())
      throw std::invalid_argument(fmt::format("no corner '{}'; there are {}", name[0], names_of(corners)));
    if (std::find(seen.begin(), seen.end(), name[0]) != seen.end())
      throw std::invalid_argument(fmt::format("corner {} has two rules", name[0]));
    seen.push_back(name[0]);
    CornerRule rule;
    rule.corner = corner->position;
    for (std::size_t i = 0; i < 2; ++i) {
      const auto quantity = meshless::elasticity::strong_form::quantity_from(conditions[i]);
      if (!quantity)
        throw std::invalid_argument(
            fmt::format("no condition '{}'; there are u1, u2, t1, t2, s11, s22, s12", conditions[i]));
      rule.conditions[i] = *quantity;
    }
    rules.push_back(rule);
  }
  return rules;
}

} // namespace comparisons::methods
