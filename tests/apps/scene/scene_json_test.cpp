// SPDX-License-Identifier: MIT
// The reader and the schema against each other and against the rooms' own checks; all findings.
#include <unistd.h>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <set>
#include <string>

#include "apps/scene/scene_json.hpp"
#include "apps/scene/scene_schema.hpp"
#include "fracture/scene/scene_doubts.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/contact/shapes/solid_surface.hpp"
#include "tests/support/scene_texts.hpp"
#include "topology/io/vtu/vtu.hpp"

using namespace sunder;
using namespace sunder::test;
using nlohmann::json;

namespace {

/// Every object schema and its object, by pointer into a scene.
void visit_objects(const json& schema, const std::string& at,
                   const std::function<void(const json&, const std::string&)>& visit) {
  if (schema.contains("properties")) {
    visit(schema, at);
    for (const auto& [key, value] : schema["properties"].items()) {
      visit_objects(value, at + "/" + key, visit);
    }
  }
  if (schema.contains("items")) visit_objects(schema["items"], at + "/0", visit);
}

/// Adds the keys, as pointers into a scene, that `scene` leaves to their defaults.
void add_left_out(const json& schema, const json& scene, const std::string& at,
                  std::set<std::string>& left_out) {
  for (std::size_t i = 0; scene.is_array() && i < scene.size(); ++i) {
    if (schema.contains("items")) {
      add_left_out(schema["items"], scene[i], at + "/" + std::to_string(i), left_out);
    }
  }
  if (!scene.is_object() || !schema.contains("properties")) return;
  for (const auto& [key, value] : schema["properties"].items()) {
    if (scene.contains(key)) {
      add_left_out(value, scene[key], at + "/" + key, left_out);
    } else if (value.contains("default")) {
      left_out.insert(at + "/" + key);
    }
  }
}

std::set<std::string> left_out(const std::string& scene) {
  std::ifstream in(std::string(SUNDER_SCENES) + "/" + scene);
  std::set<std::string> keys;
  add_left_out(json::parse(scene_schema().dump()), json::parse(in), "", keys);
  return keys;
}

}  // namespace

TEST_CASE("the scenes of the paper's tables leave no key to a default", "[run][schema]") {
  for (const char* scene : {"monolith", "block", "bunny"}) {
    INFO(scene);
    CHECK(left_out(std::string("paper/") + scene + ".json") == std::set<std::string>{});
    CHECK(read_scene(std::string(SUNDER_SCENES) + "/paper/" + scene + ".json"));
  }
  // The scenes to play with rely on many, in objects that are there and in those that are not.
  const std::set<std::string> bar = left_out("bar.json");
  CHECK(bar.contains("/contact"));
  CHECK(bar.contains("/fracture/mode"));
  CHECK(bar.contains("/bodies/0/held/0/velocity"));
  CHECK_FALSE(bar.contains("/bodies/0/material/toughness"));
  CHECK_FALSE(bar.contains("/bodies/0/cuts/0/ball"));
}

TEST_CASE("the reader takes the schema's own defaults for every key", "[run][schema]") {
  const json schema = json::parse(scene_schema().dump());
  json scene = cube_scene();
  std::size_t keys = 0;
  visit_objects(schema, "", [&](const json& object, const std::string& at) {
    // Obstacles have one shape each, and a camera two required keys: tried below.
    if (at.find("/obstacles") == 0 || at.find("camera") != std::string::npos) return;
    for (const char* required : {"loads", "held", "rotation", "shape"}) {
      if (at.find(required) != std::string::npos) return;
    }
    for (const auto& [key, value] : object["properties"].items()) {
      if (!value.contains("default")) continue;
      scene[json::json_pointer(at + "/" + key)] = value["default"];
      ++keys;
    }
  });
  const Result<SceneFile> file = read(scene);
  for (const Finding& f : file.findings) UNSCOPED_INFO(f.text);
  REQUIRE(file);
  CHECK(keys > 40);
  const Scene plain;
  CHECK(file->scene.integrator.time_step == plain.integrator.time_step);
  CHECK(file->scene.gravity.acceleration == plain.gravity.acceleration);
  CHECK(file->scene.contact.tolerance == plain.contact.tolerance);
  CHECK(file->output.frames == OutputSettings{}.frames);
}

