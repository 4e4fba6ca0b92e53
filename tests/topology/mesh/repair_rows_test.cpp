// SPDX-License-Identifier: MIT
// Repairs of careless meshes against a twin that says which rows stay, and takes them one by one.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>

#include "tests/support/random_meshes.hpp"
#include "topology/mesh/repair.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

using Rows = std::vector<std::size_t>;

template <class Value>
void take(std::vector<Value>& column, const Rows& rows, std::size_t components = 1) {
  if (column.empty()) return;
  std::vector<Value> taken;
  for (const std::size_t row : rows) {
    for (std::size_t k = 0; k < components; ++k) taken.push_back(column.at(row * components + k));
  }
  column = taken;
}

void take(std::vector<DataColumn>& data, const Rows& rows) {
  for (auto& c : data) std::visit([&](auto& v) { take(v, rows, c.components); }, c.values);
}

/// Points `rows` of `mesh`; corners are renumbered by `new_row`. Nothing where all rows stay.
void take_points(FileMesh& mesh, const Rows& rows, const std::vector<std::uint32_t>& new_row) {
  if (rows.size() == mesh.points.size()) return;
  if (mesh.source_point_id.empty()) {
    for (std::size_t p = 0; p < mesh.points.size(); ++p) mesh.source_point_id.push_back(p + 1L);
  }
  take(mesh.points, rows), take(mesh.source_point_id, rows), take(mesh.point_region, rows);
  take(mesh.point_data, rows);
  for_each_cell_list(mesh, [&](auto& cells, int) {
    for (auto& corners : cells.corners) {
      for (auto& p : corners) p = new_row.at(p);
    }
  });
}

/// Cells for which `stays(corners, row)`; nothing where all do. Returns the tetrahedra gone.
template <class Stays>
std::size_t take_cells(FileMesh& mesh, Stays stays) {
  FileMesh out = mesh;
  std::int64_t number = 1;
  bool any = false;
  for_each_cell_list(out, [&](auto& cells, int) {
    Rows rows;
    for (std::size_t i = 0; i < cells.corners.size(); ++i) {
      if (stays(cells.corners[i], i)) rows.push_back(i);
    }
    any = any || rows.size() < cells.corners.size();
    const bool numbered = !cells.source_id.empty();
    for (std::size_t i = 0; i < cells.corners.size(); ++i, ++number) {
      if (!numbered) cells.source_id.push_back(number);
    }
    take(cells.corners, rows), take(cells.region, rows), take(cells.entity, rows);
    take(cells.source_id, rows), take(cells.data, rows);
  });
  const std::size_t gone = mesh.tetrahedra.corners.size() - out.tetrahedra.corners.size();
  if (any) mesh = out;
  return gone;
}

std::size_t slow_merge(FileMesh& mesh, double distance) {
  Rows rows;
  std::vector<std::uint32_t> new_row;
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    std::size_t at = 0;
    for (; at < rows.size(); ++at) {
      double square = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        square += std::pow(mesh.points[rows[at]][k] - mesh.points[p][k], 2);
      }
      if (square <= distance * distance) break;
    }
    new_row.push_back(static_cast<std::uint32_t>(at));
    if (at == rows.size()) rows.push_back(p);
  }
  const std::size_t merged = mesh.points.size() - rows.size();
  if (merged == 0) return 0;
  take_points(mesh, rows, new_row);
  take_cells(mesh, [](const auto& corners, std::size_t) {
    return std::set(corners.begin(), corners.end()).size() == corners.size();
  });
  return merged;
}

std::size_t slow_drop_duplicates(FileMesh& mesh) {
  std::set<std::set<std::uint32_t>> known;
  return take_cells(mesh, [&](const auto& corners, std::size_t) {
    return corners.size() != 4 || known.insert({corners.begin(), corners.end()}).second;
  });
}

std::size_t slow_keep_largest(FileMesh& mesh) {
  std::map<std::set<std::uint32_t>, Rows> sides;
  const auto& cells = mesh.tetrahedra.corners;
  for (std::size_t t = 0; t < cells.size(); ++t) {
    for (std::size_t p = 0; p < 4; ++p) {
      std::multiset<std::uint32_t> face(cells[t].begin(), cells[t].end());
      face.erase(face.find(cells[t][p]));
      sides[{face.begin(), face.end()}].push_back(t);
    }
  }
  Rows part(cells.size());
  for (std::size_t t = 0; t < part.size(); ++t) part[t] = t;
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [face, ts] : sides) {
      for (const std::size_t t : ts) {
        const std::size_t low = std::min(part[t], part[ts[0]]);
        changed = changed || part[t] != low || part[ts[0]] != low;
        part[t] = part[ts[0]] = low;
      }
    }
  }
  std::size_t largest = 0;
  for (std::size_t t = 0; t < part.size(); ++t) {
    if (std::ranges::count(part, t) > std::ranges::count(part, largest)) largest = t;
  }
  std::set<std::uint32_t> used;
  for (std::size_t t = 0; t < part.size(); ++t) {
    if (part[t] == largest) used.insert(cells[t].begin(), cells[t].end());
  }
  return take_cells(mesh, [&](const auto& corners, std::size_t row) {
    if (corners.size() == 4) return part[row] == largest;
    return std::ranges::all_of(corners, [&](auto p) { return used.contains(p); });
  });
}

