#pragma once

#include "meshless/basis/shape_functions.h"
#include "meshless/kernels/kernel_table.h"

#include <memory>

namespace meshless::basis {

/// Corrective smoothed particle method (Chen & Beraun 2000; Asprone, Auricchio & Reali 2010, section 3.2):
/// the Taylor series about particle i is projected on one kernel derivative at a time,
///   f,l  from sum_J (f_J - f_i) W_J,k V_J = f,l sum_J (xi_J - x_i)_l W_J,k V_J (16),
///   f,lm from the next terms projected on W in one dimension (20), where that is the paper's form, and on W,kl in
///   two and three, where one kernel alone gives one equation for several unknowns (as CSPM does originally),
/// with the first derivatives already found. The value is sum_J f_J W_J V_J / sum_J W_J V_J.
/// The value reproduces constants, first derivatives linear functions; second derivatives only those, since
/// near a boundary the first ones are wrong for quadratics.
///
/// The papers define it at particles. Elsewhere the particle next to the point takes the place of particle i,
/// its own offset subtracted from every term: the same at particles, and as exact.
template <int dim>
std::unique_ptr<ShapeFunctions<dim>> make_cspm(const kernels::Kernel &kernel, const BasisOptions &options = {});

} // namespace meshless::basis
