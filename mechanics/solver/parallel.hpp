// SPDX-License-Identifier: MIT
// Independent pieces of work on a few threads.
#pragma once

#include <algorithm>
#include <cstddef>

#if !defined(SUNDER_SERIAL)
#include <atomic>
#include <exception>
#include <system_error>
#include <thread>
#include <vector>
#endif

namespace sunder {

/// Calls `work(item, worker)` once for every item below `count`, on at most `threads` threads
/// (fewer where the system gives no more). The caller's is worker 0, and items are handed out in
/// rising order. No item may write data that others read, or add to common sums: then results are
/// the same bytes on any number of threads. Threads live for this call (up to 90 microseconds
/// each), so it pays from a millisecond of work on. An exception of an item is thrown on when all
/// have stopped. Where the build has no threads (SUNDER_SERIAL) the caller does all.
template <class Work>
void parallel_for(unsigned threads, std::size_t count, const Work& work) {
#if defined(SUNDER_SERIAL)
  const unsigned workers = 1;
  static_cast<void>(threads);
#else
  const auto workers = static_cast<unsigned>(std::min<std::size_t>(std::max(threads, 1u), count));
#endif
  if (workers <= 1) {
    for (std::size_t item = 0; item < count; ++item) work(item, 0u);
    return;
  }
#if !defined(SUNDER_SERIAL)
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
    try {
      for (unsigned worker = 1; worker < workers; ++worker) others.emplace_back(run, worker);
    } catch (const std::system_error&) {
      // The system gives no more: those that are there do it all.
    }
    run(0);
  }
  for (const std::exception_ptr& exception : thrown) {
    if (exception) std::rethrow_exception(exception);
  }
#endif
}

}  // namespace sunder
