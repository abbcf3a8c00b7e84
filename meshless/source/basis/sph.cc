#include "meshless/basis/sph.h"

#include "pointwise_basis.h"

#include <stdexcept>

namespace meshless::basis {

namespace {

template <int dim>
class Sph final : public PointwiseBasis<dim> {
public:
  using PointwiseBasis<dim>::PointwiseBasis;
  using typename PointwiseBasis<dim>::Place;
  using typename PointwiseBasis<dim>::Values;

  int order() const override { return 0; }
  std::size_t n_terms() const override { return 1; }
  int reproduced_degree(int derivative) const override { return derivative == 0 ? -1 : 0; }
  OperatorRule operator_rule() const override { return {.subtract_own_value = true, .reiterate = true}; }

private:
  void check_wanted(const Wanted &wanted) const override {
    if (wanted.hessian && std::holds_alternative<kernels::Linear>(this->kernel()))
      throw std::invalid_argument("sph takes second derivatives from those of the kernel, which are zero for linear; "
                                  "choose another kernel, or its operators at particles");
  }

  double evaluate_point(const Place &place) const override {
    const double per_length = 1 / place.scale;
    for (const auto &neighbour : place.neighbours.all) {
      const auto put = [&](int quantity, double number) {
        place.values.row(quantity, neighbour.candidate)[place.point] = number;
      };
      if (place.wanted.value)
        put(0, neighbour.weight);
      for (int k = 0; k < dim; ++k) {
        const double derivative = -neighbour.gradient[k] * per_length; // by x, not by xi
        if (place.wanted.gradient)
          put(1 + k, derivative);
        if (place.wanted.differentiated_gradient)
          put(1 + dim + Values::n_hessian + k, derivative);
      }
      for (int kl = 0; kl < Values::n_hessian && place.wanted.hessian; ++kl)
        put(1 + dim + kl, neighbour.hessian[kl] * per_length * per_length);
    }
    return 1;
  }
};

} // namespace

template <int dim>
std::unique_ptr<ShapeFunctions<dim>> make_sph(const kernels::Kernel &kernel, const BasisOptions &options) {
  return std::make_unique<Sph<dim>>(kernel, options.edge);
}

template std::unique_ptr<ShapeFunctions<1>> make_sph<1>(const kernels::Kernel &, const BasisOptions &);
template std::unique_ptr<ShapeFunctions<2>> make_sph<2>(const kernels::Kernel &, const BasisOptions &);
template std::unique_ptr<ShapeFunctions<3>> make_sph<3>(const kernels::Kernel &, const BasisOptions &);

} // namespace meshless::basis
