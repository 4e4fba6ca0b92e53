// SPDX-License-Identifier: MIT
// The darts alone against the map with its rows: every algorithm asked of both, and CGAL's own
// check.
#include "topology/kernel/dart_map.hpp"

#include <memory>

#include "tests/support/built.hpp"
#include "topology/kernel/components_impl.hpp"
#include "topology/kernel/fan_impl.hpp"
#include "topology/kernel/invariants_impl.hpp"
#include "topology/kernel/map_answers.hpp"
#include "topology/kernel/split_face_impl.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

MapRows rows_of(const VolumeMap& map) {
  MapRows rows;
  rows.corners.assign(map.corners().begin(), map.corners().end());
  rows.neighbours.assign(map.neighbours().begin(), map.neighbours().end());
  rows.points.assign(map.points().begin(), map.points().end());
  rows.point_of_vertex.assign(map.point_of_vertex().begin(), map.point_of_vertex().end());
  return rows;
}

bool same(const FaceSplit& a, const FaceSplit& b) {
  if (a.did != b.did || a.face != b.face || a.opposite != b.opposite || a.vertices != b.vertices ||
      a.vertex_count != b.vertex_count || a.split_edges != b.split_edges) {
    return false;
  }
  for (int i = 0; i < a.vertex_count; ++i) {
    if (a.split_vertices[i].old_row != b.split_vertices[i].old_row ||
        a.split_vertices[i].new_row != b.split_vertices[i].new_row) {
      return false;
    }
  }
  return true;
}

void require_same_rows(const VolumeMap& map, const DartMap& darts) {
  REQUIRE(darts.tetrahedra() == map.tetrahedra());
  REQUIRE(darts.vertices() == map.vertices());
  for (std::size_t t = 0; t < map.tetrahedra(); ++t) {
    REQUIRE(darts.corners(TetId{t}) == map.corners(TetId{t}));
    for (int p = 0; p < 4; ++p) {
      const HalfFaceId f = half_face(TetId{t}, p);
      REQUIRE(darts.neighbour(f) == map.neighbour(f));
    }
  }
}

void require_same_answers(const VolumeMap& map, const DartMap& darts) {
  const Counts a = count_cells(map), b = count_cells(darts);
  CHECK(cells(a) == cells(b));
  CHECK(a.boundary_sheets == b.boundary_sheets);
  CHECK(a.volume == b.volume);
  for (std::size_t v = 0; v < map.vertices(); v += 7) {
    CHECK(star(map, VertexId{v}) == star(darts, VertexId{v}));
    CHECK(*fan_faces(map, VertexId{v}, {1, 2, 3}) == *fan_faces(darts, VertexId{v}, {1, 2, 3}));
  }
}

/// CGAL's is_valid with attributes as they are; it only reads.
bool cgal_says_valid(const DartMap& darts) { return darts.complex().is_valid(); }

}  // namespace

TEST_CASE("whatever is asked of the map is asked of its darts alone, with the same answers",
          "[topology][dart_map]") {
  const std::uint64_t seed = 51;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  for (const NamedMesh& shape : all_shapes()) {
    INFO(shape.name);
    VolumeMap map = built(shape.mesh);
    DartMap darts(rows_of(map));
    require_same_rows(map, darts);
    CHECK(cgal_says_valid(darts));
    Components labels = label_components(map), dart_labels = label_components(darts);
    ComponentScratch scratch, dart_scratch;
    std::vector<HalfFaceId> faces = interior_faces(map);
    std::vector<FaceSplit> done;
    while (!faces.empty() && done.size() < 150) {
      std::swap(faces[below(random, faces.size())], faces.back());
      const FaceSplit a = split_face(map, faces.back());
      const FaceSplit b = split_face(darts, faces.back());
      faces.pop_back();
      REQUIRE(same(a, b));
      const auto x = update_components(map, std::span(&a, 1), Detection::exact, labels, scratch);
      const auto y =
          update_components(darts, std::span(&b, 1), Detection::exact, dart_labels, dart_scratch);
      REQUIRE(x.created == y.created);
      REQUIRE(x.visited == y.visited);
      done.push_back(a);
    }
    require_same_rows(map, darts);
    CHECK(labels.of_vertex == dart_labels.of_vertex);
    CHECK(cgal_says_valid(darts));
    CHECK(cgal_says_valid(map.darts()));
    require_same_answers(map, darts);
    while (!done.empty()) {
      const std::size_t i = below(random, done.size());
      std::swap(done[i], done.back());
      const FaceGlue g = glue_face(map, done.back().face, done.back().opposite);
      const FaceGlue h = glue_face(darts, done.back().face, done.back().opposite);
      done.pop_back();
      REQUIRE(g.refusal == GlueRefusal::none);
      REQUIRE(h.vertex_count == g.vertex_count);
    }
    require_same_rows(map, darts);
    CHECK(cgal_says_valid(darts));
    CHECK(check(map).empty());
  }
}

