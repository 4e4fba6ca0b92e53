// SPDX-License-Identifier: MIT
// Our Betti numbers against GUDHI's, on every shape, under cuts, and on bodies with torsion.
#include <catch2/catch.hpp>

#include "tests/topology/suite/abstract_bodies.hpp"
#include "tests/topology/suite/gudhi_homology.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

/// Number of comparisons made.
std::size_t compare_with_gudhi(const GlueTwin& twin) {
  const OrbitComplex complex = orbit_complex(twin);
  const bool directly = is_simplicial(complex);
  for (const int prime : {2, 3}) {
    INFO("over GF(" << prime << ")");
    const BettiNumbers ours = betti_numbers(complex, prime);
    REQUIRE(gudhi_betti_of_subdivision(complex, prime) == ours);
    if (directly) REQUIRE(gudhi_betti(complex, prime) == ours);
  }
  return directly ? 4 : 2;
}

}  // namespace

TEST_CASE("GUDHI finds our Betti numbers on every shape, whole and under random cuts",
          "[suite][homology][gudhi]") {
  const std::uint64_t seed = 91;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  for (const NamedMesh& shape : all_shapes()) {
    INFO(shape.name);
    for (const double probability : {0.0, 0.1, 0.3}) {
      GlueTwin twin = glue_twin(shape.mesh.tetrahedra, shape.mesh.points.size());
      cut_at_random(twin, probability, random);
      compare_with_gudhi(twin);
    }
  }
}

TEST_CASE("GUDHI finds our Betti numbers where there is torsion and no orientation",
          "[suite][homology][gudhi]") {
  for (const Tetrahedra& body : {lens_space(2, 1), lens_space(3, 1), lens_space(5, 2),
                                 sphere_bundle(4, false), sphere_bundle(4, true), three_torus(3)}) {
    CHECK(compare_with_gudhi(glued(body)) == 4);
    CHECK(compare_with_gudhi(glued(Tetrahedra(body.begin(), body.end() - 1))) == 4);
  }
}

TEST_CASE("GUDHI finds our Betti numbers of any gluing", "[suite][homology][gudhi]") {
  const std::uint64_t seed = 92;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  for (int round = 0; round < 100; ++round) {
    INFO("round " << round);
    const auto points = static_cast<std::uint32_t>(5 + below(random, 6));
    GlueTwin twin = glued(random_pseudomanifold(points, 4 + below(random, 60), random));
    cut_at_random(twin, round % 3 == 0 ? 0.1 : 0.0, random);
    compare_with_gudhi(twin);
  }
}

TEST_CASE("two tetrahedra with three of their faces glued are no simplicial complex",
          "[suite][homology][gudhi]") {
  // The mirrored duplicate: vertices, edges and three faces shared, two faces and two tetrahedra on
  // the same points.
  GlueTwin twin = glue_twin({{0, 1, 2, 3}, {0, 1, 3, 2}}, 4);
  unglue(twin, HalfFaceId{0U});
  const OrbitComplex complex = orbit_complex(twin);
  CHECK_FALSE(is_simplicial(complex));
  CHECK(gudhi_betti_of_subdivision(complex, 2) == BettiNumbers{1, 0, 0, 0});
  CHECK(betti_numbers(complex, 2) == BettiNumbers{1, 0, 0, 0});
}
