#pragma once

namespace meshless::elasticity {

/// What the rows of all particles take, from those of a few.
struct RowSample {
  double nonzeros = 0;
  double seconds = 0;
};

} // namespace meshless::elasticity