TEST_CASE("CGAL counts the cells we count", "[topology][dart_map]") {
  for (const NamedMesh& shape : all_shapes()) {
    INFO(shape.name);
    VolumeMap map = built(shape.mesh);
    std::mt19937_64 random(52);
    std::vector<HalfFaceId> faces = interior_faces(map);
    for (std::size_t i = 0; i < faces.size() / 3; ++i) {
      split_face(map, faces[below(random, faces.size())]);
    }
    const Counts counts = count_cells(map);
    auto cgal = map.darts().complex().count_all_cells();
    CHECK(cells(counts) == Cells5{cgal[0], cgal[1], cgal[2], cgal[3], cgal[4]});
  }
}

TEST_CASE("CGAL's managed unsew splits the same vertices", "[topology][dart_map]") {
  const std::uint64_t seed = 53;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  for (const NamedMesh& shape : all_shapes()) {
    INFO(shape.name);
    VolumeMap map = built(shape.mesh);
    DartMap managed(rows_of(map));
    managed.complex().set_automatic_attributes_management(true);
    std::vector<HalfFaceId> faces = interior_faces(map);
    while (!faces.empty()) {
      std::swap(faces[below(random, faces.size())], faces.back());
      const HalfFaceId f = faces.back();
      faces.pop_back();
      const std::size_t before = managed.complex().number_of_vertex_attributes();
      managed.complex().unsew<3>(managed.dart_at(tetrahedron_of(f), 3 * place_of(f)));
      const auto split = static_cast<std::size_t>(split_face(map, f).vertex_count);
      REQUIRE(managed.complex().number_of_vertex_attributes() == before + split);
    }
    CHECK(managed.complex().number_of_vertex_attributes() == 4 * map.tetrahedra());
  }
}