TEST_CASE("the schema knows a key exactly when the reader does", "[run][schema]") {
  const json schema = json::parse(scene_schema().dump());
  // A key that the reader does not know makes it list those it does.
  visit_objects(schema, "", [&](const json& object, const std::string& at) {
    if (object["properties"].contains("axis")) return;  // read by hand: axis and angle
    json scene = cube_scene();
    if (at == "/obstacles/0") scene["obstacles"] = {{{"sphere", json::object()}}};
    if (at.find("/obstacles/0/") == 0) {
      scene["obstacles"] = {{{at.substr(13), json::object()}}};
    }
    scene[json::json_pointer(at + "/zzzzzzzzzz")] = 1;
    const Result<SceneFile> file = read(scene);
    INFO(at);
    REQUIRE_FALSE(file);
    std::string remedy;
    for (const Finding& f : file.findings) {
      if (f.code == "unknown_key") remedy = f.remedy;
    }
    std::string listed;
    std::set<std::string> reader, named;
    for (const char c : remedy.substr(remedy.find(": ") + 2) + ",") {
      if (c == ',') {
        reader.insert(listed);
        listed.clear();
      } else if (c != ' ') {
        listed += c;
      }
    }
    for (const auto& [key, value] : object["properties"].items()) named.insert(key);
    CHECK(reader == named);
  });
}

TEST_CASE("accuracy chooses what a scene leaves out, and what it gives stays", "[run][scene]") {
  json scene = cube_scene();
  scene["contact"] = {{"tolerance", 0.25}};
  scene["accuracy"] = "reference";
  const Result<SceneFile> file = read(scene, {"contact.max_passes=7"});
  REQUIRE(file);
  CHECK(file->accuracy == Accuracy::reference);
  CHECK(file->scene.contact.tolerance == 0.25);
  CHECK(file->scene.contact.max_passes == 7);
  CHECK(file->scene.impact.negligible == 0.01);
  CHECK(file->choices.size() == chosen_keys().size() - 2);
  const Result<SceneFile> plain = read(cube_scene());
  REQUIRE(plain);
  CHECK(plain->accuracy == Accuracy::good);
  CHECK(plain->scene.impact.negligible == ImpactSettings{}.negligible);
}

TEST_CASE("of the scenes that are shipped those with coarse meshes are doubted, and no others",
          "[run][scene]") {
  std::map<std::string, std::string> doubted;
  std::size_t scenes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(SUNDER_SCENES)) {
    const std::string name = std::filesystem::relative(entry.path(), SUNDER_SCENES).string();
    if (entry.path().extension() != ".json" || name == "scene.schema.json") continue;
    INFO(name);
    const Result<SceneFile> file = read_scene(entry.path());
    REQUIRE(file);
    ++scenes;
    for (const SettingFinding& f : scene_doubts(file->scene)) doubted[name] += f.finding.code;
  }
  CHECK(scenes > 10);
  // Two layers of cells, and one in the pane: none of these measures bending.
  CHECK(doubted == std::map<std::string, std::string>{{"charts/monolith.json", "few_layers"},
                                                      {"ensembles/pane.json", "few_layers"},
                                                      {"paper/block.json", "few_layers"},
                                                      {"paper/monolith.json", "few_layers"}});
}

TEST_CASE("cuts and strengths are read, and what is wrong with them has its line", "[run][scene]") {
  json scene = cube_scene();
  json& body = scene["bodies"][0];
  body["cuts"] = {{{"plane", {{"point", {0, 0, 0.5}}, {"normal", {0, 0, 2}}}},
                   {"box", {{"minimum", {0, 0, 0}}, {"maximum", {1, 1, 1}}}}},
                  {{"plane", {{"point", {0, 0, 0}}, {"normal", {1, 0, 0}}}},
                   {"ball", {{"center", {0, 0, 0}}, {"radius", 2}}}}};
  body["strength"] = {{"regions", {{{"region", 1}, {"tensile_strength", 1e6}}}},
                      {"weibull", {{"modulus", 8}, {"seed", 5}}}};
  body["unbreakable"] = {{{"region", "cube"}}};
  const Result<SceneFile> file = read(scene);
  REQUIRE(file);
  const BodySettings& settings = file->scene.bodies[0];
  REQUIRE(settings.cuts.size() == 2);
  CHECK(std::get<CutPlane>(settings.cuts[0].faces).normal == Eigen::Vector3d(0, 0, 1));
  CHECK(settings.cuts[0].box.has_value());
  CHECK(settings.cuts[1].ball->radius == 2);
  CHECK(settings.strength.regions.at(0).region.text == "1");
  CHECK(settings.strength.weibull->modulus == 8);
  CHECK(settings.strength.weibull->seed == 5);
  CHECK(std::get<RegionName>(settings.unbreakable.at(0).where).text == "cube");
  body["cuts"] = {{{"faces", "there_is_none.txt"}}, json::object()};
  body["strength"]["weibull"]["modulus"] = 0;
  body["unbreakable"] = {{{"region", 0.5}}};
  CHECK(codes(read(scene).findings) ==
        std::multiset<std::string>{"cannot_open", "missing_key", "out_of_range", "wrong_type"});
}

