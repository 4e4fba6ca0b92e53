// SPDX-License-Identifier: MIT
// Fans (algorithm 4) and their queue: splits, kept data, their order.
#include "fracture/algorithms/split_fan.hpp"

#include <catch2/catch.hpp>
#include <numeric>

#include "fracture/algorithms/choose_fan.hpp"
#include "mechanics/element/energy.hpp"
#include "mechanics/step.hpp"
#include "tests/support/tension.hpp"
#include "topology/kernel/invariants.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

double total(const std::vector<double>& column) {
  return std::accumulate(column.begin(), column.end(), 0.0);
}

/// Masses, members and frames after the fans, as `advance` does it.
void rebuild_all(Tension& body) {
  MechanicsScratch scratch;
  body.state.elements.component = body.cells.labels.of_tetrahedron;
  std::vector<ComponentId> all;
  for (std::size_t id = 0; id < body.cells.labels.size.size(); ++id) all.emplace_back(id);
  rebuild(body.state, body.cells.map.corners(), all, scratch);
}

Tension weak_body(double stress) {
  return uniform_tension(jittered(kuhn_box({3, 3, 3}, 0.1), 0.01, 3), Vec3::UnitZ(), stress);
}

}  // namespace

TEST_CASE("a fan leaves rows, columns and labels that agree with the map", "[fracture]") {
  Tension body = weak_body(4e6);
  FractureScratch scratch;
  const FractureReport report = break_vertices({body.cells, body.state}, {}, scratch);
  REQUIRE(report.fans.size() > 10);
  CHECK(check(body.cells.map).empty());
  CHECK(body.state.vertices.size() == body.cells.map.vertices());
  CHECK(body.cells.strength.size() == body.cells.map.vertices());
  CHECK(scratch.node_stress.value.size() == body.cells.map.vertices());
  // The labels equal a full walk up to their names.
  const Components walk = label_components(body.cells.map);
  CHECK(walk.size.size() ==
        std::size_t(std::count_if(body.cells.labels.size.begin(), body.cells.labels.size.end(),
                                  [](std::size_t n) { return n > 0; })));
  for (std::size_t t = 1; t < body.cells.map.tetrahedra(); ++t) {
    CHECK((walk.of_tetrahedron[t] == walk.of_tetrahedron[t - 1]) ==
          (body.cells.labels.of_tetrahedron[t] == body.cells.labels.of_tetrahedron[t - 1]));
  }
  for (std::size_t v = 0; v < body.state.vertices.size(); ++v) {
    const Point& p = body.cells.map.point(VertexId{v});
    CHECK(body.state.vertices.rest_position[v] == Vec3(p[0], p[1], p[2]));
  }
}

TEST_CASE("pieces weigh what the body weighed to 1e-12", "[fracture]") {
  Tension body = weak_body(4e6);
  const double before = total(body.state.vertices.mass);
  FractureScratch scratch;
  break_vertices({body.cells, body.state}, {}, scratch);
  rebuild_all(body);
  CHECK(total(body.state.vertices.mass) == Approx(before).epsilon(1e-12));
  double pieces = 0;
  for (const Component& c : body.state.components) pieces += c.mass;
  CHECK(pieces == Approx(before).epsilon(1e-12));
}

TEST_CASE("every way of detection gives the same pieces", "[fracture]") {
  std::vector<std::vector<ComponentId>> labels;
  for (const Detection d :
       {Detection::walk, Detection::oracle, Detection::dirty_counter, Detection::exact}) {
    Tension body = weak_body(4e6);
    FractureScratch scratch;
    FractureSettings settings;
    settings.detection = d;
    break_vertices({body.cells, body.state}, settings, scratch);
    labels.push_back(body.cells.labels.of_tetrahedron);
  }
  CHECK(labels[0] == labels[1]);
  CHECK(labels[0] == labels[2]);
  CHECK(labels[0] == labels[3]);
}

