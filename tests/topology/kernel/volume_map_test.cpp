// SPDX-License-Identifier: MIT
// Answers of a map besides its cells: how far a split looked, bytes, errors of fans, retired rows.
#include "tests/support/built.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

/// How many tetrahedra a walk round the edge between two rows meets, from the face away from it
/// until the boundary or the face again.
std::size_t met_round_edge(const VolumeMap& map, HalfFaceId face, VertexId a, VertexId b) {
  std::size_t met = 0;
  HalfFaceId at = face;
  do {
    ++met;
    HalfFaceId leave;
    for (int p = 0; p < 4; ++p) {
      const HalfFaceId f = half_face(tetrahedron_of(at), p);
      const VertexId opposite = map.corners(tetrahedron_of(at))[static_cast<std::size_t>(p)];
      if (f != at && opposite != a && opposite != b) leave = f;
    }
    at = map.neighbour(leave);
  } while (!at.is_none() && at != face);
  return met;
}

/// How many a search of a vertex' star meets, by the file's point, once the face is unsewn: both
/// sides look round one tetrahedron each in turn, the passed side first, until one has no more or
/// they meet; where they do not, the other side is looked at whole.
std::size_t met_in_star(const VolumeMap& map, std::uint32_t point, const FaceSplit& split) {
  std::array<std::vector<TetId>, 2> sides = {std::vector{tetrahedron_of(split.face)},
                                             std::vector{tetrahedron_of(split.opposite)}};
  std::array<std::size_t, 2> next{};
  const auto has = [&](std::size_t side, TetId t) {
    return std::ranges::find(sides[side], t) != sides[side].end();
  };
  const auto they_meet = [&](std::size_t side) {
    const TetId t = sides[side][next[side]++];
    for (int p = 0; p < 4; ++p) {
      if (map.point_of_vertex(map.corners(t)[static_cast<std::size_t>(p)]) == point) continue;
      const HalfFaceId across = map.neighbour(half_face(t, p));
      if (across.is_none() || has(side, tetrahedron_of(across))) continue;
      if (has(1 - side, tetrahedron_of(across))) return true;
      sides[side].push_back(tetrahedron_of(across));
    }
    return false;
  };
  bool met = false;
  for (std::size_t side = 0; !met && next[side] < sides[side].size(); side = 1 - side) {
    met = they_meet(side);
  }
  while (!met && next[1] < sides[1].size()) they_meet(1);
  return sides[0].size() + sides[1].size();
}

/// Splits a face and compares the count of visited tetrahedra with the twins.
FaceSplit split_and_count(VolumeMap& map, HalfFaceId face) {
  const VolumeMap before = map;
  const FaceSplit split = split_face(map, face);
  if (!split.did) return split;
  std::size_t met = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    met += met_round_edge(before, face, split.vertices[i], split.vertices[(i + 1) % 3]);
    const bool both =
        (split.split_edges >> i & 1) != 0 && (split.split_edges >> (i + 2) % 3 & 1) != 0;
    if (both) met += met_in_star(map, before.point_of_vertex(split.vertices[i]), split);
  }
  REQUIRE(split.visited == met);
  return split;
}

}  // namespace

TEST_CASE("a split looks at what the walks and searches of its twin meet", "[topology][split]") {
  const std::uint64_t seed = 61;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  for (const NamedMesh& shape : all_shapes()) {
    INFO(shape.name);
    VolumeMap map = built(shape.mesh);
    map.set_kernel(MapKernel::dense);
    for (std::size_t i = std::min<std::size_t>(150, 8 * map.tetrahedra()); i > 0; --i) {
      split_and_count(map, HalfFaceId{below(random, 4 * map.tetrahedra())});
    }
    CHECK(check(map).empty());
  }
}

TEST_CASE("stars of hundreds are searched from their small and from their large side",
          "[topology][split]") {
  // One tetrahedron comes off a fan: the table of a search grows by one of its sides alone.
  for (const std::size_t k : {30, 300, 700}) {
    for (const bool passes_large : {false, true}) {
      VolumeMap map = built(closed_fan(static_cast<int>(k)));
      CHECK(star(map, VertexId{0}).size() == k);
      split_and_count(map, face_on(map, {0, 1, 2}));
      HalfFaceId face = face_on(map, {0, 1, 3});
      const bool is_large =
          map.point_of_vertex(
              map.corners(tetrahedron_of(face))[static_cast<std::size_t>(place_of(face))]) != 2;
      if (is_large != passes_large) face = map.neighbour(face);
      const FaceSplit split = split_and_count(map, face);
      CHECK(split.vertex_count == 3);
      // If the others keep their rows, the cost is the walk round the axis and that of the one
      // tetrahedron.
      if (passes_large) CHECK(split.visited < k + 20);
      CHECK(star(map, VertexId{0}).size() == (passes_large ? k - 1 : 1));
      CHECK(check(map).empty());
    }
  }
}

