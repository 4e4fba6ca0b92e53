// SPDX-License-Identifier: MIT
// The laws of a face split, on every shape; and the checks, which notice violations.
#include <set>

#include "tests/support/built.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

/// The side that was passed keeps its rows; the other has new ones, appended in order, exactly
/// where a vertex split; a copy is where its vertex is.
void check_rows(const VolumeMap& map, const FaceSplit& split, std::size_t rows_before) {
  const auto& kept = map.corners(tetrahedron_of(split.face));
  const auto& other = map.corners(tetrahedron_of(split.opposite));
  for (const VertexId v : split.vertices) REQUIRE(place_of_vertex(kept, v) < 4);
  for (std::size_t i = 0; i < static_cast<std::size_t>(split.vertex_count); ++i) {
    const auto [old_row, new_row] = split.split_vertices[i];
    REQUIRE(new_row.index() == rows_before + i);
    REQUIRE(place_of_vertex(other, new_row) < 4);
    REQUIRE(place_of_vertex(other, old_row) == 4);
    REQUIRE(map.point(old_row) == map.point(new_row));
    REQUIRE(map.point_of_vertex(old_row) == map.point_of_vertex(new_row));
  }
  REQUIRE(map.vertices() == rows_before + static_cast<std::size_t>(split.vertex_count));
}

}  // namespace

TEST_CASE("every split of every shape obeys the laws, until nothing is left to split",
          "[topology][laws]") {
  const std::uint64_t seed = 41;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  std::set<SplitCount> kinds;
  for (const NamedMesh& shape : all_shapes()) {
    INFO(shape.name);
    VolumeMap map = built(shape.mesh);
    GlueTwin twin = twin_of(map, shape.mesh.points.size());
    std::vector<HalfFaceId> faces = interior_faces(map);
    Counts before = count_cells(map);
    REQUIRE(counts_without_chi(before) == union_find_counts(twin));
    while (!faces.empty()) {
      std::swap(faces[below(random, faces.size())], faces.back());
      const HalfFaceId across = map.neighbour(faces.back());
      const std::size_t rows = map.vertices();
      const FaceSplit split = split_face(map, below(random, 2) == 0 ? faces.back() : across);
      unglue(twin, faces.back());
      faces.pop_back();
      check_rows(map, split, rows);
      const Counts after = count_cells(map);
      REQUIRE(check_split_laws(before, after, split).empty());
      // The volume is summed over tetrahedra that no split moves.
      REQUIRE(after.volume == before.volume);
      REQUIRE(counts_after(before, map, std::span(&split, 1),
                           after.components - before.components) == after);
      kinds.insert(split_count(split));
      before = after;
    }
    REQUIRE(counts_without_chi(before) == union_find_counts(twin));
    CHECK(before.vertices == 4 * before.tetrahedra);
    CHECK(before.components == before.tetrahedra);
    CHECK(check(map).empty());
  }
  // Seven of the eight kinds are common; (0,3) is rare, one in four thousand.
  CHECK(kinds.size() >= 7);
}

TEST_CASE("false alarms are handles that were cut: never more than there were and were made",
          "[topology][laws][figure4]") {
  // On a body without handles every alarm is true as long as no split makes one.
  VolumeMap map = built(kuhn_box({2, 2, 2}));
  std::mt19937_64 random(43);
  std::vector<HalfFaceId> faces = interior_faces(map);
  std::ptrdiff_t made = 0, false_alarms = 0;
  Counts before = count_cells(map);
  while (!faces.empty()) {
    std::swap(faces[below(random, faces.size())], faces.back());
    const FaceSplit split = split_face(map, faces.back());
    faces.pop_back();
    const Counts after = count_cells(map);
    const std::ptrdiff_t handles = (*after.betti)[1] - (*before.betti)[1];
    if (handles > 0) made += handles;
    if (oracle_says_new(split) && after.components == before.components) {
      ++false_alarms;
      CHECK(handles == -1);
    }
    before = after;
  }
  CHECK(false_alarms <= made);
}

TEST_CASE("a broken law is named with what was seen and what it says", "[topology][laws]") {
  VolumeMap map = built(kuhn_box({2, 2, 2}));
  const Counts before = count_cells(map);
  const FaceSplit split = split_face(map, interior_faces(map).front());
  const Counts after = count_cells(map);
  REQUIRE(check_split_laws(before, after, split).empty());
  const auto broken = [&](auto change) {
    Counts wrong = after;
    FaceSplit said = split;
    change(wrong, said);
    const auto findings = check_split_laws(before, wrong, said);
    REQUIRE_FALSE(findings.empty());
    for (const Finding& f : findings) CHECK(f.code == "split_law");
    return findings.size();
  };
  broken([](Counts& c, FaceSplit&) { ++c.vertices; });
  broken([](Counts& c, FaceSplit&) { ++c.edges; });
  broken([](Counts& c, FaceSplit&) { ++c.faces; });
  broken([](Counts& c, FaceSplit&) { ++c.tetrahedra; });
  broken([](Counts& c, FaceSplit&) { ++c.boundary_faces; });
  broken([](Counts& c, FaceSplit&) { ++c.components; });
  broken([](Counts& c, FaceSplit&) { ++c.euler_characteristic; });
  broken([](Counts& c, FaceSplit&) { c.betti = {{1, 5, 0}}; });
  broken([](Counts&, FaceSplit& s) { s.vertex_count = 3; });
  broken([](Counts&, FaceSplit& s) {
    s.split_edges = 0;
    s.vertex_count = 1;
  });
  CHECK(broken([](Counts&, FaceSplit& s) { s.did = false; }) == 1);
}

TEST_CASE("Betti numbers say what a body is: solid, ring, shell, handles", "[topology][laws]") {
  CHECK(*count_cells(built(kuhn_box({3, 2, 1}))).betti == Betti{1, 0, 0});
  CHECK(*count_cells(built(ring({5, 4, 2}))).betti == Betti{1, 1, 0});
  CHECK(*count_cells(built(shell({4, 4, 4}))).betti == Betti{1, 0, 1});
  CHECK(*count_cells(built(crossing_channels())).betti == Betti{1, 3, 0});
  const Counts two = count_cells(built(side_by_side(ring({3, 3, 1}), shell({3, 3, 3}))));
  CHECK(*two.betti == Betti{2, 1, 1});
  CHECK(two.boundary_sheets == 3);
}

TEST_CASE("volume is that of the cubes", "[topology][laws]") {
  // 0.5 and its powers are exact, and so is every sum of them here.
  CHECK(count_cells(built(kuhn_box({3, 2, 1}, 0.5))).volume == Approx(6 * 0.125).epsilon(1e-15));
  CHECK(count_cells(built(ring({3, 3, 1}))).volume == Approx(8.0).epsilon(1e-15));
}