TEST_CASE("a fan costs the same in a body 1, 8 and 64 times as large", "[fracture]") {
  std::vector<std::size_t> visited;
  for (const int cells : {4, 8, 16}) {
    Tension body = uniform_tension(kuhn_box({cells, cells, cells}, 0.1), Vec3::UnitZ(), 4e6);
    ComponentScratch scratch;
    std::size_t met = 0, created = 0;
    // The same fans in the corner of every body, until single tetrahedra have come off.
    for (std::size_t place = 0; place < 4; ++place) {
      for (const Vec3& normal : {Vec3(1, 0.3, 0.2), Vec3(0.2, 1, 0.3), Vec3(0.3, 0.2, 1)}) {
        // The first tetrahedron lies in the corner; its rows change as it comes off.
        const VertexId v = body.cells.map.corners(TetId{0})[place];
        const VertexStar star = vertex_star(body.cells.map, v);
        const FanEvent fan =
            split_fan({body.cells, body.state}, star, normal.normalized(), {}, scratch);
        met += fan.visited;
        created += fan.components.created;
      }
    }
    CHECK(created > 0);
    visited.push_back(met);
  }
  CHECK(visited[1] == visited[0]);
  CHECK(visited[2] == visited[0]);
}

TEST_CASE("a budget keeps the most overstressed and lets the others wait", "[fracture]") {
  Tension body = weak_body(4e6);
  // Stress grows towards +z: the top must come first.
  for (std::size_t t = 0; t < body.state.elements.size(); ++t) {
    double z = 0;
    for (const VertexId v : body.cells.map.corners(TetId{t})) {
      z += 0.25 * body.state.vertices.rest_position[v.index()].z();
    }
    body.state.elements.stress[t] *= 1 + z;
  }
  FractureSettings settings;
  settings.mode = FractureMode::budget;
  settings.max_fans = 3;
  FractureScratch scratch;
  const FractureReport report = break_vertices({body.cells, body.state}, settings, scratch);
  REQUIRE(report.fans.size() == 3);
  CHECK(report.waiting > 0);
  CHECK(report.fans[0].stress >= report.fans[1].stress);
  CHECK(report.fans[1].stress >= report.fans[2].stress);
  // Every vertex over the threshold had a fan, an empty one, was relieved, or waits: none is lost.
  CHECK(report.fans.size() + report.empty_fans + report.relieved + report.waiting >=
        report.reached);
  // When the stress is gone, those that waited are counted as relieved.
  for (Mat3& s : body.state.elements.stress) s.setZero();
  const FractureReport calm = break_vertices({body.cells, body.state}, settings, scratch);
  CHECK(calm.fans.empty());
  CHECK(calm.relieved == report.waiting);
}

TEST_CASE("mode off tests nothing", "[fracture]") {
  Tension body = weak_body(1e9);
  FractureSettings settings;
  settings.mode = FractureMode::off;
  FractureScratch scratch;
  const FractureReport report = break_vertices({body.cells, body.state}, settings, scratch);
  CHECK(report.tested == 0);
  CHECK(report.fans.empty());
}

TEST_CASE("a toughness rules at crack tips alone", "[fracture]") {
  Material tough;
  tough.toughness = 1e6;
  Tension body = uniform_tension(kuhn_box({3, 3, 3}, 0.1), Vec3::UnitZ(), 3.5e6, tough);
  CHECK(body.cells.strength.front() == tough.tensile_strength);
  FractureSettings settings;
  settings.mode = FractureMode::budget;
  settings.max_fans = 1;
  FractureScratch scratch;
  const FractureReport report = break_vertices({body.cells, body.state}, settings, scratch);
  REQUIRE(report.fans.size() == 1);
  const FaceSplit& face = report.fans.front().faces.front();
  // Mean edge of a Kuhn cube's tetrahedron: 3 edges, 2 face diagonals, 1 space diagonal.
  const double h = 0.1 * (3 + 2 * std::sqrt(2.0) + std::sqrt(3.0)) / 6;
  for (const VertexId v : face.vertices) {
    CHECK(body.cells.strength[v.index()] == Approx(crack_tip_factor(1) * 1e6 / std::sqrt(h)));
  }
}

TEST_CASE("equal tensions all round choose the same fan on every mirror image", "[fracture]") {
  // Hydrostatic tension: any normal is right. The choice must not be the solver's.
  Tension body = weak_body(4e6);
  for (Mat3& s : body.state.elements.stress) s = 4e6 * Mat3::Identity();
  PrincipalTension tension = principal_tension(4e6 * Mat3::Identity());
  const VertexId inner{1 * 16 + 1 * 4 + 1};
  const VertexStar star = vertex_star(body.cells.map, inner);
  const FanPlane fan = choose_fan(body.cells, star, tension);
  REQUIRE(!fan.faces.empty());
  // Any orthonormal basis of the eigenspace gives the same plane.
  tension.directions = Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized()).matrix();
  const FanPlane turned = choose_fan(body.cells, star, tension);
  CHECK(turned.faces == fan.faces);
  CHECK((turned.normal - fan.normal).norm() < 1e-12);
}
