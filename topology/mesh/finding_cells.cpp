// SPDX-License-Identifier: MIT
// Gathers the cells that findings name.
#include "topology/mesh/finding_cells.hpp"

#include <algorithm>

namespace sunder {
namespace {

/// One integer column of a list of cells, made where it is not there yet.
std::vector<std::int64_t>& integers(std::vector<DataColumn>& data, std::size_t column,
                                    const char* name) {
  if (data.size() <= column) {
    data.push_back({name, 1, NumberType::int64, std::vector<std::int64_t>{}});
  }
  return std::get<std::vector<std::int64_t>>(data[column].values);
}

template <std::size_t Corners>
void add(CellList<Corners>& cells, const std::array<std::uint32_t, Corners>& corners,
         std::int32_t finding, std::int64_t row) {
  cells.corners.push_back(corners);
  cells.region.push_back(finding);
  integers(cells.data, 0, "finding").push_back(finding);
  integers(cells.data, 1, "row").push_back(row);
}

/// Adds the place that begins at `rows`, where its points exist.
void add_place(FileMesh& cells, const FileMesh& mesh, PlaceKind kind, const std::uint32_t* rows,
               std::int32_t finding) {
  const auto exist = [&mesh](const auto& corners) {
    return std::all_of(corners.begin(), corners.end(),
                       [&mesh](std::uint32_t p) { return p < mesh.points.size(); });
  };
  const auto add_new = [&](auto& list, const auto& corners, std::int64_t row) {
    if (exist(corners)) add(list, corners, finding, row);
  };
  switch (kind) {
    case PlaceKind::points:
      return add_new(cells.vertices, std::array{rows[0]}, rows[0]);
    case PlaceKind::edges:
      return add_new(cells.edges, std::array{rows[0], rows[1]}, -1);
    case PlaceKind::faces:
      return add_new(cells.triangles, std::array{rows[0], rows[1], rows[2]}, -1);
    case PlaceKind::triangles:
      return add_new(cells.triangles, mesh.triangles.corners[rows[0]], rows[0]);
    case PlaceKind::tetrahedra:
      return add_new(cells.tetrahedra, mesh.tetrahedra.corners[rows[0]], rows[0]);
  }
}

/// Keeps the points that cells use, and renumbers the cells.
void take_used_points(FileMesh& cells, const FileMesh& mesh) {
  std::vector<std::uint32_t> row_of(mesh.points.size(), 0);
  for_each_cell_list(cells, [&](const auto& list, int) {
    for (const auto& corners : list.corners) {
      for (const std::uint32_t p : corners) row_of[p] = 1;
    }
  });
  auto& rows = integers(cells.point_data, 0, "row");
  for (std::size_t p = 0; p < row_of.size(); ++p) {
    if (row_of[p] == 0) continue;
    row_of[p] = static_cast<std::uint32_t>(cells.points.size());
    cells.points.push_back(mesh.points[p]);
    rows.push_back(static_cast<std::int64_t>(p));
  }
  for_each_cell_list(cells, [&](auto& list, int) {
    for (auto& corners : list.corners) {
      for (std::uint32_t& p : corners) p = row_of[p];
    }
  });
}

}  // namespace

FileMesh cells_of_findings(const FileMesh& mesh, const MeshCheck& check) {
  FileMesh cells;
  std::int32_t number = 0;
  for (const Finding& f : check.findings) {
    ++number;
    for (const FindingPlaces& places : check.places) {
      if (places.code != f.code) continue;
      const std::size_t size = rows_of_place(places.kind);
      for (std::size_t i = 0; i + size <= places.rows.size(); i += size) {
        add_place(cells, mesh, places.kind, &places.rows[i], number);
      }
    }
    for_each_cell_list(cells, [&](const auto& list, int dimension) {
      if (!list.region.empty() && list.region.back() == number) {
        cells.region_name[static_cast<std::size_t>(dimension)][number] = f.code;
      }
    });
  }
  if (cell_count(cells) > 0) take_used_points(cells, mesh);
  return cells;
}

}  // namespace sunder
