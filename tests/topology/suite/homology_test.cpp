// SPDX-License-Identifier: MIT
// Homology of whole and cut bodies: closed forms, the formula for bodies in space, and laws.
#include "topology/suite/homology/homology.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/topology/suite/abstract_bodies.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

GlueTwin glued(const TetMesh& mesh) { return glue_twin(mesh.tetrahedra, mesh.points.size()); }

IntegerHomology free_homology(const BettiNumbers& betti) { return {betti, {}}; }

IntegerHomology homology_of(const GlueTwin& twin) {
  const OrbitComplex complex = orbit_complex(twin);
  REQUIRE(boundaries_are_closed(complex));
  return integer_homology(complex);
}

BettiNumbers betti_of(const GlueTwin& twin, int prime) {
  return betti_numbers(orbit_complex(twin), prime);
}

/// Takes away the glue of the face on three points. Needs: a glued face is there.
void cut(GlueTwin& twin, std::array<std::uint32_t, 3> face) {
  std::sort(face.begin(), face.end());
  for (std::size_t f = 0; f < twin.glued.size(); ++f) {
    if (twin.glued[f].is_none()) continue;
    auto corners = twin.tetrahedra[f / 4];
    std::swap(corners[f % 4], corners[3]);
    std::sort(corners.begin(), corners.begin() + 3);
    if (!std::equal(face.begin(), face.end(), corners.begin())) continue;
    unglue(twin, HalfFaceId{f});
    return;
  }
  FAIL("no glued face on these points");
}

/// Everything that must hold for any glued body, whole or cut, in space or not.
void check_laws(const GlueTwin& twin) {
  const OrbitComplex complex = orbit_complex(twin);
  REQUIRE(boundaries_are_closed(complex));
  const TwinCounts counts = union_find_counts(twin);
  REQUIRE(complex.cells == std::array<std::size_t, 4>{counts.vertices, counts.edges, counts.faces,
                                                      counts.tetrahedra});
  const IntegerHomology whole = integer_homology(complex);
  const auto alternating = [](const std::array<std::size_t, 4>& n) {
    return static_cast<std::ptrdiff_t>(n[0] + n[2]) - static_cast<std::ptrdiff_t>(n[1] + n[3]);
  };
  REQUIRE(alternating(whole.betti) == alternating(complex.cells));
  REQUIRE(whole.torsion[0].empty());
  REQUIRE(whole.torsion[3].empty());
  // Universal coefficients: each torsion coefficient that the prime divides counts in its own
  // dimension and in the next.
  for (const int prime : {2, 3, 5, 32749}) {
    BettiNumbers expected = whole.betti;
    for (std::size_t d = 0; d < 3; ++d) {
      for (const std::uint64_t n : whole.torsion[d]) {
        const bool divides = n % static_cast<std::uint64_t>(prime) == 0;
        expected[d] += divides ? 1 : 0;
        expected[d + 1] += divides ? 1 : 0;
      }
    }
    REQUIRE(betti_numbers(complex, prime) == expected);
  }
  REQUIRE(whole.betti[0] == counts.components);
}

}  // namespace

TEST_CASE("a ball, a solid torus, a shell and handles have the homology of the books",
          "[suite][homology]") {
  CHECK(homology_of(glued(one_tetrahedron())) == free_homology({1, 0, 0, 0}));
  CHECK(homology_of(glued(kuhn_box({3, 2, 1}))) == free_homology({1, 0, 0, 0}));
  CHECK(homology_of(glued(ring({5, 4, 2}))) == free_homology({1, 1, 0, 0}));
  CHECK(homology_of(glued(joined_ring(4, false))) == free_homology({1, 1, 0, 0}));
  CHECK(homology_of(glued(shell({4, 4, 4}))) == free_homology({1, 0, 1, 0}));
  CHECK(homology_of(glued(crossing_channels())) == free_homology({1, 3, 0, 0}));
  CHECK(homology_of(glued(side_by_side(ring({3, 3, 1}), shell({3, 3, 3})))) ==
        free_homology({2, 1, 1, 0}));
  CHECK(homology_of(glued(TetMesh{})) == free_homology({0, 0, 0, 0}));
}

