// SPDX-License-Identifier: MIT
// The grid of boxes against all pairs.
#include "mechanics/rubble/box_pairs.hpp"

#include <catch2/catch.hpp>

#include <limits>
#include <random>

using namespace sunder;

TEST_CASE("the grid finds the pairs that comparing all finds", "[rubble]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  BoxScratch scratch;
  std::vector<RowPair> fast, slow;
  for (int trial = 0; trial < 60; ++trial) {
    const auto count = static_cast<std::size_t>(random() % 300);
    const double size = trial % 3 == 0 ? 0.02 : 0.2;
    std::vector<Bounds> boxes;
    std::vector<std::uint32_t> body;
    std::vector<char> moves(40);
    for (char& m : moves) m = random() % 3 != 0;
    for (std::size_t k = 0; k < count; ++k) {
      const Vec3 at(any(random), any(random), any(random));
      Vec3 half = size * Vec3(any(random), any(random), any(random)).cwiseAbs();
      if (random() % 50 == 0) half *= 100;
      boxes.push_back({at - half, at + half});
      if (random() % 40 == 0) boxes.back().low[0] = std::numeric_limits<double>::quiet_NaN();
      if (random() % 40 == 0) boxes.back() = {Vec3::Constant(-1e308), Vec3::Constant(1e308)};
      body.push_back(static_cast<std::uint32_t>(random() % 40));
    }
    const BoxQuery query{boxes, body, moves};
    find_box_pairs(fast, scratch, query);
    find_box_pairs_brute_force(slow, query);
    REQUIRE(fast == slow);
  }
}