TEST_CASE("obstacles are read from surfaces and meshes, and what is wrong with them has its line",
          "[run][scene][solid]") {
  const std::filesystem::path folder = std::filesystem::temp_directory_path();
  const auto name = "sunder_tetra_" + std::to_string(getpid()) + ".obj";
  const auto write = [&](const std::string& last) {
    std::ofstream(folder / name) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                                 << "f 1 3 2\nf 1 2 4\nf 2 3 4\n"
                                 << last;
  };
  json scene = cube_scene();
  scene["obstacles"] = {{{"mesh", {{"file", name}, {"translation", {0, 0, -3}}}}, {"mass", 2}},
                        {{"mesh", {{"file", SUNDER_MESHES "/cube.msh"}}}}};
  write("f 1 4 3\n");
  const Result<SceneFile> file = read(scene);
  REQUIRE(file);
  const auto& tetrahedron = std::get<Solid>(file->scene.obstacles[0].shape);
  CHECK(tetrahedron.surface->volume == Approx(1.0 / 6));
  CHECK(tetrahedron.translation.z() == -3);
  CHECK(tetrahedron.surface->file == name);
  // Of tetrahedra the boundary.
  CHECK(std::get<Solid>(file->scene.obstacles[1].shape).surface->triangles.size() == 48);
  write("");
  const Result<SceneFile> open = read(scene);
  REQUIRE(open.findings.size() == 1);
  CHECK(open.findings[0].code == "open_surface");
  CHECK(open.findings[0].text.find("obstacles.0.mesh.file (" + name + ")") == 0);
  CHECK(open.findings[0].line > 0);
  scene["obstacles"][0]["mesh"]["file"] = "there_is_none.stl";
  CHECK(codes(read(scene).findings) == std::multiset<std::string>{"cannot_open"});
  scene["obstacles"][0]["mesh"].erase("file");
  CHECK(codes(read(scene).findings) == std::multiset<std::string>{"missing_key"});
  std::filesystem::remove(folder / name);
}

TEST_CASE("all that is wrong is told at once, each at its line", "[run][scene]") {
  json scene = cube_scene();
  scene["bodies"][0]["material"] = {{"density", -1}, {"poisson_ratio", 0.5}, {"strenght", 1}};
  scene["time_step"] = "fast";
  scene["fracture"] = {{"mode", "al"}};
  scene["obstacles"] = {{{"plane", {{"normal", {0, 0, 0}}}}}, {{"friction", 1}}};
  scene["gravity"] = {{"acceleration", {0, 1}}};
  const Result<SceneFile> file = read(scene);
  REQUIRE_FALSE(file);
  CHECK(codes(file.findings) ==
        std::multiset<std::string>{"out_of_range", "out_of_range", "unknown_key", "wrong_type",
                                   "unknown_name", "zero_direction", "missing_key", "wrong_type"});
  for (const Finding& f : file.findings) {
    INFO(f.text);
    CHECK(f.line > 0);
    CHECK_FALSE(f.remedy.empty());
  }
}

TEST_CASE("the reader refuses what the rooms' own checks refuse", "[run][scene]") {
  for (const char* setting : {"bodies.0.material.young_modulus=0",
                              "bodies.0.material.poisson_ratio=-1",
                              "bodies.0.material.poisson_ratio=0.495",
                              "bodies.0.material.density=0",
                              "bodies.0.material.tensile_strength=-1",
                              "bodies.0.material.toughness=0",
                              "integrator.rho_infinity=0.6",
                              "integrator.damping.mass_factor=-1",
                              "contact.friction=-0.1",
                              "contact.tolerance=0",
                              "contact.ball_share=1.5",
                              "contact.max_iterations=0",
                              "contact.max_passes=1.5",
                              "time_step=0",
                              "duration=-1",
                              "time_step=1e-12",
                              "fracture.max_fans=0",
                              "bodies=[]",
                              "output.pictures.width=1e9",
                              "obstacles=[{\"plane\": {}, \"mass\": 1}]",
                              "obstacles=[{\"mesh\": {}}]",
                              "obstacles=[{\"sphere\": {}, \"spin\": [1, 0, 0]}]",
                              "bodies.0.held=[{\"minimum\": [9, 9, 9], \"maximum\": [8, 8, 8]}]",
                              "bodies.0.held=[{\"minimum\": [8, 8, 8], \"maximum\": [9, 9, 9]}]"}) {
    INFO(setting);
    CHECK_FALSE(read(cube_scene(), {setting}));
  }
}

