// SPDX-License-Identifier: MIT
// Triangles of a file against its tetrahedra, shapes of tetrahedra, and the mesh of all places.
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/support/built.hpp"
#include "topology/mesh/finding_cells.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

constexpr double degree = std::numbers::pi / 180;

Quality quality_of(const TetMesh& mesh) {
  const MeshCheck check = check_file_mesh(file_mesh_of(mesh));
  REQUIRE(check.quality);
  return *check.quality;
}

TetMesh regular() {
  TetMesh mesh;
  mesh.points = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  mesh.tetrahedra = {{0, 1, 2, 3}};
  return mesh;
}

using Vector = std::array<long double, 3>;

Vector minus(const Point& a, const Point& b) {
  return {static_cast<long double>(a[0]) - b[0], static_cast<long double>(a[1]) - b[1],
          static_cast<long double>(a[2]) - b[2]};
}
long double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// 3 r / R with R from the centre that is as far from all corners, and r from volume and surface.
long double slow_radius_ratio(const std::array<Point, 4>& x) {
  const Vector a = minus(x[1], x[0]), b = minus(x[2], x[0]), c = minus(x[3], x[0]);
  const long double six_volume = dot(a, cross(b, c));
  Vector centre = {};
  const Vector bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
  for (int k = 0; k < 3; ++k) {
    centre[k] = (dot(a, a) * bc[k] + dot(b, b) * ca[k] + dot(c, c) * ab[k]) / (2 * six_volume);
  }
  long double surface = 0;
  for (int p = 0; p < 4; ++p) {
    const Vector n =
        cross(minus(x[(p + 2) % 4], x[(p + 1) % 4]), minus(x[(p + 3) % 4], x[(p + 1) % 4]));
    surface += std::sqrt(dot(n, n)) / 2;
  }
  return 3 * (std::abs(six_volume) / 2 / surface) / std::sqrt(dot(centre, centre));
}

/// Angle at the edge of corners i and j: between the parts of the edges to the others across it.
long double slow_angle(const std::array<Point, 4>& x, int i, int j, int k, int l) {
  const Vector e = minus(x[j], x[i]);
  const auto across = [&](int m) {
    Vector v = minus(x[m], x[i]);
    const long double s = dot(v, e) / dot(e, e);
    for (int n = 0; n < 3; ++n) v[n] -= s * e[n];
    return v;
  };
  const Vector u = across(k), v = across(l);
  return std::acos(dot(u, v) / std::sqrt(dot(u, u) * dot(v, v))) / degree;
}

}  // namespace

TEST_CASE("shapes of a regular tetrahedron, a cube's corner and Kuhn's have closed forms",
          "[topology][check][quality]") {
  // A few roundings of numbers near 1, or near 100 for degrees.
  const Quality q = quality_of(regular());
  CHECK(q.smallest_dihedral.value == Approx(std::acos(1.0 / 3) / degree).epsilon(1e-14));
  CHECK(q.largest_dihedral.value == Approx(std::acos(1.0 / 3) / degree).epsilon(1e-14));
  CHECK(q.smallest_radius_ratio.value == Approx(1).epsilon(1e-14));
  CHECK(q.smallest_radius_ratio.value <= 1);
  CHECK(q.smallest_volume.value == Approx(8.0 / 3).epsilon(1e-14));
  CHECK(q.shortest_edge.value == Approx(std::sqrt(8.0)).epsilon(1e-14));
  const Quality corner = quality_of(one_tetrahedron());
  CHECK(corner.smallest_dihedral.value ==
        Approx(std::acos(1 / std::sqrt(3)) / degree).epsilon(1e-14));
  CHECK(corner.largest_dihedral.value == Approx(90).epsilon(1e-14));
  const Quality kuhn = quality_of(kuhn_box({2, 2, 2}));
  CHECK(kuhn.smallest_dihedral.value == Approx(45).epsilon(1e-14));
  CHECK(kuhn.largest_dihedral.value == Approx(90).epsilon(1e-14));
  CHECK(kuhn.longest_edge.value == Approx(std::sqrt(3.0)).epsilon(1e-14));
  CHECK(kuhn.largest_volume.value == Approx(1.0 / 6).epsilon(1e-14));
  // r = 1 / (2 + 2 sqrt 2), R = sqrt(3) / 2.
  CHECK(kuhn.mean_radius_ratio ==
        Approx(3 / (2 + 2 * std::sqrt(2.0)) * 2 / std::sqrt(3.0)).epsilon(1e-13));
}

