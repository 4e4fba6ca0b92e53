// SPDX-License-Identifier: MIT
// Bodies of scenes without a mesh file, and files in other units than metres.
#include "apps/scene/reading/shape_mesh.hpp"

#include <catch2/catch.hpp>

#include "apps/scene/reading/take_source.hpp"
#include "apps/scene/scene_hash.hpp"
#include "mechanics/contact/shapes/solid_surface.hpp"
#include "tests/support/scene_texts.hpp"
#include "topology/mesh/check.hpp"

using namespace sunder;
using namespace sunder::test;
using nlohmann::json;

namespace {

json body_of(const json& shape) { return {{"bodies", {{{"shape", shape}}}}}; }

double volume_of(const TetMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.tetrahedra) {
    std::array<Eigen::Vector3d, 4> x;
    for (std::size_t k = 0; k < 4; ++k) x[k] = Eigen::Vector3d(mesh.points[t[k]].data());
    const double volume = (x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]) / 6;
    CHECK(volume > 0);
    sum += volume;
  }
  return sum;
}

}  // namespace

TEST_CASE("each shape is a valid mesh of good tetrahedra about as many as asked for",
          "[run][scene][shapes]") {
  struct Case {
    json solid;
    double volume;  ///< m^3
    double least;   ///< radius ratio
  };
  const std::vector<Case> cases = {
      {{{"box", {{"size", {0.24, 0.115, 0.07}}}}}, 0.24 * 0.115 * 0.07, 0.5},
      {{{"plate", {{"width", 0.3}, {"length", 0.3}, {"thickness", 0.04}, {"layers", 2}}}},
       0.3 * 0.3 * 0.04,
       0.3},
      {{{"cylinder", {{"radius", 0.05}, {"height", 0.2}}}}, M_PI * 0.05 * 0.05 * 0.2, 0.4},
      {{{"tube", {{"inner_radius", 0.4}, {"outer_radius", 0.5}, {"height", 0.3}}}},
       M_PI * 0.09 * 0.3,
       0.4},
      {{{"sphere", {{"radius", 0.1}}}}, 4 * M_PI / 3 * 1e-3, 0.5}};
  for (const Case& c : cases) {
    for (const int wanted : {600, 5000, 20000}) {
      INFO(c.solid.dump() << " " << wanted);
      json shape = c.solid;
      shape["tetrahedra"] = wanted;
      const Result<SceneFile> file = read(body_of(shape));
      for (const Finding& f : file.findings) UNSCOPED_INFO(f.text);
      REQUIRE(file);
      const TetMesh& mesh = file->scene.bodies[0].mesh;
      const double count = static_cast<double>(mesh.tetrahedra.size());
      CHECK(count > 0.5 * wanted);
      CHECK(count < 2 * wanted);
      // Corners lie on the true surface: the volume is never larger, and nears it.
      CHECK(volume_of(mesh) <= c.volume * (1 + 1e-9));
      CHECK(volume_of(mesh) >= c.volume * 0.9);
      const MeshCheck check = check_file_mesh(file_mesh_of(mesh));
      CHECK(check.findings.empty());
      REQUIRE(check.counts);
      CHECK(check.counts->components == 1);
      CHECK(check.counts->boundary_sheets == 1);
      REQUIRE(check.quality);
      CHECK(check.quality->smallest_radius_ratio.value > c.least);
    }
  }
}

TEST_CASE("the same shape is the same mesh, in the middle of its coordinates",
          "[run][scene][shapes]") {
  const json box = {{"box", {{"size", {1, 2, 3}}}}, {"cell", 0.5}};
  const Result<SceneFile> one = read(body_of(box)), other = read(body_of(box));
  const TetMesh& mesh = one->scene.bodies[0].mesh;
  CHECK(mesh.points == other->scene.bodies[0].mesh.points);
  CHECK(mesh.tetrahedra == other->scene.bodies[0].mesh.tetrahedra);
  CHECK(mesh.tetrahedra.size() == 6 * 2 * 4 * 6);
  CHECK(mesh.points.front() == Point{-0.5, -1, -1.5});
  CHECK(mesh.points.back() == Point{0.5, 1, 1.5});
  CHECK(scene_hash(*one) == scene_hash(*other));
}

