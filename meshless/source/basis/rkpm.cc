#include "meshless/basis/rkpm.h"

#include "weighted_basis.h"

namespace meshless::basis {

template <int dim>
std::unique_ptr<ShapeFunctions<dim>> make_rkpm(int order, const kernels::Kernel &kernel, const BasisOptions &options) {
  return make_weighted_basis<dim>("RKPM", order, {kernel, true, options.edge}, DerivativeKind::differentiated);
}

template std::unique_ptr<ShapeFunctions<1>> make_rkpm<1>(int, const kernels::Kernel &, const BasisOptions &);
template std::unique_ptr<ShapeFunctions<2>> make_rkpm<2>(int, const kernels::Kernel &, const BasisOptions &);
template std::unique_ptr<ShapeFunctions<3>> make_rkpm<3>(int, const kernels::Kernel &, const BasisOptions &);

} // namespace meshless::basis