TEST_CASE("shapes of random tetrahedra are those of slow formulas", "[topology][check][quality]") {
  const std::uint64_t seed = 71;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  for (int trial = 0; trial < 500; ++trial) {
    INFO("trial " << trial);
    TetMesh mesh = regular();
    for (Point& p : mesh.points) p = {unit(random), unit(random), unit(random)};
    const std::array<Point, 4> x = {mesh.points[0], mesh.points[1], mesh.points[2], mesh.points[3]};
    const long double angles[] = {slow_angle(x, 0, 1, 2, 3), slow_angle(x, 0, 2, 1, 3),
                                  slow_angle(x, 0, 3, 1, 2), slow_angle(x, 1, 2, 0, 3),
                                  slow_angle(x, 1, 3, 0, 2), slow_angle(x, 2, 3, 0, 1)};
    const Quality q = quality_of(mesh);
    const auto [least, most] = std::minmax_element(std::begin(angles), std::end(angles));
    // Normals of slivers lose digits: as many as the smallest angle has zeros.
    CHECK(q.smallest_dihedral.value == Approx(static_cast<double>(*least)).margin(1e-9));
    CHECK(q.largest_dihedral.value == Approx(static_cast<double>(*most)).margin(1e-9));
    CHECK(q.smallest_radius_ratio.value ==
          Approx(static_cast<double>(slow_radius_ratio(x))).epsilon(1e-8));
  }
}

TEST_CASE("a sliver and a flat tetrahedron are told with their rows",
          "[topology][check][quality]") {
  TetMesh mesh = side_by_side(regular(), one_tetrahedron());
  mesh.points[7] = mesh.points[4];
  mesh.points[7][0] += 0.3;
  mesh.points[7][1] += 0.3;
  mesh.points[7][2] += 1e-9;
  const Quality sliver = quality_of(mesh);
  CHECK(sliver.smallest_radius_ratio.tetrahedron == 1);
  CHECK(sliver.smallest_dihedral.tetrahedron == 1);
  // Height over its distance from the nearest edge of the face below, 0.3.
  CHECK(sliver.largest_dihedral.value == Approx(180).epsilon(1e-6));
  CHECK(sliver.largest_dihedral.value < 180);
  mesh.points[7][2] = mesh.points[4][2];
  const Quality flat = quality_of(mesh);
  CHECK(flat.smallest_radius_ratio.value == 0);
  CHECK(flat.smallest_dihedral.value == 0);
  CHECK(flat.largest_dihedral.value == 180);
  CHECK(flat.smallest_volume.value == 0);
  // No extent at all.
  for (int k = 5; k < 8; ++k) mesh.points[k] = mesh.points[4];
  const Quality point = quality_of(mesh);
  CHECK(point.smallest_radius_ratio.value == 0);
  CHECK(point.shortest_edge.value == 0);
}

TEST_CASE("angles and ratios do not depend on size, volumes and edges do",
          "[topology][check][quality]") {
  const TetMesh mesh = jittered(kuhn_box({3, 3, 3}), 0.2, 9);
  const Quality q = quality_of(mesh);
  for (const double scale : {0x1p-300, 0x1p-20, 0x1p20, 0x1p300}) {
    TetMesh other = mesh;
    for (Point& p : other.points) {
      for (double& x : p) x *= scale;
    }
    const Quality r = quality_of(other);
    CHECK(r.smallest_dihedral.value == q.smallest_dihedral.value);
    CHECK(r.largest_dihedral.value == q.largest_dihedral.value);
    CHECK(r.mean_radius_ratio == q.mean_radius_ratio);
    CHECK(r.longest_edge.value == q.longest_edge.value * scale);
    CHECK(r.smallest_volume.value == q.smallest_volume.value * scale * scale * scale);
  }
}

