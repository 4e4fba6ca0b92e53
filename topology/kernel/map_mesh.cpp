// SPDX-License-Identifier: MIT
// Points and tetrahedra of a map.
#include "topology/kernel/map_mesh.hpp"

#include <algorithm>

#include "topology/base/assert.hpp"

namespace sunder {

TetMesh mesh_of_map(const VolumeMap& map, const TetMesh& source, MeshPoints points) {
  SUNDER_ASSERT(map.tetrahedra() == source.tetrahedra.size(), "a map built from the source");
  TetMesh mesh;
  std::vector<std::uint32_t> point_of_row(map.point_of_vertex().begin(),
                                          map.point_of_vertex().end());
  if (points == MeshPoints::source) {
    mesh.points = source.points;
    mesh.source_point_id = source.source_point_id;
  } else {
    for (std::size_t v = 0; v < map.vertices(); ++v) {
      if (map.incident_tetrahedron(VertexId{v}).is_none()) continue;
      point_of_row[v] = static_cast<std::uint32_t>(mesh.points.size());
      mesh.points.push_back(map.point(VertexId{v}));
    }
  }
  mesh.tetrahedra.reserve(map.tetrahedra());
  for (const auto& corners : map.corners()) {
    auto& t = mesh.tetrahedra.emplace_back();
    for (std::size_t i = 0; i < 4; ++i) t[i] = point_of_row[corners[i].index()];
  }
  mesh.region = source.region;
  mesh.region_name = source.region_name;
  mesh.source_tetrahedron_id = source.source_tetrahedron_id;
  return mesh;
}

std::vector<HalfFaceId> unexpressed_cuts(const VolumeMap& map) {
  struct Side {
    std::array<VertexId, 3> vertices;
    HalfFaceId face;
    auto operator<=>(const Side&) const = default;
  };
  std::vector<Side> boundary;
  for (std::size_t i = 0; i < 4 * map.tetrahedra(); ++i) {
    const HalfFaceId f{i};
    if (!map.neighbour(f).is_none()) continue;
    Side side{.vertices = corners_of_face(map.corners(tetrahedron_of(f)), f), .face = f};
    std::sort(side.vertices.begin(), side.vertices.end());
    boundary.push_back(side);
  }
  // No three sides can agree: a face of a mesh that a map was built from has at most two.
  std::sort(boundary.begin(), boundary.end());
  std::vector<HalfFaceId> cuts;
  for (std::size_t i = 1; i < boundary.size(); ++i) {
    if (boundary[i].vertices == boundary[i - 1].vertices) cuts.push_back(boundary[i - 1].face);
  }
  std::sort(cuts.begin(), cuts.end());
  return cuts;
}

}  // namespace sunder
