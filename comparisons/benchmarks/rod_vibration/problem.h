#pragma once

#include "comparisons/study/catalogue.h"

namespace comparisons::benchmarks::rod_vibration {

/// Natural frequencies of an elastic rod with fixed ends; Asprone, Auricchio & Reali 2010, section 5.3. With N
/// particles there are N - 2 modes: the squares of the frequencies are the eigenvalues of -(E / density) D2 without the
/// rows and columns of the ends. D2 is not symmetric; modes are counted by the real part.
///
/// Quantities: `ratio_<n>`, computed over exact frequency n pi c / length of modes 1, 2, 10, 50 and 98; `n_modes`;
/// `imaginary_part`, the largest over the largest eigenvalue; `n_complex` and `n_negative`, eigenvalues with an
/// imaginary part above rounding and with a real part that is not positive.
study::Benchmark benchmark();

} // namespace comparisons::benchmarks::rod_vibration