TEST_CASE("triangles of a file are told that bound nothing or lie inside",
          "[topology][check][triangles]") {
  FileMesh file = file_mesh_of(two_tetrahedra());  // {0 1 2 3} and {1 0 2 4}
  file.triangles.corners = {{0, 1, 3}, {3, 1, 2}, {4, 0, 1}};
  CHECK(check_file_mesh(file).findings.empty());
  file.triangles.corners.push_back({2, 1, 0});
  file.triangles.corners.push_back({3, 4, 0});
  file.triangles.corners.push_back({0, 1, 2});
  file.triangles.corners.push_back({1, 3, 0});
  const MeshCheck check = check_file_mesh(file);
  CHECK(codes(check.findings) == std::vector<std::string>{"stray_triangle", "interface_triangle"});
  CHECK(finding(check.findings, "stray_triangle").ids == std::vector<std::int64_t>{4});
  CHECK(finding(check.findings, "stray_triangle").severity == Severity::warning);
  CHECK(finding(check.findings, "interface_triangle").ids == std::vector<std::int64_t>{3, 5});
}

TEST_CASE("every triangle of a grid is a face or not as all pairs say",
          "[topology][check][triangles]") {
  const std::uint64_t seed = 73;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  FileMesh file = file_mesh_of(kuhn_box({2, 2, 1}));
  std::size_t stray = 0, inside = 0;
  for (int i = 0; i < 3000; ++i) {
    std::array<std::uint32_t, 3> triangle;
    for (auto& p : triangle) p = static_cast<std::uint32_t>(below(random, file.points.size()));
    if (i % 3 == 0) {
      const auto& t = file.tetrahedra.corners[below(random, file.tetrahedra.corners.size())];
      triangle = {t[3], t[below(random, 2)], t[2]};
    }
    file.triangles.corners.push_back(triangle);
    std::size_t of = 0;
    for (const auto& t : file.tetrahedra.corners) {
      bool has_all =
          triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[0] != triangle[2];
      for (const auto p : triangle)
        has_all = has_all && std::find(t.begin(), t.end(), p) != t.end();
      of += has_all ? 1 : 0;
    }
    stray += of == 0 ? 1 : 0;
    inside += of == 2 ? 1 : 0;
  }
  const auto findings = check_file_mesh(file).findings;
  CHECK(finding(findings, "stray_triangle").count == stray);
  CHECK(finding(findings, "interface_triangle").count == inside);
}

TEST_CASE("all places of all findings become cells with region, finding and row",
          "[topology][check][cells]") {
  FileMesh file = file_mesh_of(kuhn_box({3, 3, 3}));
  for (auto& t : file.tetrahedra.corners) std::swap(t[0], t[1]);  // 162 inverted
  for (int i = 0; i < 40; ++i) file.points.push_back({10.0 + i, 0, 0});
  file.triangles.corners = {{0, 1, 63}};
  const MeshCheck check = check_file_mesh(file, true);
  const FileMesh cells = cells_of_findings(file, check);
  REQUIRE(codes(check.findings) ==
          std::vector<std::string>{"inverted_tetrahedron", "stray_triangle", "unused_point"});
  CHECK(cells.tetrahedra.corners.size() == 162);
  CHECK(cells.triangles.corners.size() == 1);
  CHECK(cells.vertices.corners.size() == 40);
  CHECK(cells.edges.corners.empty());
  CHECK(cells.tetrahedra.region == std::vector<std::int32_t>(162, 1));
  CHECK(cells.region_name[3] == std::map<std::int32_t, std::string>{{1, "inverted_tetrahedron"}});
  CHECK(cells.region_name[2] == std::map<std::int32_t, std::string>{{2, "stray_triangle"}});
  CHECK(cells.region_name[0] == std::map<std::int32_t, std::string>{{3, "unused_point"}});
  REQUIRE(cells.vertices.data.size() == 2);
  const auto& rows = std::get<std::vector<std::int64_t>>(cells.vertices.data[1].values);
  CHECK(rows.front() == 64);
  CHECK(rows.back() == 103);
  const auto& points = std::get<std::vector<std::int64_t>>(cells.point_data[0].values);
  REQUIRE(points.size() == cells.points.size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    CHECK(cells.points[p] == file.points[static_cast<std::size_t>(points[p])]);
  }
  // Without being asked for, no place is kept.
  CHECK(check_file_mesh(file).places.empty());
  CHECK(cell_count(cells_of_findings(file, check_file_mesh(file))) == 0);
}

