// SPDX-License-Identifier: MIT
// Fans at a vertex, sections of a plane, the order of their faces, and normals without a plane.
#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/built.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

Point rest_center(const VolumeMap& map, TetId t) {
  Point c = {0, 0, 0};
  for (const VertexId v : map.corners(t)) {
    for (int i = 0; i < 3; ++i) c[i] += map.point(v)[i] / 4;
  }
  return c;
}

/// Whether an edge of the face is on the surface: whether one of the tetrahedra that hang together
/// by faces at the edge, this one among them, has such a face that is nobody else's.
bool has_surface_edge(const VolumeMap& map, HalfFaceId face) {
  const auto v = corners_of_face(map.corners(tetrahedron_of(face)), face);
  for (std::size_t i = 0; i < 3; ++i) {
    std::vector<TetId> ring = {tetrahedron_of(face)};
    for (std::size_t k = 0; k < ring.size(); ++k) {
      for (int p = 0; p < 4; ++p) {
        const VertexId opposite = map.corners(ring[k])[static_cast<std::size_t>(p)];
        if (opposite == v[i] || opposite == v[(i + 1) % 3]) continue;
        const HalfFaceId across = map.neighbour(half_face(ring[k], p));
        if (across.is_none()) return true;
        const TetId u = tetrahedron_of(across);
        if (std::ranges::find(ring, u) == ring.end()) ring.push_back(u);
      }
    }
  }
  return false;
}

}  // namespace

TEST_CASE("a star is every tetrahedron of a vertex, in order", "[topology][fan]") {
  const VolumeMap map = built(jittered(kuhn_box({3, 3, 3}), 0.1, 2));
  for (std::size_t v = 0; v < map.vertices(); ++v) {
    std::vector<TetId> expected;
    for (std::size_t t = 0; t < map.tetrahedra(); ++t) {
      if (place_of_vertex(map.corners(TetId{t}), VertexId{v}) < 4) expected.push_back(TetId{t});
    }
    CHECK(star(map, VertexId{v}) == expected);
  }
}

TEST_CASE("a fan is the faces between the two sides, seen from the positive one",
          "[topology][fan]") {
  const std::uint64_t seed = 31;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  const VolumeMap map = built(jittered(kuhn_box({3, 3, 3}), 0.2, 2));
  for (std::size_t v = 0; v < map.vertices(); ++v) {
    const Point n = {unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5};
    const auto fan = fan_faces(map, VertexId{v}, n);
    REQUIRE(fan);
    CHECK(std::is_sorted(fan->begin(), fan->end()));
    const Point u = canonical_direction(n);
    const auto side = [&](TetId t) {
      const Point c = rest_center(map, t), x = map.point(VertexId{v});
      return u[0] * (c[0] - x[0]) + u[1] * (c[1] - x[1]) + u[2] * (c[2] - x[2]) >= 0;
    };
    std::vector<HalfFaceId> expected;
    for (const TetId t : star(map, VertexId{v})) {
      for (int p = 0; p < 4; ++p) {
        const HalfFaceId across = map.neighbour(half_face(t, p));
        if (across.is_none() || map.corners(t)[p] == VertexId{v}) continue;
        if (side(t) && !side(tetrahedron_of(across))) expected.push_back(half_face(t, p));
      }
    }
    CHECK(*fan == expected);
    // n and -n, long or short, are one plane.
    CHECK(*fan_faces(map, VertexId{v}, Point{-n[0], -n[1], -n[2]}) == *fan);
    CHECK(*fan_faces(map, VertexId{v}, Point{1e-200 * n[0], 1e-200 * n[1], 1e-200 * n[2]}) == *fan);
    CHECK(*fan_faces(map, VertexId{v}, Point{1e200 * n[0], 1e200 * n[1], 1e200 * n[2]}) == *fan);
  }
}

TEST_CASE("splitting the last face of a fan splits its vertex", "[topology][fan]") {
  VolumeMap map = built(kuhn_box({2, 2, 2}));
  const VertexId center{13};
  const auto fan = fan_faces(map, center, {0, 0, 1});
  REQUIRE(fan);
  REQUIRE(fan->size() > 2);
  for (std::size_t i = 0; i < fan->size(); ++i) {
    const FaceSplit split = split_face(map, (*fan)[i]);
    const bool center_split =
        std::any_of(split.split_vertices.begin(), split.split_vertices.begin() + split.vertex_count,
                    [center](const VertexCopy& c) { return c.old_row == center; });
    CHECK(center_split == (i + 1 == fan->size()));
  }
  CHECK(check(map).empty());
}

