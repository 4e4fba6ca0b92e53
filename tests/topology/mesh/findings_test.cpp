// SPDX-License-Identifier: MIT
// Every finding about a mesh, one defect each, and garbage that must not bring the check down.
#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/built.hpp"
#include "topology/mesh/survey.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The mesh has this one finding besides `beside`; with an error there is no map, without there is.
Finding only_finding(const TetMesh& mesh, const std::string& code, Severity severity,
                     std::vector<std::string> beside = {}) {
  const std::vector<Finding> findings = check_mesh(mesh);
  const Finding found = finding(findings, code);
  CHECK(found.severity == severity);
  CHECK_FALSE(found.text.empty());
  CHECK_FALSE(found.remedy.empty());
  CHECK(found.ids.size() <= Finding::max_ids);
  beside.push_back(code);
  std::vector<std::string> seen = codes(findings);
  std::sort(beside.begin(), beside.end());
  std::sort(seen.begin(), seen.end());
  CHECK(seen == beside);
  const Result<VolumeMap> map = build_map(mesh);
  CHECK(static_cast<bool>(map) == !has_error(findings));
  CHECK(codes(map.findings) == codes(findings));
  return found;
}

}  // namespace

TEST_CASE("a good mesh has no finding", "[topology][findings]") {
  CHECK(check_mesh(kuhn_box({3, 3, 3})).empty());
  CHECK(check_mesh(jittered(kuhn_box({4, 4, 4}), 0.1, 3)).empty());
  CHECK(check_mesh(ring({3, 3, 1})).empty());
}

TEST_CASE("a mesh far from the origin and a chip of a micrometre are as good as any",
          "[topology][findings]") {
  TetMesh far = kuhn_box({2, 2, 2}, 1e-3);
  for (Point& p : far.points) p[0] += 1e6;
  CHECK(check_mesh(far).empty());
  CHECK(check_mesh(kuhn_box({2, 2, 2}, 1e-6)).empty());
}

TEST_CASE("nothing at all is an empty mesh", "[topology][findings]") {
  only_finding({}, "empty_mesh", Severity::error);
}

TEST_CASE("points without tetrahedra are no body", "[topology][findings]") {
  TetMesh mesh = one_tetrahedron();
  mesh.tetrahedra.clear();
  const Finding f = only_finding(mesh, "no_tetrahedron", Severity::error, {"unused_point"});
  CHECK(f.ids.empty());
}

TEST_CASE("a mesh beyond 32-bit rows is refused before anything else is asked of it",
          "[topology][findings]") {
  // With a limit that a test can reach; the true one is 357 913 941 tetrahedra.
  const TetMesh mesh = two_tetrahedra();
  Survey survey{mesh, Severity::error, {}, {}, {}, {}, {}, {}, {}, {}};
  survey_size(survey, 2, 5);
  CHECK(survey.findings.empty());
  survey_size(survey, 1, 5);
  CHECK(finding(survey.findings, "too_large").severity == Severity::error);
  survey.findings.clear();
  survey_size(survey, 2, 4);
  finding(survey.findings, "too_large");
}

TEST_CASE("a column that is too short is refused", "[topology][findings]") {
  TetMesh mesh = two_tetrahedra();
  mesh.region = {1};
  only_finding(mesh, "column_length", Severity::error);
}

TEST_CASE("a number beyond the points is refused and never used", "[topology][findings]") {
  for (const std::uint32_t bad : {5U, 0x7fffffffU, 0xffffffffU}) {
    TetMesh mesh = two_tetrahedra();
    mesh.tetrahedra[1][3] = bad;
    const Finding f = only_finding(mesh, "index_out_of_range", Severity::error, {"unused_point"});
    CHECK(f.ids == std::vector<std::int64_t>{1});
  }
}

