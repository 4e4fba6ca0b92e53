// SPDX-License-Identifier: MIT
// Which side keeps its rows, what a copy inherits, and gluing as the inverse of splitting.
#include <algorithm>

#include "tests/support/built.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

struct Snapshot {
  std::vector<std::array<VertexId, 4>> corners;
  std::vector<std::array<HalfFaceId, 4>> neighbours;
  std::vector<std::uint32_t> point_of_vertex;
  std::vector<Point> points;
  bool operator==(const Snapshot&) const = default;
};

Snapshot snapshot(const VolumeMap& map) {
  Snapshot s;
  s.corners.assign(map.corners().begin(), map.corners().end());
  s.neighbours.assign(map.neighbours().begin(), map.neighbours().end());
  s.point_of_vertex.assign(map.point_of_vertex().begin(), map.point_of_vertex().end());
  s.points.assign(map.points().begin(), map.points().end());
  return s;
}

std::vector<HalfFaceId> shuffled_faces(const VolumeMap& map, std::mt19937_64& random) {
  std::vector<HalfFaceId> faces = interior_faces(map);
  for (std::size_t i = faces.size(); i > 1; --i) std::swap(faces[i - 1], faces[below(random, i)]);
  for (HalfFaceId& f : faces) {
    if (below(random, 2) == 1) f = map.neighbour(f);
  }
  return faces;
}

}  // namespace

TEST_CASE("the passed side keeps its rows, the other gets the appended ones",
          "[topology][split_face]") {
  for (const bool from_upper : {false, true}) {
    VolumeMap map = built(two_tetrahedra());
    HalfFaceId f = face_on(map, {0, 1, 2});
    if (from_upper) f = map.neighbour(f);
    const auto kept = map.corners(tetrahedron_of(f));
    const FaceSplit split = split_face(map, f);
    CHECK(map.corners(tetrahedron_of(f)) == kept);
    CHECK(map.vertices() == 8);
    REQUIRE(split.vertex_count == 3);
    for (int i = 0; i < 3; ++i) {
      CHECK(split.split_vertices[i].old_row == split.vertices[i]);
      CHECK(split.split_vertices[i].new_row == VertexId{static_cast<std::size_t>(5 + i)});
      CHECK(map.point(split.split_vertices[i].new_row) == map.point(split.vertices[i]));
      CHECK(map.point_of_vertex(split.split_vertices[i].new_row) ==
            map.point_of_vertex(split.vertices[i]));
    }
  }
}

TEST_CASE("the passed side keeps its rows even where it is the smaller one",
          "[topology][split_face]") {
  // A corner tetrahedron cut off a cube: every vertex's star is larger on the other side.
  for (const bool from_corner : {false, true}) {
    VolumeMap map = built(kuhn_box({3, 3, 3}));
    std::vector<HalfFaceId> cuts;
    for (int p = 0; p < 4; ++p) {
      const HalfFaceId f = half_face(TetId{0}, p), across = map.neighbour(f);
      if (!across.is_none()) cuts.push_back(from_corner ? f : across);
    }
    REQUIRE(cuts.size() >= 2);
    const auto rows = map.corners(TetId{0});
    for (const HalfFaceId f : cuts) {
      split_face(map, f);
      CHECK(check(map).empty());
    }
    CHECK((map.corners(TetId{0}) == rows) == from_corner);
  }
}

TEST_CASE("splitting a boundary face changes nothing", "[topology][split_face]") {
  VolumeMap map = built(kuhn_box({1, 1, 1}));
  const Snapshot before = snapshot(map);
  for (std::size_t i = 0; i < 4 * map.tetrahedra(); ++i) {
    if (!map.neighbour(HalfFaceId{i}).is_none()) continue;
    const FaceSplit split = split_face(map, HalfFaceId{i});
    CHECK_FALSE(split.did);
    CHECK(split.face == HalfFaceId{i});
    CHECK(split.vertex_count == 0);
    CHECK_FALSE(oracle_says_new(split));
  }
  CHECK(snapshot(map) == before);
}

