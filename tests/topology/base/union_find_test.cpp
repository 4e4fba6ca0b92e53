// SPDX-License-Identifier: MIT
// Sets by union-find, and the parts of a star.
#include "topology/base/union_find.hpp"

#include <catch2/catch.hpp>

#include <random>

#include "tests/support/built.hpp"
#include "topology/base/star_parts.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

TEST_CASE("the lowest member of a set is its root, in whatever order sets are joined",
          "[topology][union_find]") {
  const std::uint64_t seed = 51;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  for (int trial = 0; trial < 50; ++trial) {
    UnionFind sets(40);
    REQUIRE(sets.size() == 40);
    std::vector<std::uint32_t> label(40);  // relabelled one by one, the slow way
    std::iota(label.begin(), label.end(), 0U);
    for (int k = 0; k < 25; ++k) {
      const auto a = static_cast<std::uint32_t>(below(random, 40));
      const auto b = static_cast<std::uint32_t>(below(random, 40));
      sets.join(a, b);
      const auto [low, high] = std::minmax({label[a], label[b]});
      std::ranges::replace(label, std::uint32_t{high}, std::uint32_t{low});
    }
    for (std::uint32_t i = 0; i < 40; ++i) REQUIRE(sets.root(i) == label[i]);
    CHECK(std::move(sets).roots() == label);
  }
}

TEST_CASE("a star falls into the orbits that splitting the cut faces gives its vertex",
          "[topology][star_parts]") {
  const std::uint64_t seed = 52;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  int parted = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const VolumeMap intact = built(kuhn_box({2, 2, 2}));
    const VertexId v{below(random, intact.vertices())};
    const std::vector<TetId> tets = star(intact, v);
    VolumeMap map = intact;
    std::vector<HalfFaceId> cut;
    for (const HalfFaceId f : interior_faces(map)) {
      if (below(random, 3) == 0) continue;
      cut.push_back(f);
      cut.push_back(map.neighbour(f));
      split_face(map, f);
    }
    std::ranges::sort(cut);
    const auto parts = star_parts(tets, [&](TetId t, int p) -> std::optional<TetId> {
      const HalfFaceId other = intact.neighbour(half_face(t, p));
      if (other.is_none() || std::ranges::binary_search(cut, other)) return std::nullopt;
      return tetrahedron_of(other);
    });
    const auto row = [&](std::size_t i) {
      for (const VertexId w : map.corners(tets[i])) {
        if (map.point_of_vertex(w) == v.value) return w;
      }
      return VertexId::none();
    };
    for (std::size_t i = 0; i < tets.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) REQUIRE((row(i) == row(j)) == (parts[i] == parts[j]));
      CHECK(parts[i] <= i);
      parted += parts[i] != 0;
    }
  }
  CHECK(parted > 100);
}

TEST_CASE("what lies behind the end of a star is not of it", "[topology][star_parts]") {
  std::vector<std::uint32_t> star = {2, 3, 5};
  star.pop_back();  // its row stands there still
  const auto parts = star_parts(star, [](std::uint32_t, int) { return std::optional{5U}; });
  CHECK(parts == std::vector<std::uint32_t>{0, 1});
}
