// SPDX-License-Identifier: GPL-3.0-or-later
// sunder-mesh without its mesher: shapes, placing, quality, order of rows, the search for a count.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "apps/sunder-mesh/count_search.hpp"
#include "apps/sunder-mesh/mesh_quality.hpp"
#include "apps/sunder-mesh/surface.hpp"

namespace {

using namespace sunder;

/// Volume inside a closed surface by the divergence theorem; positive when triangles face out.
double enclosed_volume(const Surface& s) {
  double six_volumes = 0;
  for (const auto& t : s.triangles) {
    const Point &a = s.points[t[0]], &b = s.points[t[1]], &c = s.points[t[2]];
    six_volumes += a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
                   a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return six_volumes / 6;
}

/// True when every directed edge occurs once, and once backwards.
bool is_closed(const Surface& s) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const auto& t : s.triangles) {
    for (int k = 0; k < 3; ++k) ++uses[{t[k], t[(k + 1) % 3]}];
  }
  return std::all_of(uses.begin(), uses.end(), [&](const auto& use) {
    const auto back = uses.find({use.first.second, use.first.first});
    return use.second == 1 && back != uses.end() && back->second == 1;
  });
}

TetMesh unit_corner() {
  TetMesh m;
  m.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  m.tetrahedra = {{0, 1, 2, 3}};
  return m;
}

/// Two tetrahedra that share a face, and one apart from them, in awkward order.
TetMesh three_tets() {
  TetMesh m;
  m.points = {{9, 9, 9},  {0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {0, 0, 0},
              {0, 0, -1}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}, {5, 0, 1}};
  m.tetrahedra = {{6, 7, 8, 9}, {3, 4, 2, 5}, {4, 3, 2, 1}};
  return m;
}

Finding no_tetrahedron() {
  Finding f;
  f.code = "no_tetrahedron";
  return f;
}

/// A made-up mesher: its count falls in steps as the size grows.
Result<TetMesh> staircase(double scale) {
  const auto count = static_cast<std::size_t>(std::floor(50 / (scale * scale * scale))) / 7 * 7;
  if (count == 0) return no_tetrahedron();
  TetMesh m;
  m.points.resize(4);
  m.tetrahedra.resize(count);
  return m;
}

}  // namespace

TEST_CASE("a box surface is closed, faces out and holds the box's volume", "[sunder-mesh]") {
  const Surface box = box_surface({1, 0.25, 2});
  CHECK(is_closed(box));
  CHECK(enclosed_volume(box) == Approx(0.5).epsilon(1e-14));
}

TEST_CASE("a ring surface is closed, faces out and holds the polygon ring's volume",
          "[sunder-mesh]") {
  const Surface ring = ring_surface({0.5, 0.3, 0.2});
  CHECK(is_closed(ring));
  // A regular n-gon of circumradius r has the area n/2 r^2 sin(2 pi / n).
  const double area = ring_segments / 2.0 * std::sin(2 * std::numbers::pi / ring_segments) *
                      (0.5 * 0.5 - 0.3 * 0.3);
  CHECK(enclosed_volume(ring) == Approx(area * 0.2).epsilon(1e-12));
}

TEST_CASE("turning an axis up is a proper rotation that brings it to z", "[sunder-mesh]") {
  struct Turn {
    UpAxis up;
    Point axis;
  };
  const auto turn = GENERATE(Turn{UpAxis::x, {1, 0, 0}}, Turn{UpAxis::minus_x, {-1, 0, 0}},
                             Turn{UpAxis::y, {0, 1, 0}}, Turn{UpAxis::minus_y, {0, -1, 0}},
                             Turn{UpAxis::z, {0, 0, 1}}, Turn{UpAxis::minus_z, {0, 0, -1}});
  std::vector<Point> axis{turn.axis};
  turn_up(axis, turn.up);
  CHECK(axis[0] == Point{0, 0, 1});
  // A mirror image would turn the surface inside out.
  Surface box = box_surface({1, 2, 3});
  turn_up(box.points, turn.up);
  CHECK(enclosed_volume(box) == Approx(6).epsilon(1e-14));
}

TEST_CASE("a body scaled to a height has it, and on the ground stands on z = 0", "[sunder-mesh]") {
  Surface box = box_surface({1, 2, 4});
  for (Point& p : box.points) p = {p[0] + 7, p[1] - 3, p[2] + 11};
  scale_to_height(box.points, 0.15);
  stand_on_ground(box.points);
  const auto [low, high] =
      std::minmax_element(box.points.begin(), box.points.end(),
                          [](const Point& a, const Point& b) { return a[2] < b[2]; });
  CHECK((*low)[2] == 0);
  CHECK((*high)[2] == Approx(0.15).epsilon(1e-13));
  double sum_x = 0, sum_y = 0;
  for (const Point& p : box.points) sum_x += p[0], sum_y += p[1];
  CHECK(sum_x == Approx(0).margin(1e-13));
  CHECK(sum_y == Approx(0).margin(1e-13));
  CHECK(bounding_diagonal(box.points) == Approx(std::sqrt(21.0) * 0.15 / 4).epsilon(1e-13));
}

