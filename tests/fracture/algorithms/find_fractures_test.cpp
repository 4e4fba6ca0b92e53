// SPDX-License-Identifier: MIT
// Algorithms 3 and 4 line by line, on bodies small enough for known results.
#include "fracture/algorithms/find_fractures.hpp"

#include <catch2/catch.hpp>

#include "fracture/algorithms/split_fan.hpp"
#include "fracture/algorithms/threshold_test.hpp"
#include "tests/support/tension.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

/// Algorithms 3 and 4 as printed: every vertex over its threshold is split at once.
struct Printed {
  FractureReport report;
  NodeStressField field;

  struct Search {
    Tension& body;
    const FractureSettings& settings;
    FractureReport& report;
    std::vector<double> xi = body.cells.strength;
    ComponentScratch scratch = {};

    std::optional<double> threshold(VertexId v) { return xi[v.index()]; }
    void split(VertexId v, const PrincipalTension& tension) {
      report.fans.push_back(split_fan({body.cells, body.state}, vertex_star(body.cells.map, v),
                                      tension.directions.col(0), settings, scratch));
    }
  };

  void run(Tension& body, const FractureSettings& settings) {
    find_fractures(report, field, body.cells,
                   element_stress(body.cells, body.state, settings.node_stress), settings,
                   Search{body, settings, report});
  }
};

FractureSettings as_printed() {
  FractureSettings settings;
  settings.node_stress = NodeStress::mass;
  settings.test = ThresholdTest::gershgorin;
  settings.detection = Detection::oracle;
  return settings;
}

/// Only `weak` can break.
void leave_weak(Tension& body, VertexId weak) {
  for (std::size_t v = 0; v < body.cells.strength.size(); ++v) {
    if (v != weak.index()) body.cells.strength[v] = 1e12;
  }
}

}  // namespace

TEST_CASE("algorithm 3: a vertex over its threshold, its stress, its direction",
          "[fracture][algorithm3]") {
  Tension body = uniform_tension(jittered(kuhn_box({2, 2, 2}, 0.1), 0.01, 3), Vec3::UnitZ(), 1e6);
  // Stresses that differ, so that the mean is one.
  for (std::size_t t = 0; t < body.state.elements.size(); ++t) {
    body.state.elements.stress[t] *= 1 + 0.1 * static_cast<double>(t % 5);
  }
  const VertexId middle{13};
  leave_weak(body, middle);
  Mat3 sum = Mat3::Zero();
  double mass = 0;
  for (const TetId t : star(body.cells.map, middle)) {
    sum += body.state.elements.mass[t.index()] * body.state.elements.stress[t.index()];
    mass += body.state.elements.mass[t.index()];
  }
  const double tension = (sum / mass)(2, 2);  // uniaxial: the largest eigenvalue
  for (const double factor : {1 + 1e-6, 1 - 1e-6}) {
    Tension tried = body;
    tried.cells.strength[middle.index()] = factor * tension;
    Printed printed;
    printed.run(tried, as_printed());
    CHECK(printed.report.tested == 27);
    CHECK((printed.field.value[middle.index()] - sum / mass).norm() < 1e-9 * tension);
    CHECK(gershgorin_bound(printed.field.value[middle.index()]) >= tension * (1 - 1e-12));
    REQUIRE(printed.report.fans.size() == (factor < 1 ? 1 : 0));
    CHECK(printed.report.reached == printed.report.fans.size());
    if (factor > 1) continue;
    const FanEvent& fan = printed.report.fans.front();
    CHECK(fan.vertex == middle);
    CHECK(std::abs(fan.normal.z()) == Approx(1));
  }
}

TEST_CASE("algorithm 3 stops at a stress that is not a number", "[fracture][algorithm3]") {
  Tension body = uniform_tension(kuhn_box({2, 2, 2}, 0.1), Vec3::UnitZ(), 1e9);
  body.state.elements.stress[0](0, 0) = std::nan("");
  Printed printed;
  printed.run(body, as_printed());
  REQUIRE(printed.report.not_a_number);
  CHECK(*printed.report.not_a_number ==
        *std::ranges::min_element(body.cells.map.corners(TetId{0})));
}