TEST_CASE("a vertex that hangs is shown with the face that it hangs in",
          "[topology][check][cells]") {
  TetMesh mesh = side_by_side(one_tetrahedron(), one_tetrahedron());
  const Point& a = mesh.points[0];
  const Point &b = mesh.points[1], &c = mesh.points[2];
  for (int k = 0; k < 3; ++k) mesh.points[4][k] = a[k] + (b[k] - a[k]) / 4 + (c[k] - a[k]) / 4;
  for (int i = 5; i < 8; ++i) mesh.points[i] = {10.0 + (i == 5), 10.0 + (i == 6), -5.0 - (i == 7)};
  const FileMesh file = file_mesh_of(mesh);
  const MeshCheck check = check_file_mesh(file, true);
  CHECK(finding(check.findings, "hanging_vertex").ids == std::vector<std::int64_t>{4});
  const FileMesh cells = cells_of_findings(file, check);
  const auto number = cells.vertices.region.at(0);
  CHECK(cells.region_name[0].at(number) == "hanging_vertex");
  CHECK(cells.region_name[2].at(number) == "hanging_vertex");
  REQUIRE(cells.triangles.corners.size() == 1);
  const auto& rows = std::get<std::vector<std::int64_t>>(cells.point_data[0].values);
  for (const auto p : cells.triangles.corners[0]) CHECK(rows[p] < 3);
}

TEST_CASE("garbage is checked with its triangles and places, never with a crash",
          "[topology][check][cells]") {
  const std::uint64_t seed = 20261121;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  for (int trial = 0; trial < 10000; ++trial) {
    FileMesh file;
    const std::size_t points = below(random, 9);
    const auto row = [&] {
      return static_cast<std::uint32_t>(below(random, 60) == 0 ? random()
                                                               : below(random, points + 1));
    };
    for (std::size_t p = 0; p < points; ++p) {
      const auto value = [&random] {
        const std::size_t v = below(random, 40);
        const double odd[] = {std::nan(""), std::numeric_limits<double>::infinity(), 1e300, 5e-324};
        return v < 4 ? odd[v] : double(v % 5);
      };
      file.points.push_back({value(), value(), value()});
    }
    for (std::size_t n = below(random, 9); n > 0; --n) {
      file.tetrahedra.corners.push_back({row(), row(), row(), row()});
    }
    for (std::size_t n = below(random, 4); n > 0; --n) {
      file.triangles.corners.push_back({row(), row(), row()});
    }
    INFO("trial " << trial);
    const MeshCheck check = check_file_mesh(file, true);
    const FileMesh cells = cells_of_findings(file, check);
    for (const FindingPlaces& places : check.places) {
      if (places.code == "hanging_vertex" && places.kind == PlaceKind::faces) continue;
      REQUIRE(finding(check.findings, places.code).count ==
              places.rows.size() / rows_of_place(places.kind));
    }
    for (const auto& t : cells.tetrahedra.corners) {
      for (const auto p : t) REQUIRE(p < cells.points.size());
    }
    TetMesh alone;
    alone.points = file.points;
    alone.tetrahedra = file.tetrahedra.corners;
    for (const Finding& f : check_mesh(alone)) finding(check.findings, f.code);
  }
}