TEST_CASE("a coordinate that is no number is refused", "[topology][findings]") {
  for (const double bad : {std::nan(""), infinity, -infinity}) {
    for (const std::size_t axis : {0, 1, 2}) {
      TetMesh mesh = two_tetrahedra();
      mesh.points[3][axis] = bad;
      CHECK(only_finding(mesh, "nan_coordinate", Severity::error).ids ==
            std::vector<std::int64_t>{3});
    }
  }
}

TEST_CASE("a tetrahedron that names a point twice is refused", "[topology][findings]") {
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      INFO("corners " << j << " and " << i);
      TetMesh mesh = two_tetrahedra();
      std::array<std::uint32_t, 4> corners = {0, 1, 3, 4};
      corners[i] = corners[j];
      mesh.tetrahedra.push_back(corners);
      CHECK(only_finding(mesh, "repeated_vertex", Severity::error).ids ==
            std::vector<std::int64_t>{2});
    }
  }
}

TEST_CASE("fixture 18: a copy of a tetrahedron is refused, mirrored or not, with its row",
          "[topology][findings][fixture]") {
  TetMesh mesh = kuhn_box({2, 1, 1});
  mesh.tetrahedra.push_back(mesh.tetrahedra[3]);
  CHECK(only_finding(mesh, "duplicate_tetrahedron", Severity::error).ids ==
        std::vector<std::int64_t>{12});
  std::swap(mesh.tetrahedra[12][0], mesh.tetrahedra[12][1]);
  CHECK(only_finding(mesh, "mirrored_tetrahedron", Severity::error).ids ==
        std::vector<std::int64_t>{12});
  TetMesh pair = one_tetrahedron();
  pair.tetrahedra.push_back({1, 0, 2, 3});
  only_finding(pair, "mirrored_tetrahedron", Severity::error);
  pair.tetrahedra[1] = {1, 2, 0, 3};
  pair.tetrahedra.push_back({2, 0, 1, 3});
  CHECK(only_finding(pair, "duplicate_tetrahedron", Severity::error).count == 2);
}

TEST_CASE("fixture 19: a face of three tetrahedra is refused with the face and all three",
          "[topology][findings][fixture]") {
  TetMesh mesh = two_tetrahedra();
  mesh.points.push_back({0.2, 0.2, -2});
  mesh.tetrahedra.push_back({1, 0, 2, 5});
  const Finding f =
      only_finding(mesh, "overfull_face", Severity::error, {"pinched_vertex", "pinched_edge"});
  CHECK(f.count == 1);
  CHECK(f.ids == std::vector<std::int64_t>{0, 1, 2, 0, 1, 2});
}

TEST_CASE("fixture 20: an inverted tetrahedron is turned over and listed",
          "[topology][findings][fixture]") {
  TetMesh mesh = two_tetrahedra();
  std::swap(mesh.tetrahedra[1][0], mesh.tetrahedra[1][1]);
  const Finding f = only_finding(mesh, "inverted_tetrahedron", Severity::warning);
  CHECK(f.ids == std::vector<std::int64_t>{1});
  const VolumeMap map = built(mesh);
  CHECK(cells(map) == Cells5{5, 9, 7, 2, 1});
  REQUIRE(map.reoriented().size() == 1);
  CHECK(map.reoriented()[0] == TetId{1});
  CHECK(map.corners(TetId{1}) ==
        std::array<VertexId, 4>{VertexId{0}, VertexId{1}, VertexId{4}, VertexId{2}});
  CHECK(count_cells(map).volume == Approx(2.0 / 6));
}

TEST_CASE("a mesh whose every tetrahedron is inverted is turned over as a whole",
          "[topology][findings]") {
  TetMesh mesh = kuhn_box({3, 2, 2});
  for (auto& t : mesh.tetrahedra) std::swap(t[1], t[2]);
  CHECK(only_finding(mesh, "inverted_tetrahedron", Severity::warning).count ==
        mesh.tetrahedra.size());
  CHECK(count_cells(built(mesh)).volume == Approx(12.0));
}