TEST_CASE("algorithm 4: the last face of a fan parts its vertex and nothing else",
          "[fracture][algorithm4]") {
  Tension body = uniform_tension(kuhn_box({4, 4, 4}, 0.1), Vec3::UnitZ(), 1e6);
  const VertexId middle{62};  // no face at it reaches the surface
  leave_weak(body, middle);
  body.cells.strength[middle.index()] = 0.5e6;
  Printed printed;
  printed.run(body, as_printed());
  REQUIRE(printed.report.fans.size() == 1);
  const FanEvent& fan = printed.report.fans.front();
  const Point centre = body.cells.map.point(middle);
  const auto height = [&](TetId t) {
    double z = 0;
    for (const VertexId v : body.cells.map.corners(t)) z += body.cells.map.point(v)[2] / 4;
    return z - centre[2];
  };
  // Every face stands between a positive and a negative tetrahedron.
  REQUIRE(fan.faces.size() > 3);
  for (std::size_t i = 0; i < fan.faces.size(); ++i) {
    const FaceSplit& face = fan.faces[i];
    CHECK(height(tetrahedron_of(face.face)) * height(tetrahedron_of(face.opposite)) < 0);
    CHECK(face.vertex_count == (i + 1 == fan.faces.size() ? 1 : 0));
  }
  // One copy, with all that its vertex has; the oracle was silent, so nobody looked for components.
  CHECK(body.cells.map.vertices() == 126);
  CHECK(body.state.vertices.rest_position[125] == body.state.vertices.rest_position[62]);
  CHECK(body.cells.labels.of_vertex[125] == body.cells.labels.of_vertex[62]);
  CHECK(fan.components.predicted == 0);
  CHECK(fan.components.visited == 0);
  CHECK(body.cells.labels.size.size() == 1);
}

TEST_CASE("algorithm 4: a face whose three vertices split brings a component",
          "[fracture][algorithm4]") {
  // Two tetrahedra on both sides of z = 0, pulled apart (figure 3 b).
  TetMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.2, 1}, {0.2, 0.2, -1}};
  mesh.tetrahedra = {{0, 1, 2, 3}, {0, 2, 1, 4}};
  Tension body = uniform_tension(mesh, Vec3::UnitZ(), 1e6);
  leave_weak(body, VertexId{0});
  body.cells.strength[0] = 0.5e6;
  Printed printed;
  printed.run(body, as_printed());
  REQUIRE(printed.report.fans.size() == 1);
  const FanEvent& fan = printed.report.fans.front();
  REQUIRE(fan.faces.size() == 1);
  CHECK(fan.faces[0].vertex_count == 3);
  CHECK(fan.components.predicted == 1);
  CHECK(fan.components.created == 1);
  CHECK(body.cells.map.vertices() == 8);
  CHECK(body.cells.labels.size == std::vector<std::size_t>{1, 1});
  CHECK(body.cells.labels.of_tetrahedron[0] != body.cells.labels.of_tetrahedron[1]);
  for (std::size_t t = 0; t < 2; ++t) {
    for (const VertexId v : body.cells.map.corners(TetId{t})) {
      CHECK(body.cells.labels.of_vertex[v.index()] == body.cells.labels.of_tetrahedron[t]);
    }
  }
}

TEST_CASE("algorithm 4 on a star that others have split since makes the fan they left",
          "[fracture][algorithm4]") {
  Tension body = uniform_tension(kuhn_box({2, 2, 2}, 0.1), Vec3::UnitZ(), 1e6);
  const VertexId middle{13};
  const VertexStar before = vertex_star(body.cells.map, middle);
  ComponentScratch scratch;
  const BreakableBody all{body.cells, body.state};
  const FanEvent first = split_fan(all, before, Vec3(1, 0.1, 0.2), {}, scratch);
  REQUIRE(!first.faces.empty());
  REQUIRE(vertex_star(body.cells.map, middle).corners.size() < before.corners.size());
  // Of the whole star as it was: on both sides of the first crack.
  Tension fresh = uniform_tension(kuhn_box({2, 2, 2}, 0.1), Vec3::UnitZ(), 1e6);
  std::vector<HalfFaceId> expected =
      fan_faces(fresh.cells.map, before, plane_signs(fresh.cells.map, before, {0.1, 0.2, 1}));
  std::erase_if(expected, [&](HalfFaceId f) { return body.cells.map.neighbour(f).is_none(); });
  const FanEvent second = split_fan(all, before, Vec3(0.1, 0.2, 1), {}, scratch);
  std::vector<HalfFaceId> split;
  for (const FaceSplit& face : second.faces) split.push_back(face.face);
  std::ranges::sort(split);
  CHECK(split == expected);
  CHECK(check(body.cells.map).empty());
}
