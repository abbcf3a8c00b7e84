#pragma once

#include "meshless/basis/shape_functions.h"
#include "meshless/kernels/kernel_table.h"

#include <memory>

namespace meshless::basis {

/// Finite particle method in one dimension, Asprone, Auricchio & Reali 2010, section 3.4: f and f' together from the
/// Taylor series of first order projected on W and W' (30), which is MSPH of order 1; f'' at particles by
/// applying f' twice, which does not converge.
std::unique_ptr<ShapeFunctions<1>> make_fpm(const kernels::Kernel &kernel, const BasisOptions &options = {});

/// Modified FPM, section 3.5: f' and f'' together from f - f(x_i) projected on W and W' (36).
///
/// At a particle the value is the particle's own. Elsewhere the particle next to the point takes the place of
/// particle i, as in basis/cspm.h, and the value follows from its Taylor series.
std::unique_ptr<ShapeFunctions<1>> make_modified_fpm(const kernels::Kernel &kernel, const BasisOptions &options = {});

/// Second-order FPM, section 4: as the modified one with the corrected kernel K = C W (39), C = a s^3 + b s + c
/// (40), whose zeroth moment is 1 and whose first and third vanish (42), so that f'' is of second order
/// at the ends too; at particles it is exact for cubics. K' is that in the source variable, C' included, a, b, c
/// frozen. At least four neighbours; a support cut short (2h for a Gaussian of h = spacing) spoils it.
std::unique_ptr<ShapeFunctions<1>> make_fpm2(const kernels::Kernel &kernel, const BasisOptions &options = {});

} // namespace meshless::basis
