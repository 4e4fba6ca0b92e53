// SPDX-License-Identifier: MIT
// Scenes as triangles and lines.
#include "apps/render/scene_geometry.hpp"

#include <catch2/catch.hpp>

using namespace sunder::render;

namespace {

/// A square of skin in two triangles, cut along its diagonal: the crack's two sides go down from
/// there, and lie in one place. Rows 0, 1, 2, 3 are the first triangle with its side of the crack,
/// 4 to 7 the second.
Surface cut_square() {
  Surface s;
  s.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, -1},
                 {0, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, -1}};
  s.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {5, 4, 7}};
  s.face_class = {FaceClass::skin, FaceClass::crack, FaceClass::skin, FaceClass::crack};
  return s;
}

}  // namespace

TEST_CASE("a closed crack is a line where it comes to the skin", "[render]") {
  FrameScene scene;
  scene.surfaces = {cut_square()};
  const SceneGeometry geometry = scene_geometry(scene);
  CHECK(geometry.triangles.size() == 12);
  REQUIRE(geometry.edges.size() == 2);  // one of each side
  for (const EdgeInstance& edge : geometry.edges) {
    CHECK(edge.from == std::array<float, 3>{0, 0, 0});
    CHECK(edge.to == std::array<float, 3>{1, 1, 0});
    CHECK(edge.color[0] < 100);
  }
}

TEST_CASE("a body without cracks has no lines, and one with all edges has each once", "[render]") {
  FrameScene scene;
  scene.surfaces = {cut_square()};
  scene.surfaces[0].face_class.assign(4, FaceClass::skin);
  CHECK(scene_geometry(scene).edges.empty());
  scene.surfaces[0].face_class.clear();
  CHECK(scene_geometry(scene).edges.empty());
  scene.surfaces = {cut_square()};
  scene.surfaces[0].style = SurfaceStyle::filled_with_edges;
  CHECK(scene_geometry(scene).edges.size() == 10);
  scene.surfaces[0].style = SurfaceStyle::wireframe;
  CHECK(scene_geometry(scene).edges.empty());
  CHECK(scene_geometry(scene).wires.size() == 10);
}