TEST_CASE("rotations are an axis and degrees, directions need no unit length", "[run][scene]") {
  json scene = cube_scene();
  scene["bodies"][0]["rotation"] = {{"axis", {0, 0, 3}}, {"angle", 90}};
  scene["obstacles"] = {{{"plane", {{"normal", {0, 4, 3}}, {"offset", 2}}}}};
  const Result<SceneFile> file = read(scene);
  REQUIRE(file);
  const Eigen::Vector3d turned = file->scene.bodies[0].rotation * Eigen::Vector3d::UnitX();
  CHECK((turned - Eigen::Vector3d::UnitY()).norm() < 1e-15);
  const auto& plane = std::get<Plane>(file->scene.obstacles[0].shape);
  CHECK((plane.normal - Eigen::Vector3d(0, 0.8, 0.6)).norm() < 1e-15);
}

TEST_CASE("cracks are drawn smooth only where they have planes", "[run][scene]") {
  const json scene = cube_scene();
  CHECK(read(scene)->output.crack_surface == CrackSurface::mesh);
  const Result<SceneFile> refused =
      read(scene, {"output.crack_surface=smooth", "fracture.crack=paper"});
  REQUIRE_FALSE(refused);
  REQUIRE(refused.findings.size() == 1);
  CHECK(refused.findings[0].code == "no_crack_planes");
  CHECK(refused.findings[0].remedy.find("fracture.crack") != std::string::npos);
  const Result<SceneFile> taken =
      read(scene, {"output.crack_surface=smooth", "fracture.crack=object"});
  REQUIRE(taken);
  CHECK(taken->output.crack_surface == CrackSurface::smooth);
}

TEST_CASE("a painted field of the mesh's file is the strength of its points", "[run][scene]") {
  // Two tetrahedra; the numbers of the MSH file's nodes are not its rows.
  const std::vector<Point> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}};
  const TetMesh mesh{.points = points, .tetrahedra = {{0, 1, 2, 3}, {1, 0, 2, 4}}};
  const std::vector<double> xi = {1e6, 2e6, 3e6, 4e6, 5e6};
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("sunder_paint_" + std::to_string(getpid()));
  std::filesystem::create_directory(folder);
  const std::string vtu = (folder / "painted.vtu").string();
  const std::string msh = (folder / "painted.msh").string();
  const std::vector<NamedColumn> columns = {{"xi", std::span(xi), 1},
                                            vector_column("wind", points)};
  REQUIRE(write_vtu(vtu, mesh, columns).empty());
  std::ofstream(msh)
      << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n5\n10 0 0 0\n7 1 0 0\n8 0 1 "
         "0\n9 0 0 1\n12 0 0 -1\n$EndNodes\n$Elements\n2\n1 4 2 0 1 10 7 8 9\n2 4 2 "
         "0 1 7 10 8 12\n$EndElements\n$NodeData\n1\n\"other\"\n1\n0\n3\n0\n1\n1\n7 "
         "1\n$EndNodeData\n$NodeData\n1\n\"xi\"\n1\n0.0\n3\n0\n1\n5\n7 2e6\n8 3e6\n9 "
         "4e6\n10 1e6\n12 5e6\n$EndNodeData\n";
  json scene = cube_scene();
  json& body = scene["bodies"][0];
  for (const std::string& file : {vtu, msh}) {
    INFO(file);
    body["mesh"] = file;
    body["strength"] = {{"field", "xi"}};
    const auto painted = read(scene);
    REQUIRE(painted);
    CHECK(painted->scene.bodies[0].strength.painted == xi);
    CHECK(build_simulation(painted->scene));
    body["strength"]["field"] = "nothing";
    CHECK(codes(read(scene).findings) == std::multiset<std::string>{"no_such_field"});
    CHECK(read(scene).findings.front().line > 1);
  }
  // Of "other" four nodes have no number.
  body["strength"]["field"] = "other";
  CHECK(codes(read(scene).findings) == std::multiset<std::string>{"painted_strength"});
  CHECK(read(scene).findings.front().line > 1);
  body["mesh"] = vtu;
  body["strength"]["field"] = "wind";
  CHECK(codes(read(scene).findings) == std::multiset<std::string>{"not_a_scalar"});
  std::filesystem::remove_all(folder);
}
