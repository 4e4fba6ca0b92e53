// SPDX-License-Identifier: MIT
// Names of materials in scene files.
#include "apps/scene/reading/material_names.hpp"

#include <catch2/catch.hpp>

#include "apps/scene/scene_hash.hpp"
#include "mechanics/state/settings/named_materials.hpp"
#include "tests/support/scene_texts.hpp"

using namespace sunder;
using namespace sunder::test;
using nlohmann::json;

namespace {

json cube_of(const json& material) {
  json scene = cube_scene();
  scene["bodies"][0]["material"] = material;
  return scene;
}

Material material_of(const json& material, const std::vector<std::string>& settings = {}) {
  const Result<SceneFile> file = read(cube_of(material), settings);
  for (const Finding& f : file.findings) UNSCOPED_INFO(f.text);
  REQUIRE(file);
  return file->scene.bodies[0].material;
}

}  // namespace

TEST_CASE("a body takes the numbers of a named material, and a scene may change them",
          "[run][scene][materials]") {
  const Material glass = find_material("glass")->material;
  for (const json& given : {json("glass"), json("Glass"), json{{"name", "glass"}}}) {
    const Material m = material_of(given);
    CHECK(m.young_modulus == glass.young_modulus);
    CHECK(m.density == glass.density);
    CHECK(m.tensile_strength == glass.tensile_strength);
    CHECK(m.toughness == glass.toughness);
  }
  // The order of keys is of no importance.
  const Material weak = material_of({{"density", 2700}, {"name", "glass"}});
  CHECK(weak.density == 2700);
  CHECK(weak.young_modulus == glass.young_modulus);
  // Settings change a material that is a text, or its name.
  const Material set = material_of("glass", {"bodies.0.material.tensile_strength=2e7"});
  CHECK(set.tensile_strength == 2e7);
  CHECK(set.density == glass.density);
  CHECK(material_of("glass", {"bodies.0.material=ice"}).density == 917);
  CHECK(material_of("glass", {"bodies.0.material.name=ice"}).density == 917);
  // A fracture energy replaces the toughness that stands for another one.
  const Material tough = material_of({{"name", "concrete"}, {"fracture_energy", 100}});
  CHECK_FALSE(tough.toughness);
  CHECK(tough.fracture_energy == 100.0);
}

TEST_CASE("a name that no material has is refused at its line with the nearest",
          "[run][scene][materials]") {
  for (const json& given : {json("glas"), json{{"name", "glas"}}}) {
    const Result<SceneFile> file = read(cube_of(given));
    REQUIRE_FALSE(file);
    REQUIRE(codes(file.findings) == std::multiset<std::string>{"unknown_name"});
    const Finding& f = file.findings[0];
    CHECK(f.text.find("bodies.0.material.name") != std::string::npos);
    CHECK(f.remedy == "did you mean glass?");
    CHECK(f.line > 1);
  }
  const Result<SceneFile> far = read(cube_of("unobtainium"));
  REQUIRE_FALSE(far);
  CHECK(far.findings[0].remedy.find("sunder materials") != std::string::npos);
  CHECK(codes(read(cube_of("")).findings) == std::multiset<std::string>{"unknown_name"});
  CHECK(codes(read(cube_of(3)).findings) == std::multiset<std::string>{"wrong_type"});
  CHECK(codes(read(cube_of({{"name", 3}})).findings) == std::multiset<std::string>{"wrong_type"});
}

TEST_CASE("a named material and its numbers are one scene", "[run][scene][materials]") {
  const Material m = find_material("ice")->material;
  const json numbers = {{"young_modulus", m.young_modulus},
                        {"poisson_ratio", m.poisson_ratio},
                        {"density", m.density},
                        {"toughness", *m.toughness},
                        {"tensile_strength", m.tensile_strength}};
  CHECK(scene_hash(*read(cube_of("ice"))) == scene_hash(*read(cube_of(numbers))));
}
