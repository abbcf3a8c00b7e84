#pragma once

#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <memory>

namespace meshless::parallel {

/// Makes something of every chunk [begin, end) of 0 ... n - 1, several at once, and takes what was made in the order of
/// the chunks, one after the other: the outcome does not depend on the number of threads. What is left to do with them
/// is finished several at once again. Few results exist at a time.
///
/// If chunks throw, the exception of the first of them is thrown, after the others.
/// @param make (begin, end) -> Result, called by several threads
/// @param take (Result &)
/// @param finish (Result &) of one that was taken
template <typename Result, typename Make, typename Take, typename Finish>
void in_ordered_chunks(std::size_t n, std::size_t chunk, int n_threads, const Make &make, const Take &take,
                       const Finish &finish) {
  struct Item {
    std::unique_ptr<Result> result;
    bool taken = false;
    std::exception_ptr error;
  };
  std::size_t next = 0;
  std::exception_ptr error;
  const auto give = [&](tbb::flow_control &flow) -> std::size_t {
    if (next >= n) {
      flow.stop();
      return 0;
    }
    const std::size_t begin = next;
    next += chunk;
    return begin;
  };
  const auto run = [&](std::size_t begin) {
    auto item = std::make_shared<Item>();
    try {
      item->result = std::make_unique<Result>(make(begin, std::min(n, begin + chunk)));
    } catch (...) {
      item->error = std::current_exception();
    }
    return item;
  };
  const auto use = [&](std::shared_ptr<Item> item) {
    if (error)
      return item;
    if (item->error)
      error = item->error;
    else {
      take(*item->result);
      item->taken = true;
    }
    return item;
  };
  const auto end = [&](const std::shared_ptr<Item> &item) {
    if (item->taken)
      finish(*item->result);
  };
  // More than the machine has would only draw a warning.
  tbb::task_arena arena(std::min(n_threads, tbb::this_task_arena::max_concurrency()));
  arena.execute([&] {
    tbb::parallel_pipeline(
        4 * static_cast<std::size_t>(n_threads),
        tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, give) &
            tbb::make_filter<std::size_t, std::shared_ptr<Item>>(tbb::filter_mode::parallel, run) &
            tbb::make_filter<std::shared_ptr<Item>, std::shared_ptr<Item>>(tbb::filter_mode::serial_in_order, use) &
            tbb::make_filter<std::shared_ptr<Item>, void>(tbb::filter_mode::parallel, end));
  });
  if (error)
    std::rethrow_exception(error);
}

template <typename Result, typename Make, typename Take>
void in_ordered_chunks(std::size_t n, std::size_t chunk, int n_threads, const Make &make, const Take &take) {
  in_ordered_chunks<Result>(n, chunk, n_threads, make, take, [](Result &) {});
}

} // namespace meshless::parallel
