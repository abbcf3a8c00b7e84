#include "meshless/basis/mls.h"

#include "weighted_basis.h"

namespace meshless::basis {

template <int dim>
std::unique_ptr<ShapeFunctions<dim>> make_mls(int order, const kernels::Kernel &kernel, const BasisOptions &options) {
  return make_weighted_basis<dim>("MLS", order, {kernel, options.volumes, options.edge},
                                  DerivativeKind::differentiated);
}

template std::unique_ptr<ShapeFunctions<1>> make_mls<1>(int, const kernels::Kernel &, const BasisOptions &);
template std::unique_ptr<ShapeFunctions<2>> make_mls<2>(int, const kernels::Kernel &, const BasisOptions &);
template std::unique_ptr<ShapeFunctions<3>> make_mls<3>(int, const kernels::Kernel &, const BasisOptions &);

} // namespace meshless::basis