std::size_t slow_drop_unused(FileMesh& mesh) {
  std::set<std::uint32_t> used;
  for_each_cell_list(mesh, [&](const auto& cells, int) {
    for (const auto& corners : cells.corners) used.insert(corners.begin(), corners.end());
  });
  std::vector<std::uint32_t> new_row;
  for (std::uint32_t p = 0; p < mesh.points.size(); ++p) {
    new_row.push_back(static_cast<std::uint32_t>(std::distance(used.begin(), used.lower_bound(p))));
  }
  const std::size_t gone = mesh.points.size() - used.size();
  take_points(mesh, {used.begin(), used.end()}, new_row);
  return gone;
}

bool is_whole(const FileMesh& mesh) {
  bool whole = true;
  for (const Point& p : mesh.points) whole = whole && is_finite(p);
  for_each_cell_list(mesh, [&](const auto& cells, int) {
    for (const auto& corners : cells.corners) {
      for (const auto p : corners) whole = whole && p < mesh.points.size();
    }
  });
  return whole;
}

}  // namespace

TEST_CASE("repairs of careless meshes take the rows that a slow twin takes", "[topology][repair]") {
  std::array<std::size_t, 5> did{};
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    FileMesh mesh = careless(random);
    if (!is_whole(mesh) || mesh.tetrahedra.corners.size() > 120) continue;
    const auto hold = [&](std::size_t which, const Finding& told, const FileMesh& mended,
                          std::size_t count, const FileMesh& expected) {
      INFO(told.code << ": " << told.text);
      CHECK(told.count == count);
      CHECK(told.severity == Severity::note);
      CHECK(mended == expected);
      if (count > 0) ++did[which];
    };
    for (const double distance : {0.0, 0.3}) {
      FileMesh mended = mesh, expected = mesh;
      const Finding told = merge_points(mended, distance);
      hold(distance > 0 ? 1 : 0, told, mended, slow_merge(expected, distance), expected);
    }
    const auto both = [&](std::size_t which, auto fast, auto slow) {
      FileMesh mended = mesh, expected = mesh;
      const Finding told = fast(mended);
      hold(which, told, mended, slow(expected), expected);
    };
    both(2, drop_duplicate_tetrahedra, slow_drop_duplicates);
    both(3, keep_largest_component, slow_keep_largest);
    both(4, drop_unused_points, slow_drop_unused);
  }
  for (const std::size_t n : did) CHECK(n > 10);
}

TEST_CASE("of components of the same size that with the lowest row stays, and all are counted",
          "[topology][repair]") {
  FileMesh mesh;
  for (int i = 0; i < 3; ++i) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (const Point p : {Point{0, 0, 0}, Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}}) {
      mesh.points.push_back({p[0] + 3 * i, p[1], p[2]});
    }
    mesh.tetrahedra.corners.push_back({first, first + 1, first + 2, first + 3});
  }
  const Finding told = keep_largest_component(mesh);
  CHECK(told.count == 2);
  CHECK(told.text == "of 3 components the largest stays: 2 tetrahedra were dropped");
  CHECK(mesh.tetrahedra.corners == std::vector<std::array<std::uint32_t, 4>>{{0, 1, 2, 3}});
}

TEST_CASE("a mesh that cannot be glued is left as it is, and the refusal names the option",
          "[topology][repair]") {
  FileMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 2}, {0, 0, -1}};
  mesh.tetrahedra.corners = {{0, 1, 2, 3}, {0, 1, 2, 4}, {0, 2, 1, 5}};
  const FileMesh before = mesh;
  const Finding told = split_nonmanifold(mesh);
  CHECK(told.severity == Severity::error);
  CHECK(told.text.starts_with("--split-nonmanifold needs a mesh that can be glued: "));
  CHECK(mesh == before);
}

TEST_CASE("points merge where cubes of the distance have no numbers, or are no larger than 0",
          "[topology][repair]") {
  FileMesh mesh;
  mesh.points = {{1e300, 0, 0},  {-1e300, 0, 0}, {1e300, 0, 0}, {0, 0, 0},
                 {1e-290, 0, 0}, {0, 0, 0},      {0.5, 0, 0},   {0.25, 0, 0}};
  FileMesh exact = mesh;
  CHECK(merge_points(exact, 0).count == 2);
  CHECK(exact.source_point_id == std::vector<std::int64_t>{1, 2, 4, 5, 7, 8});
  CHECK(merge_points(mesh, 1e-280).count == 3);
  CHECK(mesh.source_point_id == std::vector<std::int64_t>{1, 2, 4, 7, 8});
}
