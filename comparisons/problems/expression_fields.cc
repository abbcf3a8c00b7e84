#include "comparisons/problems/expression_fields.h"

#include "comparisons/scene/expression.h"

#include <charconv>
#include <mutex>
#include <optional>

namespace comparisons::problems {

namespace {

std::optional<double> constant(const std::string &text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

} // namespace

struct ScalarField::Function {
  std::optional<double> constant;
  std::unique_ptr<scene::Expression> expression;
  /// The parser keeps its variables within itself.
  mutable std::mutex mutex;
};

ScalarField::ScalarField(const std::string &text) {
  auto function = std::make_shared<Function>();
  function->constant = constant(text);
  if (!function->constant)
    function->expression = std::make_unique<scene::Expression>(text, 2);
  function_ = std::move(function);
}

void ScalarField::evaluate(std::span<const Point2> points, std::span<double> values) const {
  if (function_->constant) {
    std::fill(values.begin(), values.end(), *function_->constant);
    return;
  }
  const std::lock_guard lock(function_->mutex);
  for (std::size_t i = 0; i < points.size(); ++i)
    values[i] = function_->expression->value({points[i][0], points[i][1], 0});
}

double ScalarField::value(const Point2 &point) const {
  double result = 0;
  evaluate({&point, 1}, {&result, 1});
  return result;
}

namespace {

/// Fills the components of `values` from one field each.
template <std::size_t n>
void fill(const std::array<ScalarField, n> &fields, std::span<const Point2> points,
          std::span<std::array<double, n>> values) {
  std::vector<double> component(points.size());
  for (std::size_t k = 0; k < n; ++k) {
    fields[k].evaluate(points, component);
    for (std::size_t i = 0; i < points.size(); ++i)
      values[i][k] = component[i];
  }
}

} // namespace

ScalarValues scalar_values(const std::string &text, double factor) {
  return [field = ScalarField(text), factor](std::span<const Point2> points, std::span<double> values) {
    field.evaluate(points, values);
    for (double &value : values)
      value *= factor;
  };
}

VectorField vector_field(const std::array<std::string, 2> &texts) {
  const std::array fields{ScalarField(texts[0]), ScalarField(texts[1])};
  return [fields](std::span<const Point2> points, std::span<Vector2> values) { fill(fields, points, values); };
}

StressField stress_field(const std::array<std::string, 3> &texts) {
  const std::array fields{ScalarField(texts[0]), ScalarField(texts[1]), ScalarField(texts[2])};
  return [fields](std::span<const Point2> points, std::span<Stress2> values) { fill(fields, points, values); };
}

TractionField traction_field(const std::array<std::string, 2> &texts) {
  return [field = vector_field(texts)](std::span<const Point2> points, std::span<const Vector2>,
                                       std::span<Vector2> values) { field(points, values); };
}

TractionField pressure_field(const std::string &text) {
  return [field = ScalarField(text)](std::span<const Point2> points, std::span<const Vector2> normals,
                                     std::span<Vector2> values) {
    std::vector<double> pressure(points.size());
    field.evaluate(points, pressure);
    for (std::size_t i = 0; i < points.size(); ++i)
      values[i] = {-pressure[i] * normals[i][0], -pressure[i] * normals[i][1]};
  };
}

TractionField traction_of(StressField stress) {
  return [stress = std::move(stress)](std::span<const Point2> points, std::span<const Vector2> normals,
                                      std::span<Vector2> values) {
    std::vector<Stress2> s(points.size());
    stress(points, s);
    for (std::size_t i = 0; i < points.size(); ++i)
      values[i] = {s[i][0] * normals[i][0] + s[i][2] * normals[i][1],
                   s[i][2] * normals[i][0] + s[i][1] * normals[i][1]};
  };
}

} // namespace comparisons::problems
