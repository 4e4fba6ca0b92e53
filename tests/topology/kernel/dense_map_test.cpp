// SPDX-License-Identifier: MIT
// The rows by themselves against the map that keeps darts too, split and glued at random.
#include "topology/kernel/dense_map.hpp"

#include <catch2/catch.hpp>
#include <random>

#include "topology/kernel/components.hpp"
#include "topology/kernel/dart_map.hpp"
#include "topology/kernel/split_face.hpp"
#include "topology/kernel/volume_map.hpp"
#include "topology/mesh/build_map.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;

namespace {

/// Everything that a kernel answers, dart by dart.
void check_alike(const DenseMap& dense, const VolumeMap& map) {
  REQUIRE(dense.vertices() == map.vertices());
  for (std::size_t t = 0; t < map.tetrahedra(); ++t) {
    REQUIRE(dense.corners(TetId{t}) == map.darts().corners(TetId{t}));
    for (int p = 0; p < 4; ++p) {
      const HalfFaceId face = half_face(TetId{t}, p);
      REQUIRE(dense.neighbour(face) == map.darts().neighbour(face));
    }
  }
  for (std::size_t d = 0; d < 12 * map.tetrahedra(); ++d) {
    const DartId dart{d};
    REQUIRE(dense.beta0(dense.beta1(dart)) == dart);
    REQUIRE(dense.beta2(dense.beta2(dart)) == dart);
    if (!dense.is_free(dart)) REQUIRE(dense.beta3(dense.beta3(dart)) == dart);
  }
  for (std::size_t v = 0; v < map.vertices(); ++v) {
    const TetId t = dense.incident_tetrahedron(VertexId{v});
    if (t.is_none()) continue;
    REQUIRE(place_of_vertex(dense.corners(t), VertexId{v}) < 4);
  }
}

}  // namespace

TEST_CASE("rows alone split and glue as the map with darts does", "[kernel]") {
  auto map = build_map(suite::kuhn_box({3, 2, 2}, 1));
  REQUIRE(map);
  DenseMap dense = map->dense();
  std::mt19937 random(7);
  std::vector<FaceSplit> splits;
  for (int i = 0; i < 400; ++i) {
    if (!splits.empty() && random() % 3 == 0) {
      const std::size_t which = random() % splits.size();
      const FaceSplit split = splits[which];
      splits.erase(splits.begin() + static_cast<std::ptrdiff_t>(which));
      const FaceGlue a = glue_face(*map, split.face, split.opposite);
      const FaceGlue b = glue_face(dense, split.face, split.opposite);
      REQUIRE(a.refusal == b.refusal);
      REQUIRE(a.vertex_count == b.vertex_count);
    } else {
      const HalfFaceId face{random() % (4 * map->tetrahedra())};
      const FaceSplit a = split_face(*map, face), b = split_face(dense, face);
      REQUIRE(a.did == b.did);
      REQUIRE(a.vertex_count == b.vertex_count);
      REQUIRE(a.split_edges == b.split_edges);
      if (a.did) splits.push_back(a);
    }
    check_alike(dense, *map);
  }
  const Components a = label_components(*map), b = label_components(dense);
  CHECK(a.of_tetrahedron == b.of_tetrahedron);
  CHECK(a.of_vertex == b.of_vertex);
  CHECK(check(*map).empty());
}

TEST_CASE("nodes of a map without tetrahedra come, and leave no row when they go", "[kernel]") {
  MapRows rows;
  rows.points = {{1, 2, 3}};
  DenseMap map(std::move(rows));
  const VertexId node = map.append_node(Point{4, 5, 6}), copy = map.append_node(node);
  CHECK(map.vertices() == 2);
  CHECK((map.is_node(node) && map.is_node(copy)));
  map.retire_node(node);
  CHECK(map.vertices() == 2);
  CHECK_FALSE(map.is_node(node));
  map.retire_node(copy);
  CHECK(map.vertices() == 0);
}
