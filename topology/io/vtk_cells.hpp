// SPDX-License-Identifier: MIT
// Internal to topology/io: cells and columns as VTK's formats hold them, of all kinds in one list.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "topology/io/draft.hpp"

namespace sunder::io {

/// Cells of a file: VTK's type of each, and where its points end in the list of all.
struct VtkCells {
  std::vector<std::int64_t> types;
  std::vector<std::int64_t> ends;
  std::vector<std::int64_t> points;
};

/// Where one piece of a file stands in the mesh.
struct VtkPiece {
  /// Rows of the mesh that its points are.
  std::size_t first_point = 0;
  std::size_t points = 0;
  /// The list that each of its cells went to, by dimension; -1 where it was left out.
  std::vector<std::int8_t> list_of_cell;
};

/// Fails with bad_offsets where ends fall or a cell has fewer points than its type; `at`: the place
/// of the offsets in the text.
void check_vtk_cells(const VtkCells& cells, std::string_view text, std::size_t at);

/// Adds the simplices to the draft's lists, of curved ones the corners, and counts the others.
/// Fails with unknown_cell_type. Needs: check_vtk_cells passed, and as many `points` as it counts.
void add_vtk_cells(Draft& draft, VtkPiece& piece, const VtkCells& cells, std::size_t at);

/// A column of cells goes to the lists of its cells: as region, entity or source id by its name,
/// otherwise as data. A region or an id that was given before is not replaced. `at`: for messages.
void add_vtk_cell_column(Draft& draft, const VtkPiece& piece, const DataColumn& column,
                         std::size_t at);

/// A column of points: source ids or regions by its name, or data. `at`: for messages.
void add_vtk_point_column(Draft& draft, const VtkPiece& piece, DataColumn&& column, std::size_t at);

/// Drops columns that not all pieces had, with a warning, and labels and ids that are incomplete.
/// Where there are cells of several dimensions, those of one lose columns of nothing but 0 (labels,
/// ids) or not-a-number (data): vtk_grid fills with them.
void finish_vtk_columns(Draft& draft);

/// Calls `work` with a zero of the type that a file stores numbers in.
template <class Work>
decltype(auto) with_stored(NumberType type, Work&& work) {
  switch (type) {
    case NumberType::float64:
      return work(double{});
    case NumberType::float32:
      return work(float{});
    case NumberType::int8:
      return work(std::int8_t{});
    case NumberType::uint8:
      return work(std::uint8_t{});
    case NumberType::int16:
      return work(std::int16_t{});
    case NumberType::uint16:
      return work(std::uint16_t{});
    case NumberType::int32:
      return work(std::int32_t{});
    case NumberType::uint32:
      return work(std::uint32_t{});
    case NumberType::int64:
      return work(std::int64_t{});
    default:
      return work(std::uint64_t{});
  }
}

/// VTU's words for the types, in the order of NumberType.
inline constexpr std::string_view vtu_types[] = {"Float64", "Float32", "Int8",   "UInt8", "Int16",
                                                 "UInt16",  "Int32",   "UInt32", "Int64", "UInt64"};

/// A mesh as VTK's formats hold it: one list of cells, columns over all of them.
struct VtkGrid {
  std::vector<std::int32_t> connectivity;
  std::vector<std::int64_t> ends;
  std::vector<std::uint8_t> types;
  std::vector<DataColumn> point_data;
  /// Columns that cells of some dimension lack are filled: with not-a-number, integers with 0.
  std::vector<DataColumn> cell_data;
};
VtkGrid vtk_grid(const FileMesh& mesh);

}  // namespace sunder::io
