// SPDX-License-Identifier: MIT
// Rows dropped, merged, copied: in every column of points and cells alike.
#include "topology/mesh/repair.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <string_view>
#include <unordered_map>

#include "topology/base/counted.hpp"
#include "topology/base/point_math.hpp"
#include "topology/base/union_find.hpp"
#include "topology/base/whole_number.hpp"
#include "topology/mesh/build_map.hpp"
#include "topology/mesh/face_table.hpp"
#include "topology/mesh/kinds/split_cells.hpp"
#include "topology/mesh/kinds/take_rows.hpp"

namespace sunder {
namespace {

/// Drops cells for which `stays(kind, nodes, row)` is false; returns how many volume cells went.
template <class Stays>
std::size_t keep_cells(FileMesh& mesh, Stays stays) {
  std::array<std::vector<std::uint32_t>, cell_kinds> kept;
  bool any = false;
  for (const CellKind kind : all_cell_kinds) {
    const CellRows cells = rows_of(mesh, kind);
    for (std::size_t i = 0; i < cells.count; ++i) {
      if (stays(kind, cells[i], i)) kept[index_of(kind)].push_back(static_cast<std::uint32_t>(i));
    }
    any = any || kept[index_of(kind)].size() < cells.count;
  }
  if (!any) return 0;
  std::size_t dropped = 0, first = 1;
  for (const CellKind kind : all_cell_kinds) {
    const std::size_t count = rows_of(mesh, kind).count;
    number_rows(columns_of(mesh, kind).source_id, count, first);
    first += count;
    if (traits_of(kind).dimension == 3) dropped += count - kept[index_of(kind)].size();
    take_cells(mesh, kind, kept[index_of(kind)]);
  }
  return dropped;
}

/// The finding about a repair, with the text `nothing` where it changed nothing.
Finding done(std::string_view code, std::size_t count, std::string text, std::string_view nothing) {
  return {.code = std::string(code),
          .severity = Severity::note,
          .count = count,
          .text = count > 0 ? std::move(text) : std::string(nothing),
          .remedy = "nothing to do: it was asked for"};
}

/// Cubes of the merging distance, and the kept points in each.
struct PointGrid {
  double size;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> kept;

