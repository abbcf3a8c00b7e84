#pragma once

namespace comparisons::program {

/// Debian 12's OpenBLAS does not know processors that are newer than itself and then uses its kernels
/// of 2004 (Prescott): sparse factorisations take up to twice as long. If that happened on a processor
/// with AVX2, the program starts itself once more with the kernels for AVX2 (OPENBLAS_CORETYPE). A
/// choice of the user's own is respected. To be called first in main; returns if nothing is to be done.
void restart_with_fast_blas(char **argv);

} // namespace comparisons::program
