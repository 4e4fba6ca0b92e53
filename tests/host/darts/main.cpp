// SPDX-License-Identifier: MIT
// A researcher's host: splits a face of a mesh and follows it through CGAL's map and back to rows.
#include <cstdio>
#include <sunder/cgal_map.hpp>
#include <sunder/mesh.hpp>
#include <vector>

int main(int argc, char** argv) {
  if (argc != 2) return std::puts("usage: darts MESH"), 2;
  const auto mesh = sunder::read_mesh(argv[1]);
  auto map = mesh ? sunder::build_map(*mesh) : sunder::Result<sunder::VolumeMap>{};
  if (!map) return std::puts("no map can be built of this mesh"), 3;

  // The first face between two tetrahedra, and its dart from its first corner.
  sunder::HalfFaceId face{0};
  while (map->neighbour(face).is_none()) face = sunder::HalfFaceId{face.index() + 1};
  const sunder::TetId t = sunder::tetrahedron_of(face);
  const int from = sunder::dart_order::face_corners[sunder::place_of(face)][0];
  const sunder::FaceSplit split = sunder::split_face(*map, face);

  // From the row to CGAL's dart, and from the dart to its attributes and beta links.
  const sunder::DartMap& darts = map->darts();
  const auto dart = darts.dart(face, sunder::corner(t, from));
  const auto& cgal = darts.complex();
  const sunder::VertexId row = cgal.info<0>(dart).row;
  const auto& p = cgal.point(dart);
  std::printf("dart %u of tetrahedron %u, 3-free: %d\n", darts.id(dart).value,
              cgal.info<3>(dart).value, cgal.is_free<3>(dart));
  std::printf("vertex row %u, next along beta1 %u\n", row.value,
              darts.vertex(darts.beta1(dart)).value);

  // A column of one's own, a row a vertex, filled on the dense side and read through the dart.
  std::vector<double> height(map->vertices());
  for (std::size_t v = 0; v < height.size(); ++v) height[v] = map->point(sunder::VertexId{v})[2];
  std::printf("height %.17g, by the dart %.17g\n", height[row.index()], p.z());

  // And back: the row's corner of the tetrahedron, the face on the other side, which is cut.
  const bool agrees = split.did && cgal.is_free<3>(dart) && cgal.info<3>(dart) == t &&
                      map->corners(t)[static_cast<std::size_t>(from)] == row &&
                      map->neighbour(face).is_none() && height[row.index()] == p.z();
  return agrees ? 0 : 1;
}