  std::array<std::int64_t, 3> cube(const Point& p) const {
    std::array<std::int64_t, 3> c{};
    for (std::size_t k = 0; k < 3; ++k) {
      // Points that are not numbers merge with nothing: their cubes do not matter.
      c[k] = whole_number<std::int64_t>(std::clamp(std::floor(p[k] / size), -9e18, 9e18));
    }
    return c;
  }
  static std::uint64_t key(const std::array<std::int64_t, 3>& c) {
    std::uint64_t hash = 0;
    for (const std::int64_t x : c) {
      hash = (hash ^ static_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15;
    }
    return hash;
  }
};

/// The lowest kept point within `distance` of `p`; none where there is none.
std::optional<std::uint32_t> kept_near(const PointGrid& grid, const FileMesh& mesh, const Point& p,
                                       double distance) {
  std::optional<std::uint32_t> found;
  const auto c = grid.cube(p);
  for (int i = 0; i < 27; ++i) {
    const auto at =
        grid.kept.find(PointGrid::key({c[0] + i % 3 - 1, c[1] + i / 3 % 3 - 1, c[2] + i / 9 - 1}));
    if (at == grid.kept.end()) continue;
    for (const std::uint32_t row : at->second) {
      const Point& q = mesh.points[row];
      const bool is_near = detail::distance(q, p) <= distance;
      if (is_near && (!found || row < *found)) found = row;
    }
  }
  return found;
}

/// The part of each tetrahedron, by faces, named by its lowest row.
std::vector<std::uint32_t> parts_by_faces(const FileMesh& mesh) {
  UnionFind parts(mesh.tetrahedra.corners.size());
  const FaceTable table = face_table(mesh.tetrahedra.corners, mesh.points.size());
  for_each_face(table, [&](const auto&, std::span<const TableFace> sides) {
    for (const TableFace& side : sides) parts.join(sides[0].half_face / 4, side.half_face / 4);
  });
  return std::move(parts).roots();
}

}  // namespace

Finding merge_points(FileMesh& mesh, double distance) {
  // Not so small that cubes far from the origin could not be distinguished.
  double extent = std::numeric_limits<double>::min();
  for (const Point& p : mesh.points) {
    for (const double x : p) extent = std::isfinite(x) ? std::max(extent, std::abs(x)) : extent;
  }
  PointGrid grid{std::max(distance, extent * 0x1p-50), {}};
  std::vector<std::uint32_t> rows, new_row(mesh.points.size());
  for (std::uint32_t p = 0; p < mesh.points.size(); ++p) {
    if (const auto near = kept_near(grid, mesh, mesh.points[p], distance)) {
      new_row[p] = new_row[*near];
      continue;
    }
    new_row[p] = static_cast<std::uint32_t>(rows.size());
    rows.push_back(p);
    grid.kept[PointGrid::key(grid.cube(mesh.points[p]))].push_back(p);
  }
  const std::size_t merged = mesh.points.size() - rows.size();
  std::size_t flat = 0;
  if (merged > 0) {
    take_points(mesh, rows, new_row);
    flat = keep_cells(mesh, [](CellKind kind, std::span<const std::uint32_t> nodes, std::size_t) {
      const std::size_t corners = traits_of(kind).corners;
      std::vector<std::uint32_t> sorted(nodes.begin(), nodes.end());
      if (corners > 0) sorted.resize(corners);
      std::ranges::sort(sorted);
      return std::ranges::adjacent_find(sorted) == sorted.end();
    });
  }
  return done(
      "merged_points", merged,
      fmt::format("{} merged into others within {} m{}",
                  counted(merged, "point was", "points were"), distance,
                  flat == 0 ? ""
                            : fmt::format("; {} dropped for a lost corner",
                                          counted(flat, "volume cell was", "volume cells were"))),
      fmt::format("no points lie within {} m of others: none was merged", distance));
}

Finding drop_duplicate_tetrahedra(FileMesh& mesh) {
  std::vector<std::pair<std::array<std::uint32_t, 4>, std::uint32_t>> sorted;
  for (std::uint32_t t = 0; t < mesh.tetrahedra.corners.size(); ++t) {
    sorted.emplace_back(mesh.tetrahedra.corners[t], t);
    std::sort(sorted.back().first.begin(), sorted.back().first.end());
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<char> again(sorted.size(), 0);
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    again[sorted[i].second] = sorted[i].first == sorted[i - 1].first;
  }
  const std::size_t dropped =
      keep_cells(mesh, [&](CellKind kind, std::span<const std::uint32_t>, std::size_t row) {
        return kind != CellKind::tetrahedron || !again[row];
      });
  return done("dropped_duplicates", dropped,
              fmt::format("{} with the points of an earlier one {} dropped",
                          counted_tetrahedra(dropped), for_count(dropped, "was", "were")),
              "no two tetrahedra have the same points: none was dropped");
}

Finding split_nonmanifold(FileMesh& mesh) {
  TetMesh tetrahedra;
  tetrahedra.points = mesh.points;
  tetrahedra.tetrahedra = mesh.tetrahedra.corners;
  Result<VolumeMap> map = build_map(tetrahedra, Severity::warning, MapKernel::dense);
  if (!map) {
    Finding refused = map.findings.front();
    refused.text =
        fmt::format("--split-nonmanifold needs a mesh that can be glued: {}", refused.text);
    return refused;
  }
  std::vector<std::uint32_t> rows(mesh.points.size()), point_of_row(map->vertices());
  std::iota(rows.begin(), rows.end(), 0U);
  const std::vector<std::uint32_t> same_row = rows;
  std::vector<char> taken(mesh.points.size(), 0);
  for (std::size_t row = 0; row < map->vertices(); ++row) {
    const std::uint32_t point = map->point_of_vertex(VertexId{row});
    point_of_row[row] = point;
    if (taken[point]) {
      point_of_row[row] = static_cast<std::uint32_t>(rows.size());
      rows.push_back(point);
    }
    taken[point] = 1;
  }
  const std::size_t copies = rows.size() - mesh.points.size();
  if (copies > 0) {
    take_points(mesh, rows, same_row);
    const auto corners = map->corners();
    for (std::size_t t = 0; t < corners.size(); ++t) {
      // The map may have swapped two corners of an inverted tetrahedron: the file's order stays.
      for (std::uint32_t& corner : mesh.tetrahedra.corners[t]) {
        for (const VertexId v : corners[t]) {
          if (map->point_of_vertex(v) == corner) corner = point_of_row[v.index()];
        }
      }
    }
  }
  return done("split_nonmanifold", copies,
              fmt::format("{} made where stars only touched",
                          counted(copies, "copy of a point was", "copies of points were")),
              "no stars of tetrahedra only touch: nothing was split");
}

Finding keep_largest_component(FileMesh& mesh) {
  const std::vector<std::uint32_t> part = parts_by_faces(mesh);
  std::vector<std::size_t> size(part.size(), 0);
  for (const std::uint32_t p : part) ++size[p];
  const auto largest = static_cast<std::uint32_t>(std::ranges::max_element(size) - size.begin());
  std::vector<char> used(mesh.points.size(), 0);
  for (std::size_t t = 0; t < part.size(); ++t) {
    if (part[t] != largest) continue;
    for (const std::uint32_t corner : mesh.tetrahedra.corners[t]) used[corner] = 1;
  }
  const std::size_t parts = part.size() - std::ranges::count(size, std::size_t{0});
  const std::size_t dropped =
      keep_cells(mesh, [&](CellKind kind, std::span<const std::uint32_t> nodes, std::size_t row) {
        if (kind == CellKind::tetrahedron) return part[row] == largest;
        return std::ranges::all_of(nodes, [&](std::uint32_t node) { return used[node] != 0; });
      });
  return done("kept_largest_component", dropped,
              fmt::format("of {} the largest stays: {} dropped", counted(parts, "component"),
                          counted(dropped, "tetrahedron was", "tetrahedra were")),
              "the body is one component: nothing was dropped");
}

Finding fix_orientation(FileMesh& mesh) {
  std::size_t swapped = 0;
  for (auto& t : mesh.tetrahedra.corners) {
    const auto& x = mesh.points;
    if (!(detail::six_volumes(x[t[0]], x[t[1]], x[t[2]], x[t[3]]) < 0)) continue;
    std::swap(t[2], t[3]);
    ++swapped;
  }
  return done("fixed_orientation", swapped,
              fmt::format("{} had two points swapped",
                          counted(swapped, "inverted tetrahedron", "inverted tetrahedra")),
              "no tetrahedron is inverted: none was changed");
}

Finding drop_unused_points(FileMesh& mesh) {
  const std::size_t dropped =
      drop_points_out_of_use(mesh, std::vector<bool>(mesh.points.size(), true));
  return done("dropped_unused", dropped,
              fmt::format("{} that no cell uses {} dropped", counted(dropped, "point"),
                          for_count(dropped, "was", "were")),
              "every point is used by a cell: none was dropped");
}

std::optional<Finding> needs_tetrahedra(const FileMesh& mesh, std::string_view who) {
  std::size_t count = 0;
  std::string plurals;
  for (const CellKind kind : all_cell_kinds) {
    const std::size_t n = rows_of(mesh, kind).count;
    if (n == 0 || kind == CellKind::tetrahedron || traits_of(kind).dimension < 3) continue;
    count += n;
    plurals += fmt::format("{}{}", plurals.empty() ? "" : ", ",
                           counted(n, traits_of(kind).name, traits_of(kind).plural));
  }
  if (count == 0) return std::nullopt;
  return Finding{
      .code = "unsupported_cells",
      .count = count,
      .text = fmt::format("{} needs tetrahedra of first order: the mesh has {}", who, plurals),
      .remedy =
          "cut them into tetrahedra: --split, with --order 1 for those of second "
          "order"};
}

std::vector<Finding> repair(FileMesh& mesh, const Repairs& repairs) {
  std::vector<Finding> findings;
  const bool needs = repairs.drop_duplicates || repairs.split_nonmanifold ||
                     repairs.largest_component || repairs.fix_orientation;
  if (needs) {
    if (auto refused = needs_tetrahedra(mesh, "a repair that was asked for")) {
      return {std::move(*refused)};
    }
  }
  if (repairs.merge_points) findings.push_back(merge_points(mesh, *repairs.merge_points));
  if (repairs.drop_duplicates) findings.push_back(drop_duplicate_tetrahedra(mesh));
  if (repairs.split_nonmanifold) findings.push_back(split_nonmanifold(mesh));
  if (repairs.largest_component) findings.push_back(keep_largest_component(mesh));
  if (repairs.fix_orientation) findings.push_back(fix_orientation(mesh));
  if (repairs.drop_unused) findings.push_back(drop_unused_points(mesh));
  return findings;
}

}  // namespace sunder
