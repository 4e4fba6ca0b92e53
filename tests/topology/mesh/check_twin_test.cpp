// SPDX-License-Identifier: MIT
// Triangles, shapes and places by a check of a whole file, compared with slow definitions.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "tests/support/built.hpp"
#include "tests/support/random_meshes.hpp"
#include "topology/base/point_math.hpp"
#include "topology/mesh/finding_cells.hpp"
#include "topology/mesh/radius_ratio.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

using Row = std::uint32_t;
using Integers = std::vector<std::int64_t>;

/// Tetrahedra that count: four points in range, none a copy of an earlier one.
std::vector<bool> usable_in(const FileMesh& mesh) {
  std::set<std::set<Row>> known;
  std::vector<bool> usable;
  for (const auto& t : mesh.tetrahedra.corners) {
    const std::set<Row> points(t.begin(), t.end());
    const bool in_range = *points.rbegin() < mesh.points.size();
    usable.push_back(in_range && points.size() == 4 && known.insert(points).second);
  }
  return usable;
}

/// Triangles on faces of no tetrahedron, and on those of two.
std::array<std::vector<Row>, 2> stray_and_inner(const FileMesh& mesh) {
  const std::vector<bool> usable = usable_in(mesh);
  std::array<std::vector<Row>, 2> rows;
  for (Row i = 0; i < mesh.triangles.corners.size(); ++i) {
    const auto& f = mesh.triangles.corners[i];
    const std::set<Row> points(f.begin(), f.end());
    std::size_t of = 0;
    for (std::size_t t = 0; t < usable.size(); ++t) {
      const std::set<Row> corners(mesh.tetrahedra.corners[t].begin(),
                                  mesh.tetrahedra.corners[t].end());
      of += points.size() == 3 && usable[t] && std::ranges::includes(corners, points);
    }
    if (of == 0) rows[0].push_back(i);
    if (of == 2) rows[1].push_back(i);
  }
  return rows;
}

/// The mesh of all places, place by place.
FileMesh expected_cells(const FileMesh& mesh, const MeshCheck& check) {
  FileMesh cells;
  std::array<Integers, 4> rows;
  std::int32_t number = 0;
  const auto add = [&](auto& list, std::size_t dimension, const auto& corners, std::int64_t row,
                       const std::string& code) {
    if (!std::ranges::all_of(corners, [&](Row p) { return p < mesh.points.size(); })) return;
    list.corners.push_back(corners);
    list.region.push_back(number);
    rows[dimension].push_back(row);
    cells.region_name[dimension][number] = code;
  };
  for (const Finding& f : check.findings) {
    ++number;
    for (const FindingPlaces& p : check.places) {
      if (p.code != f.code) continue;
      const auto& r = p.rows;
      for (std::size_t i = 0; i < r.size(); ++i) {
        if (p.kind == PlaceKind::points) add(cells.vertices, 0, std::array{r[i]}, r[i], f.code);
        if (p.kind == PlaceKind::edges && i % 2 == 0) {
          add(cells.edges, 1, std::array{r[i], r[i + 1]}, -1, f.code);
        }
        if (p.kind == PlaceKind::faces && i % 3 == 0) {
          add(cells.triangles, 2, std::array{r[i], r[i + 1], r[i + 2]}, -1, f.code);
        }
        if (p.kind == PlaceKind::triangles) {
          add(cells.triangles, 2, mesh.triangles.corners[r[i]], r[i], f.code);
        }
        if (p.kind == PlaceKind::tetrahedra) {
          add(cells.tetrahedra, 3, mesh.tetrahedra.corners[r[i]], r[i], f.code);
        }
      }
    }
  }
  std::map<Row, Row> used;
  for_each_cell_list(cells, [&](auto& list, int dimension) {
    if (list.corners.empty()) return;
    list.data = {
        {"finding", 1, NumberType::int64, Integers(list.region.begin(), list.region.end())},
        {"row", 1, NumberType::int64, rows[static_cast<std::size_t>(dimension)]}};
    for (const auto& corners : list.corners) {
      for (const Row p : corners) used[p] = 0;
    }
  });
  Integers points;
  for (auto& [p, row] : used) {
    row = static_cast<Row>(points.size());
    points.push_back(p);
    cells.points.push_back(mesh.points[p]);
  }
  if (!points.empty()) cells.point_data = {{"row", 1, NumberType::int64, points}};
  for_each_cell_list(cells, [&](auto& list, int) {
    for (auto& corners : list.corners) {
      for (Row& p : corners) p = used.at(p);
    }
  });
  return cells;
}

std::vector<Row> rows_of(const MeshCheck& check, const std::string& code) {
  for (const FindingPlaces& p : check.places) {
    if (p.code == code) return p.rows;
  }
  return {};
}

void name_nans(FileMesh& mesh) {
  for (Point& p : mesh.points) {
    for (double& x : p) x = std::isnan(x) ? -12345 : x;
  }
}

