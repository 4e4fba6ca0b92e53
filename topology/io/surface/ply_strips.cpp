// SPDX-License-Identifier: MIT
// Triangle strips of PLY, as scanners write them: -1 ends a strip.
#include <array>
#include <limits>
#include <utility>

#include "topology/io/surface/ply_reader.hpp"

namespace sunder::io {
namespace {

/// A triangle of a strip; those that repeat a point only join parts of the strip.
void add_strip_triangle(PlyReader& r, std::array<std::int64_t, 3> points, bool is_odd) {
  if (is_odd) std::swap(points[0], points[1]);
  if (points[0] == points[1] || points[1] == points[2] || points[0] == points[2]) return;
  r.strips.push_back({points, r.draft.cell.at});
}

/// Triangle strips: each point makes a triangle with the two before it, turned every other time.
void read_strip(PlyReader& r, const Property& p) {
  const std::size_t length = read_length(r, p);
  std::array<std::int64_t, 3> points{};
  std::size_t found = 0;
  const auto end_strip = [&] {
    if (found > 0 && found < 3) {
      add_other_cells(r.draft, "strips of fewer than three points", 2, 1, r.draft.cell.at);
    }
    found = 0;
  };
  for (std::size_t k = 0; k < length; ++k) {
    const std::int64_t row = read_integer(r, p.type, "a point's row");
    if (row == -1) {
      end_strip();
      continue;
    }
    points = {points[1], points[2], row};
    if (++found >= 3) add_strip_triangle(r, points, found % 2 == 0);
  }
  end_strip();
}

}  // namespace

void read_strips(PlyReader& r, Element& e) {
  assign_corners(r, e);
  for (const Property& p : e.properties) {
    if (p.role == Role::corners) continue;
    add_skipped(r.draft, "properties of strips", p.name, e.at, e.count);
  }
  for (std::size_t i = 0; i < e.count; ++i) {
    r.draft.cell.at = begin_row(r);
    for (const Property& p : e.properties) {
      p.role == Role::corners ? read_strip(r, p) : skip_property(r, p);
    }
    end_row(r);
  }
}

void add_strips(PlyReader& r) {
  if (r.strips.empty()) return;
  for (const StripTriangle& t : r.strips) {
    r.draft.cell.begin(3, t.at);
    r.draft.cell.numbers.assign(t.points.begin(), t.points.end());
    r.draft.cell.rows = r.draft.cell.numbers;
    add_cell(r.draft, CellKind::triangle, r.draft.cell);
  }
  // Strips have no data: faces beside them may have some.
  CellColumns& cells = r.draft.mesh.triangles;
  const std::size_t rows = r.draft.mesh.triangles.corners.size();
  if (!cells.region.empty()) cells.region.resize(rows, 0);
  if (!cells.entity.empty()) cells.entity.resize(rows, 0);
  add_skipped(r.draft, "numbers of faces beside strips", {}, 0, cells.source_id.size());
  cells.source_id.clear();
  for (DataColumn& column : cells.data) {
    const std::size_t numbers = rows * column.components;
    if (auto* const reals = std::get_if<std::vector<double>>(&column.values)) {
      reals->resize(numbers, std::numeric_limits<double>::quiet_NaN());
    } else {
      std::get<std::vector<std::int64_t>>(column.values).resize(numbers, 0);
    }
  }
}

}  // namespace sunder::io
