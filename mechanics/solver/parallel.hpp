// SPDX-License-Identifier: MIT
// Independent pieces of work on a few threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

namespace sunder {

/// Calls `work(item, worker)` once for every item below `count`, on at most `threads` threads; the
/// caller's is worker 0, and items are handed out in rising order. The items must neither write
/// what others read nor add to common sums: then results are the same bytes on any number of
/// threads. Threads live for this call (up to 90 microseconds each), so it pays from a millisecond
/// of work on. What an item throws is thrown on when all have stopped.
template <class Work>
void parallel_for(unsigned threads, std::size_t count, const Work& work) {
  const auto workers = static_cast<unsigned>(std::min<std::size_t>(std::max(threads, 1u), count));
  if (workers <= 1) {
    for (std::size_t item = 0; item < count; ++item) work(item, 0u);
    return;
  }
  std::atomic<std::size_t> next{0};
  std::vector<std::exception_ptr> thrown(workers);
  const auto run = [&](unsigned worker) {
    try {
      for (std::size_t item = next++; item < count; item = next++) work(item, worker);
    } catch (...) {
      thrown[worker] = std::current_exception();
      next = count;
    }
  };
  {
    std::vector<std::jthread> others;
    for (unsigned worker = 1; worker < workers; ++worker) others.emplace_back(run, worker);
    run(0);
  }
  for (const std::exception_ptr& exception : thrown) {
    if (exception) std::rethrow_exception(exception);
  }
}

}  // namespace sunder
