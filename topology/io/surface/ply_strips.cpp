// SPDX-License-Identifier: MIT
// Triangle strips of PLY, as scanners write them: -1 ends a strip. They are passed over first, and
// read behind all faces.
#include <fmt/format.h>

#include <array>
#include <limits>
#include <utility>

#include "topology/io/surface/ply_reader.hpp"

namespace sunder::io {
namespace {

using Triangle = std::array<std::int64_t, 3>;

/// Calls `take(triangle)` for each triangle of a list: each point makes one with the two before it,
/// turned every other time. Those that repeat a point only join parts of the strip. Calls
/// `end(points)` behind each strip.
template <class Take, class End>
void for_triangles(PlyReader& r, const Property& p, Take take, End end) {
  const std::size_t length = read_length(r, p);
  Triangle last{};
  std::size_t found = 0;
  for (std::size_t k = 0; k < length; ++k) {
    const std::int64_t row = read_integer(r, p.type, "a point's row");
    if (row == -1) {
      end(std::exchange(found, 0));
      continue;
    }
    last = {last[1], last[2], row};
    if (++found < 3 || last[0] == last[1] || last[1] == last[2] || last[0] == last[2]) continue;
    take(found % 2 == 1 ? last : Triangle{last[1], last[0], last[2]});
  }
  end(found);
}

/// The same for all rows of an element.
template <class Take, class End>
void for_all_triangles(PlyReader& r, const Element& e, Take take, End end) {
  for (std::size_t i = 0; i < e.count; ++i) {
    r.draft.cell.at = begin_row(r);
    for (const Property& p : e.properties) {
      p.role == Role::corners ? for_triangles(r, p, take, end) : skip_property(r, p);
    }
    end_row(r);
  }
}

/// Wide columns are not filled for many strips: a few bytes could ask for any number.
void drop_wide_columns(PlyReader& r, std::size_t rows) {
  std::vector<DataColumn>& columns = r.draft.mesh.triangles.data;
  std::size_t components = 0;
  for (const DataColumn& column : columns) components += column.components;
  if (components == 0 || rows <= (1000 + r.in.s.text.size() / 4) / components) return;
  for (const DataColumn& column : columns) {
    add_skipped(r.draft, "data of faces beside strips", column.name, 0);
  }
  columns.clear();
}

/// Strips have no data; faces of the same file may have some.
void fill_columns(PlyReader& r) {
  CellColumns& cells = r.draft.mesh.triangles;
  const std::size_t rows = r.draft.mesh.triangles.corners.size();
  drop_wide_columns(r, rows);
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

}  // namespace

void pass_strips(PlyReader& r, Element& e) {
  assign_corners(r, e);
  for (const Property& p : e.properties) {
    if (p.role == Role::corners) continue;
    add_skipped(r.draft, "properties of strips", p.name, e.at, e.count);
  }
  r.strips.push_back({&e, r.in.s.at});
  for_all_triangles(
      r, e, [&](const Triangle&) { ++r.strip_triangles; }, [](std::size_t) {});
  // A byte may be a triangle of twelve.
  if (r.strip_triangles <= 1000 + r.in.s.text.size() / 3) return;
  fail(r.in.s.text, e.at,
       {.code = "count_too_big",
        .text = fmt::format("{} triangles of strips in a file of {} bytes", r.strip_triangles,
                            r.in.s.text.size()),
        .remedy = "write the triangles as faces"});
}

void add_strips(PlyReader& r) {
  if (r.strips.empty()) return;
  FileMesh& mesh = r.draft.mesh;
  mesh.triangles.corners.reserve(mesh.triangles.corners.size() + r.strip_triangles);
  const std::size_t end = r.in.s.at;
  FileCell& cell = r.draft.cell;
  for (const StripPlace& place : r.strips) {
    r.in.s.at = place.at;
    const auto take = [&](const Triangle& points) {
      cell.begin(3, cell.at);
      cell.numbers.assign(points.begin(), points.end());
      cell.rows = cell.numbers;
      add_cell(r.draft, CellKind::triangle, cell);
    };
    for_all_triangles(r, *place.element, take, [&](std::size_t points) {
      if (points == 0 || points > 2) return;
      add_other_cells(r.draft, "strips of fewer than three points", 2, 1, cell.at);
    });
  }
  r.in.s.at = end;
  fill_columns(r);
}

}  // namespace sunder::io
