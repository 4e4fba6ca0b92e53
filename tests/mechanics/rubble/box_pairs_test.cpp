// SPDX-License-Identifier: MIT
// The grid of boxes against all pairs.
#include "mechanics/contact/shapes/box_pairs.hpp"

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
    std::vector<Vec3> ways(count);
    for (Vec3& way : ways) {
      way = size * Vec3(any(random), any(random), random() % 3 == 0 ? 0 : any(random));
    }
    for (const BoxQuery& query :
         {BoxQuery{boxes, body, moves}, BoxQuery{boxes, body, moves, ways}}) {
      find_box_pairs(fast, scratch, query);
      find_box_pairs_brute_force(slow, query);
      REQUIRE(fast == slow);
      UnionFind joined(moves.size()), all(moves.size());
      join_bodies(joined, scratch, query);
      for (const auto& [a, b] : slow) all.join(body[a], body[b]);
      for (std::uint32_t k = 0; k < moves.size(); ++k) REQUIRE(joined.root(k) == all.root(k));
    }
  }
}

TEST_CASE("boxes meet on their way when they overlap at one of its moments", "[rubble]") {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto some = [&](double size) {
    return Vec3(size * Vec3(any(random), any(random), any(random)));
  };
  int met = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Vec3 p = some(1), q = some(1), half_p = some(0.4).cwiseAbs(),
               half_q = some(0.4).cwiseAbs();
    const Bounds a{p - half_p, p + half_p}, b{q - half_q, q + half_q};
    Vec3 way = some(1.5);
    if (trial % 4 == 0) way[trial % 3] = 0;
    const auto apart_at = [&](double share) {  // m, along the axis that parts them most
      return ((p + share * way - q).cwiseAbs() - half_p - half_q).maxCoeff();
    };
    double nearest = apart_at(1);
    for (int k = 0; k < 1000; ++k) nearest = std::min(nearest, apart_at(1e-3 * k));
    const double between = 1e-3 * way.norm();
    if (std::abs(nearest) < between) continue;
    CAPTURE(trial, nearest);
    CHECK(meet(a, b, way) == (nearest < 0));
    met += nearest < 0;
  }
  CHECK(met > 100);
}
