// SPDX-License-Identifier: MIT
// A map written as a mesh and read again.
#include "topology/kernel/map_mesh.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "tests/support/built.hpp"
#include "topology/io/mesh_file.hpp"

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
    // Whole sections: every face between tetrahedra of different random signs, so that no crack
    // face keeps all three of its vertices.
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
    // A boundary face with the points of another is sewn again: the file cannot keep them apart.
    std::size_t lost = 0;
    for (std::size_t i = 0; i < 4 * map.tetrahedra(); ++i) {
      const HalfFaceId f{i};
      lost += map.neighbour(f).is_none() && !again.neighbour(f).is_none() ? 1 : 0;
    }
    CHECK(a.boundary_faces == b.boundary_faces + lost);
    if (lost == 0) CHECK(cells(a) == cells(b));
  }
}

TEST_CASE("a cut mesh and its unexpressed cuts restore the same map, row for row",
          "[topology][map_mesh]") {
  const std::uint64_t seed = 62;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  const auto path = [](const char* end) {
    return std::filesystem::temp_directory_path() / fmt::format("sunder_{}{}", getpid(), end);
  };
  std::size_t unexpressed = 0;
  for (const NamedMesh& shape : all_shapes()) {
    for (const std::size_t part : {1U, 4U, 16U}) {
      INFO(shape.name << ", one face in " << part);
      VolumeMap map = built(shape.mesh);
      for (const HalfFaceId f : interior_faces(map)) {
        if (below(random, part) == 0) split_face(map, f);
      }
      const std::vector<HalfFaceId> cuts = unexpressed_cuts(map);
      unexpressed += cuts.size();
      const TetMesh written = mesh_of_map(map, shape.mesh, MeshPoints::vertices);
      std::vector<std::array<std::uint32_t, 3>> triples;
      for (const HalfFaceId f : cuts) {
        auto& triple = triples.emplace_back();
        for (int k = 0; k < 3; ++k) {
          triple[k] = written.tetrahedra[f.index() / 4][dart_order::face_corners[place_of(f)][k]];
        }
      }
      for (const char* end : {".msh", ".vtu"}) {
        REQUIRE_FALSE(has_error(write_mesh(path(end), written)));
        const Result<TetMesh> read = read_mesh(path(end));
        std::filesystem::remove(path(end));
        REQUIRE(read);
        VolumeMap again = built(*read);
        std::vector<HalfFaceId> faces =
            find_faces(again, std::span<const std::array<std::uint32_t, 3>>(triples));
        CHECK(faces == cuts);
        std::reverse(faces.begin(), faces.end());  // in whichever order
        for (const HalfFaceId f : faces) CHECK(split_face(again, f).vertex_count == 0);
        if (!again.reoriented().empty()) {
          // It has no place in space: a piece of it alone has a negative volume.
          CHECK(shape.name == "closed simplex boundary");
          continue;
        }
        CHECK(std::ranges::equal(again.corners(), map.corners()));
        CHECK(std::ranges::equal(again.neighbours(), map.neighbours()));
        for (std::size_t v = 0; v < map.vertices(); ++v) {
          REQUIRE(again.point(VertexId{v}) == map.point(VertexId{v}));
        }
        CHECK(label_components(again).of_tetrahedron == label_components(map).of_tetrahedron);
        CHECK(unexpressed_cuts(again) == cuts);
      }
    }
  }
  CHECK(unexpressed > 100);
}

TEST_CASE("only cuts that split no vertex between their sides are unexpressed",
          "[topology][map_mesh]") {
  VolumeMap map = built(kuhn_box({4, 4, 4}));
  CHECK(unexpressed_cuts(map).empty());
  // Fixture 12: a crack of two faces inside a body.
  std::vector<HalfFaceId> cuts = {face_on(map, {32, 37, 62}), face_on(map, {32, 57, 62})};
  for (const HalfFaceId f : cuts) split_face(map, f);
  std::sort(cuts.begin(), cuts.end());
  CHECK(unexpressed_cuts(map) == cuts);
  // Cut through to the surface everywhere, every face has two sides of its own.
  const auto section = plane_faces(map, {{0, 0, 1}, 2});
  for (const HalfFaceId f : *section) split_face(map, f);
  for (const HalfFaceId f : *section) {
    CHECK(std::ranges::count(unexpressed_cuts(map), f) == 0);
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

TEST_CASE("regions and numbers of tetrahedra stay with their rows, those of points with the points",
          "[topology][map_mesh]") {
  TetMesh mesh = bent_bar(4, {{0, 0}});
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    mesh.region.push_back(static_cast<std::int32_t>(3 * t) - 7);
    mesh.source_tetrahedron_id.push_back(static_cast<std::int64_t>(1000 - t));
  }
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    mesh.source_point_id.push_back(static_cast<std::int64_t>(500 - p));
  }
  mesh.region_name = {{-7, "first"}, {2, "fourth"}};
  VolumeMap map = built(mesh);
  for (const HalfFaceId f : interior_faces(map)) {
    if (f.index() % 3 == 0) split_face(map, f);
  }
  for (const MeshPoints points : {MeshPoints::source, MeshPoints::vertices}) {
    const TetMesh written = mesh_of_map(map, mesh, points);
    CHECK(written.region == mesh.region);
    CHECK(written.region_name == mesh.region_name);
    CHECK(written.source_tetrahedron_id == mesh.source_tetrahedron_id);
    const bool has_numbers = points == MeshPoints::source;
    CHECK(written.source_point_id ==
          (has_numbers ? mesh.source_point_id : decltype(written.source_point_id){}));
    for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
      for (std::size_t i = 0; i < 4; ++i) {
        CHECK(written.points[written.tetrahedra[t][i]] == mesh.points[mesh.tetrahedra[t][i]]);
      }
    }
  }
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

TEST_CASE("unexpressed cuts are the lower of two boundary faces on the same vertices, in order",
          "[topology][map_mesh]") {
  std::mt19937_64 random(4);
  std::size_t first = 0, all = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    INFO("seed " << seed);
    VolumeMap map = built(shuffled(kuhn_box({4, 3, 3}), seed));
    for (const HalfFaceId f : interior_faces(map)) {
      if (f.index() == 0 || below(random, 16) == 0) split_face(map, f);
    }
    std::vector<std::pair<std::set<VertexId>, HalfFaceId>> boundary;
    for (std::size_t i = 0; i < 4 * map.tetrahedra(); ++i) {
      const HalfFaceId f{i};
      if (!map.neighbour(f).is_none()) continue;
      const auto corners = corners_of_face(map.corners(tetrahedron_of(f)), f);
      boundary.emplace_back(std::set(corners.begin(), corners.end()), f);
    }
    std::vector<HalfFaceId> expected;
    for (std::size_t i = 0; i < boundary.size(); ++i) {
      for (std::size_t j = i + 1; j < boundary.size(); ++j) {
        if (boundary[i].first == boundary[j].first) expected.push_back(boundary[i].second);
      }
    }
    CHECK(unexpressed_cuts(map) == expected);
    all += expected.size();
    first += static_cast<std::size_t>(std::ranges::count(expected, HalfFaceId{0}));
  }
  CHECK(all > 50);
  CHECK(first > 0);
}
