// SPDX-License-Identifier: MIT
// From all contents of a file to the mesh for computing, and back.
#include "topology/mesh/file_mesh.hpp"

#include <utility>

namespace sunder {

namespace {

/// The place of a kind among those that are no simplices of first order.
constexpr std::size_t place_among_others(CellKind kind) {
  std::size_t place = 0;
  for (const CellKind k : all_cell_kinds) place += k < kind && !is_simplex(k);
  return place;
}

constexpr auto kind_places = [] {
  std::array<std::uint8_t, cell_kinds> all{};
  for (const CellKind kind : all_cell_kinds) {
    all[index_of(kind)] = static_cast<std::uint8_t>(place_among_others(kind));
  }
  return all;
}();

template <class Columns, class Mesh>
Columns& columns_in(Mesh& mesh, CellKind kind) {
  switch (kind) {
    case CellKind::vertex:
      return mesh.vertices;
    case CellKind::edge:
      return mesh.edges;
    case CellKind::triangle:
      return mesh.triangles;
    case CellKind::tetrahedron:
      return mesh.tetrahedra;
    default:
      return mesh.others[kind_places[index_of(kind)]];
  }
}

template <std::size_t Corners>
CellRows rows_in(const CellList<Corners>& cells) {
  return {cells.corners.empty() ? nullptr : cells.corners.front().data(), Corners, nullptr,
          cells.corners.size()};
}

}  // namespace

OtherCells& other_cells(FileMesh& mesh, CellKind kind) {
  return mesh.others[kind_places[index_of(kind)]];
}
const OtherCells& other_cells(const FileMesh& mesh, CellKind kind) {
  return mesh.others[kind_places[index_of(kind)]];
}

CellColumns& columns_of(FileMesh& mesh, CellKind kind) {
  return columns_in<CellColumns>(mesh, kind);
}
const CellColumns& columns_of(const FileMesh& mesh, CellKind kind) {
  return columns_in<const CellColumns>(mesh, kind);
}

CellRows rows_of(const FileMesh& mesh, CellKind kind) {
  switch (kind) {
    case CellKind::vertex:
      return rows_in(mesh.vertices);
    case CellKind::edge:
      return rows_in(mesh.edges);
    case CellKind::triangle:
      return rows_in(mesh.triangles);
    case CellKind::tetrahedron:
      return rows_in(mesh.tetrahedra);
    default:
      break;
  }
  const OtherCells& cells = other_cells(mesh, kind);
  const std::size_t nodes = traits_of(kind).nodes;
  if (kind == CellKind::polygon) {
    return {cells.points.data(), 0, cells.ends.data(), cells.ends.size()};
  }
  return {cells.points.data(), nodes, nullptr, cells.points.size() / nodes};
}

std::span<std::uint32_t> nodes_of(FileMesh& mesh, CellKind kind) {
  const CellRows rows = rows_of(mesh, kind);
  const std::size_t n =
      kind == CellKind::polygon ? other_cells(mesh, kind).points.size() : rows.count * rows.nodes;
  return {const_cast<std::uint32_t*>(rows.points), n};
}

void append_cell(FileMesh& mesh, CellKind kind, std::span<const std::uint32_t> nodes) {
  switch (kind) {
    case CellKind::vertex:
      mesh.vertices.corners.push_back({nodes[0]});
      return;
    case CellKind::edge:
      mesh.edges.corners.push_back({nodes[0], nodes[1]});
      return;
    case CellKind::triangle:
      mesh.triangles.corners.push_back({nodes[0], nodes[1], nodes[2]});
      return;
    case CellKind::tetrahedron:
      mesh.tetrahedra.corners.push_back({nodes[0], nodes[1], nodes[2], nodes[3]});
      return;
    default:
      break;
  }
  OtherCells& cells = other_cells(mesh, kind);
  cells.points.insert(cells.points.end(), nodes.begin(), nodes.end());
  if (kind == CellKind::polygon) cells.ends.push_back(cells.points.size());
}

std::size_t cell_count(const FileMesh& mesh) {
  std::size_t count = 0;
  for (const CellKind kind : all_cell_kinds) count += rows_of(mesh, kind).count;
  return count;
}

const std::vector<std::int32_t>& label_of(const CellColumns& cells) {
  if (!cells.region.empty()) return cells.region;
  static const std::vector<std::int32_t> none;
  for (const std::int32_t entity : cells.entity) {
    if (entity != cells.entity.front()) return cells.entity;
  }
  return none;
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
