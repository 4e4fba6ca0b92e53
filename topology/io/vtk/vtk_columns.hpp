// SPDX-License-Identifier: MIT
// Internal to topology/io: the columns of VTK's formats on their way into a mesh. Numbers go from
// the file straight to the list of their cell: a column of bytes grows to eight times its size, and
// there is no room for it twice.
#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "topology/io/vtk/vtk_cells.hpp"

namespace sunder::io {

/// The head before an array's numbers.
struct VtkArrayHead {
  std::string name;
  std::size_t components = 1;
  NumberType type = NumberType::float64;
  bool of_cells = false;
  /// Byte of the text, for messages.
  std::size_t at = 0;
};

inline bool is_real(NumberType type) {
  return type == NumberType::float64 || type == NumberType::float32;
}

/// Names of integer cell arrays that mean a region, an entity, or a cell's own number: ours, and
/// those that Gmsh, meshio, CGAL and FEniCS use.
bool is_region_name(std::string_view name);
bool is_entity_name(std::string_view name);
bool is_cell_id_name(std::string_view name);

/// The names that a piece has given so far.
struct VtkNames {
  std::set<std::string, std::less<>> points;
  std::set<std::string, std::less<>> cells;
};

/// Whether an array is the first of its name in a piece; others are to be left out, and are counted
/// as duplicate_name (a warning). Fails with count_too_big where there are more than 1024.
bool is_new_name(Draft& draft, VtkNames& names, const VtkArrayHead& head);

/// Whether an array of this head gives regions, entities or ids: one integer a row, by its name.
bool is_vtk_label(const VtkArrayHead& head);

/// Takes the regions, entities or ids of a piece. Where a list has them already, they are data.
/// Needs: is_vtk_label; one value per row. Fails with number_out_of_range.
void add_vtk_label(Draft& draft, VtkPiece& piece, const VtkArrayHead& head,
                   const std::vector<std::int64_t>& values);

/// Takes an array's numbers one after the other, and puts each row where its cell went.
template <class Value>
struct VtkSink {
  /// By kind; of points the first. Null: those rows are dropped.
  std::array<std::vector<Value>*, cell_kinds> lists{};
  /// Empty for points.
  std::span<const std::int8_t> list_of_row;
  /// Empty where every row is one cell.
  std::span<const std::uint32_t> parts_of_row;
  std::size_t components = 1;
  std::size_t row = 0;
  std::size_t left_of_row = 0;
  std::vector<Value>* list = nullptr;

  void operator()(Value value) {
    if (left_of_row == 0) {
      const int d = list_of_row.empty() ? 0 : list_of_row[row];
      list = d < 0 ? nullptr : lists[static_cast<std::size_t>(d)];
      left_of_row = components;
      ++row;
    }
    --left_of_row;
    if (list == nullptr) return;
    list->push_back(value);
    if (left_of_row == 0 && !parts_of_row.empty()) copy_row(parts_of_row[row - 1] - 1);
  }
  /// Gives the row that is complete to more cells.
  void copy_row(std::size_t times) {
    for (std::size_t i = times * components; i > 0; --i) {
      const Value value = (*list)[list->size() - components];
      list->push_back(value);
    }
  }
  void operator()(std::span<const Value> values) {
    for (const Value value : values) (*this)(value);
  }
};

/// The sink for the rows of an array of data: columns of that name are begun, or go on where
/// another piece began them. Rows missing from earlier pieces are found at the end. Room is made
/// for the rows of the whole mesh, at most `most_numbers`.
/// Needs: all points or cells of the file are there. The sink is good until the next call.
template <class Value>
VtkSink<Value> begin_vtk_data(Draft& draft, VtkPiece& piece, const VtkArrayHead& head,
                              std::size_t most_numbers);

/// Drops columns that not all pieces had, with a warning, and labels and ids that are incomplete.
/// Where there are cells of several kinds, those of one lose columns of nothing but 0 (labels,
/// ids) or not-a-number (data): vtk_grid fills with them.
void finish_vtk_columns(Draft& draft);

}  // namespace sunder::io
