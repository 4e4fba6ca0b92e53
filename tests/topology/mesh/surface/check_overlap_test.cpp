// SPDX-License-Identifier: MIT
// Boundary faces that go through each other: planted ones, and every pair compared
// by exact signs.
#include <algorithm>
#include <random>
#include <set>

#include "tests/support/built.hpp"
#include "topology/mesh/surface/crossing.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// Both bodies, the second one moved.
TetMesh with(TetMesh mesh, const TetMesh& other, const Point& shift) {
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  for (const Point& p : other.points)
    mesh.points.push_back({p[0] + shift[0], p[1] + shift[1], p[2] + shift[2]});
  for (auto t : other.tetrahedra) {
    for (auto& p : t) p += first;
    mesh.tetrahedra.push_back(t);
  }
  return mesh;
}

std::vector<Finding> findings_of(const TetMesh& mesh) {
  return check_file_mesh(file_mesh_of(mesh)).findings;
}

std::size_t overlaps(const TetMesh& mesh) {
  for (const Finding& f : findings_of(mesh))
    if (f.code == "overlapping_faces") return f.count;
  return 0;
}

/// The faces that a check shows, corners rising.
std::set<Triangle> shown(const TetMesh& mesh) {
  std::set<Triangle> faces;
  for (const FindingPlaces& p : check_file_mesh(file_mesh_of(mesh), true).places) {
    if (p.code != "overlapping_faces") continue;
    REQUIRE(p.kind == PlaceKind::faces);
    for (std::size_t i = 0; i < p.rows.size(); i += 3) {
      Triangle face = {p.rows[i], p.rows[i + 1], p.rows[i + 2]};
      std::ranges::sort(face);
      REQUIRE(faces.insert(face).second);
    }
  }
  return faces;
}

/// In general position two triangles have a point in common just where an edge of one goes through
/// the other.
std::set<Triangle> twin_of(const TetMesh& mesh) {
  std::map<Triangle, int> of;
  for (const auto& t : mesh.tetrahedra) {
    for (std::size_t p = 0; p < 4; ++p) {
      Triangle face = {t[(p + 1) % 4], t[(p + 2) % 4], t[(p + 3) % 4]};
      std::ranges::sort(face);
      ++of[face];
    }
  }
  std::vector<Triangle> boundary;
  for (const auto& [face, count] : of)
    if (count == 1) boundary.push_back(face);
  std::set<Triangle> found;
  for (const Triangle& a : boundary) {
    for (const Triangle& b : boundary) {
      if (a < b && triangles_cross(mesh.points, a, b)) found.insert({a, b});
    }
  }
  return found;
}

TetMesh slanted(TetMesh mesh, double a) {
  for (Point& p : mesh.points) {
    p = {std::cos(a) * p[0] - std::sin(a) * p[1], std::sin(a) * p[0] + std::cos(a) * p[1], p[2]};
    p = {p[0], std::cos(a) * p[1] - std::sin(a) * p[2], std::sin(a) * p[1] + std::cos(a) * p[2]};
  }
  return mesh;
}

}  // namespace

TEST_CASE("bodies that only touch do not overlap", "[topology][check][overlap]") {
  const TetMesh box = kuhn_box({2, 2, 2}), fine = kuhn_box({3, 3, 3}, 0.5);
  const Point shift =
      GENERATE(Point{2, 0, 0}, Point{2, 0.25, 0.125}, Point{2, 2, 0.3}, Point{2, 2, 2},
               Point{0.25, -1.5, 0.75}, Point{2 - 1e-7, 0.3, 0.4}, Point{3, 0, 0});
  CHECK(overlaps(with(box, fine, shift)) == 0);
  for (const double turn : {0.3, 1.1, 2.4})
    CHECK(overlaps(slanted(with(box, fine, shift), turn)) == 0);
  CHECK(overlaps(kuhn_box({4, 4, 4})) == 0);
}

TEST_CASE("a bar through a wall is told, with the faces of both", "[topology][check][overlap]") {
  const TetMesh wall = kuhn_box({1, 1, 1}, 4), bar = kuhn_box({1, 1, 9});
  const TetMesh both = with(wall, bar, {1.5, 1, -2.3});
  const auto findings = findings_of(both);
  const Finding f = finding(findings, "overlapping_faces");
  CHECK(f.severity == Severity::warning);
  CHECK(f.count == twin_of(both).size());
  CHECK(f.ids.size() == std::min<std::size_t>(15, 3 * f.count));
  CHECK(finding(findings, "overlapping_faces").text.starts_with(std::to_string(f.count)));
  CHECK(shown(both) == twin_of(both));
  CHECK(findings.size() == 1);
}