TEST_CASE("closed manifolds: the 3-sphere, the 3-torus, sphere bundles over the circle",
          "[suite][homology]") {
  CHECK(homology_of(glued(closed_simplex_boundary())) == free_homology({1, 0, 0, 1}));
  CHECK(homology_of(glued(three_torus(3))) == free_homology({1, 3, 3, 1}));
  CHECK(homology_of(glued(sphere_bundle(3, false))) == free_homology({1, 1, 1, 1}));
  const GlueTwin twisted = glued(sphere_bundle(4, true));
  CHECK(homology_of(twisted) == IntegerHomology{{1, 1, 0, 0}, {{{}, {}, {2}, {}}}});
  CHECK(betti_of(twisted, 2) == BettiNumbers{1, 1, 1, 1});
  CHECK(betti_of(twisted, 3) == BettiNumbers{1, 1, 0, 0});
}

TEST_CASE("lens spaces have their torsion, closed and with a ball removed", "[suite][homology]") {
  for (const auto& [p, q] : {std::array{2U, 1U}, {3U, 1U}, {4U, 1U}, {5U, 2U}, {7U, 3U}}) {
    INFO("L(" << p << ", " << q << ")");
    Tetrahedra tetrahedra = lens_space(p, q);
    REQUIRE(tetrahedra.size() == 96 * p);
    const GlueTwin closed = glued(tetrahedra);
    CHECK(is_orientable(closed));
    CHECK(homology_of(closed) == IntegerHomology{{1, 0, 0, 1}, {{{}, {p}, {}, {}}}});
    CHECK(betti_of(closed, 11) == BettiNumbers{1, 0, 0, 1});
    tetrahedra.pop_back();
    const GlueTwin bounded = glued(tetrahedra);
    CHECK(homology_of(bounded) == IntegerHomology{{1, 0, 0, 0}, {{{}, {p}, {}, {}}}});
    if (p != 4) CHECK(betti_of(bounded, static_cast<int>(p)) == BettiNumbers{1, 1, 1, 0});
    check_laws(bounded);
  }
}

TEST_CASE("homology of bodies side by side is the sum, torsion in one chain of divisors",
          "[suite][homology]") {
  Tetrahedra both = lens_space(2, 1);
  for (const std::uint32_t p : {3U, 4U}) {
    const Tetrahedra next = lens_space(p, 1);
    std::uint32_t first = 0;
    for (const auto& t : both) first = std::max(first, 1 + *std::max_element(t.begin(), t.end()));
    for (auto t : next) {
      for (std::uint32_t& point : t) point += first;
      both.push_back(t);
    }
  }
  // Z/2 + Z/3 + Z/4 = Z/2 + Z/12.
  CHECK(homology_of(glued(both)) == IntegerHomology{{3, 0, 0, 3}, {{{}, {2, 12}, {}, {}}}});
}

TEST_CASE("cutting the ring of figure 4 first costs its handle, then makes two balls",
          "[suite][homology][figure4]") {
  GlueTwin twin = glued(ring({3, 3, 1}));
  cut(twin, {1, 5, 21});
  CHECK(homology_of(twin) == free_homology({1, 1, 0, 0}));
  cut(twin, {1, 17, 21});
  CHECK(homology_of(twin) == free_homology({1, 0, 0, 0}));
  cut(twin, {9, 13, 29});
  cut(twin, {9, 25, 29});
  CHECK(homology_of(twin) == free_homology({2, 0, 0, 0}));
}

TEST_CASE("in figure 5 a handle comes and goes between the faces of one fan",
          "[suite][homology][figure5]") {
  GlueTwin twin = glued(kuhn_box({2, 2, 2}));
  cut(twin, {1, 4, 14});
  CHECK(homology_of(twin) == free_homology({1, 0, 0, 0}));
  cut(twin, {4, 14, 17});
  CHECK(homology_of(twin) == free_homology({1, 1, 0, 0}));
  cut(twin, {4, 7, 17});
  CHECK(homology_of(twin) == free_homology({1, 0, 0, 0}));
}

