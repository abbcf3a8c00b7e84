#include "meshless/basis/ssph.h"

#include "weighted_basis.h"

namespace meshless::basis {

template <int dim>
std::unique_ptr<ShapeFunctions<dim>> make_ssph(int order, const kernels::Kernel &kernel, const BasisOptions &options) {
  return make_weighted_basis<dim>("SSPH", order, {kernel, options.volumes, options.edge}, DerivativeKind::direct);
}

template std::unique_ptr<ShapeFunctions<1>> make_ssph<1>(int, const kernels::Kernel &, const BasisOptions &);
template std::unique_ptr<ShapeFunctions<2>> make_ssph<2>(int, const kernels::Kernel &, const BasisOptions &);
template std::unique_ptr<ShapeFunctions<3>> make_ssph<3>(int, const kernels::Kernel &, const BasisOptions &);

} // namespace meshless::basis
