#include "meshless/basis/fpm.h"

#include "pointwise_basis.h"

#include <stdexcept>

namespace meshless::basis {

namespace {

/// First and second derivative together from f - f(x_i), projected on a kernel and its derivative.
class DifferenceFpm final : public PointwiseBasis<1> {
public:
  /// @param corrected the kernel is that of the second-order FPM
  DifferenceFpm(const kernels::Kernel &kernel, EdgeRule edge, bool corrected)
      : PointwiseBasis<1>(kernel, edge), corrected_(corrected) {}

  int order() const override { return 2; }
  std::size_t n_terms() const override { return corrected_ ? 4 : 3; }
  /// The third moment of the corrected kernel vanishes: its second derivative holds for cubics too.
  int reproduced_degree(int derivative) const override { return corrected_ && derivative == 2 ? 3 : 2; }

private:
  void check_wanted(const Wanted &wanted) const override {
    if (wanted.differentiated_gradient)
      throw std::invalid_argument("fpm does not differentiate its shape functions; choose direct derivatives");
  }

  double evaluate_point(const Place &place) const override {
    double ratio = 1;
    std::array<double, 3> correction{1, 0, 0}; // c, b, a
    if (corrected_)
      ratio = find_correction(place, correction);
    if (!(ratio > 0))
      return 0;
    const auto &[c, b, a] = correction;
    auto &projection = place.workspace.projections[1];
    projection.resize(2, place.size());
    const double own = place.nearest().offset[0];
    for (std::size_t j = 0; j < place.size(); ++j) {
      const auto &neighbour = place.neighbours.all[j];
      const double d = neighbour.offset[0];
      const double factor = c + d * (b + d * d * a);
      const double slope = b + 3 * a * d * d;
      projection.tests(j)[0] = factor * neighbour.weight;
      projection.tests(j)[1] = factor * neighbour.gradient[0] + slope * neighbour.weight;
      projection.terms(j)[0] = d - own;
      projection.terms(j)[1] = d * d - own * own;
    }
    ratio = std::min(ratio, projection.factorise());
    if (!(ratio > 0))
      return 0;
    write(place, projection);
    return ratio;
  }

  /// K = (c + b d + a d^3) W with the moments 1, 0, 0 of degree 0, 1, 3.
  static double find_correction(const Place &place, std::array<double, 3> &correction) {
    auto &projection = place.workspace.projections[0];
    projection.resize(3, place.size());
    for (std::size_t j = 0; j < place.size(); ++j) {
      const auto &neighbour = place.neighbours.all[j];
      const double d = neighbour.offset[0];
      const double terms[] = {1, d, d * d * d};
      for (std::size_t t = 0; t < 3; ++t) {
        projection.terms(j)[t] = terms[t];
        projection.tests(j)[t] = terms[t] * neighbour.weight;
      }
    }
    const double ratio = projection.factorise();
    if (ratio > 0) {
      const auto solution = projection.coefficients(0);
      std::copy(solution.begin(), solution.end(), correction.begin());
    }
    return ratio;
  }

  static void write(const Place &place, TaylorProjection &projection) {
    const std::size_t n = place.size();
    const std::size_t nearest = place.neighbours.nearest;
    auto &numbers = place.workspace.numbers;
    numbers.assign(3 * n, 0.0);
    const auto value = std::span(numbers).first(n);
    value[nearest] = 1;
    const double own = place.nearest().offset[0];
    for (std::size_t derivative = 1; derivative <= 2; ++derivative) {
      const auto shape = std::span(numbers).subspan(derivative * n, n);
      projection.shape_functions(derivative - 1, 1, shape);
      double sum = 0;
      for (const double number : shape)
        sum += number;
      shape[nearest] -= sum;
      // f(x) = f_i less the terms of the series at particle i.
      const double term = derivative == 1 ? own : own * own;
      for (std::size_t j = 0; j < n; ++j)
        value[j] -= term * shape[j];
      const double unit = derivative == 1 ? 1 / place.scale : 2 / (place.scale * place.scale);
      for (double &number : shape)
        number *= unit;
      if (derivative == 1 ? place.wanted.gradient : place.wanted.hessian)
        place.write(static_cast<int>(derivative), shape);
    }
    if (place.wanted.value)
      place.write(0, value);
  }

  bool corrected_;
};

} // namespace

std::unique_ptr<ShapeFunctions<1>> make_modified_fpm(const kernels::Kernel &kernel, const BasisOptions &options) {
  return std::make_unique<DifferenceFpm>(kernel, options.edge, false);
}

std::unique_ptr<ShapeFunctions<1>> make_fpm2(const kernels::Kernel &kernel, const BasisOptions &options) {
  return std::make_unique<DifferenceFpm>(kernel, options.edge, true);
}

} // namespace meshless::basis
