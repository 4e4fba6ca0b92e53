// SPDX-License-Identifier: MIT
// A mesh with all that its file said about it: what mesh files are converted through.
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

/// The type a file gives its numbers in. Values are kept as doubles or 64-bit integers; writers of
/// formats with types write them in their own again.
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

/// A column of data beside points or cells: `components` numbers a row, row after row.
struct DataColumn {
  std::string name;
  /// 1 for a scalar, 3 for a vector, 9 for a tensor (row by row).
  std::size_t components = 1;
  NumberType type = NumberType::float64;
  std::variant<std::vector<double>, std::vector<std::int64_t>> values;

  friend bool operator==(const DataColumn&, const DataColumn&) = default;
};

/// What is said of the cells of one list; every column is empty or as long as the list.
struct CellColumns {
  /// Region: physical group (Gmsh), reference (MEDIT), attribute or marker (TetGen), element set.
  std::vector<std::int32_t> region;
  /// Number of the model's entity that the cell meshes (Gmsh's elementary entity).
  std::vector<std::int32_t> entity;
  /// The file's own number of the cell; empty when it is its place among all cells.
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
  /// Rows of points, the nodes of one cell after those of the other.
  std::vector<std::uint32_t> points;
  /// Of polygons: where each ends in `points`. Empty for all other kinds.
  std::vector<std::size_t> ends;

  friend bool operator==(const OtherCells&, const OtherCells&) = default;
};

/// All that a mesh file holds, as far as Sunder knows it. Cells by kind; their order among
/// different kinds is not kept.
struct FileMesh {
  /// m.
  std::vector<Point> points;
  /// The file's own number of each point; empty when it is the row (or the row + 1 by convention).
  std::vector<std::int64_t> source_point_id;
  /// Reference (MEDIT) or boundary marker (TetGen) of each point; empty when the file has none.
  std::vector<std::int32_t> point_region;
  std::vector<DataColumn> point_data;
  CellList<1> vertices;
  CellList<2> edges;
  CellList<3> triangles;
  CellList<4> tetrahedra;
  /// Cells of all kinds that are no simplices of first order: see other_cells.
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

/// The list of a kind that is no simplex of first order.
OtherCells& other_cells(FileMesh& mesh, CellKind kind);
const OtherCells& other_cells(const FileMesh& mesh, CellKind kind);

/// What is said of the cells of any kind.
CellColumns& columns_of(FileMesh& mesh, CellKind kind);
const CellColumns& columns_of(const FileMesh& mesh, CellKind kind);

/// The cells of one kind, by their nodes; good while the list stays as it is.
struct CellRows {
  const std::uint32_t* points = nullptr;
  /// Nodes of a cell; of polygons `ends` tells where each ends.
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

/// All nodes of the cells of a kind, to be renumbered.
std::span<std::uint32_t> nodes_of(FileMesh& mesh, CellKind kind);

/// Appends a cell's nodes to the list of its kind; its columns are left to the caller. Needs: as
/// many as the kind has.
void append_cell(FileMesh& mesh, CellKind kind, std::span<const std::uint32_t> nodes);

/// All cells together.
std::size_t cell_count(const FileMesh& mesh);

/// Names of regions of all dimensions together.
std::size_t name_count(const FileMesh& mesh);

/// What stands for the region of these cells in formats that know one label a cell: `region`, or
/// the entities where no region is given and there are several; empty otherwise.
const std::vector<std::int32_t>& label_of(const CellColumns& cells);

/// The tetrahedra of first order with their points, labels, names and numbers, to compute with; the
/// rest is dropped. Numbers are those of the file: readers leave out those that only count.
TetMesh tet_mesh_of(FileMesh&& mesh);

/// The same mesh as a file would hold it.
FileMesh file_mesh_of(const TetMesh& mesh);

}  // namespace sunder