TEST_CASE("orientation of a random subset never changes the map's counts or volume",
          "[topology][findings]") {
  std::mt19937_64 random(5);
  TetMesh mesh = jittered(kuhn_box({3, 3, 3}), 0.1, 5);
  const Counts before = count_cells(built(mesh));
  for (auto& t : mesh.tetrahedra) {
    if (below(random, 2) == 1) std::swap(t[below(random, 2)], t[2 + below(random, 2)]);
  }
  const VolumeMap map = built(mesh);
  const Counts after = count_cells(map);
  CHECK(cells(after) == cells(before));
  CHECK(after.betti == before.betti);
  // The sum of 162 volumes of the same magnitude, exact but for the order within each.
  CHECK(after.volume == Approx(before.volume).epsilon(1e-14));
  CHECK(map.reoriented().size() == finding(check_mesh(mesh), "inverted_tetrahedron").count);
}

TEST_CASE("a tetrahedron turned inside out against its neighbours is folded",
          "[topology][findings]") {
  // Its numbers agree with its neighbour's; only its fourth point has come through their face.
  TetMesh mesh = two_tetrahedra();
  mesh.points[4] = {0.2, 0.2, 0.1};
  CHECK(only_finding(mesh, "folded_tetrahedron", Severity::error).ids ==
        std::vector<std::int64_t>{1});
  CHECK(build_map(mesh, Severity::warning));
  CHECK(finding(check_mesh(mesh, Severity::warning), "folded_tetrahedron").severity ==
        Severity::warning);
}

TEST_CASE("where volumes are split evenly the lowest tetrahedron decides which half is folded",
          "[topology][findings]") {
  TetMesh mesh = two_tetrahedra();
  mesh.points[4] = {0.2, 0.2, 0.1};
  for (auto& t : mesh.tetrahedra) std::swap(t[0], t[1]);
  CHECK(only_finding(mesh, "folded_tetrahedron", Severity::error, {"inverted_tetrahedron"}).ids ==
        std::vector<std::int64_t>{1});
}

TEST_CASE("a flat tetrahedron is an error for those who need volumes, a warning for others",
          "[topology][findings]") {
  TetMesh mesh = two_tetrahedra();
  mesh.points[4] = {0.3, 0.3, 0};
  CHECK(only_finding(mesh, "flat_tetrahedron", Severity::error).ids ==
        std::vector<std::int64_t>{1});
  CHECK(cells(*build_map(mesh, Severity::warning)) == Cells5{5, 9, 7, 2, 1});
}

TEST_CASE("flatness is judged against the rounding of the coordinates", "[topology][findings]") {
  // Coplanar points with coordinates that are not exact in binary: the volume is rounding error,
  // and grows with the body's distance from the origin.
  for (const double far : {0.0, 1e3, 1e6}) {
    TetMesh mesh = one_tetrahedron();
    mesh.points = {{0.1, 0.1, 0.3}, {1.1, 0.2, 1.4}, {0.3, 0.7, 1.3}, {}};
    for (Point& p : mesh.points) {
      for (double& x : p) x += far;
    }
    const Point &a = mesh.points[0], &b = mesh.points[1], &c = mesh.points[2];
    for (int i = 0; i < 3; ++i) {
      mesh.points[3][i] = a[i] + 0.7 * (b[i] - a[i]) + 0.9 * (c[i] - a[i]);
    }
    only_finding(mesh, "flat_tetrahedron", Severity::error);
  }
  // A sliver a million times thinner than long still has a volume.
  TetMesh sliver = one_tetrahedron();
  sliver.points[3] = {0.3, 0.3, 1e-6};
  CHECK(check_mesh(sliver).empty());
}

TEST_CASE("coordinates whose volume overflows are flat, not fatal", "[topology][findings]") {
  TetMesh mesh = one_tetrahedron();
  for (Point& p : mesh.points) {
    for (double& x : p) x *= 1e200;
  }
  only_finding(mesh, "flat_tetrahedron", Severity::error);
}

