// SPDX-License-Identifier: MIT
#include "mechanics/solver/parallel.hpp"

#include <catch2/catch.hpp>
#include <stdexcept>

using sunder::parallel_for;

TEST_CASE("every item is worked on once, on any number of threads", "[mechanics][parallel]") {
  const unsigned threads = GENERATE(0u, 1u, 2u, 7u);
  const std::size_t count = GENERATE(0u, 1u, 5u, 1000u);
  std::vector<int> done(count, 0);
  std::atomic<unsigned> highest = 0;
  parallel_for(threads, count, [&](std::size_t item, unsigned worker) {
    ++done[item];
    unsigned seen = highest;
    while (worker > seen && !highest.compare_exchange_weak(seen, worker)) {
    }
  });
  CHECK(done == std::vector<int>(count, 1));
  CHECK(highest < std::max(threads, 1u));
}

TEST_CASE("what an item throws is thrown on", "[mechanics][parallel]") {
  const unsigned threads = GENERATE(1u, 3u);
  CHECK_THROWS_AS(parallel_for(threads, 100,
                               [](std::size_t item, unsigned) {
                                 if (item == 42) throw std::runtime_error("42");
                               }),
                  std::runtime_error);
}
