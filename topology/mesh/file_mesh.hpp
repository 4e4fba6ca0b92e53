// SPDX-License-Identifier: MIT
// A mesh with all that its file said about it: what mesh files are converted through.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "topology/base/tet_mesh.hpp"

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

/// Cells with `Corners` corners, in the file's order; every column is empty or as long as
/// `corners`.
template <std::size_t Corners>
struct CellList {
  /// Rows of points.
  std::vector<std::array<std::uint32_t, Corners>> corners;
  /// Region: physical group (Gmsh), reference (MEDIT), attribute or marker (TetGen), element set.
  std::vector<std::int32_t> region;
  /// Number of the model's entity that the cell meshes (Gmsh's elementary entity).
  std::vector<std::int32_t> entity;
  /// The file's own number of the cell; empty when it is its place among all cells.
  std::vector<std::int64_t> source_id;
  std::vector<DataColumn> data;

  friend bool operator==(const CellList&, const CellList&) = default;
};

/// All that a mesh file holds, as far as Sunder knows it. Cells by dimension; their order among
/// different dimensions is not kept.
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

/// All cells together.
std::size_t cell_count(const FileMesh& mesh);

/// Names of regions of all dimensions together.
std::size_t name_count(const FileMesh& mesh);

/// What stands for the region of these cells in formats that know one label a cell: `region`, or
/// the entities where no region is given and there are several; empty otherwise.
template <std::size_t Corners>
const std::vector<std::int32_t>& label_of(const CellList<Corners>& cells) {
  if (!cells.region.empty()) return cells.region;
  static const std::vector<std::int32_t> none;
  for (const std::int32_t entity : cells.entity) {
    if (entity != cells.entity.front()) return cells.entity;
  }
  return none;
}

/// The tetrahedra with their points, labels, names and ids, to compute with; the rest is dropped.
/// Numbers that count on from the cells of lower dimension are dropped too.
TetMesh tet_mesh_of(FileMesh&& mesh);

/// The same mesh as a file would hold it.
FileMesh file_mesh_of(const TetMesh& mesh);

}  // namespace sunder
