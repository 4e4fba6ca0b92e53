// SPDX-License-Identifier: MIT
// Points and tetrahedra of a map.
#include "topology/map_mesh.hpp"

#include "topology/assert.hpp"

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

}  // namespace sunder