TEST_CASE("unused and coincident points are noted and get no vertex of their own accord",
          "[topology][findings]") {
  TetMesh mesh = two_tetrahedra();
  mesh.points.push_back({9, 9, 9});
  CHECK(only_finding(mesh, "unused_point", Severity::note).ids == std::vector<std::int64_t>{5});
  CHECK(built(mesh).vertices() == 5);
  TetMesh crack = two_tetrahedra();
  crack.points.push_back(crack.points[0]);
  crack.points[5][1] = -0.0;  // zero is zero
  crack.tetrahedra[1][1] = 5;
  CHECK(only_finding(crack, "coincident_points", Severity::note, {"pinched_vertex", "pinched_edge"})
            .ids == std::vector<std::int64_t>{5});
}

TEST_CASE("a vertex row skips unused points and leads back to the file's point",
          "[topology][findings]") {
  TetMesh mesh = two_tetrahedra();
  mesh.points.insert(mesh.points.begin() + 2, Point{7, 7, 7});
  for (auto& t : mesh.tetrahedra) {
    for (auto& p : t) p += p >= 2 ? 1 : 0;
  }
  const VolumeMap map = built(mesh);
  CHECK(std::vector<std::uint32_t>(map.point_of_vertex().begin(), map.point_of_vertex().end()) ==
        std::vector<std::uint32_t>{0, 1, 3, 4, 5});
  for (std::size_t v = 0; v < map.vertices(); ++v) {
    CHECK(map.point(VertexId{v}) == mesh.points[map.point_of_vertex(VertexId{v})]);
  }
}

TEST_CASE("further orbits of pinched points come last, by lowest tetrahedron and then by point",
          "[topology][findings]") {
  TetMesh mesh;
  mesh.points = {{0, 0, 0},  {1, 0, 0},  {0, 1, 0}, {0, 0, 1}, {-1, 0, 0},
                 {0, -1, 0}, {0, 0, -1}, {2, 1, 0}, {2, 0, 1}, {2, -1, -1}};
  // Point 0 joins tetrahedra 0 and 2, point 1 joins 0 and 1.
  mesh.tetrahedra = {{0, 1, 2, 3}, {1, 7, 8, 9}, {0, 4, 5, 6}};
  const VolumeMap map = built(mesh);
  REQUIRE(map.vertices() == 12);
  CHECK(map.point_of_vertex(VertexId{10}) == 1);
  CHECK(map.point_of_vertex(VertexId{11}) == 0);
  CHECK(place_of_vertex(map.corners(TetId{1}), VertexId{10}) == 0);
  CHECK(place_of_vertex(map.corners(TetId{2}), VertexId{11}) == 0);
}

TEST_CASE("an edge can be pinched where none of its ends is", "[topology][findings]") {
  // Of the middle layer only two cubes stand, which touch along one upright edge; both of its ends
  // lie in whole layers.
  const Cells grid = {2, 2, 3};
  const TetMesh mesh = kuhn_cubes(grid, [](int i, int j, int k) { return k != 1 || i != j; });
  const Finding f = only_finding(mesh, "pinched_edge", Severity::note);
  CHECK(f.count == 1);
  CHECK(f.ids == std::vector<std::int64_t>{grid_point(grid, 1, 1, 1), grid_point(grid, 1, 1, 2)});
  const VolumeMap map = built(mesh);
  CHECK(map.vertices() == mesh.points.size());
  CHECK(counts_without_chi(count_cells(map)) ==
        union_find_counts(twin_of(map, mesh.points.size())));
}

TEST_CASE("every finding is told at once, errors first", "[topology][findings]") {
  TetMesh mesh = kuhn_box({2, 1, 1});
  mesh.tetrahedra.push_back({0, 1, 2, 99});
  mesh.tetrahedra.push_back({0, 0, 1, 2});
  mesh.tetrahedra.push_back(mesh.tetrahedra[0]);
  mesh.points.push_back({5, 5, std::nan("")});
  std::swap(mesh.tetrahedra[4][0], mesh.tetrahedra[4][1]);
  const std::vector<Finding> findings = check_mesh(mesh);
  for (const char* code : {"index_out_of_range", "repeated_vertex", "duplicate_tetrahedron",
                           "nan_coordinate", "inverted_tetrahedron", "unused_point"}) {
    finding(findings, code);
  }
  CHECK(std::is_sorted(findings.begin(), findings.end(),
                       [](const Finding& a, const Finding& b) { return a.severity > b.severity; }));
}

