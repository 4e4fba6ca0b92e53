// SPDX-License-Identifier: MIT
// Node stress (eq. 6) and the threshold in a body under uniform tension, whatever its direction.
#include "fracture/algorithms/node_stress.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <random>

#include "tests/support/tension.hpp"
#include "topology/kernel/fan.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

Vec3 random_direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return Vec3(normal(random), normal(random), normal(random)).normalized();
}

}  // namespace

TEST_CASE("uniaxial patch: node stress is exact to 1e-10 in 20 random directions", "[fracture]") {
  std::mt19937_64 random(2026);
  for (int i = 0; i < 20; ++i) {
    const Vec3 axis = random_direction(random);
    Tension body = uniform_tension(jittered(kuhn_box({3, 3, 3}), 0.15, 5), axis, 2e6);
    std::vector<Mat3> stress;
    average_node_stress(stress, body.elements(), body.cells.map.vertices());
    const Mat3 expected = 2e6 * axis * axis.transpose();
    for (const Mat3& sigma : stress) REQUIRE((sigma - expected).norm() < 1e-10 * 2e6);
  }
}

TEST_CASE("the first fan comes exactly when the stress passes the threshold", "[fracture]") {
  std::mt19937_64 random(2027);
  for (int i = 0; i < 20; ++i) {
    const Vec3 axis = random_direction(random);
    FractureScratch scratch;
    const TetMesh mesh = jittered(kuhn_box({3, 3, 3}), 0.15, 6);
    // 1e-9 is the resolution of the exact test; node stress itself is good to 1e-12 here.
    Tension below = uniform_tension(mesh, axis, (1 - 2e-9) * Material{}.tensile_strength);
    CHECK(break_vertices({below.cells, below.state}, {}, scratch).reached == 0);
    Tension above = uniform_tension(mesh, axis, (1 + 2e-9) * Material{}.tensile_strength);
    const FractureReport report = break_vertices({above.cells, above.state}, {}, scratch);
    CHECK(report.reached == 64);
    REQUIRE(!report.fans.empty());
    CHECK(std::abs(report.fans.front().normal.dot(axis)) == Approx(1).epsilon(1e-9));
  }
}

TEST_CASE("the node stress of a star equals that of the whole pass to the bit", "[fracture]") {
  Tension body = uniform_tension(jittered(kuhn_box({2, 3, 2}), 0.1, 7), Vec3::UnitX(), 1e6);
  for (Mat3& s : body.state.elements.stress) s *= 1 + 0.1 * s(0, 0) / 1e6;
  std::vector<Mat3> stress;
  average_node_stress(stress, body.elements(), body.cells.map.vertices());
  for (std::size_t v = 0; v < stress.size(); ++v) {
    REQUIRE(stress[v] ==
            node_stress_of_star(body.elements(), vertex_star(body.cells.map, VertexId{v}).corners));
  }
}

TEST_CASE("a stress that is not a number stops fracture and names the vertex", "[fracture]") {
  Tension body = uniform_tension(kuhn_box({2, 2, 2}), Vec3::UnitX(), 1e6);
  body.state.elements.stress[5](0, 1) = std::numeric_limits<double>::quiet_NaN();
  FractureScratch scratch;
  const FractureReport report = break_vertices({body.cells, body.state}, {}, scratch);
  REQUIRE(report.not_a_number.has_value());
  CHECK(place_of_vertex(body.cells.map.corners(TetId{5}), *report.not_a_number) < 4);
  CHECK(report.fans.empty());
}
