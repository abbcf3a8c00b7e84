#pragma once

#include <cstdint>
#include <span>

namespace comparisons::metrics {

/// Half-bandwidth max |i - j| of a square matrix, its rows renumbered by Cuthill and McKee from a node of least
/// degree that is far from all others (George & Liu 1979): what a band solver would have to store, whatever order the
/// nodes came in. The pattern counts as symmetric: i and j couple if either of (i, j), (j, i) is there.
/// @param row_start, columns compressed rows
std::int64_t half_bandwidth(std::span<const std::int64_t> row_start, std::span<const std::int64_t> columns);

} // namespace comparisons::metrics