TEST_CASE("long lists of ids are cut, counts are not", "[topology][findings]") {
  TetMesh mesh = kuhn_box({3, 3, 3});
  for (auto& t : mesh.tetrahedra) std::swap(t[0], t[1]);
  const Finding f = finding(check_mesh(mesh), "inverted_tetrahedron");
  CHECK(f.count == 162);
  CHECK(f.ids.size() == Finding::max_ids);
}

TEST_CASE("garbage is answered with findings, never with a crash", "[topology][findings]") {
  const std::uint64_t seed = 20261121;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  std::size_t built_maps = 0;
  for (int trial = 0; trial < 30000; ++trial) {
    TetMesh mesh;
    const std::size_t points = below(random, 9), tetrahedra = below(random, 12);
    for (std::size_t p = 0; p < points; ++p) {
      // Few values, so that points coincide and tetrahedra are flat; some are not numbers.
      const auto value = [&random] {
        const std::size_t v = below(random, 40);
        return v == 0 ? std::nan("") : v == 1 ? infinity : v == 2 ? 1e300 : double(v % 5);
      };
      mesh.points.push_back({value(), value(), value()});
    }
    for (std::size_t t = 0; t < tetrahedra; ++t) {
      auto& corners = mesh.tetrahedra.emplace_back();
      for (auto& p : corners) {
        p = below(random, 60) == 0 ? static_cast<std::uint32_t>(random())
                                   : static_cast<std::uint32_t>(below(random, points + 1));
        if (points > 0 && below(random, 30) != 0) p = static_cast<std::uint32_t>(p % points);
      }
    }
    const Result<VolumeMap> map = build_map(mesh, Severity::warning);
    CHECK(static_cast<bool>(map) == !has_error(map.findings));
    if (!map) continue;
    ++built_maps;
    INFO("trial " << trial);
    REQUIRE(check(*map).empty());
    REQUIRE(counts_without_chi(count_cells(*map)) ==
            union_find_counts(twin_of(*map, mesh.points.size())));
  }
  CHECK(built_maps > 100);
}

TEST_CASE("any heap of tetrahedra with distinct points is refused or agrees with union-find",
          "[topology][findings]") {
  const std::uint64_t seed = 20261122;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  std::size_t built_maps = 0, pinched = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    TetMesh mesh;
    const std::size_t points = 5 + below(random, 5), tetrahedra = 1 + below(random, 8);
    for (std::size_t p = 0; p < points; ++p) {
      mesh.points.push_back({unit(random), unit(random), unit(random)});
    }
    for (std::size_t t = 0; t < tetrahedra; ++t) {
      std::array<std::uint32_t, 4> corners;
      for (std::size_t i = 0; i < 4; ++i) {
        do {
          corners[i] = static_cast<std::uint32_t>(below(random, points));
        } while (std::find(corners.begin(), corners.begin() + i, corners[i]) !=
                 corners.begin() + i);
      }
      mesh.tetrahedra.push_back(corners);
    }
    const Result<VolumeMap> map = build_map(mesh, Severity::warning);
    CHECK(static_cast<bool>(map) == !has_error(map.findings));
    if (!map) continue;
    ++built_maps;
    pinched += map->vertices() > mesh.points.size() ? 1 : 0;
    INFO("trial " << trial);
    REQUIRE(check(*map).empty());
    REQUIRE(counts_without_chi(count_cells(*map)) ==
            union_find_counts(twin_of(*map, mesh.points.size())));
  }
  CHECK(built_maps > 1000);
  CHECK(pinched > 500);
}
