// SPDX-License-Identifier: MIT
// The table of changes by a face split, compared with those that the exact sequence allows.
#include "tests/support/built.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// Whether a split of s_v vertices and s_e edges can change the Betti numbers by `d`, which Euler's
/// formula bounds: d0 - d1 + d2 = s_v - s_e + 1. The old body is the new one with the two copies of
/// the triangle glued. Before that they share S, the triangle's boundary less s_v vertices and s_e
/// edges: a circle, some parts, or nothing [Mayer-Vietoris].
bool can_change(int s_v, int s_e, const Betti& d) {
  if (d[0] - d[1] + d[2] != s_v - s_e + 1) return false;
  const int parts = s_e == 0 ? 1 : s_e - s_v, loops = s_e == 0 ? 1 : 0;
  if (d[0] < 0 || d[0] > (parts == 0 ? 1 : 0)) return false;
  // A circle: the copies close a void between them.
  if (loops == 1) return d[1] == 0 && d[2] == 1;
  // Each part but the first was a sheet between two voids that opens, or leaves a tunnel.
  if (parts > 0) return d[1] >= 0 && d[2] <= 0 && d[1] - d[2] == parts - 1;
  return d[2] == 0 && (d[0] == 1 ? d[1] == 0 : d[1] == -1);
}

FaceSplit split_of(int s_v, int s_e) {
  FaceSplit split;
  split.did = true;
  split.face = HalfFaceId{11};
  split.vertex_count = s_v;
  split.split_edges = static_cast<std::uint8_t>((1 << s_e) - 1);
  return split;
}

/// Counts of a large body after such a split.
Counts changed(Counts c, int s_v, int s_e, const Betti& d) {
  c.vertices += static_cast<std::size_t>(s_v);
  c.edges += static_cast<std::size_t>(s_e);
  c.faces += 1;
  c.boundary_faces += 2;
  c.components += static_cast<std::size_t>(d[0]);
  c.euler_characteristic += s_v - s_e + 1;
  for (std::size_t i = 0; i < 3; ++i) (*c.betti)[i] += d[i];
  return c;
}

Counts large() {
  Counts c;
  c.vertices = 100, c.edges = 300, c.faces = 300, c.tetrahedra = 100, c.components = 5;
  c.boundary_faces = 40, c.boundary_sheets = 8;
  c.betti = {{5, 6, 3}};
  return c;
}

}  // namespace

TEST_CASE("a split passes with the changes that the exact sequence leaves, and no others",
          "[topology][laws]") {
  const std::vector<SplitCount> kinds = {{0, 0}, {0, 1}, {0, 2}, {0, 3},
                                         {1, 2}, {1, 3}, {2, 3}, {3, 3}};
  for (int s_v = 0; s_v <= 3; ++s_v) {
    for (int s_e = 0; s_e <= 3; ++s_e) {
      const bool is_kind = std::ranges::find(kinds, SplitCount{s_v, s_e}) != kinds.end();
      int possible = 0;
      for (int i = 0; i < 4 * 7 * 7; ++i) {
        const Betti d = {i / 49, i / 7 % 7 - 3, i % 7 - 3};
        const bool passes =
            check_split_laws(large(), changed(large(), s_v, s_e, d), split_of(s_v, s_e)).empty();
        INFO(s_v << " vertices, " << s_e << " edges: " << d[0] << " " << d[1] << " " << d[2]);
        CHECK(passes == (is_kind && can_change(s_v, s_e, d)));
        possible += passes ? 1 : 0;
      }
      CHECK((possible > 0) == is_kind);
    }
  }
}

