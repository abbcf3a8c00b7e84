#pragma once

namespace meshless::parallel {

/// Threads that assembly may use from now on, one at first. As BLAS has it, this is a setting of the process: change it
/// between solves, not during one.
/// @throws std::invalid_argument unless n >= 1
void set_threads(int n);
int threads();

} // namespace meshless::parallel
