// SPDX-License-Identifier: MIT
// From all that a file says to what is computed with, and back.
#include "topology/mesh/file_mesh.hpp"

#include <utility>

namespace sunder {

std::size_t cell_count(const FileMesh& mesh) {
  std::size_t count = 0;
  for_each_cell_list(mesh, [&](const auto& cells, int) { count += cells.corners.size(); });
  return count;
}

std::size_t name_count(const FileMesh& mesh) {
  std::size_t names = 0;
  for (const auto& of_dimension : mesh.region_name) names += of_dimension.size();
  return names;
}

TetMesh tet_mesh_of(FileMesh&& mesh) {
  TetMesh result;
  result.points = std::move(mesh.points);
  result.region = label_of(mesh.tetrahedra);
  result.tetrahedra = std::move(mesh.tetrahedra.corners);
  result.region_name = std::move(mesh.region_name[3]);
  result.source_point_id = std::move(mesh.source_point_id);
  result.source_tetrahedron_id = std::move(mesh.tetrahedra.source_id);
  return result;
}

FileMesh file_mesh_of(const TetMesh& mesh) {
  FileMesh result;
  result.points = mesh.points;
  result.source_point_id = mesh.source_point_id;
  result.tetrahedra.corners = mesh.tetrahedra;
  result.tetrahedra.region = mesh.region;
  result.tetrahedra.source_id = mesh.source_tetrahedron_id;
  result.region_name[3] = mesh.region_name;
  return result;
}

}  // namespace sunder
