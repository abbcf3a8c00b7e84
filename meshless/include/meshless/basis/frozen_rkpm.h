#pragma once

#include "meshless/basis/shape_functions.h"
#include "meshless/kernels/kernel_table.h"

#include <memory>

namespace meshless::basis {

/// RKPM with frozen coefficients in one dimension, Asprone, Auricchio & Reali 2010, section 3.3: K_i = C_i W_i (22)
/// with moments 1, 0 (order 1) or 1, 0, 0 (order 2); f' = sum_J (f(x_i) - f_J) K_i'(xi_J) V_J (25) with the derivative
/// in the source variable, a, b, c kept; f'' at particles by applying that twice (26).
///
/// The value reproduces polynomials of degree <= order; f' only constants, and near the ends it does not
/// converge. The other RKPM derivative, that of the corrected kernel by the evaluation point, is
/// basis/rkpm.h. Away from particles the particle next to the point takes the place of particle i.
/// @throws std::invalid_argument for an order other than 1 or 2
std::unique_ptr<ShapeFunctions<1>> make_frozen_rkpm(int order, const kernels::Kernel &kernel,
                                                    const BasisOptions &options = {});

} // namespace meshless::basis
