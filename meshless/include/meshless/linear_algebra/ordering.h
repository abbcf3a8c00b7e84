#pragma once

#include "meshless/linear_algebra/sparse_rows.h"

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace meshless::linear_algebra {

/// In which order the unknowns of a system are eliminated.
enum class Ordering {
  natural, ///< as they are numbered
  rcm,     ///< reverse Cuthill-McKee (1969): a narrow band, neighbours near each other
  amd,     ///< approximate minimum degree (Amestoy, Davis, Duff 1996): little fill
  metis,   ///< nested dissection (METIS, Karypis, Kumar 1998): least fill of large systems
};

struct OrderingDescription {
  Ordering ordering;
  const char *name;
  const char *meaning;
};

/// Every ordering by its name.
std::span<const OrderingDescription> ordering_table();
const char *to_text(Ordering ordering);
/// @throws std::invalid_argument for an unknown name, listing those there are
Ordering ordering_of(std::string_view name);

/// Order of the groups of `group` consecutive unknowns (the particles' unknowns): order[k] is the group at place k.
/// AMD and METIS see the graph of A + A^T, without values.
/// @throws std::invalid_argument if A is not square or `group` does not divide its rows; std::runtime_error if memory
///   runs out
std::vector<std::uint32_t> order_of(const SparseRows &matrix, Ordering ordering, std::size_t group = 2);

} // namespace meshless::linear_algebra
