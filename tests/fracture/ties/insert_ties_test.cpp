// SPDX-License-Identifier: MIT
// Which faces are tied, and their areas.
#include "fracture/ties/insert_ties.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>

#include "mechanics/rebuild.hpp"
#include "topology/kernel/split_face.hpp"
#include "topology/mesh/build_map.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;

TEST_CASE("faces that came apart are tied, on their area along the crack's plane", "[ties]") {
  auto map = build_map(suite::kuhn_box({1, 1, 1}, 2));
  REQUIRE(map);
  std::vector<Vec3> rest;
  for (std::size_t v = 0; v < map->vertices(); ++v) {
    rest.emplace_back(map->point(VertexId{v}).data());
  }
  const std::vector<Material> materials{Material{.fracture_energy = 10}};
  const std::vector<Corners> corners(map->corners().begin(), map->corners().end());
  auto mechanics = make_state({.rest_positions = rest, .corners = corners, .materials = materials});
  REQUIRE(mechanics);
  Cells cells = make_cells(std::move(*map), *mechanics);
  HalfFaceId face{0};
  while (cells.map.neighbour(face).is_none()) face = HalfFaceId{face.index() + 1};

  FanEvent fan;
  fan.faces.push_back(split_face(cells.map, face));
  fan.faces.push_back(split_face(cells.map, face));  // open by now
  REQUIRE(fan.faces[0].did);
  REQUIRE_FALSE(fan.faces[1].did);
  const Vec3 across = rest_area_vector(cells.map, face).normalized();
  const double area = rest_area_vector(cells.map, face).norm();
  for (const double angle : {0.0, 0.4, 1.0}) {
    fan.normal = std::cos(angle) * across + std::sin(angle) * across.unitOrthogonal();
    std::vector<Tie> ties;
    add_ties(ties, cells, *mechanics, {&fan, 1});
    REQUIRE(ties.size() == 1);
    CHECK(ties[0].face == face);
    CHECK(ties[0].fracture_energy == 10);
    CHECK(std::abs(ties[0].normal.dot(fan.normal)) == Approx(1));
    for (const TieCorner& corner : ties[0].corners) {
      CHECK(corner.area == Approx(area * std::cos(angle) / 3));
      CHECK_FALSE(corner.is_apart());
    }
  }
}
