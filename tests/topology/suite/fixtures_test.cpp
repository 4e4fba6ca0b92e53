// SPDX-License-Identifier: MIT
// The numbered fixtures of the topology cases, with the numbers computed outside this project.
#include "tests/support/built.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

void require_counts(const VolumeMap& map, const Cells5& expected, std::ptrdiff_t chi,
                    const Betti& betti) {
  const Counts counts = count_cells(map);
  CHECK(cells(counts) == expected);
  CHECK(counts.euler_characteristic == chi);
  REQUIRE(counts.betti);
  CHECK(*counts.betti == betti);
}

struct Cut {
  std::array<std::uint32_t, 3> points;
  SplitCount expected;
};

void require_cuts(VolumeMap& map, const std::vector<Cut>& cuts) {
  for (const Cut& cut : cuts) {
    INFO("face " << cut.points[0] << " " << cut.points[1] << " " << cut.points[2]);
    const Counts before = count_cells(map);
    const FaceSplit split = split_on(map, cut.points);
    REQUIRE(split.did);
    CHECK(split_count(split) == cut.expected);
    CHECK(oracle_says_new(split) == (cut.expected[0] == 3));
    CHECK(check_split_laws(before, count_cells(map), split).empty());
    CHECK(check(map).empty());
  }
}

}  // namespace

TEST_CASE("fixture 1: the faces of one tetrahedron cannot be split", "[topology][fixture]") {
  VolumeMap map = built(one_tetrahedron());
  require_counts(map, {4, 6, 4, 1, 1}, 1, {1, 0, 0});
  for (int p = 0; p < 4; ++p) CHECK_FALSE(split_face(map, half_face(TetId{0}, p)).did);
  CHECK(cells(map) == Cells5{4, 6, 4, 1, 1});
}

TEST_CASE("fixture 2: two tetrahedra come apart and together again", "[topology][fixture]") {
  VolumeMap map = built(two_tetrahedra());
  require_counts(map, {5, 9, 7, 2, 1}, 1, {1, 0, 0});
  const FaceSplit split = split_on(map, {0, 1, 2});
  CHECK(split_count(split) == SplitCount{3, 3});
  CHECK(oracle_says_new(split));
  CHECK(cells(map) == Cells5{8, 12, 8, 2, 2});
  CHECK(glue_face(map, split.face, split.opposite).refusal == GlueRefusal::none);
  require_counts(map, {5, 9, 7, 2, 1}, 1, {1, 0, 0});
}

TEST_CASE("fixture 3: an edge in common is no face in common", "[topology][fixture]") {
  const TetMesh mesh = two_tetrahedra_sharing_an_edge();
  const VolumeMap map = built(mesh);
  require_counts(map, {8, 12, 8, 2, 2}, 2, {2, 0, 0});
  CHECK(finding(check_mesh(mesh), "pinched_vertex").count == 2);
  CHECK(finding(check_mesh(mesh), "pinched_edge").count == 1);
  CHECK(map.vertices() == mesh.points.size() + 2);
}

TEST_CASE("fixture 4: a vertex in common is no face in common", "[topology][fixture]") {
  const TetMesh mesh = two_tetrahedra_sharing_a_vertex();
  const VolumeMap map = built(mesh);
  require_counts(map, {8, 12, 8, 2, 2}, 2, {2, 0, 0});
  CHECK(finding(check_mesh(mesh), "pinched_vertex").count == 1);
  CHECK(map.vertices() == mesh.points.size() + 1);
}

TEST_CASE("fixture 5: a closed fan opens with its first cut and falls apart with the others",
          "[topology][fixture]") {
  for (const int k : {3, 4, 6}) {
    INFO("k = " << k);
    const auto n = static_cast<std::size_t>(k);
    VolumeMap map = built(closed_fan(k));
    require_counts(map, {n + 2, 3 * n + 1, 3 * n, n, 1}, 1, {1, 0, 0});
    for (std::uint32_t i = 0; i < n; ++i) {
      require_cuts(map, {{{0, 1, 2 + i}, i == 0 ? SplitCount{1, 2} : SplitCount{3, 3}}});
      CHECK(cells(map)[4] == std::max<std::size_t>(1, i + 1));
    }
    CHECK(cells(map)[0] == 4 * n);
  }
}