TEST_CASE("shapes that cannot be made are refused with place and remedy", "[run][scene][shapes]") {
  const json box = {{"box", {{"size", {1, 1, 1}}}}};
  const auto codes_of = [](const json& shape) { return codes(read(body_of(shape)).findings); };
  using Codes = std::multiset<std::string>;
  CHECK(codes_of({{"box", {{"size", {1, 0, 1}}}}}) == Codes{"out_of_range"});
  CHECK(codes_of({{"box", json::object()}}) == Codes{"missing_key"});
  CHECK(codes_of({{"cell", 0.1}}) == Codes{"missing_key"});
  CHECK(codes_of({{"bax", {{"size", {1, 1, 1}}}}}).contains("unknown_key"));
  CHECK(codes_of({{"box", {{"size", {1, 1, 1}}}}, {"sphere", {{"radius", 1}}}}) ==
        Codes{"missing_key"});
  CHECK(codes_of({{"box", {{"size", {1, 1, 1}}}}, {"cell", 1e-6}}) == Codes{"too_many_cells"});
  CHECK(codes_of({{"tube", {{"inner_radius", 0.5}, {"outer_radius", 0.4}, {"height", 1}}}}) ==
        Codes{"no_wall"});
  json both = body_of(box);
  both["bodies"][0]["mesh"] = SUNDER_MESHES "/cube.msh";
  CHECK(codes(read(both).findings) == Codes{"two_meshes"});
  json scaled = body_of(box);
  scaled["bodies"][0]["units"] = "mm";
  CHECK(codes(read(scaled).findings) == Codes{"scale_without_file"});
  json painted = body_of(box);
  painted["bodies"][0]["strength"] = {{"field", "xi"}};
  CHECK(codes(read(painted).findings) == Codes{"no_such_field"});
  const Result<SceneFile> none = read({{"bodies", {json::object()}}});
  REQUIRE(codes(none.findings) == Codes{"missing_key"});
  CHECK(none.findings[0].remedy.find("shape") != std::string::npos);
}

TEST_CASE("files in millimetres are read in metres", "[run][scene][shapes]") {
  const Result<SceneFile> plain = read(cube_scene());
  const Point last = plain->scene.bodies[0].mesh.points.back();
  const auto scaled = [](const json& keys) {
    json scene = cube_scene();
    scene["bodies"][0].update(keys);
    const Result<SceneFile> file = read(scene);
    REQUIRE(file);
    return file->scene.bodies[0].mesh.points.back();
  };
  CHECK(scaled({{"units", "m"}}) == last);
  CHECK(scaled({{"units", "mm"}})[0] == Approx(1e-3 * last[0]));
  CHECK(scaled({{"units", "in"}})[2] == Approx(0.0254 * last[2]));
  CHECK(scaled({{"scale", 0.5}})[0] == 0.5 * last[0]);
  CHECK(scaled({{"units", "cm"}, {"scale", 10}})[0] == Approx(0.1 * last[0]));
  json wrong = cube_scene();
  wrong["bodies"][0]["units"] = "mn";
  const Result<SceneFile> refused = read(wrong);
  REQUIRE(codes(refused.findings) == std::multiset<std::string>{"unknown_name"});
  CHECK(refused.findings[0].text.find("mm") != std::string::npos);

  json scene = cube_scene();
  scene["bodies"][0]["translation"] = {0, 0, 5};
  scene["obstacles"] = {{{"mesh", {{"file", SUNDER_MESHES "/cube.msh"}, {"units", "cm"}}}}};
  const Result<SceneFile> obstacle = read(scene);
  REQUIRE(obstacle);
  const auto& solid = std::get<Solid>(obstacle->scene.obstacles[0].shape);
  scene["obstacles"][0]["mesh"].erase("units");
  const Result<SceneFile> large = read(scene);
  const auto& whole = std::get<Solid>(large->scene.obstacles[0].shape);
  CHECK(solid.surface->volume == Approx(1e-6 * whole.surface->volume));
}
