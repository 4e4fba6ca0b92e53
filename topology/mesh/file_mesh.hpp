// SPDX-License-Identifier: MIT
// A mesh with everything that its file holds; conversions read and write this struct.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "topology/base/tet_mesh.hpp"
#include "topology/mesh/kinds/cell_kinds.hpp"

namespace sunder {

/// Type of the numbers in a file. Values are held as doubles or 64-bit integers. Writers of formats
/// with types restore the original type.
enum class NumberType {
  float64,
  float32,
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  int64,
  uint64
};

/// A column of data of points or cells: `components` numbers per row, row after row.
struct DataColumn {
  std::string name;
  /// 1 for a scalar, 3 for a vector, 9 for a tensor (row by row).
  std::size_t components = 1;
  NumberType type = NumberType::float64;
  std::variant<std::vector<double>, std::vector<std::int64_t>> values;

  friend bool operator==(const DataColumn&, const DataColumn&) = default;
};

/// Columns of the cells of one list. Each column is empty or as long as the list.
struct CellColumns {
  /// Region: physical group (Gmsh), reference (MEDIT), attribute or marker (TetGen), element set.
  std::vector<std::int32_t> region;
  /// Number of the model's entity that the cell meshes (Gmsh's elementary entity).
  std::vector<std::int32_t> entity;
  /// The file's own number of the cell; empty if it equals the place among all cells.
  std::vector<std::int64_t> source_id;
  std::vector<DataColumn> data;

  friend bool operator==(const CellColumns&, const CellColumns&) = default;
};

/// Simplices of first order with `Corners` corners, in the file's order.
template <std::size_t Corners>
struct CellList : CellColumns {
  /// Rows of points.
  std::vector<std::array<std::uint32_t, Corners>> corners;

  friend bool operator==(const CellList&, const CellList&) = default;
};

/// Cells of any other kind, in the file's order.
struct OtherCells : CellColumns {
  /// Rows of points, cell after cell.
  std::vector<std::uint32_t> points;
  /// For polygons, the index in `points` after the last node of each. Empty for all other kinds.
  std::vector<std::size_t> ends;

  friend bool operator==(const OtherCells&, const OtherCells&) = default;
};

/// The content of a mesh file as far as Sunder reads it. Cells stand by kind. The order among
/// different kinds is lost.
struct FileMesh {
  /// m.
  std::vector<Point> points;
  /// The file's own number of each point; empty if it equals the row, or the row + 1 by convention.
  std::vector<std::int64_t> source_point_id;
  /// Reference (MEDIT) or boundary marker (TetGen) of each point; empty if the file has none.
  std::vector<std::int32_t> point_region;
  std::vector<DataColumn> point_data;
  CellList<1> vertices;
  CellList<2> edges;
  CellList<3> triangles;
  CellList<4> tetrahedra;
  /// Cells of all kinds other than simplices of first order: see other_cells.
  std::array<OtherCells, cell_kinds - 4> others;
  /// Names of regions by the dimension of their cells.
  std::array<std::map<std::int32_t, std::string>, 4> region_name;

  friend bool operator==(const FileMesh&, const FileMesh&) = default;
};

/// Calls `work(cells, dimension)` for the lists of vertices, edges, triangles and tetrahedra.
template <class Mesh, class Work>
void for_each_cell_list(Mesh&& mesh, Work&& work) {
  work(mesh.vertices, 0);
  work(mesh.edges, 1);
  work(mesh.triangles, 2);
  work(mesh.tetrahedra, 3);
}

/// The list of a kind other than a simplex of first order. Requires: such a kind.
OtherCells& other_cells(FileMesh& mesh, CellKind kind);
const OtherCells& other_cells(const FileMesh& mesh, CellKind kind);

/// The columns of the cells of any kind.
CellColumns& columns_of(FileMesh& mesh, CellKind kind);
const CellColumns& columns_of(const FileMesh& mesh, CellKind kind);

/// The cells of one kind by their nodes; valid until the list changes.
struct CellRows {
  const std::uint32_t* points = nullptr;
  /// Nodes per cell; for polygons `ends` holds the end of each.
  std::size_t nodes = 0;
  const std::size_t* ends = nullptr;
  std::size_t count = 0;

  std::size_t size() const { return count; }
  std::span<const std::uint32_t> operator[](std::size_t row) const {
    if (ends == nullptr) return {points + row * nodes, nodes};
    const std::size_t begin = row == 0 ? 0 : ends[row - 1];
    return {points + begin, ends[row] - begin};
  }
};
CellRows rows_of(const FileMesh& mesh, CellKind kind);

/// All nodes of the cells of a kind, writable for renumbering.
std::span<std::uint32_t> nodes_of(FileMesh& mesh, CellKind kind);

/// Appends a cell's nodes to the list of its kind. The caller extends the columns. Requires: as
/// many nodes as the kind has.
void append_cell(FileMesh& mesh, CellKind kind, std::span<const std::uint32_t> nodes);

/// Number of cells of all kinds together.
std::size_t cell_count(const FileMesh& mesh);

/// Number of names of regions of all dimensions together.
std::size_t name_count(const FileMesh& mesh);

/// The labels of these cells in formats with one label per cell: `region`, or `entity` if there is
/// no region and more than one entity; empty otherwise.
const std::vector<std::int32_t>& label_of(const CellColumns& cells);

/// The tetrahedra of first order with their points, labels, names and numbers. All other cells are
/// dropped. Numbers are the file's own; readers leave out numbers that equal the row.
TetMesh tet_mesh_of(FileMesh&& mesh);

/// The same mesh as a file would hold it.
FileMesh file_mesh_of(const TetMesh& mesh);

}  // namespace sunder