TEST_CASE("a face is not glued to the wrong face of the right neighbour", "[topology][glue_face]") {
  for (const MapKernel kernel : {MapKernel::dense, MapKernel::lcc}) {
    VolumeMap map = built(two_tetrahedra());
    map.set_kernel(kernel);
    const FaceSplit split = split_on(map, {0, 1, 2});
    const Snapshot before = snapshot(map);
    for (int p = 0; p < 4; ++p) {
      // It has the three points as corners, but one of them is not on the face.
      const HalfFaceId wrong = half_face(tetrahedron_of(split.opposite), p);
      if (wrong == split.opposite) continue;
      CHECK(glue_face(map, split.face, wrong).refusal == GlueRefusal::different_points);
      CHECK(glue_face(map, wrong, split.face).refusal == GlueRefusal::different_points);
      CHECK(snapshot(map) == before);
      CHECK(check(map).empty());
    }
    CHECK(glue_face(map, split.face, split.opposite).refusal == GlueRefusal::none);
    CHECK(cells(map) == Cells5{5, 9, 7, 2, 1});
  }
}

TEST_CASE("gluing in the opposite order restores the very same rows", "[topology][glue_face]") {
  const std::uint64_t seed = 11;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  for (const NamedMesh& shape : all_shapes()) {
    INFO(shape.name);
    VolumeMap map = built(shape.mesh);
    std::vector<FaceSplit> done;
    std::vector<Snapshot> history;
    for (const HalfFaceId f : shuffled_faces(map, random)) {
      if (done.size() == 60) break;
      history.push_back(snapshot(map));
      done.push_back(split_face(map, f));
    }
    REQUIRE(check(map).empty());
    while (!done.empty()) {
      const FaceGlue glue = glue_face(map, done.back().face, done.back().opposite);
      REQUIRE(glue.refusal == GlueRefusal::none);
      REQUIRE(glue.vertex_count == done.back().vertex_count);
      REQUIRE(snapshot(map) == history.back());
      done.pop_back();
      history.pop_back();
    }
    CHECK(check(map).empty());
  }
}

TEST_CASE("gluing in any order restores the body, with some rows retired",
          "[topology][glue_face]") {
  const std::uint64_t seed = 12;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  for (const NamedMesh& shape : all_shapes()) {
    INFO(shape.name);
    VolumeMap map = built(shape.mesh);
    GlueTwin twin = twin_of(map, shape.mesh.points.size());
    const Snapshot before = snapshot(map);
    const Counts counts = count_cells(map);
    std::vector<FaceSplit> done;
    for (const HalfFaceId f : shuffled_faces(map, random)) {
      done.push_back(split_face(map, f));
      unglue(twin, f);
    }
    for (std::size_t i = done.size(); i > 0; --i) {
      std::swap(done[i - 1], done[below(random, i)]);
      const FaceSplit& split = done[i - 1];
      REQUIRE(glue_face(map, split.opposite, split.face).refusal == GlueRefusal::none);
      glue_again(twin, split.face, split.opposite);
      if (i % 50 != 1) continue;
      REQUIRE(check(map).empty());
      REQUIRE(counts_without_chi(count_cells(map)) == union_find_counts(twin));
    }
    CHECK(cells(count_cells(map)) == cells(counts));
    // The lowest row of each orbit is the one it had: merging keeps the lower of two.
    CHECK(snapshot(map) == before);
  }
}

TEST_CASE("what cannot be glued is refused with its reason and left alone",
          "[topology][glue_face]") {
  VolumeMap map = built(kuhn_box({2, 1, 1}));
  const Snapshot before = snapshot(map);
  std::vector<HalfFaceId> boundary;
  for (std::size_t i = 0; i < 4 * map.tetrahedra(); ++i) {
    if (map.neighbour(HalfFaceId{i}).is_none()) boundary.push_back(HalfFaceId{i});
  }
  const HalfFaceId inner = interior_faces(map).front();
  CHECK(glue_face(map, boundary[0], boundary[0]).refusal == GlueRefusal::same_half_face);
  CHECK(glue_face(map, inner, map.neighbour(inner)).refusal == GlueRefusal::not_boundary);
  CHECK(glue_face(map, inner, boundary[0]).refusal == GlueRefusal::not_boundary);
  CHECK(glue_face(map, boundary[0], inner).refusal == GlueRefusal::not_boundary);
  for (std::size_t i = 1; i < boundary.size(); ++i) {
    CHECK(glue_face(map, boundary[0], boundary[i]).refusal == GlueRefusal::different_points);
  }
  CHECK(snapshot(map) == before);
}