std::optional<Quality> quality_of(const FileMesh& mesh) { return check_file_mesh(mesh).quality; }

}  // namespace

TEST_CASE("triangles and places of careless files are what all pairs and a list say",
          "[topology][check]") {
  std::map<PlaceKind, std::size_t> kinds;
  std::size_t stray = 0, inner = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    FileMesh mesh = careless(random);
    if (mesh.tetrahedra.corners.size() > 150) continue;
    const auto some = [&] { return static_cast<Row>(below(random, mesh.points.size() + 1)); };
    for (std::size_t i = below(random, 4); i > 0; --i) {
      mesh.triangles.corners.push_back({some(), some(), some()});
      if (!mesh.triangles.corners.empty() && below(random, 2) == 0) {
        auto again = mesh.triangles.corners[below(random, mesh.triangles.corners.size())];
        std::swap(again[0], again[below(random, 2) + 1]);
        mesh.triangles.corners.push_back(again);
      }
    }
    const MeshCheck check = check_file_mesh(mesh, true);
    const auto triangles = stray_and_inner(mesh);
    CHECK(rows_of(check, "stray_triangle") == triangles[0]);
    CHECK(rows_of(check, "interface_triangle") == triangles[1]);
    stray += triangles[0].size();
    inner += triangles[1].size();
    for (const FindingPlaces& p : check.places) ++kinds[p.kind];
    FileMesh cells = cells_of_findings(mesh, check), expected = expected_cells(mesh, check);
    name_nans(cells), name_nans(expected);
    CHECK(cells == expected);
  }
  CHECK(stray > 100);
  CHECK(inner > 100);
  CHECK(kinds.size() == 5);
}

TEST_CASE("bad volumes are errors of a file that leave its cells counted, without Betti numbers",
          "[topology][check]") {
  FileMesh mesh = file_mesh_of(suite::two_tetrahedra());
  CHECK(check_file_mesh(mesh).counts->betti.has_value());
  mesh.points[4] = {0.2, 0.2, 0.1};
  MeshCheck folded = check_file_mesh(mesh);
  CHECK(finding(folded.findings, "folded_tetrahedron").severity == Severity::error);
  REQUIRE(folded.counts);
  CHECK(folded.counts->edges == 9);
  CHECK_FALSE(folded.counts->betti.has_value());
  mesh.points[4] = {0.2, 0.2, 0};
  MeshCheck flat = check_file_mesh(mesh);
  CHECK(finding(flat.findings, "flat_tetrahedron").severity == Severity::error);
  CHECK_FALSE(flat.counts->betti.has_value());
  // With an error of another kind nothing is counted, and the volumes are reported all the same.
  mesh.tetrahedra.corners.push_back({0, 0, 1, 2});
  flat = check_file_mesh(mesh);
  CHECK(finding(flat.findings, "flat_tetrahedron").severity == Severity::error);
  CHECK_FALSE(flat.counts.has_value());
  mesh = file_mesh_of(suite::two_tetrahedra());
  mesh.tetrahedra.source_id = {5};
  CHECK(finding(check_file_mesh(mesh).findings, "column_length").severity == Severity::error);
  mesh.tetrahedra.source_id = {};
  mesh.source_point_id = {5, 6};
  CHECK(finding(check_file_mesh(mesh).findings, "column_length").severity == Severity::error);
}