TEST_CASE("a fan that parts nothing visits as much in a large body as in a small one",
          "[topology][fan][cost]") {
  std::vector<std::size_t> visited;
  for (const int n : {4, 10, 20}) {
    VolumeMap map = built(kuhn_box({n, n, n}));
    Components labels = label_components(map);
    ComponentScratch scratch;
    const VertexId middle{grid_point({n, n, n}, n / 2, n / 2, n / 2)};
    std::vector<FaceSplit> splits;
    std::size_t looked_at = 0;
    const auto fan = fan_faces(map, middle, {0.3, 0.5, 1});
    for (const HalfFaceId f : *fan) {
      splits.push_back(split_face(map, f));
      // Three edges of at most eight tetrahedra, three stars of at most 24.
      CHECK(splits.back().visited <= 3 * 8 + 3 * 24);
      looked_at += splits.back().visited;
    }
    const auto update = update_components(map, splits, Detection::exact, labels, scratch);
    CHECK(update.created == 0);
    CHECK(splits.size() > 3);
    visited.push_back(looked_at + update.visited);
  }
  CHECK(visited == std::vector<std::size_t>(3, visited[0]));
  VolumeMap pair = built(two_tetrahedra());
  // One tetrahedron round each edge, two in each star: nothing else is there.
  CHECK(split_on(pair, {0, 1, 2}).visited == 3 * 1 + 3 * 2);
  CHECK(split_on(pair, {0, 1, 2}).visited == 0);
}

TEST_CASE("a centre on the plane counts as positive, to a millionth of its tetrahedron",
          "[topology][fan]") {
  // The plane z = 1/4 through a vertex at that height holds the first tetrahedron's centre.
  TetMesh mesh = two_tetrahedra();
  const VolumeMap map = built(mesh);
  const auto fan = plane_faces(map, {{0, 0, 1}, 0.25});
  REQUIRE(fan);
  CHECK(fan->size() == 1);
  // Off by less than a millionth of its radius, sqrt(11) / 4: the same fan; by more: on one side.
  for (const double off : {-8e-7, -1e-16, 1e-16, 8e-7}) {
    CHECK(*plane_faces(map, {{0, 0, 1}, 0.25 + off}) == *fan);
  }
  CHECK(plane_faces(map, {{0, 0, 1}, 0.25 + 8.6e-7})->empty());
  // A turned copy of an axis-aligned body gives the turned plane the same fan.
  TetMesh turned = kuhn_box({2, 2, 2});
  const double c = std::cos(0.3), s = std::sin(0.3);
  for (Point& p : turned.points) p = {c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]};
  const VolumeMap straight = built(kuhn_box({2, 2, 2})), oblique = built(turned);
  for (std::size_t v = 0; v < straight.vertices(); ++v) {
    CHECK(*fan_faces(straight, VertexId{v}, {1, 0, 0}) ==
          *fan_faces(oblique, VertexId{v}, {c, s, 0}));
  }
}

TEST_CASE("a fan does not change where the body lies far from the origin", "[topology][fan]") {
  // Kuhn tetrahedra have rest centres like v + (3, 2, 1) / 4: on the plane with normal (1, -2, 1).
  // With edges of 0.1, far away, the coordinates themselves are off by more than 1e-10 of that.
  const TetMesh near = kuhn_box({3, 3, 3}, 0.1);
  TetMesh far = near;
  for (Point& p : far.points) {
    for (double& x : p) x += 1e6 / 3;
  }
  const VolumeMap a = built(near), b = built(far);
  for (std::size_t v = 0; v < a.vertices(); ++v) {
    CHECK(*fan_faces(a, VertexId{v}, {1, -2, 1}) == *fan_faces(b, VertexId{v}, {1, -2, 1}));
  }
}

TEST_CASE("a normal that is no direction and a vertex that is none are findings",
          "[topology][fan]") {
  VolumeMap map = built(two_tetrahedra());
  for (const Point& bad : {Point{0, 0, 0}, Point{std::nan(""), 0, 1}}) {
    const auto fan = fan_faces(map, VertexId{0}, bad);
    CHECK_FALSE(fan);
    CHECK(finding(fan.findings, "not_a_direction").severity == Severity::error);
    CHECK_FALSE(plane_faces(map, {bad, 0}));
  }
  CHECK_FALSE(plane_faces(map, {{1, 0, 0}, std::nan("")}));
  for (const VertexId v : {VertexId{5}, VertexId::none()}) {
    const auto fan = fan_faces(map, v, {0, 0, 1});
    CHECK_FALSE(fan);
    finding(fan.findings, "no_such_vertex");
  }
}

TEST_CASE("all tetrahedra on one side: an empty fan, no error", "[topology][fan]") {
  const VolumeMap map = built(two_tetrahedra());
  const auto fan = fan_faces(map, VertexId{3}, {0, 0, 1});
  REQUIRE(fan);
  CHECK(fan->empty());
  CHECK(plane_faces(map, {{1, 0, 0}, 5})->empty());
}

