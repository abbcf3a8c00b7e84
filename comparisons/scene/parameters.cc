#include "comparisons/scene/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace comparisons::scene {

namespace {

const Parameter *find(const std::vector<Parameter> &parameters, std::string_view name) {
  const auto found = std::ranges::find_if(parameters, [&](const Parameter &p) { return p.declaration.name == name; });
  return found == parameters.end() ? nullptr : &*found;
}

/// The value of a key as T, or a logic error that names the key.
template <typename T>
const T &get(const std::vector<Parameter> &parameters, std::string_view name) {
  const Parameter *parameter = find(parameters, name);
  if (parameter == nullptr)
    throw std::logic_error(fmt::format("the key '{}' is absent from the parameters", name));
  if (const T *value = std::get_if<T>(&parameter->value))
    return *value;
  throw std::logic_error(fmt::format("the key '{}' was asked for as another type than it has", name));
}

} // namespace

void Parameters::add(Parameter parameter) {
  if (has(parameter.declaration.name))
    throw std::logic_error(fmt::format("the key '{}' is added twice", parameter.declaration.name));
  parameters_.push_back(std::move(parameter));
}

bool Parameters::has(std::string_view name) const { return find(parameters_, name) != nullptr; }

bool Parameters::is_given(std::string_view name) const {
  const Parameter *parameter = find(parameters_, name);
  return parameter != nullptr && parameter->given;
}

Location Parameters::location(std::string_view name) const {
  const Parameter *parameter = find(parameters_, name);
  return parameter != nullptr && parameter->given ? parameter->location : Location{};
}

bool Parameters::boolean(std::string_view name) const { return get<bool>(parameters_, name); }

std::int64_t Parameters::integer(std::string_view name) const { return get<std::int64_t>(parameters_, name); }

double Parameters::real(std::string_view name) const { return get<double>(parameters_, name); }

const std::string &Parameters::text(std::string_view name) const { return get<std::string>(parameters_, name); }

Point Parameters::point(std::string_view name) const { return get<Point>(parameters_, name); }

std::string to_text(const Value &value) {
  struct Printer {
    std::string operator()(bool v) const { return v ? "true" : "false"; }
    std::string operator()(std::int64_t v) const { return fmt::format("{}", v); }
    std::string operator()(double v) const { return fmt::format("{}", v); }
    std::string operator()(const std::string &v) const { return v; }
    std::string operator()(const Point &v) const { return fmt::format("[{}, {}]", v[0], v[1]); }
  };
  return std::visit(Printer{}, value);
}

} // namespace comparisons::scene
