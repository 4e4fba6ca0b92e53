// SPDX-License-Identifier: MIT
// Edges of all kinds of cells by the points at their ends.
#include "topology/mesh/kinds/second_order.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "topology/base/point_math.hpp"
#include "topology/mesh/kinds/move_cells.hpp"

namespace sunder {
namespace {

using Ends = std::pair<std::uint32_t, std::uint32_t>;

Point middle_of(const FileMesh& mesh, std::uint32_t a, std::uint32_t b) {
  return detail::middle(mesh.points[a], mesh.points[b]);
}

double distance(const Point& a, const Point& b) { return detail::length(detail::difference(a, b)); }

/// The columns of points in the middles of edges, behind the others.
void append_point_columns(FileMesh& mesh, const std::vector<Ends>& edges) {
  const auto of_both = [](auto a, auto b) { return a == b ? a : decltype(a){0}; };
  if (!mesh.source_point_id.empty()) {
    const std::int64_t last = *std::ranges::max_element(mesh.source_point_id);
    for (std::size_t k = 0; k < edges.size(); ++k) {
      mesh.source_point_id.push_back(last + 1 + static_cast<std::int64_t>(k));
    }
  }
  if (!mesh.point_region.empty()) {
    for (const auto& [a, b] : edges) {
      mesh.point_region.push_back(of_both(mesh.point_region[a], mesh.point_region[b]));
    }
  }
  for (DataColumn& column : mesh.point_data) {
    const std::size_t n = column.components;
    if (auto* reals = std::get_if<std::vector<double>>(&column.values)) {
      for (const auto& [a, b] : edges) {
        for (std::size_t i = 0; i < n; ++i) {
          reals->push_back(0.5 * ((*reals)[n * a + i] + (*reals)[n * b + i]));
        }
      }
    } else {
      auto& numbers = std::get<std::vector<std::int64_t>>(column.values);
      for (const auto& [a, b] : edges) {
        for (std::size_t i = 0; i < n; ++i) {
          numbers.push_back(of_both(numbers[n * a + i], numbers[n * b + i]));
        }
      }
    }
  }
}

void drop_rows(FileMesh& mesh, CellKind kind) {
  switch (kind) {
    case CellKind::edge:
      return mesh.edges.corners.clear();
    case CellKind::triangle:
      return mesh.triangles.corners.clear();
    case CellKind::tetrahedron:
      return mesh.tetrahedra.corners.clear();
    default:
      return other_cells(mesh, kind).points.clear();
  }
}

}  // namespace

std::size_t raise_order(FileMesh& mesh) {
  std::map<Ends, std::uint32_t> middle;
  for (const CellKind kind : all_cell_kinds) {
    if (linear_kind(kind) == kind) continue;
    const std::size_t corners = traits_of(kind).corners;
    const auto edges = edges_of(linear_kind(kind));
    const CellRows rows = rows_of(mesh, kind);
    for (std::size_t row = 0; row < rows.size(); ++row) {
      for (std::size_t e = 0; e < edges.size(); ++e) {
        const Ends ends = std::minmax(rows[row][edges[e][0]], rows[row][edges[e][1]]);
        middle.try_emplace(ends, rows[row][corners + e]);
      }
    }
  }
  std::vector<Ends> fresh;
  for (const CellKind kind : all_cell_kinds) {
    const CellKind raised = raised_kind(kind);
    const CellRows rows = rows_of(mesh, kind);
    if (raised == kind || rows.size() == 0) continue;
    const std::size_t count = rows.size(), before = rows_of(mesh, raised).size();
    const auto edges = edges_of(kind);
    for (std::size_t row = 0; row < count; ++row) {
      std::vector<std::uint32_t> nodes(rows[row].begin(), rows[row].end());
      for (const auto& [i, j] : edges) {
        const Ends ends = std::minmax(nodes[i], nodes[j]);
        const auto [at, is_new] =
            middle.try_emplace(ends, static_cast<std::uint32_t>(mesh.points.size()));
        if (is_new) {
          mesh.points.push_back(middle_of(mesh, ends.first, ends.second));
          fresh.push_back(ends);
        }
        nodes.push_back(at->second);
      }
      append_cell(mesh, raised, nodes);
    }
    CellColumns columns = std::exchange(columns_of(mesh, kind), CellColumns{});
    append_columns(columns_of(mesh, raised), before, std::move(columns), count);
    drop_rows(mesh, kind);
  }
  append_point_columns(mesh, fresh);
  return fresh.size();
}

CurvedCells curved_cells(const FileMesh& mesh, CellKind kind) {
  constexpr double straight = 1e-6;
  CurvedCells curved;
  if (linear_kind(kind) == kind) return curved;
  const std::size_t corners = traits_of(kind).corners;
  const auto edges = edges_of(linear_kind(kind));
  const CellRows rows = rows_of(mesh, kind);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    double most = 0;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const std::uint32_t a = rows[row][edges[e][0]], b = rows[row][edges[e][1]];
      const double length = distance(mesh.points[a], mesh.points[b]);
      const double off = distance(mesh.points[rows[row][corners + e]], middle_of(mesh, a, b));
      if (off > straight * length) most = std::max(most, length > 0 ? off / length : 1);
    }
    if (most == 0) continue;
    if (curved.count++ == 0) curved.first = row;
    curved.most = std::max(curved.most, most);
  }
  return curved;
}

}  // namespace sunder
