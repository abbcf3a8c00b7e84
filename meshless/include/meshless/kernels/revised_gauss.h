#pragma once

#include "meshless/kernels/gauss.h"

namespace meshless::kernels {

/// Revised Gauss function, Zhang & Batra 2008, Eqs. (6.2) and (6.8): the Gauss function of
/// kernels/gauss.h with the cut-off rho = 2.
/// G = 1.04823, 1.10081, 1.18516 in one, two, three dimensions.
class RevisedGauss : public Gauss {
public:
  RevisedGauss() : Gauss(2) {}
};

} // namespace meshless::kernels
