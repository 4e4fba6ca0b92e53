// SPDX-License-Identifier: MIT
// Parts of a divided step: they fill it, are short where something passes, and long elsewhere.
#include "mechanics/contact/step_division.hpp"

#include <catch2/catch.hpp>
#include <random>
#include <vector>

using namespace sunder;

namespace {

/// Parts of a step in whole numbers, 1 << 20 in all.
struct Taken {
  std::uint64_t from, length;
};
constexpr std::uint64_t whole = 1u << 20;

/// Takes a step in which pieces pass each other in any part that is longer than `shortest` and has
/// the moment in it. They move `way` edges in the whole step.
std::vector<Taken> take_step(std::uint64_t moment, std::uint64_t shortest, double way, int& tries) {
  StepDivision division;
  std::vector<Taken> taken;
  tries = 0;
  while (division.taken < division.parts) {
    const std::uint64_t length = whole / division.parts, from = division.taken * length;
    ++tries;
    const bool passes = from <= moment && moment < from + length && length > shortest;
    if (passes && division.may_divide()) {
      divide(division, way / division.parts);
      continue;
    }
    taken.push_back({from, length});
    take_part(division);
  }
  return taken;
}

}  // namespace

TEST_CASE("parts of a divided step follow each other and fill it", "[mechanics][contact]") {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 500; ++trial) {
    const std::uint64_t moment = random() % whole, shortest = whole >> (random() % 17);
    const double way = static_cast<double>(random() % 100000);
    int tries = 0;
    std::uint64_t end = 0;
    for (const auto& [from, length] : take_step(moment, shortest, way, tries)) {
      REQUIRE(from == end);
      end += length;
    }
    CHECK(end == whole);
    CHECK(tries < 200);
  }
}

TEST_CASE("a part is as short as the way of passing pieces asks for, to a limit",
          "[mechanics][contact]") {
  const double way = GENERATE(0.1, 100.0, 3000.0, 1e9);
  const std::uint64_t moment = whole / 3, shortest = GENERATE(1ul, 64ul, 8192ul);
  INFO(way << " edges, shortest " << shortest);
  int tries = 0;
  std::uint64_t length = whole;
  for (const Taken& part : take_step(moment, shortest, way, tries)) {
    if (part.from <= moment && moment < part.from + part.length) length = part.length;
  }
  const std::uint64_t limit = way > 32768 ? 65536 : way > 2048 ? 8192 : 256;
  CHECK(length == std::max(shortest, whole / limit));
}
