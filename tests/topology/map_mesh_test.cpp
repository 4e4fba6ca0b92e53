// SPDX-License-Identifier: MIT
// A map written as a mesh and read again.
#include "topology/map_mesh.hpp"

#include "tests/topology/built.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

TEST_CASE("a split map written with its vertices reads back as the same map",
          "[topology][map_mesh]") {
  const std::uint64_t seed = 61;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  for (const NamedMesh& shape : all_shapes()) {
    INFO(shape.name);
    VolumeMap map = built(shape.mesh);
    // Whole sections: every face whose tetrahedra differ in a random sign, so that no crack face
    // keeps all three of its vertices.
    std::vector<char> side(map.tetrahedra());
    for (char& s : side) s = static_cast<char>(below(random, 2));
    for (const HalfFaceId f : interior_faces(map)) {
      if (side[f.index() / 4] != side[map.neighbour(f).index() / 4]) split_face(map, f);
    }
    const TetMesh written = mesh_of_map(map, shape.mesh, MeshPoints::vertices);
    const VolumeMap again = built(written);
    CHECK(again.reoriented().empty());
    const Counts a = count_cells(map), b = count_cells(again);
    CHECK(a.vertices == b.vertices);
    // A boundary face whose points are those of another is sewn again: the file cannot tell.
    std::size_t lost = 0;
    for (std::size_t i = 0; i < 4 * map.tetrahedra(); ++i) {
      const HalfFaceId f{i};
      lost += map.neighbour(f).is_none() && !again.neighbour(f).is_none() ? 1 : 0;
    }
    CHECK(a.boundary_faces == b.boundary_faces + lost);
    if (lost == 0) CHECK(cells(a) == cells(b));
  }
}

TEST_CASE("with the source's points pinches are as they were and splits are gone",
          "[topology][map_mesh]") {
  TetMesh mesh = bent_bar(4, {{0, 0}});
  mesh.region.assign(mesh.tetrahedra.size(), 7);
  mesh.region_name[7] = "bar";
  VolumeMap map = built(mesh);
  for (const HalfFaceId f : interior_faces(map)) split_face(map, f);
  const TetMesh written = mesh_of_map(map, mesh, MeshPoints::source);
  CHECK(written.tetrahedra == mesh.tetrahedra);
  CHECK(written.points == mesh.points);
  CHECK(written.region == mesh.region);
  CHECK(written.region_name == mesh.region_name);
}

TEST_CASE("rows retired by gluing leave no point behind", "[topology][map_mesh]") {
  const TetMesh mesh = kuhn_box({2, 1, 1});
  VolumeMap map = built(mesh);
  std::vector<FaceSplit> done;
  for (const HalfFaceId f : interior_faces(map)) done.push_back(split_face(map, f));
  for (std::size_t i = 0; i + 1 < done.size(); ++i) {
    glue_face(map, done[i].face,
              done[i].opposite);  // in the order of splitting: rows retire inside
  }
  const TetMesh written = mesh_of_map(map, mesh, MeshPoints::vertices);
  CHECK(written.points.size() == count_cells(map).vertices);
  CHECK(cells(built(written)) == cells(map));
}
