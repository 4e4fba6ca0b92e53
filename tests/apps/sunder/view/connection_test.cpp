// SPDX-License-Identifier: MIT
// Which connections `sunder view` drops where more come than it has threads for.
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <vector>

// Last: it brings httplib.h.
#include "apps/sunder/view/connection.hpp"

namespace {

using sunder::Connections;

/// A connection to nobody, with both of its ends.
struct Pair {
  std::array<int, 2> ends{};
  Pair() { REQUIRE(socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()) == 0); }
  ~Pair() {
    for (const int end : ends) ::close(end);
  }
  Pair(const Pair&) = delete;
  Pair& operator=(const Pair&) = delete;

  bool is_dropped() const {
    char byte = 0;
    return recv(ends[1], &byte, 1, MSG_DONTWAIT) == 0;
  }
};

std::vector<std::size_t> dropped(const std::vector<Pair>& pairs) {
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (pairs[i].is_dropped()) numbers.push_back(i);
  }
  return numbers;
}

using Numbers = std::vector<std::size_t>;

}  // namespace

TEST_CASE("view: as many connections are dropped as are beyond the threads", "[view]") {
  constexpr std::size_t threads = 3;
  const std::vector<Pair> pairs(8);
  Connections connections;
  std::vector<Connections::Entry> entries;
  const auto enter = [&] { entries.push_back(connections.enter(pairs[entries.size()].ends[0])); };

  SECTION("they come one after another: the oldest goes for each") {
    for (std::size_t i = 0; i < threads; ++i) {
      connections.arrive(threads);
      enter();
    }
    CHECK(dropped(pairs).empty());
    connections.arrive(threads);
    CHECK(dropped(pairs) == Numbers{0});
    connections.arrive(threads);
    CHECK(dropped(pairs) == Numbers{0, 1});
    connections.leave(entries[0]);
    enter();
    CHECK(dropped(pairs) == Numbers{0, 1});
  }
  SECTION("all arrive before a thread has one: the last ones stay") {
    for (std::size_t i = 0; i < pairs.size(); ++i) connections.arrive(threads);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (i >= threads) connections.leave(entries[i - threads]);
      enter();
    }
    CHECK(dropped(pairs) == Numbers{0, 1, 2, 3, 4});
  }
  SECTION("a request at work is answered before its connection goes") {
    connections.arrive(1);
    enter();
    connections.begin_work(entries[0]);
    connections.arrive(1);
    CHECK(dropped(pairs).empty());
    connections.end_work(entries[0]);
    CHECK(dropped(pairs) == Numbers{0});
  }
  SECTION("connections with the token stay longest") {
    for (std::size_t i = 0; i < threads; ++i) {
      connections.arrive(threads);
      enter();
    }
    connections.begin_work(entries[0]);
    connections.end_work(entries[0]);
    connections.arrive(threads);
    CHECK(dropped(pairs) == Numbers{1});
  }
}
