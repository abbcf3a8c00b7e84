#include "meshless/basis/msph.h"

#include "meshless/basis/fpm.h"
#include "meshless/basis/monomials.h"
#include "pointwise_basis.h"

#include <fmt/format.h>

#include <stdexcept>

namespace meshless::basis {

namespace {

template <int dim, int m>
class Msph final : public PointwiseBasis<dim> {
  using Terms = Monomials<dim, m>;
  static constexpr std::size_t n = Terms::size;

public:
  using typename PointwiseBasis<dim>::Place;

  Msph(const kernels::Kernel &kernel, EdgeRule edge, OperatorRule rule = {})
      : PointwiseBasis<dim>(kernel, edge), rule_(rule) {}

  int order() const override { return m; }
  std::size_t n_terms() const override { return n; }
  OperatorRule operator_rule() const override { return rule_; }

private:
  void check_wanted(const Wanted &wanted) const override {
    if (wanted.differentiated_gradient)
      throw std::invalid_argument("msph and fpm do not differentiate their shape functions; choose direct derivatives");
    if (wanted.hessian && m < 2)
      throw std::invalid_argument(rule_.reiterate
                                      ? "fpm has second derivatives at particles only, by applying the first twice: "
                                        "make_derivative_operators gives them"
                                      : "second derivatives need a basis of order 2 at least");
  }

  double evaluate_point(const Place &place) const override {
    auto &projection = place.workspace.projections[0];
    projection.resize(n, place.size());
    std::array<double, n> terms;
    for (std::size_t j = 0; j < place.size(); ++j) {
      const auto &neighbour = place.neighbours.all[j];
      const auto tests = projection.tests(j);
      tests[0] = neighbour.weight;
      std::copy(neighbour.gradient.begin(), neighbour.gradient.end(), tests.begin() + 1);
      if constexpr (m == 2)
        std::copy(neighbour.hessian.begin(), neighbour.hessian.end(), tests.begin() + 1 + dim);
      Terms::evaluate(neighbour.offset, terms);
      std::copy(terms.begin(), terms.end(), projection.terms(j).begin());
    }
    const double ratio = projection.factorise();
    if (!(ratio > 0))
      return 0;
    auto &shape = place.workspace.numbers;
    shape.resize(place.size());
    const double per_length = 1 / place.scale;
    const auto put = [&](std::size_t term, double factor) {
      projection.shape_functions(term, factor, shape);
      place.write(static_cast<int>(term), shape); // quantities are in the order of the terms
    };
    if (place.wanted.value)
      put(0, 1);
    for (std::size_t k = 0; k < dim && place.wanted.gradient; ++k)
      put(1 + k, per_length);
    if constexpr (m == 2)
      if (place.wanted.hessian) {
        std::size_t term = 1 + dim;
        for (int k = 0; k < dim; ++k)
          for (int l = k; l < dim; ++l, ++term)
            put(term, (k == l ? 2 : 1) * per_length * per_length);
      }
    return ratio;
  }

  OperatorRule rule_;
};

} // namespace

template <int dim>
std::unique_ptr<ShapeFunctions<dim>> make_msph(int order, const kernels::Kernel &kernel, const BasisOptions &options) {
  if (order == 2 && std::holds_alternative<kernels::Linear>(kernel))
    throw std::invalid_argument("msph of order 2 projects on the second derivatives of the kernel, and that of linear "
                                "is zero: its matrix is singular; choose another kernel, such as quadratic");
  switch (order) {
  case 1:
    return std::make_unique<Msph<dim, 1>>(kernel, options.edge);
  case 2:
    return std::make_unique<Msph<dim, 2>>(kernel, options.edge);
  default:
    throw std::invalid_argument(fmt::format("MSPH of order {}; the orders are 1 and 2", order));
  }
}

template std::unique_ptr<ShapeFunctions<1>> make_msph<1>(int, const kernels::Kernel &, const BasisOptions &);
template std::unique_ptr<ShapeFunctions<2>> make_msph<2>(int, const kernels::Kernel &, const BasisOptions &);
template std::unique_ptr<ShapeFunctions<3>> make_msph<3>(int, const kernels::Kernel &, const BasisOptions &);

std::unique_ptr<ShapeFunctions<1>> make_fpm(const kernels::Kernel &kernel, const BasisOptions &options) {
  return std::make_unique<Msph<1, 1>>(kernel, options.edge,
                                      OperatorRule{.subtract_own_value = false, .reiterate = true});
}

} // namespace meshless::basis
