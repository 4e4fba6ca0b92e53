// SPDX-License-Identifier: MIT
// Simplices from the least corner of each cell.
#include "topology/mesh/kinds/split_cells.hpp"

#include <algorithm>
#include <cmath>

#include "topology/base/point_math.hpp"
#include "topology/mesh/boundary_surface.hpp"
#include "topology/mesh/kinds/move_cells.hpp"
#include "topology/mesh/kinds/take_rows.hpp"

namespace sunder {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// Relative size below which a part is flat, and a polygon plane.
constexpr double flat_part = 1e-12, plane = 1e-6;

/// Calls `take` for the triangles of a face around its least corner, turned as the face; those with
/// a corner twice are left out, and counted.
template <class Take>
std::size_t for_fan(std::span<const std::uint32_t> face, Take take) {
  const auto least = static_cast<std::size_t>(std::ranges::min_element(face) - face.begin());
  const std::size_t n = face.size();
  std::size_t empty = 0;
  for (std::size_t k = 1; k + 1 < n; ++k) {
    const Triangle t{face[least], face[(least + k) % n], face[(least + k + 1) % n]};
    t[0] == t[1] || t[1] == t[2] || t[2] == t[0] ? void(++empty) : take(t);
  }
  return empty;
}

/// A cell's parts on their way into a mesh.
struct Parts {
  FileMesh& mesh;
  SplitCells& report;
  /// Rows of the cells that the new parts come from.
  std::vector<std::uint32_t> parents;
};

void cut_volume(Parts& p, CellKind linear, std::span<const std::uint32_t> corners,
                std::uint32_t row) {
  const std::vector<Point>& x = p.mesh.points;
  const std::uint32_t least = *std::ranges::min_element(corners);
  const double whole = six_volumes_of(p.mesh, linear, corners);
  bool is_concave = false;
  for (const FaceCorners& f : faces_of(linear)) {
    const std::array<std::uint32_t, 4> face{corners[f[0]], corners[f[1]], corners[f[2]],
                                            corners[f[3]]};
    const auto points = std::span(face).first(f[2] == f[3] ? 3 : 4);
    if (std::ranges::find(points, least) != points.end()) continue;
    p.report.empty_parts += for_fan(points, [&](const Triangle& t) {
      const double part = detail::six_volumes(x[least], x[t[0]], x[t[1]], x[t[2]]);
      is_concave = is_concave || !(part * (whole < 0 ? -1 : 1) > flat_part * std::abs(whole));
      p.mesh.tetrahedra.corners.push_back({least, t[0], t[1], t[2]});
      p.parents.push_back(row);
    });
  }
  p.report.concave_volumes += is_concave;
}

/// Twice the area of a face as a vector, by its corners.
Point area_of(const FileMesh& mesh, std::span<const std::uint32_t> face) {
  Point sum{};
  const Point& o = mesh.points[face[0]];
  for (std::size_t k = 1; k + 1 < face.size(); ++k) {
    const Point n = detail::cross(detail::difference(mesh.points[face[k]], o),
                                  detail::difference(mesh.points[face[k + 1]], o));
    for (std::size_t i = 0; i < 3; ++i) sum[i] += n[i];
  }
  return sum;
}

bool is_bent(const FileMesh& mesh, std::span<const std::uint32_t> face, const Point& area) {
  double size = 0, off = 0;
  const double length = detail::length(area);
  for (const std::uint32_t corner : face) {
    const Point d = detail::difference(mesh.points[corner], mesh.points[face[0]]);
    size = std::max(size, detail::length(d));
    off = std::max(off, std::abs(detail::dot(d, area)));
  }
  return off > plane * size * length;
}

void cut_face(Parts& p, CellKind linear, std::span<const std::uint32_t> corners,
              std::uint32_t row) {
  const Point area = area_of(p.mesh, corners);
  bool is_concave = false;
  p.report.empty_parts += for_fan(corners, [&](const Triangle& t) {
    const Point part = area_of(p.mesh, t);
    is_concave = is_concave || !(detail::dot(part, area) > flat_part * detail::dot(area, area));
    p.mesh.triangles.corners.push_back(t);
    p.parents.push_back(row);
  });
  p.report.concave_faces += is_concave;
  if (linear == CellKind::polygon) p.report.bent_polygons += is_bent(p.mesh, corners, area);
}

/// Columns of the cells of `kind` for their parts, of which there are `parents`.
CellColumns columns_of_parts(CellColumns&& cells, const std::vector<std::uint32_t>& parents,
                             std::int64_t& last, SplitCells& report) {
  take_rows(cells, parents);
  for (std::size_t i = 1; i < cells.source_id.size(); ++i) {
    if (parents[i] != parents[i - 1]) continue;
    cells.source_id[i] = ++last;
    ++report.numbers_added;
  }
  return std::move(cells);
}

/// Numbers for all cells where some have any: parts would else be named by wrong places.
std::int64_t last_number(FileMesh& mesh) {
  bool any = false;
  for (const CellKind kind : all_cell_kinds) any |= !columns_of(mesh, kind).source_id.empty();
  std::int64_t last = 0, first = 1;
  for (const CellKind kind : all_cell_kinds) {
    std::vector<std::int64_t>& ids = columns_of(mesh, kind).source_id;
    const std::size_t rows = rows_of(mesh, kind).count;
    if (any) number_rows(ids, rows, static_cast<std::size_t>(first));
    first += static_cast<std::int64_t>(rows);
    for (const std::int64_t id : ids) last = std::max(last, id);
  }
  return last;
}

}  // namespace

