// SPDX-License-Identifier: MIT
// Internal to topology/io: cells and columns as VTK's formats hold them, of all kinds in one list.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "topology/base/whole_number.hpp"
#include "topology/io/draft.hpp"
#include "topology/io/text/scan.hpp"

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
  /// The kind of each of its cells, or of its parts; -1 where it was left out.
  std::vector<std::int8_t> list_of_cell;
  /// Into how many parts each was cut: poly-vertices, polylines and strips become vertices, edges
  /// and triangles, which have the data of the whole. Empty where there are none of these.
  std::vector<std::uint32_t> parts_of_cell;
  /// By kind: how many there are, and the row of the first. Empty without cells: a file may have
  /// many pieces.
  std::vector<std::size_t> cells, first_cell;
  /// How many parts there are more than cells, and how many numbers may still be copied for them.
  std::size_t more_parts = 0;
  std::size_t copies_left = 0;
};

/// Takes the copies that a column of so many components needs for parts of cells off the room left.
/// Fails with count_too_big.
void count_copies(const Draft& draft, VtkPiece& piece, std::size_t components, std::size_t at);

/// Fails with bad_offsets where ends fall or a cell has fewer points than its type; `at`: the place
/// of the offsets in the text.
void check_vtk_cells(const VtkCells& cells, std::string_view text, std::size_t at);

/// Adds the cells to the draft's lists, of those of higher order the corners, of poly-vertices,
/// polylines and strips the parts, and counts the others.
/// Fails with unknown_cell_type. Needs: check_vtk_cells passed, and as many `points` as it counts.
void add_vtk_cells(Draft& draft, VtkPiece& piece, const VtkCells& cells, std::size_t at);

/// Room for `more` rows: just that at first, later at least half as much again.
template <class Row>
void make_room(std::vector<Row>& rows, std::size_t more) {
  const std::size_t needed = rows.size() + more;
  if (needed <= rows.capacity()) return;
  rows.reserve(rows.empty() ? needed : std::max(needed, rows.capacity() + rows.capacity() / 2));
}

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

/// The next number of a text as a file with raw numbers of type `Stored` would have it: integers
/// that the type does not hold fail, reals are rounded to it. `Value`: double or std::int64_t.
template <class Stored, class Value>
Value read_text_as(Scanner& s, std::string_view what) {
  if constexpr (std::is_integral_v<Stored>) {
    return static_cast<Value>(read_number<Stored>(s, what));
  } else {
    const double x = read_number<double>(s, what);
    constexpr double most = std::numeric_limits<Stored>::max();
    if (std::abs(x) > most) {
      return number_cast<Value>(std::copysign(std::numeric_limits<double>::infinity(), x));
    }
    return number_cast<Value>(static_cast<Stored>(x));
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
  /// Columns that cells of some kind lack are filled: with not-a-number, integers with 0.
  std::vector<DataColumn> cell_data;
};
VtkGrid vtk_grid(const FileMesh& mesh);

/// VTK's type of a kind; 0 for pyramids of 14 nodes, which it does not have.
std::uint8_t vtk_type_of(CellKind kind);

/// Names of data that do not reach the grid whole: a name stands for one array there, of points or
/// of all cells. The second column of a name is left out, and so are columns with names of our own
/// labels; columns with other components or numbers than the first are filled.
std::vector<std::string> vtk_clashes(const FileMesh& mesh);

/// Names of whole numbers that cells of some kind have and those of another lack. These get 0 in
/// the grid, which no reader can distinguish from a number. (Reals get not-a-number, and labels get
/// 0, which is read as none.)
std::vector<std::string> vtk_fillings(const FileMesh& mesh);

}  // namespace sunder::io
