// SPDX-License-Identifier: MIT
// Decisions about a vertex next to a crack.
#include "fracture/breaking/choose_crack.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "fracture/breaking/decide_sides.hpp"
#include "tests/support/tension.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

constexpr double h = 0.1;

/// A box with a crack that has begun at the vertex in its middle, across x.
struct Begun {
  Tension body = uniform_tension(jittered(kuhn_box({6, 6, 6}, h), 0.01, 7), Vec3::UnitX(), 1e6);
  ComponentScratch scratch;
  FanEvent event;

  VertexId nearest(const Vec3& place) const {
    VertexId best{0};
    const auto away = [&](VertexId v) {
      return (Vec3(body.cells.map.point(v).data()) - place).norm();
    };
    for (std::size_t v = 0; v < body.cells.map.vertices(); ++v) {
      if (away(VertexId{v}) < away(best)) best = VertexId{v};
    }
    return best;
  }

  /// `untested`: s, since fractures were looked for.
  explicit Begun(double untested = 0) {
    PlannedFan fan{vertex_star(body.cells.map, nearest({0.3, 0.3, 0.3}))};
    fan.normal = Vec3::UnitX();
    fan.at = Vec3(body.cells.map.point(fan.v.vertex).data());
    fan.untested = untested;
    decide_sides(body.cells, body.state, {&fan, 1});
    event = split_planned({body.cells, body.state}, fan, {}, scratch);
  }

  /// `way`: m, as far as the crack's wave has come.
  CrackChoice choose(VertexId v, const Vec3& tension, double way = 1) const {
    PrincipalTension pull{1, {}};
    pull.directions = tension.normalized();
    return choose_crack(body.cells, vertex_star(body.cells.map, v), pull,
                        {h, Vec3(0.3, 0.3, 0.3),
                         body.state.time + way / body.cells.cracks.anchors[0].wave_speed, 0});
  }
};

Vec3 turned(double degrees) {
  const double a = degrees * 3.14159265358979 / 180;
  return {std::cos(a), std::sin(a), 0};
}

}  // namespace

TEST_CASE("a crack goes on at its front, branches where the tension turns, and holds its flanks",
          "[fracture][cracks]") {
  const Begun begun;
  REQUIRE(begun.event.faces.size() > 3);
  REQUIRE(begun.event.crack == CrackId{0});
  CHECK(begun.event.labels.size() > 8);
  const VolumeMap& map = begun.body.cells.map;
  std::size_t fronts = 0, flanks = 0;
  for (const FaceSplit& split : begun.event.faces) {
    for (const VertexId v : split.vertices) {
      if (map.point_of_vertex(v) == begun.event.point) continue;
      const CrackChoice along = begun.choose(v, turned(20));
      REQUIRE(along.step == CrackStep::grows);
      CHECK(along.crack == CrackId{0});
      // Between its own normal and the crack's.
      CHECK(along.plane.normal.dot(turned(20)) > std::cos(0.35));
      CHECK(along.plane.normal.x() > std::cos(0.35));
      CHECK(begun.choose(v, turned(-160)).plane.normal.x() > 0);  // n and -n are one tension
      CHECK(begun.choose(v, turned(80)).step == CrackStep::starts);
      ++fronts;
    }
  }
  CHECK(fronts > 6);
  // Both copies of the vertex that broke see one side alone.
  for (std::size_t v = 0; v < map.vertices(); ++v) {
    if (map.point_of_vertex(VertexId{v}) != begun.event.point) continue;
    CHECK(begun.choose(VertexId{v}, turned(30)).step == CrackStep::waits);
    CHECK(begun.choose(VertexId{v}, turned(80)).step == CrackStep::starts);
    ++flanks;
  }
  CHECK(flanks == 2);
}

TEST_CASE("a crack holds back others beside it until its wave has come to them",
          "[fracture][cracks]") {
  const Begun begun, late{2e-4};
  const VertexId near = begun.nearest({0.5, 0.3, 0.3}), far = begun.nearest({0.3, 0.6, 0.6});
  REQUIRE(cracks_at(begun.body.cells.cracks, vertex_star(begun.body.cells.map, near)).empty());
  for (const double way : {0.0, 0.1, 0.15}) {
    CHECK(begun.choose(near, turned(10), way).step == CrackStep::waits);
    CHECK(begun.choose(near, turned(80), way).step == CrackStep::starts);
    CHECK(begun.choose(far, turned(10), way).step == CrackStep::starts);
    CHECK(late.choose(far, turned(10), way).step == CrackStep::waits);
  }
  CHECK(begun.choose(near, turned(10), 0.25).step == CrackStep::starts);
  CHECK(late.choose(far, turned(10), 0.5).step == CrackStep::starts);
  const CrackLabels& cracks = begun.body.cells.cracks;
  const double speed = cracks.anchors[0].wave_speed, time = begun.body.state.time;
  REQUIRE(speed * 2e-4 > 0.43);  // from the middle to `far`
  CHECK(first_under_way(cracks, time) == 0);
  CHECK(first_under_way(cracks, time + 0.25 / speed) == 0);
  CHECK(first_under_way(cracks, time + 0.5 / speed) == 1);
}

TEST_CASE("starts of one tie side by side are one crack, whatever their order",
          "[fracture][cracks]") {
  Begun begun;
  Tension body = uniform_tension(jittered(kuhn_box({6, 6, 6}, h), 0.01, 7), Vec3::UnitX(), 1e6);
  const auto plan = [&](const Vec3& place, const Vec3& normal) {
    PlannedFan fan{vertex_star(body.cells.map, begun.nearest(place))};
    fan.normal = normal;
    fan.at = Vec3(body.cells.map.point(fan.v.vertex).data());
    return fan;
  };
  std::vector<PlannedFan> fans = {
      plan({0.3, 0.3, 0.3}, turned(10)), plan({0.3, 0.4, 0.3}, -turned(-5)),
      plan({0.4, 0.3, 0.3}, turned(0)), plan({0.6, 0.6, 0.6}, turned(0))};
  decide_sides(body.cells, body.state, fans);
  CHECK(fans[0].crack == fans[1].crack);
  CHECK(fans[0].normal.dot(fans[1].normal) > 0.9);
  CHECK(fans[2].crack != fans[0].crack);
  CHECK(fans[3].crack != fans[0].crack);
  std::vector<PlannedFan> other = {fans[1], fans[0]};
  for (PlannedFan& fan : other) fan.crack = CrackId::none();
  decide_sides(body.cells, body.state, other);
  CHECK(other[0].positive == fans[1].positive);
  CHECK(other[1].positive == fans[0].positive);
  // A tetrahedron that both hold is on one side for both.
  std::size_t common = 0;
  for (std::size_t i = 0; i < fans[0].v.corners.size(); ++i) {
    for (std::size_t j = 0; j < fans[1].v.corners.size(); ++j) {
      if (tetrahedron_of(fans[0].v.corners[i]) != tetrahedron_of(fans[1].v.corners[j])) continue;
      CHECK(fans[0].positive[i] == fans[1].positive[j]);
      ++common;
    }
  }
  CHECK(common > 3);
}