SplitCells split_cells(FileMesh& mesh) {
  SplitCells report;
  std::int64_t last = last_number(mesh);
  for (const CellKind kind : all_cell_kinds) {
    const CellKind linear = linear_kind(kind);
    const std::size_t count = rows_of(mesh, kind).count;
    if (is_simplex(linear) || count == 0) continue;
    const CellKindTraits& t = traits_of(kind);
    const CellKind simplex = simplex_of(t.dimension);
    const std::size_t had = rows_of(mesh, simplex).count;
    Parts parts{mesh, report, {}};
    const CellRows rows = rows_of(mesh, kind);
    for (std::uint32_t i = 0; i < count; ++i) {
      const auto nodes = rows[i];
      t.dimension == 3
          ? cut_volume(parts, linear, nodes.first(t.corners), i)
          : cut_face(parts, linear, t.corners == 0 ? nodes : nodes.first(t.corners), i);
    }
    const std::size_t more = parts.parents.size();
    report.cut[index_of(kind)] = count;
    (t.dimension == 3 ? report.tetrahedra : report.triangles) += more;
    append_columns(columns_of(mesh, simplex), had,
                   columns_of_parts(std::move(columns_of(mesh, kind)), parts.parents, last, report),
                   more);
    drop_cells(mesh, kind);
  }
  return report;
}

std::vector<bool> used_points(const FileMesh& mesh) {
  std::vector<bool> used(mesh.points.size(), false);
  for (const CellKind kind : all_cell_kinds) {
    const CellRows rows = rows_of(mesh, kind);
    for (std::size_t i = 0; i < rows.count; ++i) {
      for (const std::uint32_t node : rows[i]) used[node] = true;
    }
  }
  return used;
}

std::size_t drop_points_out_of_use(FileMesh& mesh, const std::vector<bool>& used_before) {
  const std::vector<bool> used = used_points(mesh);
  std::vector<std::uint32_t> rows, new_row(mesh.points.size());
  for (std::uint32_t p = 0; p < used.size(); ++p) {
    new_row[p] = static_cast<std::uint32_t>(rows.size());
    if (used[p] || !used_before[p]) rows.push_back(p);
  }
  const std::size_t dropped = mesh.points.size() - rows.size();
  if (dropped > 0) take_points(mesh, rows, new_row);
  return dropped;
}

}  // namespace sunder
