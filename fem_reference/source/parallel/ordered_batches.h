#pragma once

#include "fem_reference/threads.h"

#include <tbb/parallel_pipeline.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <memory>
#include <optional>

namespace fem_reference::parallel {
/// Makes something of every batch [begin, end) of 0 ... n - 1, several at once, and takes what was made in the order of
/// the batches, one after the other: the outcome does not depend on the number of threads. Few results exist at a time.
///
/// If batches throw, the exception of the first of them is thrown, after the others.
/// @param make (begin, end) -> Result, called by several threads
/// @param take (begin, const Result &)
template <typename Result, typename Make, typename Take>
void in_ordered_batches(std::size_t n, std::size_t size, const Make &make, const Take &take) {
  if (threads() == 1) {
    for (std::size_t begin = 0; begin < n; begin += size)
      take(begin, make(begin, std::min(n, begin + size)));
    return;
  }
  struct Item {
    std::size_t begin = 0;
    std::optional<Result> result;
    std::exception_ptr error;
  };
  using Pointer = std::shared_ptr<Item>;
  std::size_t next = 0;
  std::exception_ptr error;
  const auto give = [&](tbb::flow_control &flow) -> std::size_t {
    const std::size_t begin = next;
    next += size;
    if (begin >= n)
      flow.stop();
    return begin;
  };
  const auto run = [&](std::size_t begin) {
    auto item = std::make_shared<Item>();
    item->begin = begin;
    try {
      item->result = make(begin, std::min(n, begin + size));
    } catch (...) {
      item->error = std::current_exception();
    }
    return item;
  };
  const auto use = [&](const Pointer &item) {
    if (!error)
      error = item->error;
    if (!error)
      take(item->begin, *item->result);
  };
  // As many batches under way as threads: no more of them take part.
  tbb::parallel_pipeline(static_cast<std::size_t>(threads()),
                         tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, give) &
                             tbb::make_filter<std::size_t, Pointer>(tbb::filter_mode::parallel, run) &
                             tbb::make_filter<Pointer, void>(tbb::filter_mode::serial_in_order, use));
  if (error)
    std::rethrow_exception(error);
}
} // namespace fem_reference::parallel