TEST_CASE("extremes of shapes are those of one tetrahedron after the other, told at the first",
          "[topology][check][quality]") {
  std::size_t measured = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const FileMesh mesh = careless(random);
    const std::vector<bool> usable = usable_in(mesh);
    Quality least{{1e300, 0}, {-1, 0}, {1e300, 0}, 0, {1e300, 0}, {-1, 0}, {1e300, 0}, {-1, 0}};
    std::size_t n = 0;
    for (std::size_t t = 0; t < usable.size(); ++t) {
      const auto& corners = mesh.tetrahedra.corners[t];
      if (!usable[t]) continue;
      FileMesh one;
      for (const Row p : corners) one.points.push_back(mesh.points[p]);
      one.tetrahedra.corners = {{0, 1, 2, 3}};
      const std::optional<Quality> q = quality_of(one);
      const bool finite = std::ranges::all_of(one.points, is_finite);
      CHECK(q.has_value() == finite);
      if (!q) continue;
      ++n;
      const auto row = static_cast<Row>(t);
      const auto lower = [&](Quality::Extreme& e, double value) {
        if (value < e.value) e = {value, row};
      };
      const auto raise = [&](Quality::Extreme& e, double value) {
        if (value > e.value) e = {value, row};
      };
      std::array<Point, 4> x;
      std::ranges::copy(one.points, x.begin());
      const double volume = std::abs(detail::six_volumes(x[0], x[1], x[2], x[3])) / 6;
      CHECK(q->smallest_volume.value == Approx(volume).margin(1e-12));
      CHECK(q->largest_volume.value == q->smallest_volume.value);
      CHECK(q->smallest_radius_ratio.value == radius_ratio(x));
      lower(least.smallest_dihedral, q->smallest_dihedral.value);
      raise(least.largest_dihedral, q->largest_dihedral.value);
      lower(least.smallest_radius_ratio, q->smallest_radius_ratio.value);
      least.mean_radius_ratio += q->smallest_radius_ratio.value;
      lower(least.smallest_volume, q->smallest_volume.value);
      raise(least.largest_volume, q->smallest_volume.value);
      for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < i; ++j) {
          const double edge = detail::length(detail::difference(x[i], x[j]));
          CHECK(edge >= q->shortest_edge.value * (1 - 1e-14));
          CHECK(edge <= q->longest_edge.value * (1 + 1e-14));
        }
      }
      lower(least.shortest_edge, q->shortest_edge.value);
      raise(least.longest_edge, q->longest_edge.value);
    }
    const std::optional<Quality> all = quality_of(mesh);
    REQUIRE(all.has_value() == (n > 0));
    if (!all) continue;
    ++measured;
    const auto same = [](const Quality::Extreme& a, const Quality::Extreme& b) {
      CHECK(a.value == b.value);
      CHECK(a.tetrahedron == b.tetrahedron);
    };
    same(all->smallest_radius_ratio, least.smallest_radius_ratio);
    same(all->smallest_volume, least.smallest_volume);
    same(all->largest_volume, least.largest_volume);
    same(all->shortest_edge, least.shortest_edge);
    same(all->longest_edge, least.longest_edge);
    CHECK(all->mean_radius_ratio == least.mean_radius_ratio / static_cast<double>(n));
    // Angles are compared by their cosines, and reported by an arc tangent.
    CHECK(all->smallest_dihedral.value == Approx(least.smallest_dihedral.value).margin(1e-5));
    CHECK(all->largest_dihedral.value == Approx(least.largest_dihedral.value).margin(1e-5));
  }
  CHECK(measured > 100);
}

TEST_CASE("of two congruent bodies extremes are told of the first", "[topology][check][quality]") {
  TetMesh mesh = suite::jittered(suite::kuhn_box({1, 1, 2}), 0.1, 3);
  const auto cells = static_cast<Row>(mesh.tetrahedra.size());
  const auto n = static_cast<Row>(mesh.points.size());
  for (Row p = 0; p < n; ++p) {
    for (double& x : mesh.points[p]) x = std::round(x * 1024) / 1024;
    mesh.points.push_back({mesh.points[p][0] + 8, mesh.points[p][1], mesh.points[p][2]});
  }
  for (Row t = 0; t < cells; ++t) {
    auto corners = mesh.tetrahedra[t];
    for (Row& p : corners) p += n;
    mesh.tetrahedra.push_back(corners);
  }
  const Quality q = *quality_of(file_mesh_of(mesh));
  for (const auto& e : {q.smallest_dihedral, q.largest_dihedral, q.smallest_radius_ratio,
                        q.smallest_volume, q.largest_volume, q.shortest_edge, q.longest_edge}) {
    CHECK(e.tetrahedron < cells);
  }
}

TEST_CASE("faces without area have no angles, and what has no size is not measured",
          "[topology][check][quality]") {
  FileMesh mesh;
  mesh.points = {{0, 0, 0}, {1e-170, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.tetrahedra.corners = {{0, 1, 2, 3}};
  const Quality needle = *quality_of(mesh);
  CHECK(needle.smallest_dihedral.value == 0);
  CHECK(needle.largest_dihedral.value == 0);
  mesh.points = {{0, 0, 0}, {1e-170, 0, 0}, {0, 1e-170, 0}, {0, 0, 1}};
  const Quality line = *quality_of(mesh);
  CHECK(line.smallest_dihedral.value == 0);
  CHECK(line.smallest_dihedral.tetrahedron == 0);
  CHECK(line.largest_dihedral.value == 180);
  CHECK(line.largest_dihedral.tetrahedron == 0);
  mesh.points = {{0, 0, 0}, {1.5e308, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  CHECK_FALSE(quality_of(mesh).has_value());
  mesh.points[1][0] = std::nan("");
  CHECK_FALSE(quality_of(mesh).has_value());
}

TEST_CASE("a place of an edge is two rows, of a face three, of all else one", "[topology][check]") {
  CHECK(rows_of_place(PlaceKind::points) == 1);
  CHECK(rows_of_place(PlaceKind::edges) == 2);
  CHECK(rows_of_place(PlaceKind::faces) == 3);
  CHECK(rows_of_place(PlaceKind::triangles) == 1);
  CHECK(rows_of_place(PlaceKind::tetrahedra) == 1);
  CHECK(Quality::Extreme{}.value == 0);
  CHECK(Quality::Extreme{}.tetrahedron == 0);
}