TEST_CASE("a copy of a map is a map of its own, retired rows included", "[topology][volume_map]") {
  std::mt19937_64 random(13);
  VolumeMap map = built(kuhn_box({2, 2, 2}));
  std::vector<FaceSplit> done;
  for (const HalfFaceId f : shuffled_faces(map, random)) done.push_back(split_face(map, f));
  for (std::size_t i = 0; i < done.size() / 2; ++i) {
    glue_face(map, done[i].face, done[i].opposite);
  }
  VolumeMap copy = map;
  CHECK(check(copy).empty());
  CHECK(snapshot(copy) == snapshot(map));
  const Snapshot before = snapshot(map);
  for (std::size_t i = 0; i < done.size() / 2; ++i) split_face(copy, done[i].face);
  CHECK(check(copy).empty());
  CHECK(snapshot(map) == before);
  VolumeMap moved = std::move(copy);
  CHECK(check(moved).empty());
  moved = map;
  CHECK(snapshot(moved) == before);
}

TEST_CASE("the same splits give the same rows, whatever the map went through before",
          "[topology][determinism]") {
  std::mt19937_64 random(14);
  const TetMesh mesh = jittered(kuhn_box({3, 3, 3}), 0.1, 1);
  VolumeMap first = built(mesh), second = built(mesh);
  // The second is split and glued again first: hidden state must not show.
  std::vector<FaceSplit> done;
  for (const HalfFaceId f : shuffled_faces(second, random)) done.push_back(split_face(second, f));
  for (; !done.empty(); done.pop_back()) {
    glue_face(second, done.back().face, done.back().opposite);
  }
  Components labels_first = label_components(first), labels_second = label_components(second);
  ComponentScratch scratch_first, scratch_second;
  for (const HalfFaceId f : shuffled_faces(first, random)) {
    const FaceSplit a = split_face(first, f), b = split_face(second, f);
    update_components(first, std::span(&a, 1), Detection::exact, labels_first, scratch_first);
    update_components(second, std::span(&b, 1), Detection::exact, labels_second, scratch_second);
  }
  CHECK(snapshot(first) == snapshot(second));
  CHECK(labels_first.of_tetrahedron == labels_second.of_tetrahedron);
  CHECK(labels_first.of_vertex == labels_second.of_vertex);
}

TEST_CASE("the order of points and tetrahedra in the file does not change the topology",
          "[topology][determinism]") {
  for (const NamedMesh& shape : all_shapes()) {
    INFO(shape.name);
    const Counts counts = count_cells(built(shape.mesh));
    for (const std::uint64_t seed : {1U, 2U}) {
      const Counts other = count_cells(built(shuffled(shape.mesh, seed)));
      CHECK(cells(other) == cells(counts));
      CHECK(other.boundary_sheets == counts.boundary_sheets);
      CHECK(other.betti == counts.betti);
    }
  }
}

TEST_CASE("a star of ten thousand tetrahedra is searched as any other", "[topology][split_face]") {
  // The small table of the star search has to grow here; twice, and from both sides.
  VolumeMap map = built(closed_fan(10000));
  CHECK(split_count(split_on(map, {0, 1, 2})) == SplitCount{1, 2});
  CHECK(split_count(split_on(map, {0, 1, 5002})) == SplitCount{3, 3});
  CHECK(check(map).empty());
  CHECK(cells(map)[4] == 2);
}

TEST_CASE("a map of 48 000 tetrahedra keeps within its bytes, whole and shattered",
          "[topology][volume_map][memory]") {
  VolumeMap map = std::move(*build_map(kuhn_box({20, 20, 20})));
  const auto each = [](const VolumeMap& m) { return total(m.bytes()) / m.tetrahedra(); };
  CHECK(each(map) <= 900);
  for (const HalfFaceId f : interior_faces(map)) split_face(map, f);
  CHECK(map.vertices() == 4 * map.tetrahedra());
  CHECK(each(map) <= 1100);
  const VolumeMap copy = map;
  CHECK(each(copy) <= each(map));
}