TEST_CASE("an inner crack is a void, and the first cut of a closed body is none",
          "[suite][homology]") {
  GlueTwin cube = glued(kuhn_box({4, 4, 4}));
  cut(cube, {32, 37, 62});
  CHECK(homology_of(cube) == free_homology({1, 0, 1, 0}));
  cut(cube, {32, 57, 62});
  CHECK(homology_of(cube) == free_homology({1, 0, 1, 0}));
  GlueTwin sphere = glued(closed_simplex_boundary());
  cut(sphere, {0, 1, 2});
  CHECK(homology_of(sphere) == free_homology({1, 0, 0, 0}));
}

TEST_CASE("bodies in space under random cuts: b2 = sheets - components over every field",
          "[suite][homology]") {
  const std::uint64_t seed = 71;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  for (const NamedMesh& shape : all_shapes()) {
    if (shape.name == "closed simplex boundary") continue;  // Its tetrahedra overlap in space.
    INFO(shape.name);
    for (const double probability : {0.0, 0.03, 0.1, 0.2, 0.5}) {
      GlueTwin twin = glued(shape.mesh);
      cut_at_random(twin, probability, random);
      const TwinCounts counts = union_find_counts(twin);
      const std::size_t b2 = counts.boundary_sheets - counts.components;
      const std::size_t b1 = counts.components + b2 + counts.edges + counts.tetrahedra -
                             counts.vertices - counts.faces;
      REQUIRE(homology_of(twin) == free_homology({counts.components, b1, b2, 0}));
      check_laws(twin);
      REQUIRE(is_orientable(twin));
    }
  }
}

TEST_CASE("bodies that lie in no space may have more voids than that: S2 x S1 and lens spaces",
          "[suite][homology]") {
  // sheets - components = 0 in both.
  Tetrahedra bundle = sphere_bundle(4, false);
  bundle.pop_back();
  CHECK(homology_of(glued(bundle)) == free_homology({1, 1, 1, 0}));
  Tetrahedra lens = lens_space(3, 1);
  lens.pop_back();
  CHECK(betti_of(glued(lens), 3) == BettiNumbers{1, 1, 1, 0});
  CHECK(betti_of(glued(lens), 2) == BettiNumbers{1, 0, 0, 0});
}

TEST_CASE("any gluing of tetrahedra obeys Euler and universal coefficients", "[suite][homology]") {
  const std::uint64_t seed = 72;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  std::size_t with_torsion = 0, not_orientable = 0;
  for (int round = 0; round < 300; ++round) {
    INFO("round " << round);
    const auto points = static_cast<std::uint32_t>(5 + below(random, 7));
    GlueTwin twin = glued(random_pseudomanifold(points, 4 + below(random, 100), random));
    cut_at_random(twin, round % 3 == 0 ? 0.05 : 0.0, random);
    check_laws(twin);
    const IntegerHomology homology = homology_of(twin);
    with_torsion += homology.torsion[1].empty() && homology.torsion[2].empty() ? 0 : 1;
    not_orientable += is_orientable(twin) ? 0 : 1;
  }
  CHECK(with_torsion > 0);
  CHECK(not_orientable > 0);
}

TEST_CASE("orientable is what has a 3-cycle when closed, and no twist when not",
          "[suite][homology]") {
  CHECK(is_orientable(glued(TetMesh{})));
  CHECK(is_orientable(glued(joined_ring(4, false))));
  CHECK_FALSE(is_orientable(glued(joined_ring(4, true))));
  CHECK_FALSE(is_orientable(glued(joined_ring(5, true))));
  CHECK(is_orientable(glued(sphere_bundle(5, false))));
  CHECK_FALSE(is_orientable(glued(sphere_bundle(5, true))));
  // Cut once across, the twisted ring is a bar.
  GlueTwin bar = glued(joined_ring(4, true));
  std::size_t cuts = 0;
  while (!is_orientable(bar)) {
    std::size_t f = 0;
    while (bar.glued[f].is_none()) ++f;
    unglue(bar, HalfFaceId{f});
    ++cuts;
  }
  CHECK(cuts > 0);
  CHECK(union_find_counts(bar).tetrahedra == 24);
}

TEST_CASE("the numbers do not depend on the order of points, tetrahedra and corners",
          "[suite][homology]") {
  for (const NamedMesh& shape : all_shapes()) {
    INFO(shape.name);
    const IntegerHomology homology = homology_of(glued(shape.mesh));
    CHECK(homology_of(glued(shuffled(shape.mesh, 73))) == homology);
  }
}