TEST_CASE("the final map does not depend on the order of a fan's faces", "[topology][dart_map]") {
  // Rows differ between orders, so isomorphism is asked of the darts with points, not rows.
  const std::array<std::array<std::uint32_t, 3>, 3> fan = {{{1, 4, 14}, {4, 14, 17}, {4, 7, 17}}};
  std::array<int, 3> order = {0, 1, 2};
  std::unique_ptr<VolumeMap> first;
  do {
    VolumeMap map = built(kuhn_box({2, 2, 2}));
    for (const int i : order) split_on(map, fan[i]);
    if (!first) {
      first = std::make_unique<VolumeMap>(std::move(map));
    } else {
      CHECK(map.darts().complex().is_isomorphic_to(first->darts().complex(), false, false, true));
    }
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST_CASE("a damaged map is found out", "[topology][volume_map]") {
  const auto damaged = [](auto hurt) {
    VolumeMap map = built(kuhn_box({2, 2, 1}));
    hurt(map, const_cast<DartMap&>(map.darts()));
    const std::vector<Finding> findings = check(map);
    REQUIRE_FALSE(findings.empty());
    for (const Finding& f : findings) CHECK(f.code == "map_damaged");
  };
  damaged([](VolumeMap& map, DartMap& darts) { darts.unsew(interior_faces(map)[3]); });
  // Unsewn in both, but its vertices never got their rows.
  damaged([](VolumeMap& map, DartMap&) {
    for (const HalfFaceId f : interior_faces(map)) map.unsew(f);
  });
  damaged([](VolumeMap& map, DartMap& darts) {
    const auto d = darts.dart_at(TetId{5}, 4);
    darts.complex().info<0>(d).row = VertexId{map.vertices() - 1};
  });
  damaged([](VolumeMap&, DartMap& darts) {
    darts.complex().info<3>(darts.dart_at(TetId{0}, 0)) = TetId{1};
  });
  damaged([](VolumeMap&, DartMap& darts) {
    const auto d = darts.dart_at(TetId{2}, 7);
    darts.complex().point(d) = DartComplex::Point(9, 9, 9);
  });
}

TEST_CASE("the canonical darts are the ones the header draws", "[topology][dart_map]") {
  for (int k = 0; k < 12; ++k) {
    CHECK(dart_order::beta0(dart_order::beta1(k)) == k);
    CHECK(dart_order::beta2(dart_order::beta2(k)) == k);
    CHECK(dart_order::beta2(k) / 3 != k / 3);
    CHECK(dart_order::origin(dart_order::beta2(k)) == dart_order::target(k));
    CHECK(dart_order::target(dart_order::beta2(k)) == dart_order::origin(k));
    CHECK(dart_order::origin(k) != k / 3);
    CHECK(dart_order::dart_from(k / 3, dart_order::origin(k)) == k);
  }
  const VolumeMap map = built(two_tetrahedra());
  for (std::size_t d = 0; d < 24; ++d) {
    const auto handle = map.darts().dart_at(TetId{d / 12}, static_cast<int>(d % 12));
    CHECK(map.darts().id(handle) == DartId{d});
    CHECK(map.darts().vertex(handle) == map.vertex(DartId{d}));
  }
}

TEST_CASE("a dart tells its half-face and the corner where it starts", "[topology][dart_map]") {
  const VolumeMap map = built(kuhn_box({2, 1, 1}));
  const DartMap& darts = map.darts();
  for (std::size_t row = 0; row < 12 * map.tetrahedra(); ++row) {
    const TetId t{row / 12};
    const auto d = darts.dart_at(t, static_cast<int>(row % 12));
    const CornerId c = darts.corner_of(d);
    CHECK(darts.half_face_of(d) == HalfFaceId{row / 3});
    CHECK(tetrahedron_of(c) == t);
    CHECK(map.corners(t)[static_cast<std::size_t>(place_of(c))] == map.vertex(DartId{row}));
    CHECK(darts.dart(darts.half_face_of(d), c) == d);
    CHECK(darts.dart(DartMap::ConstDart(d)) == d);
    CHECK(map.id(DartId{row}) == DartId{row});
  }
}

TEST_CASE("bytes of darts and attributes are those of CGAL's containers", "[topology][dart_map]") {
  const VolumeMap map = built(kuhn_box({2, 2, 2}));
  const DartComplex& complex = map.darts().complex();
  const auto held = [](const auto& cells) {
    return cells.capacity() * sizeof(typename std::decay_t<decltype(cells)>::value_type);
  };
  CHECK(map.darts().bytes().darts == held(complex.darts()));
  CHECK(map.darts().bytes().attributes ==
        held(complex.attributes<0>()) + held(complex.attributes<3>()));
}

TEST_CASE("rows dropped and appended again may be retired ones, and come into use",
          "[topology][dart_map]") {
  VolumeMap map = built(two_tetrahedra());
  const FaceSplit split = split_on(map, {0, 1, 2});
  REQUIRE(map.vertices() == 8);
  // A tetrahedron of its own comes behind the three copies, which gluing retires then.
  CellChange change{5, 8, 2};
  change.points = {{5, 0, 0}, {6, 0, 0}, {5, 1, 0}, {5, 0, 1}};
  change.vertices = {5, 6, 7, 8};
  change.cells = {{TetId{2}, {VertexId{8}, VertexId{9}, VertexId{10}, VertexId{11}}, {}}};
  for (std::size_t v = 8; v < 12; ++v) change.begins.push_back({VertexId{v}, TetId{2}});
  map.apply(change);
  REQUIRE(check(map).empty());
  REQUIRE(glue_face(map, split.face, split.opposite).vertex_count == 3);
  REQUIRE(map.vertices() == 12);
  const MapRows before = rows_of(map);
  const CellChange redo = map.apply(CellChange{5, 5, 2});
  CHECK(map.vertices() == 5);
  CHECK(check(map).empty());
  CHECK(map.darts().complex().number_of_attributes<0>() == 5);
  map.apply(redo);
  CHECK(rows_of(map).corners == before.corners);
  CHECK(rows_of(map).point_of_vertex == before.point_of_vertex);
  CHECK(check(map).empty());
  CHECK(map.darts().complex().number_of_attributes<0>() == 9);
  // A tetrahedron that comes in may have the retired ones for its corners.
  CellChange again{9, 12, 3};
  again.points = {{0, 0, -7}};
  again.vertices = {9};
  again.cells = {{TetId{3}, {VertexId{5}, VertexId{6}, VertexId{7}, VertexId{12}}, {}}};
  again.begins = {{VertexId{0}, TetId{0}}};  // said once more
  for (const std::size_t v : {5, 6, 7, 12}) again.begins.push_back({VertexId{v}, TetId{3}});
  const CellChange taken_back = map.apply(again);
  CHECK(check(map).empty());
  CHECK(map.darts().complex().number_of_attributes<0>() == 13);
  // And goes again, and leaves them retired.
  map.apply(taken_back);
  CHECK(check(map).empty());
  CHECK(map.darts().complex().number_of_attributes<0>() == 9);
  CHECK(map.darts().incident_tetrahedron(VertexId{5}).is_none());
}