TEST_CASE("fixture 6: the middle face of an open fan halves it", "[topology][fixture]") {
  VolumeMap map = built(open_fan(4));
  CHECK(cells(map) == Cells5{7, 15, 13, 4, 1});
  require_cuts(map, {{{0, 1, 4}, {3, 3}}});
  CHECK(cells(map) == Cells5{10, 18, 14, 4, 2});
}

TEST_CASE("fixture 7: the equator of an octahedron, face by face and opposite faces first",
          "[topology][fixture]") {
  VolumeMap map = built(octahedron_star());
  require_counts(map, {7, 18, 20, 8, 1}, 1, {1, 0, 0});
  require_cuts(map, {{{0, 1, 2}, {0, 1}}});
  CHECK(cells(map)[1] == 19);
  CHECK(cells(map)[2] == 21);
  require_cuts(map, {{{0, 2, 3}, {1, 2}}, {{0, 3, 4}, {1, 2}}, {{0, 4, 1}, {3, 3}}});
  CHECK(cells(map) == Cells5{12, 26, 24, 8, 2});
  VolumeMap other = built(octahedron_star());
  require_cuts(
      other, {{{0, 1, 2}, {0, 1}}, {{0, 3, 4}, {0, 1}}, {{0, 2, 3}, {2, 3}}, {{0, 4, 1}, {3, 3}}});
  CHECK(cells(other) == Cells5{12, 26, 24, 8, 2});
}

TEST_CASE("fixture 8, figure 4: the first section of a ring fools the oracle, the second parts it",
          "[topology][fixture][figure4]") {
  VolumeMap map = built(ring({3, 3, 1}));
  require_counts(map, {32, 112, 128, 48, 1}, 0, {1, 1, 0});
  Components labels = label_components(map);
  ComponentScratch scratch;
  const auto cut = [&](std::array<std::uint32_t, 3> points, SplitCount expected) {
    const FaceSplit split = split_on(map, points);
    CHECK(split_count(split) == expected);
    CHECK(check(map).empty());
    return update_components(map, std::span(&split, 1), Detection::exact, labels, scratch);
  };
  CHECK(cut({1, 5, 21}, {1, 2}).predicted == 0);
  const ComponentUpdate fooled = cut({1, 17, 21}, {3, 3});
  CHECK(fooled.predicted == 1);
  CHECK(fooled.created == 0);
  CHECK((*count_cells(map).betti)[1] == 0);
  CHECK(cut({9, 13, 29}, {1, 2}).predicted == 0);
  const ComponentUpdate parted = cut({9, 25, 29}, {3, 3});
  CHECK(parted.predicted == 1);
  CHECK(parted.created == 1);
  require_counts(map, {40, 122, 132, 48, 2}, 2, {2, 0, 0});
}

TEST_CASE("fixture 9, figure 5: the order of a fan's faces decides whether the oracle is fooled",
          "[topology][fixture][figure5]") {
  const std::array<std::uint32_t, 3> a = {1, 4, 14}, b = {4, 14, 17}, c = {4, 7, 17};
  struct Order {
    std::string name;
    std::vector<Cut> cuts;
  };
  const std::vector<Order> orders = {{"abc", {{a, {0, 1}}, {b, {0, 2}}, {c, {3, 3}}}},
                                     {"bac", {{b, {0, 1}}, {a, {0, 2}}, {c, {3, 3}}}},
                                     {"acb", {{a, {0, 1}}, {c, {1, 2}}, {b, {2, 3}}}},
                                     {"bca", {{b, {0, 1}}, {c, {2, 3}}, {a, {1, 2}}}},
                                     {"cab", {{c, {1, 2}}, {a, {0, 1}}, {b, {2, 3}}}},
                                     {"cba", {{c, {1, 2}}, {b, {1, 2}}, {a, {1, 2}}}}};
  int fooled = 0;
  for (const Order& order : orders) {
    INFO("order " << order.name);
    VolumeMap map = built(kuhn_box({2, 2, 2}));
    require_counts(map, {27, 98, 120, 48, 1}, 1, {1, 0, 0});
    require_cuts(map, {order.cuts[0], order.cuts[1]});
    // A false alarm is a handle that is cut, so there has to be one.
    const bool last_alarms = order.cuts[2].expected[0] == 3;
    CHECK((*count_cells(map).betti)[1] == (last_alarms ? 1 : 0));
    require_cuts(map, {order.cuts[2]});
    CHECK(cells(map) == Cells5{30, 104, 123, 48, 1});
    fooled += last_alarms ? 1 : 0;
  }
  CHECK(fooled == 2);
}

