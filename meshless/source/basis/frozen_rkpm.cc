#include "meshless/basis/frozen_rkpm.h"

#include "pointwise_basis.h"

#include <fmt/format.h>

#include <stdexcept>

namespace meshless::basis {

namespace {

class FrozenRkpm final : public PointwiseBasis<1> {
public:
  FrozenRkpm(int order, const kernels::Kernel &kernel, EdgeRule edge)
      : PointwiseBasis<1>(kernel, edge), order_(order) {}

  int order() const override { return order_; }
  std::size_t n_terms() const override { return static_cast<std::size_t>(order_) + 1; }
  int reproduced_degree(int derivative) const override { return derivative == 0 ? order_ : 0; }
  OperatorRule operator_rule() const override { return {.subtract_own_value = false, .reiterate = true}; }

private:
  void check_wanted(const Wanted &wanted) const override {
    if (wanted.differentiated_gradient)
      throw std::invalid_argument(
          "the RKPM with frozen coefficients does not differentiate its shape functions; choose "
          "rkpm, or direct derivatives");
    if (wanted.hessian)
      throw std::invalid_argument("the RKPM with frozen coefficients has second derivatives at particles only, by "
                                  "applying the first twice: make_derivative_operators gives them");
  }

  double evaluate_point(const Place &place) const override {
    const std::size_t n = n_terms();
    auto &projection = place.workspace.projections[0];
    projection.resize(n, place.size());
    for (std::size_t j = 0; j < place.size(); ++j) {
      const auto &neighbour = place.neighbours.all[j];
      double term = 1;
      for (std::size_t t = 0; t < n; ++t, term *= neighbour.offset[0]) {
        projection.terms(j)[t] = term;
        projection.tests(j)[t] = term * neighbour.weight;
      }
    }
    const double ratio = projection.factorise();
    if (!(ratio > 0))
      return 0;
    auto &shape = place.workspace.numbers;
    shape.resize(place.size());
    if (place.wanted.value) {
      projection.shape_functions(0, 1, shape);
      place.write(0, shape);
    }
    if (place.wanted.gradient)
      write_gradient(place, projection.coefficients(0), shape);
    return ratio;
  }

  /// (25): the coefficients of C stay, the argument of C and W moves with the source.
  static void write_gradient(const Place &place, std::span<const double> coefficients, std::vector<double> &shape) {
    double sum = 0;
    for (std::size_t j = 0; j < place.size(); ++j) {
      const auto &neighbour = place.neighbours.all[j];
      const double d = neighbour.offset[0];
      double factor = 0;
      double slope = 0;
      for (std::size_t t = coefficients.size(); t-- > 0;) {
        slope = slope * d + factor;
        factor = factor * d + coefficients[t];
      }
      const double derivative = (factor * neighbour.gradient[0] + slope * neighbour.weight) / place.scale;
      shape[j] = -derivative;
      sum += derivative;
    }
    shape[place.neighbours.nearest] += sum;
    place.write(1, shape);
  }

  int order_;
};

} // namespace

std::unique_ptr<ShapeFunctions<1>> make_frozen_rkpm(int order, const kernels::Kernel &kernel,
                                                    const BasisOptions &options) {
  if (order != 1 && order != 2)
    throw std::invalid_argument(
        fmt::format("RKPM with frozen coefficients of order {}; the orders are 1 and 2", order));
  return std::make_unique<FrozenRkpm>(order, kernel, options.edge);
}

} // namespace meshless::basis