TEST_CASE("a star is searched whose tetrahedra crowd one half of the table", "[topology][split]") {
  // The small table has 256 slots, where the search begins at one that the row gives: here an even
  // one for all of the fan. They are as many as the table's even slots, and more.
  const TetMesh both = side_by_side(closed_fan(140), kuhn_box({3, 3, 3}));
  TetMesh mesh = both;
  std::size_t of_fan = 0, other = 140;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const bool is_even = (t * 0x9e3779b1U >> 7) % 2 == 0;
    const bool takes_fan = (is_even && of_fan < 140) || other == both.tetrahedra.size();
    mesh.tetrahedra[t] = both.tetrahedra[takes_fan ? of_fan++ : other++];
    if (takes_fan) REQUIRE(is_even);
  }
  VolumeMap map = built(mesh);
  CHECK(star(map, VertexId{0}).size() == 140);
  CHECK(split_count(split_and_count(map, face_on(map, {0, 1, 2}))) == SplitCount{1, 2});
  CHECK(split_count(split_and_count(map, face_on(map, {0, 1, 72}))) == SplitCount{3, 3});
  CHECK(check(map).empty());
}

TEST_CASE("a split tells how many tetrahedra it looked at, as counted by hand",
          "[topology][split]") {
  for (const MapKernel kernel : {MapKernel::dense, MapKernel::lcc}) {
    VolumeMap two = built(two_tetrahedra());
    two.set_kernel(kernel);
    // Three edges, one tetrahedron each; three vertices, both sides of one tetrahedron each.
    CHECK(split_on(two, {0, 1, 2}).visited == 9);

    for (const int k : {3, 4, 7}) {
      VolumeMap fan = built(closed_fan(k));
      fan.set_kernel(kernel);
      // The axis' walk comes round all k; the two rim edges are open at once; only the rim's vertex
      // has both of its edges apart, and a tetrahedron on each side.
      const FaceSplit first = split_on(fan, {0, 1, 2});
      CHECK(first.vertex_count == 1);
      CHECK(first.visited == static_cast<std::uint32_t>(k) + 2 + 2);
      // The face opened, the fan is a row of k: the walk round the axis ends at the first face, one
      // tetrahedron away, and every search of a vertex meets only one or both ends.
      const FaceSplit second = split_on(fan, {0, 1, 3});
      CHECK(second.vertex_count == 3);
      CHECK(edge_count(second) == 3);
    }
    // Nothing to split, nothing looked at.
    CHECK(split_face(two, half_face(TetId{0}, 0)).visited == 0);
  }
}

TEST_CASE("a vertex of two sides that meet is searched from both in turn", "[topology][split]") {
  VolumeMap star = built(octahedron_star());
  // The first equator face: its rim edge opens, and no vertex has two open edges.
  const FaceSplit first = split_on(star, {0, 1, 2});
  // Edges 0-1 and 0-2 have four tetrahedra each, 1-2 has the two of the face.
  CHECK(first.visited == 4 + 4 + 1);
}

TEST_CASE("bytes of a map are those of its columns", "[topology][volume_map]") {
  TetMesh mesh = kuhn_box({4, 4, 4});
  for (const std::size_t t : {7, 8, 90}) std::swap(mesh.tetrahedra[t][0], mesh.tetrahedra[t][1]);
  VolumeMap map = built(mesh);
  map.set_kernel(MapKernel::dense);
  const MapRows& rows = map.dense().rows();
  REQUIRE(rows.reoriented.size() == 3);
  CHECK(total(MapBytes{}) == 0);
  const MapBytes dense = map.bytes();
  CHECK(dense.darts == 0);
  CHECK(dense.attributes == 0);
  CHECK(dense.handles == 0);
  CHECK(dense.adjacency == 16 * rows.corners.capacity() + 16 * rows.neighbours.capacity() +
                               4 * rows.reoriented.capacity());
  CHECK(dense.vertex_columns ==
        24 * rows.points.capacity() + 4 * rows.point_of_vertex.capacity() + 4 * map.vertices());
  CHECK(total(dense) == dense.adjacency + dense.vertex_columns);
  map.set_kernel(MapKernel::lcc);
  const MapBytes both = map.bytes();
  CHECK(both.adjacency == dense.adjacency);
  CHECK(both.vertex_columns == dense.vertex_columns);
  // At least a handle for each dart's four links; a point and rows for each vertex; a handle for
  // each tetrahedron and a corner for each vertex.
  CHECK(both.darts >= 12 * 4 * 8 * map.tetrahedra());
  CHECK(both.attributes >= 32 * map.vertices() + 8 * map.tetrahedra());
  CHECK(both.handles >= 8 * map.tetrahedra() + 4 * map.vertices());
  CHECK(both.handles < 16 * map.tetrahedra() + 8 * map.vertices());
  CHECK(total(both) == both.darts + both.attributes + both.handles + total(dense));
  // A map that already has the requested kernel keeps it.
  const DartMap* darts = &map.darts();
  map.set_kernel(MapKernel::lcc);
  CHECK(&map.darts() == darts);
}