TEST_CASE("fixture 10: a cavity is a second sheet", "[topology][fixture]") {
  const VolumeMap solid = built(kuhn_box({3, 3, 3}));
  require_counts(solid, {64, 279, 378, 162, 1}, 1, {1, 0, 0});
  CHECK(count_cells(solid).boundary_sheets == 1);
  const VolumeMap hollow = built(shell({3, 3, 3}));
  require_counts(hollow, {64, 278, 372, 156, 1}, 2, {1, 0, 1});
  CHECK(count_cells(hollow).boundary_sheets == 2);
}

TEST_CASE("fixture 11: two crossing channels are three handles", "[topology][fixture]") {
  const VolumeMap map = built(crossing_channels());
  require_counts(map, {64, 266, 332, 132, 1}, -2, {1, 3, 0});
}

TEST_CASE("fixture 12: an inner crack begins as a lens-shaped void", "[topology][fixture]") {
  VolumeMap map = built(kuhn_box({4, 4, 4}));
  CHECK(cells(map) == Cells5{125, 604, 864, 384, 1});
  require_cuts(map, {{{32, 37, 62}, {0, 0}}});
  CHECK(*count_cells(map).betti == Betti{1, 0, 1});
  require_cuts(map, {{{32, 57, 62}, {0, 1}}});
  CHECK(*count_cells(map).betti == Betti{1, 0, 1});
}

TEST_CASE("fixture 13: cutting out a star makes one void and one separation",
          "[topology][fixture]") {
  VolumeMap map = built(kuhn_box({4, 4, 4}));
  const VertexId center{62};
  Components labels = label_components(map);
  ComponentScratch scratch;
  std::array<int, 4> seen = {0, 0, 0, 0};  // (0,0) (0,1) (1,2) (3,3)
  std::vector<HalfFaceId> link;
  for (const TetId t : star(map, center)) {
    link.push_back(half_face(t, place_of_vertex(map.corners(t), center)));
  }
  REQUIRE(link.size() == 24);
  // Cut in an order in which each face after the first meets one that is cut already: the crack
  // grows as one sheet, as the counts of the fixture assume.
  std::vector<HalfFaceId> order = {link.front()};
  link.erase(link.begin());
  std::size_t created = 0, predicted = 0;
  const auto cut = [&](HalfFaceId f) {
    const FaceSplit split = split_face(map, f);
    const SplitCount n = split_count(split);
    seen[n == SplitCount{0, 0} ? 0 : n == SplitCount{0, 1} ? 1 : n == SplitCount{1, 2} ? 2 : 3]++;
    const auto update =
        update_components(map, std::span(&split, 1), Detection::exact, labels, scratch);
    created += update.created;
    predicted += update.predicted;
  };
  cut(order.front());
  while (!link.empty()) {
    // The next face that would split one edge or two: a disc grows without handles.
    for (std::size_t i = 0; i < link.size(); ++i) {
      VolumeMap trial = map;
      const SplitCount n = split_count(split_face(trial, link[i]));
      const bool grows = n == SplitCount{0, 1} || n == SplitCount{1, 2} || n == SplitCount{3, 3};
      if (!grows) continue;
      cut(link[i]);
      link.erase(link.begin() + static_cast<std::ptrdiff_t>(i));
      break;
    }
  }
  CHECK(seen == std::array<int, 4>{1, 11, 11, 1});
  CHECK(predicted == 1);
  CHECK(created == 1);
  require_counts(map, {139, 640, 888, 384, 2}, 3, {2, 0, 1});
  CHECK(check(map).empty());
}

