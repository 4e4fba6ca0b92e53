// SPDX-License-Identifier: MIT
#include "topology/base/fnv1a.hpp"

#include <catch2/catch.hpp>

TEST_CASE("sums of bytes are those that the authors of FNV-1a publish", "[topology][fnv1a]") {
  const auto sum_of = [](std::string_view bytes) {
    sunder::Fnv1a sum;
    sum.add(bytes);
    return sum.value;
  };
  CHECK(sum_of("") == 0xcbf29ce484222325ULL);
  CHECK(sum_of("a") == 0xaf63dc4c8601ec8cULL);
  CHECK(sum_of("foobar") == 0x85944171f73967e8ULL);
}