TEST_CASE("counts of nothing are noughts", "[topology][counts]") {
  const Counts none = count_cells(VolumeMap(MapRows{}));
  CHECK(none == Counts{0, 0, 0, 0, 0, 0, 0, 0, std::array<std::ptrdiff_t, 3>{0, 0, 0}, 0});
  CHECK(Counts{} == Counts{0, 0, 0, 0, 0, 0, 0, 0, std::nullopt, 0});
}

TEST_CASE("the fan of a row that is none or retired is refused, with the rows there are",
          "[topology][fan]") {
  VolumeMap map = built(side_by_side(two_tetrahedra(), two_tetrahedra()));
  const FaceSplit first = split_on(map, {0, 1, 2});
  const FaceSplit second = split_on(map, {5, 6, 7});
  REQUIRE(first.vertex_count == 3);
  REQUIRE(second.vertex_count == 3);
  REQUIRE(map.vertices() == 16);
  REQUIRE(glue_face(map, first.face, first.opposite).vertex_count == 3);
  // The rows of the second split stand behind those retired.
  REQUIRE(map.vertices() == 16);
  for (const std::size_t row :
       {std::size_t{10}, std::size_t{12}, std::size_t{16}, std::size_t{99}}) {
    const auto fan = fan_faces(map, VertexId{row}, Point{0, 0, 1});
    REQUIRE_FALSE(fan);
    REQUIRE(fan.findings.size() == 1);
    const Finding& f = fan.findings[0];
    CHECK(f.code == "no_such_vertex");
    CHECK(f.ids == std::vector<std::int64_t>{static_cast<std::int64_t>(row)});
    CHECK(f.text ==
          "vertex " + std::to_string(row) + " is not a vertex of the body, which has rows 0 to 15");
    CHECK(f.remedy == "give the row of a vertex that belongs to a tetrahedron");
  }
  CHECK(star(map, VertexId{10}).empty());
  CHECK(vertex_star(map, VertexId{10}).vertex == VertexId{10});
  CHECK(fan_faces(map, VertexId{13}, Point{0, 0, 1}));
  const VolumeMap nothing{MapRows{}};
  const auto fan = fan_faces(nothing, VertexId{0}, Point{0, 0, 1});
  REQUIRE(fan.findings.size() == 1);
  CHECK(fan.findings[0].text == "vertex 0 is not a vertex of the body, which has rows 0 to 0");
}

TEST_CASE("a plane without a direction or an offset is refused in words", "[topology][fan]") {
  const VolumeMap map = built(two_tetrahedra());
  const double none = std::numeric_limits<double>::quiet_NaN(),
               all = std::numeric_limits<double>::infinity();
  for (const CuttingPlane& plane :
       {CuttingPlane{{0, 0, 0}, 0}, CuttingPlane{{none, 0, 1}, 0}, CuttingPlane{{0, all, 1}, 0},
        CuttingPlane{{0, 0, 1}, none}, CuttingPlane{{0, 0, 1}, all}}) {
    const auto faces = plane_faces(map, plane);
    CHECK_FALSE(faces);
    REQUIRE(faces.findings.size() == 1);
    CHECK(faces.findings[0].code == "not_a_direction");
    CHECK_FALSE(faces.findings[0].text.empty());
    CHECK_FALSE(faces.findings[0].remedy.empty());
  }
  const auto fan = fan_faces(map, VertexId{0}, Point{0, 0, 0});
  REQUIRE(fan.findings.size() == 1);
  CHECK(fan.findings[0].code == "not_a_direction");
}

TEST_CASE("the faces of a section are each on the positive side, once, in rising order",
          "[topology][fan]") {
  const VolumeMap map = built(kuhn_box({2, 2, 2}));
  for (const CuttingPlane& plane : {CuttingPlane{{0, 0, 1}, 1}, CuttingPlane{{1, 0, 0}, 1},
                                    CuttingPlane{{1, 1, 0}, 2.1}, CuttingPlane{{0, -3, 0}, -3}}) {
    const auto faces = plane_faces(map, plane);
    REQUIRE(faces);
    CHECK_FALSE(faces->empty());
    CHECK(std::ranges::is_sorted(*faces));
    const auto above = [&](TetId t) {
      double sum = 0;
      for (const VertexId v : map.corners(t)) {
        for (std::size_t i = 0; i < 3; ++i) sum += plane.normal[i] * map.point(v)[i];
      }
      // The sign is that of the canonical direction.
      const double side = plane.normal[1] < 0 ? -1 : 1;
      return side * (sum / 4 - plane.offset) >= 0;
    };
    std::vector<HalfFaceId> expected;
    for (std::size_t i = 0; i < 4 * map.tetrahedra(); ++i) {
      const HalfFaceId f{i}, across = map.neighbour(f);
      if (!across.is_none() && above(tetrahedron_of(f)) && !above(tetrahedron_of(across))) {
        expected.push_back(f);
      }
    }
    CHECK(*faces == expected);
  }
}
