// SPDX-License-Identifier: MIT
// Rows and darts answer alike, in the same order, whatever is split and glued.
#include "topology/kernel/map_answers.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <random>
#include <vector>

#include "topology/kernel/components.hpp"
#include "topology/kernel/counts.hpp"
#include "topology/kernel/fan.hpp"
#include "topology/kernel/invariants.hpp"
#include "topology/kernel/split_face.hpp"
#include "topology/mesh/build_map.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;

namespace {

VolumeMap map_by(MapKernel kernel, const TetMesh& mesh) {
  Result<VolumeMap> map = build_map(mesh, Severity::error, kernel);
  REQUIRE(map);
  CHECK(map->kernel() == kernel);
  return std::move(*map);
}

bool same_rows(const VolumeMap& a, const VolumeMap& b) {
  return std::ranges::equal(a.corners(), b.corners()) &&
         std::ranges::equal(a.neighbours(), b.neighbours()) &&
         std::ranges::equal(a.point_of_vertex(), b.point_of_vertex());
}

void check_alike(const VolumeMap& a, const VolumeMap& b, VertexId v, const Point& normal) {
  REQUIRE(same_rows(a, b));
  REQUIRE(vertex_star(a, v).corners == vertex_star(b, v).corners);
  const auto fan_a = fan_faces(a, v, normal), fan_b = fan_faces(b, v, normal);
  REQUIRE(fan_a.value.has_value() == fan_b.value.has_value());
  if (fan_a) {
    std::vector<HalfFaceId> one = *fan_a, other = *fan_b;
    order_faces(a, FaceOrder::paper, one);
    order_faces(b, FaceOrder::paper, other);
    REQUIRE(one == other);
  }
}

}  // namespace

TEST_CASE("a map answered by darts and one of rows stay the same through splits and glues",
          "[kernel]") {
  const TetMesh mesh = suite::kuhn_box({3, 2, 2});
  VolumeMap rows = map_by(MapKernel::dense, mesh), darts = map_by(MapKernel::lcc, mesh);
  Components of_rows = label_components(rows), of_darts = label_components(darts);
  ComponentScratch scratch_rows, scratch_darts;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-1, 1);
  std::vector<FaceSplit> splits;
  for (int i = 0; i < 300; ++i) {
    if (!splits.empty() && random() % 4 == 0) {
      const std::size_t which = random() % splits.size();
      const FaceSplit split = splits[which];
      splits.erase(splits.begin() + static_cast<std::ptrdiff_t>(which));
      REQUIRE(glue_face(rows, split.face, split.opposite).refusal ==
              glue_face(darts, split.face, split.opposite).refusal);
      of_rows = label_components(rows);
      of_darts = label_components(darts);
    } else {
      const HalfFaceId face{random() % (4 * mesh.tetrahedra.size())};
      const FaceSplit a = split_face(rows, face), b = split_face(darts, face);
      REQUIRE(a.did == b.did);
      REQUIRE(a.split_edges == b.split_edges);
      REQUIRE(a.visited == b.visited);
      if (!a.did) continue;
      splits.push_back(a);
      const auto one =
          update_components(rows, std::span(&a, 1), Detection::exact, of_rows, scratch_rows);
      const auto other =
          update_components(darts, std::span(&b, 1), Detection::exact, of_darts, scratch_darts);
      REQUIRE(one.created == other.created);
      REQUIRE(one.visited == other.visited);
    }
    REQUIRE(of_rows.of_tetrahedron == of_darts.of_tetrahedron);
    const VertexId v{random() % rows.vertices()};
    if (rows.incident_tetrahedron(v).is_none()) continue;
    check_alike(rows, darts, v, {any(random), any(random), any(random)});
  }
  const Counts a = count_cells(rows), b = count_cells(darts);
  CHECK(a.vertices == b.vertices);
  CHECK(a.edges == b.edges);
  CHECK(a.faces == b.faces);
  CHECK(a.betti == b.betti);
  CHECK(check(rows).empty());
  CHECK(check(darts).empty());
}

TEST_CASE("each dart has the vertex and the tetrahedron of its row, and signs are nought or one",
          "[kernel]") {
  const TetMesh mesh = suite::kuhn_box({2, 1, 1});
  for (const MapKernel kernel : {MapKernel::dense, MapKernel::lcc}) {
    VolumeMap map = map_by(kernel, mesh);
    answer(map, [&map](const auto& answers) {
      for (std::size_t t = 0; t < map.tetrahedra(); ++t) {
        for (int p = 0; p < 4; ++p) {
          const CornerId from = corner(TetId{t}, (p + 1) % 4);
          const auto d = answers.dart(half_face(TetId{t}, p), from);
          CHECK(answers.vertex(d) == map.corners(TetId{t})[static_cast<std::size_t>((p + 1) % 4)]);
          CHECK(answers.tetrahedron(d) == TetId{t});
          CHECK(answers.id(d) == map.dart(half_face(TetId{t}, p), from));
          CHECK(map.dense().id(answers.id(d)) == answers.id(d));
          CHECK(answers.beta0(d) == answers.beta1(answers.beta1(d)));
        }
      }
    });
    const VertexStar around = vertex_star(map, VertexId{1});
    const std::vector<char> signs = plane_signs(map, around, {1, 0, 0});
    REQUIRE(signs.size() == around.corners.size());
    for (std::size_t i = 0; i < signs.size(); ++i) {
      double side = 0;  // of the centre, from the vertex
      for (const VertexId v : map.corners(tetrahedron_of(around.corners[i]))) {
        side += map.point(v)[0] - map.point(around.vertex)[0];
      }
      CHECK(signs[i] == (side >= 0 ? 1 : 0));
    }
  }
}

TEST_CASE("darts have no place for a vertex that gluing has retired", "[kernel]") {
  VolumeMap map =
      map_by(MapKernel::lcc, suite::side_by_side(suite::two_tetrahedra(), suite::two_tetrahedra()));
  std::size_t f = 0;
  while (map.neighbour(HalfFaceId{f}).is_none()) ++f;
  const FaceSplit first = split_face(map, HalfFaceId{f});
  f = 8;
  while (map.neighbour(HalfFaceId{f}).is_none()) ++f;
  const FaceSplit second = split_face(map, HalfFaceId{f});
  REQUIRE(glue_face(map, first.face, first.opposite).vertex_count == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    const VertexId retired = first.split_vertices[i].new_row,
                   stays = second.split_vertices[i].new_row;
    REQUIRE(map.incident_tetrahedron(retired).is_none());
    CHECK(map.darts().point(retired) == Point{0, 0, 0});
    CHECK(map.darts().point(stays) == map.point(stays));
  }
}

TEST_CASE("darts are made and let go, and copies have what the first has", "[kernel]") {
  VolumeMap map = map_by(MapKernel::dense, suite::kuhn_box({2, 2, 2}));
  split_face(map, half_face(TetId{5}, 1));
  const std::size_t without = total(map.bytes());
  map.set_kernel(MapKernel::lcc);
  CHECK(check(map).empty());
  CHECK(total(map.bytes()) > 5 * without);
  const VolumeMap copy = map;
  CHECK(copy.kernel() == MapKernel::lcc);
  CHECK(check(copy).empty());
  map.set_kernel(MapKernel::dense);
  CHECK(total(map.bytes()) == without);
  CHECK(same_rows(map, copy));
}
