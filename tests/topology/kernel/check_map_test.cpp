// SPDX-License-Identifier: MIT
// Every rule of `check` about the rows of a map, broken alone: its words, how often, where.
#include "tests/topology/kernel/map_damage.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

struct Rows {
  MapRows map;
  std::vector<TetId> begins;
};

Rows rows_of(const TetMesh& mesh) {
  const VolumeMap map = built(mesh);
  const auto begins = map.dense().incident_tetrahedra();
  return {map.dense().rows(), {begins.begin(), begins.end()}};
}

std::vector<Finding> checked(const Rows& rows) { return check(VolumeMap(rows.map, rows.begins)); }

HalfFaceId& across(Rows& rows, HalfFaceId f) {
  return rows.map.neighbours[f.index() / 4][f.index() % 4];
}
}  // namespace

TEST_CASE("rows that break one rule of a map are told by it, before any dart is made",
          "[topology][volume_map]") {
  Rows rows = rows_of(kuhn_box({2, 1, 1}));
  REQUIRE(checked(rows).empty());
  const std::size_t vertices = rows.begins.size(), tetrahedra = rows.map.corners.size();

  SECTION("a row of a corner") {
    for (const std::size_t row : {vertices, vertices + 5}) {
      rows.map.corners[5][3] = VertexId{row};
      require_among(checked(rows), "rows of corners are in range", {5});
    }
  }
  SECTION("two corners on one point") {
    rows.map.point_of_vertex[rows.map.corners[3][0].index()] =
        rows.map.point_of_vertex[rows.map.corners[3][2].index()];
    Ids both;
    for (std::size_t t = 0; t < tetrahedra; ++t) {
      const auto& c = rows.map.corners[t];
      if (std::ranges::count(c, rows.map.corners[3][0]) +
              std::ranges::count(c, rows.map.corners[3][2]) ==
          2) {
        both.push_back(static_cast<std::int64_t>(t));
      }
    }
    require_only(checked(rows), "the corners of a tetrahedron have different points", both);
  }
  const VolumeMap whole = built(kuhn_box({2, 1, 1}));
  const HalfFaceId f = interior_faces(whole).front(), g = whole.neighbour(f);
  SECTION("a neighbour that is none of them") {
    for (const std::size_t row : {4 * tetrahedra, 4 * tetrahedra + 7}) {
      across(rows, f) = HalfFaceId{row};
      require_among(checked(rows), "neighbours are in range", {id(f)});
    }
    for (int p = 0; p < 4; ++p) across(rows, half_face(TetId{4}, p)) = HalfFaceId{4 * tetrahedra};
    across(rows, f) = g;
    require_among(checked(rows), "neighbours are in range", {16, 17, 18, 19});
  }
  SECTION("a neighbour that knows of none") {
    across(rows, g) = HalfFaceId::none();
    require_only(checked(rows), "neighbours name each other", {id(f)});
    const HalfFaceId last = interior_faces(whole).back(), of_last = whole.neighbour(last);
    across(rows, g) = f;
    across(rows, of_last) = HalfFaceId{0};
    for (const Finding& told : checked(rows)) {
      if (told.text == "neighbours name each other")
        CHECK(std::ranges::count(told.ids, id(last)) == 1);
    }
    require_among(checked(rows), "neighbours name each other", sorted({id(last), id(of_last)}));
  }
  SECTION("two faces of one tetrahedron changed for each other") {
    HalfFaceId other;
    for (int p = 0; p < 4; ++p) {
      const HalfFaceId h = half_face(tetrahedron_of(f), p);
      if (h != f && !whole.neighbour(h).is_none()) other = h;
    }
    REQUIRE_FALSE(other.is_none());
    const HalfFaceId k = whole.neighbour(other);
    across(rows, f) = k, across(rows, k) = f;
    across(rows, other) = g, across(rows, g) = other;
    require_only(checked(rows), "the rows of a face are the same on both sides",
                 sorted({id(f), id(g), id(other), id(k)}));
  }
  SECTION("a face taken for one beside it, whose opposite corner it has") {
    HalfFaceId beside;
    for (int p = 0; p < 4; ++p) {
      const HalfFaceId h = half_face(tetrahedron_of(g), p);
      if (whole.neighbour(h).is_none()) beside = h;
    }
    REQUIRE_FALSE(beside.is_none());
    across(rows, f) = beside, across(rows, beside) = f;
    across(rows, g) = HalfFaceId::none();
    require_only(checked(rows), "the rows of a face are the same on both sides",
                 sorted({id(f), id(beside)}));
  }
  SECTION("a vertex that begins nowhere, or where it is not") {
    rows.begins[2] = rows.begins[5] = TetId::none();
    require_only(checked(rows), "only retired rows have no tetrahedron", {2, 5});
    for (const std::size_t v : {2, 5}) {
      std::size_t t = 0;
      while (place_of_vertex(rows.map.corners[t], VertexId{v}) < 4) ++t;
      rows.begins[v] = TetId{t};
    }
    require_only(checked(rows), "the incident tetrahedron has the vertex", {2, 5});
  }
  SECTION("corners that have the row of a node") {
    rows.map.first_node_point = 10;  // of twelve
    require_only(checked(rows), "no corner has the row of a node", {10, 11});
  }
}

TEST_CASE("a row of two orbits and a retired last row are damage", "[topology][volume_map]") {
  Rows rows = rows_of(two_tetrahedra_sharing_a_vertex());
  const std::size_t last = rows.begins.size() - 1;
  VertexId first;
  for (VertexId& v : rows.map.corners[1]) {
    if (v.index() != last) continue;
    for (const VertexId u : rows.map.corners[0]) {
      if (rows.map.point_of_vertex[u.index()] == rows.map.point_of_vertex[last]) v = first = u;
    }
  }
  REQUIRE_FALSE(first.is_none());
  // One row for both: nobody has the last row any more, and it says that it begins.
  std::vector<Finding> findings = checked(rows);
  CHECK(findings.size() == 2);
  require_among(findings, "each row is one vertex orbit", {first.value});
  require_among(findings, "only retired rows have no tetrahedron",
                {static_cast<std::int64_t>(last)});
  rows.begins[last] = TetId::none();
  findings = checked(rows);
  CHECK(findings.size() == 2);
  require_among(findings, "each row is one vertex orbit", {first.value});
  require_among(findings, "the last row is not a retired one",
                {static_cast<std::int64_t>(last) + 1});
}

TEST_CASE("a body without tetrahedra has nothing to break", "[topology][volume_map]") {
  CHECK(check(VolumeMap(MapRows{})).empty());
}