TEST_CASE("too few edges for the vertices, and a separation without three vertices, are told alone",
          "[topology][laws]") {
  const auto told = [](int s_v, int s_e, std::size_t separated) {
    Counts before = large(), after = changed(large(), s_v, s_e, {0, 0, 0});
    before.betti = after.betti = std::nullopt;
    after.components += separated;
    const auto findings = check_split_laws(before, after, split_of(s_v, s_e));
    REQUIRE(findings.size() <= 1);
    return findings.empty() ? std::string() : findings[0].text;
  };
  const auto has = [](const std::string& text, const char* words) {
    return text.find(words) != std::string::npos;
  };
  for (int s_v = 0; s_v <= 3; ++s_v) {
    for (int s_e = 0; s_e <= 3; ++s_e) {
      INFO(s_v << " vertices, " << s_e << " edges");
      const bool enough = s_v == 0 || (s_v == 1 && s_e >= 2) || s_e == 3;
      CHECK(told(s_v, s_e, 0).empty() == enough);
      if (!enough) CHECK(has(told(s_v, s_e, 0), "enough edges for the vertices"));
      if (!enough) continue;
      CHECK(told(s_v, s_e, 1).empty() == (s_v == 3));
      CHECK_FALSE(told(s_v, s_e, ~std::size_t{0}).empty());  // one component less
      CHECK(has(told(s_v, s_e, 2), "a separation that the oracle allows is 0, the law says 1"));
    }
  }
  CHECK(told(1, 0, 0) ==
        "splitting half-face 11 (1 vertices, 0 edges split): enough edges for the vertices (1: 2, "
        "more: "
        "3) is 0, the law says 1");
}

TEST_CASE("counts after splits are those of counting anew, by fields", "[topology][laws]") {
  for (const suite::NamedMesh& shape : suite::all_shapes()) {
    INFO(shape.name);
    VolumeMap map = built(shape.mesh);
    const Counts before = count_cells(map);
    std::vector<FaceSplit> splits;
    for (const HalfFaceId f : interior_faces(map)) {
      if (f.value % 3 != 0) splits.push_back(split_face(map, f));
    }
    // One that did nothing counts for nothing.
    splits.push_back(split_face(map, half_face(TetId{0}, 0)));
    splits.push_back({});
    const Counts after = count_cells(map);
    const Counts told = counts_after(before, map, splits, after.components - before.components);
    CHECK(told == after);
    if (before.betti) CHECK(told.volume == before.volume);
  }
}

TEST_CASE("what breaks a law is told with its face, once, and without Betti numbers as with them",
          "[topology][laws]") {
  Counts before = large(), after = changed(large(), 1, 2, {0, 0, 0});
  *after.betti = {(*after.betti)[0] + 1, (*after.betti)[1] + 2, (*after.betti)[2] - 4};
  const auto findings = check_split_laws(before, after, split_of(1, 2));
  REQUIRE(findings.size() == 1);
  CHECK(findings[0].code == "split_law");
  CHECK(findings[0].ids == std::vector<std::int64_t>{11});
  CHECK_FALSE(findings[0].remedy.empty());
  CHECK(
      findings[0].text ==
      "splitting half-face 11 (1 vertices, 2 edges split): a possible change of the Betti numbers "
      "(seen: 1, 2, -4) is 0, the law says 1");
  after.betti = std::nullopt;
  CHECK(check_split_laws(before, after, split_of(1, 2)).empty());
  std::swap(before.betti, after.betti);
  CHECK(check_split_laws(before, after, split_of(1, 2)).empty());
  // Parts that join are no split's doing.
  after.components -= 1;
  CHECK(check_split_laws(before, after, split_of(1, 2)).size() == 1);
  FaceSplit none = split_of(0, 0);
  none.did = false;
  const auto undone = check_split_laws(large(), large(), none);
  REQUIRE(undone.size() == 1);
  CHECK(undone[0].text ==
        "splitting half-face 11 (0 vertices, 0 edges split): did (nothing else to "
        "hold) is 0, the law says 1");
}

TEST_CASE("a split that did nothing is passed over, wherever it stands", "[topology][laws]") {
  VolumeMap map = built(suite::kuhn_box({2, 2, 2}));
  const Counts before = count_cells(map);
  std::vector<FaceSplit> splits(1);
  for (const HalfFaceId f : interior_faces(map)) splits.push_back(split_face(map, f));
  const Counts after = count_cells(map);
  CHECK(counts_after(before, map, splits, after.components - before.components) == after);
}