TEST_CASE("fixture 14: the first cut of a closed map makes its boundary", "[topology][fixture]") {
  VolumeMap map = built(closed_simplex_boundary());
  const Counts before = count_cells(map);
  CHECK(cells(before) == Cells5{5, 10, 10, 5, 1});
  CHECK(before.euler_characteristic == 0);
  CHECK(before.boundary_faces == 0);
  CHECK_FALSE(before.betti);
  const FaceSplit split = split_face(map, half_face(TetId{0}, 0));
  CHECK(split_count(split) == SplitCount{0, 0});
  require_counts(map, {5, 10, 11, 5, 1}, 1, {1, 0, 0});
  CHECK(check(map).empty());
}

TEST_CASE("fixture 15: a bar pinched onto itself stays a bar", "[topology][fixture]") {
  const TetMesh at_vertex = bent_bar(4, {{0, 0}});
  CHECK(at_vertex.points.size() == 19);
  const VolumeMap one = built(at_vertex);
  require_counts(one, {20, 61, 66, 24, 1}, 1, {1, 0, 0});
  const Finding pinch = finding(check_mesh(at_vertex), "pinched_vertex");
  CHECK(pinch.count == 1);
  CHECK(pinch.severity == Severity::note);
  CHECK(one.point_of_vertex(VertexId{19}) == static_cast<std::uint32_t>(pinch.ids.at(0)));
  const TetMesh at_edge = bent_bar(4, {{0, 0}, {0, 1}});
  CHECK(at_edge.points.size() == 18);
  require_counts(built(at_edge), {20, 61, 66, 24, 1}, 1, {1, 0, 0});
  CHECK(finding(check_mesh(at_edge), "pinched_vertex").count == 2);
  CHECK(finding(check_mesh(at_edge), "pinched_edge").count == 1);
}

TEST_CASE("fixture 16: a bar whose ends are joined is a ring", "[topology][fixture]") {
  const VolumeMap map = built(joined_ring(4, false));
  require_counts(map, {16, 56, 64, 24, 1}, 0, {1, 1, 0});
}

TEST_CASE("fixture 17: a ring that closes with a twist is refused", "[topology][fixture]") {
  const TetMesh mesh = joined_ring(4, true);
  CHECK(mesh.points.size() == 16);
  const Result<VolumeMap> map = build_map(mesh, Severity::warning);
  CHECK_FALSE(map);
  CHECK(finding(map.findings, "non_orientable").count > 0);
}

TEST_CASE("fixture 22: a cut in one body leaves the other alone", "[topology][fixture]") {
  VolumeMap map = built(side_by_side(two_tetrahedra(), one_tetrahedron()));
  CHECK(cells(map) == Cells5{9, 15, 11, 3, 2});
  Components labels = label_components(map);
  ComponentScratch scratch;
  const auto other_corners = map.corners(TetId{2});
  const FaceSplit split = split_on(map, {0, 1, 2});
  update_components(map, std::span(&split, 1), Detection::exact, labels, scratch);
  CHECK(map.corners(TetId{2}) == other_corners);
  CHECK(labels.of_tetrahedron[2] == ComponentId{1});
  CHECK(labels.of_tetrahedron[1] == ComponentId{2});
  CHECK(labels.size == std::vector<std::size_t>{1, 1, 1});
}

TEST_CASE("fixture 23: a body split at every face is a heap of tetrahedra", "[topology][fixture]") {
  for (const int n : {2, 4}) {
    VolumeMap map = built(kuhn_box({n, n, n}));
    const std::size_t T = map.tetrahedra();
    for (const HalfFaceId f : interior_faces(map)) CHECK(split_face(map, f).did);
    CHECK(cells(map) == Cells5{4 * T, 6 * T, 4 * T, T, T});
    CHECK(map.vertices() == 4 * T);
    CHECK(check(map).empty());
  }
}