TEST_CASE("what overlaps by less than the tolerance touches", "[topology][check][overlap]") {
  // The tip of a tetrahedron goes down into a face with a longest edge of 1, and leans to one side.
  const std::array<std::uint32_t, 4> order =
      GENERATE(as<std::array<std::uint32_t, 4>>(), std::array{0U, 1U, 2U, 3U},
               std::array{1U, 2U, 0U, 3U}, std::array{2U, 0U, 1U, 3U});
  const auto tip_at = [&](double depth, double x, double lean, double scale) {
    TetMesh mesh;
    mesh.points = {{0, 0, 0},        {0.8, 0, 0},   {0, 0.6, 0},          {0.8, 0.2, -0.2},
                   {x, 0.2, -depth}, {x, 0.2, 0.5}, {x + lean, 0.2, 0.5}, {x + lean, 0.3, 0.5}};
    for (Point& p : mesh.points) {
      for (double& v : p) v *= scale;
    }
    mesh.tetrahedra = {order, {4, 5, 6, 7}};
    return overlaps(mesh);
  };
  for (const double scale : {1.0, 1e-30, 1e40}) {
    CHECK(tip_at(1.1e-6, 0.2, 0.1, scale) > 0);
    CHECK(tip_at(0.9e-6, 0.2, 0.1, scale) == 0);
    // At the edge x = 0.
    CHECK(tip_at(0.1, 1.1e-6, -0.1, scale) > 0);
    CHECK(tip_at(0.1, 0.3e-6, -0.1, scale) == 0);
  }
  CHECK(tip_at(-0.1, 0.2, 0.1, 1) == 0);
}

TEST_CASE("just at the tolerance faces touch", "[topology][check][overlap]") {
  // A face of sides 3, 4 and 5; all that is compared is rounded alike.
  TetMesh mesh;
  mesh.tetrahedra = {{0, 1, 2, 3}, {4, 5, 6, 7}};
  const auto tip = [&](const Point& low, double top, double lean) {
    mesh.points = {{0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {2, 1, -0.5}, low};
    mesh.points.push_back({low[0], low[1], top});
    mesh.points.push_back({low[0] + lean, low[1], top});
    mesh.points.push_back({low[0] + lean, low[1] + 0.001, top});
    return shown(mesh).contains({0, 1, 2});
  };
  const double depth = contact_tolerance * 5, side = contact_tolerance * 10;
  CHECK_FALSE(tip({1, 1, -depth}, 3, 0.5));
  CHECK(tip({1, 1, -1.001 * depth}, 3, 0.5));
  // The edge from -2 to 8 is longer than those of the face.
  CHECK_FALSE(tip({side, 1, -2}, 8, -1));
  CHECK(tip({1.001 * side, 1, -2}, 8, -1));
}

TEST_CASE("every face that goes through another is found, against exact signs",
          "[topology][check][overlap]") {
  std::mt19937_64 random(7);
  std::size_t found = 0;
  for (int round = 0; round < 60; ++round) {
    TetMesh mesh = jittered(kuhn_box({2, 2, 1}), 0.1, static_cast<std::uint64_t>(round));
    const int others = 1 + round % 3;
    for (int k = 0; k < others; ++k) {
      const Point shift = {3 * unit(random) - 1.5, 3 * unit(random) - 1.5, 2 * unit(random) - 1};
      mesh =
          with(mesh, slanted(jittered(kuhn_box({1, 2, 1}), 0.1, 99 - k), 6 * unit(random)), shift);
    }
    if (round % 2 == 0) {
      // Tetrahedra that share points with the rest and go anywhere.
      std::uniform_int_distribution<std::uint32_t> any(
          0, static_cast<std::uint32_t>(mesh.points.size()) - 1);
      mesh.points.push_back({unit(random), unit(random), 3 * unit(random)});
      const std::uint32_t a = any(random), b = (a + 1) % (mesh.points.size() - 1);
      mesh.points.push_back({unit(random), 3 * unit(random), unit(random)});
      mesh.tetrahedra.push_back({a, b, static_cast<std::uint32_t>(mesh.points.size() - 2),
                                 static_cast<std::uint32_t>(mesh.points.size() - 1)});
    }
    const auto twin = twin_of(mesh);
    REQUIRE(shown(mesh) == twin);
    found += twin.size();
  }
  CHECK(found > 1000);
}

TEST_CASE("where too many faces lie through each other the search ends and says so",
          "[topology][check][overlap]") {
  std::mt19937_64 random(3);
  TetMesh mesh;
  for (int cluster = 0; cluster < 20; ++cluster) {
    for (std::uint32_t k = 0; k < 80; ++k) {
      const auto first = static_cast<std::uint32_t>(mesh.points.size());
      for (int p = 0; p < 4; ++p)
        mesh.points.push_back({10.0 * cluster + unit(random), unit(random), unit(random)});
      mesh.tetrahedra.push_back({first, first + 1, first + 2, first + 3});
    }
  }
  const auto findings = findings_of(mesh);
  const Finding left = finding(findings, "overlap_unfinished");
  CHECK(left.severity == Severity::warning);
  CHECK(left.count == 1161);
  CHECK(left.ids.size() == 15);
  CHECK(finding(findings, "overlapping_faces").count > 5000);
}

TEST_CASE("the search for overlaps ends where no look is left, not before",
          "[topology][check][overlap]") {
  // The box of each face of such a tetrahedron is the whole cube. Each of the 2 856 faces then
  // takes 4 903 looks, all boxes and the nodes over them: one look of 400 for each is left after
  // 233.
  TetMesh mesh;
  for (std::uint32_t k = 0; k < 714; ++k) {
    const double s = 1 + 1e-3 * k;
    mesh.points.insert(mesh.points.end(), {{s, s, s}, {s, -s, -s}, {-s, s, -s}, {-s, -s, s}});
    mesh.tetrahedra.push_back({4 * k, 4 * k + 1, 4 * k + 2, 4 * k + 3});
  }
  CHECK(finding(findings_of(mesh), "overlap_unfinished").count == 2856 - 234);
  CHECK(overlaps(mesh) == 0);
}