TEST_CASE("the section of a plane parts a body in two", "[topology][fan]") {
  const std::uint64_t seed = 33;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  for (int trial = 0; trial < 20; ++trial) {
    VolumeMap map = built(jittered(kuhn_box({3, 3, 3}), 0.1, 3));
    const Point n = {unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5};
    const CuttingPlane plane = {n, 1.5 * (n[0] + n[1] + n[2])};
    const auto faces = plane_faces(map, plane);
    REQUIRE(faces);
    REQUIRE_FALSE(faces->empty());
    for (const HalfFaceId f : *faces) CHECK(split_face(map, f).did);
    // No interior face has its tetrahedra on different sides any more.
    CHECK(plane_faces(map, plane)->empty());
    CHECK(count_cells(map).components >= 2);
    CHECK(check(map).empty());
  }
}

TEST_CASE("the paper's order puts faces with an edge on the surface first, cracks included",
          "[topology][fan][figure5]") {
  VolumeMap map = built(kuhn_box({4, 4, 4}));
  const VertexId center{62};
  auto fan = *fan_faces(map, center, {0, 0, 1});
  const auto given = fan;
  order_faces(map, FaceOrder::given, fan);
  CHECK(fan == given);
  order_faces(map, FaceOrder::paper, fan);
  CHECK(fan == given);  // deep inside: no face has an edge on the surface, the order stands
  // One cracked face next to the last face of the fan: their common edge is surface now, and with
  // it every face of the fan that has it.
  const HalfFaceId last = given.back();
  const TetId t = tetrahedron_of(last);
  int q = 0;
  while (q == place_of(last) || map.corners(t)[q] == center) ++q;
  CHECK(split_count(split_face(map, half_face(t, q))) == SplitCount{0, 0});
  order_faces(map, FaceOrder::paper, fan);
  CHECK(fan.front() != given.front());
  const auto first_inner = std::find(fan.begin(), fan.end(), given.front());
  CHECK(std::find(fan.begin(), first_inner, last) != first_inner);
  CHECK(std::is_permutation(fan.begin(), fan.end(), given.begin(), given.end()));
}

TEST_CASE("the paper's order parts faces by their edges alone, the given one does nothing",
          "[topology][fan]") {
  const std::uint64_t seed = 36;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  for (int trial = 0; trial < 300; ++trial) {
    VolumeMap map = built(kuhn_box({3, 3, 3}));
    for (std::size_t i = below(random, 60); i > 0; --i) {
      split_face(map, HalfFaceId{below(random, 4 * map.tetrahedra())});
    }
    const Point n = {unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5};
    const std::vector<HalfFaceId> fan = *fan_faces(map, VertexId{below(random, 64)}, n);
    std::vector<HalfFaceId> given = fan, paper = fan, expected = fan;
    order_faces(map, FaceOrder::given, given);
    CHECK(given == fan);
    order_faces(map, FaceOrder::paper, paper);
    std::ranges::stable_partition(expected, [&](HalfFaceId f) { return has_surface_edge(map, f); });
    CHECK(paper == expected);
  }
}

TEST_CASE("more than two copies of a vertex can result from one fan", "[topology][fan]") {
  const std::uint64_t seed = 34;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  int most = 0;
  for (int trial = 0; trial < 40; ++trial) {
    VolumeMap map = built(jittered(kuhn_box({3, 3, 3}), 0.3, seed + trial));
    for (std::size_t v = 0; v < 64; ++v) {
      const Point n = {unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5};
      int copies = 1;
      const auto fan = fan_faces(map, VertexId{v}, n);
      for (const HalfFaceId f : *fan) {
        const FaceSplit split = split_face(map, f);
        for (int i = 0; i < split.vertex_count; ++i) {
          if (map.point_of_vertex(split.split_vertices[i].old_row) == v) ++copies;
        }
      }
      most = std::max(most, copies);
    }
    REQUIRE(check(map).empty());
  }
  CHECK(most > 2);
}

TEST_CASE("faces are found by their points, in any order of the three", "[topology][fan]") {
  const VolumeMap map = built(kuhn_box({2, 2, 2}));
  std::vector<std::array<std::uint32_t, 3>> asked;
  std::vector<HalfFaceId> expected;
  std::mt19937_64 random(35);
  for (std::size_t i = 0; i < 4 * map.tetrahedra(); ++i) {
    const HalfFaceId f{i}, across = map.neighbour(f);
    const auto corners = map.corners(tetrahedron_of(f));
    std::array<std::uint32_t, 3> points;
    for (int k = 0; k < 3; ++k) {
      points[k] = map.point_of_vertex(corners[dart_order::face_corners[place_of(f)][k]]);
    }
    std::rotate(points.begin(), points.begin() + below(random, 3), points.end());
    asked.push_back(points);
    expected.push_back(across.is_none() ? f : std::min(f, across));
  }
  asked.push_back({0, 1, 26});
  expected.push_back(HalfFaceId::none());
  asked.push_back({0, 1, 999});
  expected.push_back(HalfFaceId::none());
  CHECK(find_faces(map, std::span<const std::array<std::uint32_t, 3>>(asked)) == expected);
}