TEST_CASE("the quality of known tetrahedra is the known one", "[sunder-mesh]") {
  const MeshQuality corner = quality_of(unit_corner());
  CHECK(corner.least_dihedral_angle ==
        Approx(std::acos(1 / std::sqrt(3.0)) * 180 / std::numbers::pi).epsilon(1e-14));
  CHECK(corner.largest_dihedral_angle == Approx(90).epsilon(1e-14));
  CHECK(corner.volume == Approx(1.0 / 6).epsilon(1e-14));

  TetMesh regular;
  regular.points = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  regular.tetrahedra = {{0, 1, 2, 3}};
  const MeshQuality q = quality_of(regular);
  CHECK(q.least_dihedral_angle == Approx(std::acos(1.0 / 3) * 180 / std::numbers::pi));
  CHECK(q.largest_dihedral_angle == Approx(q.least_dihedral_angle));
  CHECK(quality_of(three_tets()).components == 2);
}

TEST_CASE("sorted rows do not depend on the order they came in", "[sunder-mesh]") {
  TetMesh reference = three_tets();
  const double volume = quality_of(reference).volume;
  sort_rows(reference);
  CHECK(reference.points.size() == 9);  // the unused point is gone
  CHECK(quality_of(reference).volume == Approx(volume).epsilon(1e-14));
  CHECK(quality_of(reference).least_volume > 0);
  CHECK(std::is_sorted(reference.points.begin(), reference.points.end(), [](auto& a, auto& b) {
    return std::array{a[2], a[1], a[0]} < std::array{b[2], b[1], b[0]};
  }));

  const auto seed = std::random_device{}();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  for (int trial = 0; trial < 50; ++trial) {
    TetMesh mesh = three_tets();
    std::vector<std::uint32_t> row(mesh.points.size());
    for (std::uint32_t k = 0; k < row.size(); ++k) row[k] = k;
    std::shuffle(row.begin(), row.end(), random);
    const std::vector<Point> points = mesh.points;
    for (std::size_t k = 0; k < row.size(); ++k) mesh.points[row[k]] = points[k];
    for (auto& t : mesh.tetrahedra) {
      for (auto& v : t) v = row[v];
      std::rotate(t.begin(), t.begin() + 1 + trial % 3, t.end());
      if (trial % 3 != 1) std::swap(t[0], t[1]);  // odd rotations need an exchange to stay even
    }
    std::shuffle(mesh.tetrahedra.begin(), mesh.tetrahedra.end(), random);
    sort_rows(mesh);
    REQUIRE(mesh.points == reference.points);
    REQUIRE(mesh.tetrahedra == reference.tetrahedra);
  }
}

TEST_CASE("the largest component stays alone, with its points only", "[sunder-mesh]") {
  TetMesh mesh = three_tets();
  CHECK(keep_largest_component(mesh) == 1);
  CHECK(mesh.tetrahedra.size() == 2);
  CHECK(mesh.points.size() == 5);
  CHECK(quality_of(mesh).components == 1);
}

TEST_CASE("the search for a count ends at the nearest step of the staircase", "[sunder-mesh]") {
  const auto goal = GENERATE(std::size_t{7}, 12, 413, 6142, 100000);
  CAPTURE(goal);
  int tries = 0;
  const auto mesh = mesh_with_count(staircase, {goal, 60},
                                    [&](const CountTry& t) { CHECK(t.number == ++tries); });
  REQUIRE(mesh);
  // Counts are multiples of 7: none is nearer than half a step.
  CHECK(std::abs(static_cast<double>(mesh->tetrahedra.size()) - static_cast<double>(goal)) <= 3.5);
  CHECK(tries <= 60);
}

TEST_CASE("the search gets past sizes at which nothing fits, and reports when nothing ever does",
          "[sunder-mesh]") {
  const auto coarse_start = [](double scale) { return staircase(scale * 1000); };
  const auto mesh = mesh_with_count(coarse_start, {70, 40}, [](const CountTry&) {});
  REQUIRE(mesh);
  CHECK(mesh->tetrahedra.size() == 70);

  const auto never = [](double) -> Result<TetMesh> { return no_tetrahedron(); };
  const auto none = mesh_with_count(never, {70, 5}, [](const CountTry&) {});
  CHECK_FALSE(none);
  REQUIRE(none.findings.size() == 1);
  CHECK(none.findings[0].code == "no_tetrahedron");
}
