// SPDX-License-Identifier: MIT
// Scenes of arrays through the C functions, and the findings of refused ones.
#include "apps/host/memory_scene.hpp"

#include <catch2/catch.hpp>

#include <cstdint>
#include <string>

#include "apps/host/sunder.h"
#include "tests/apps/host/host_engine.hpp"

using namespace sunder::test;

namespace {

sunder_scene scene_of(const std::string& text) {
  sunder_scene scene{};
  scene.size = sizeof scene;
  scene.text = text.data();
  scene.text_size = text.size();
  scene.name = "test.json";
  return scene;
}

}  // namespace

TEST_CASE("findings of a refused scene have codes, rows and remedies", "[host]") {
  const double corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const std::uint32_t rows[] = {0, 1, 2, 3, 0, 1, 2, 9};
  const std::string text = R"({"bodies": [{"mesh": "a"}]})";
  sunder_mesh mesh = mesh_of_arrays(corners, rows);
  mesh.tetrahedron_count = 1;
  const sunder_mesh* meshes[] = {&mesh};
  sunder_scene scene = scene_of(text);
  scene.meshes = meshes;
  scene.mesh_count = 1;
  CHECK(Engine(sunder_create(&scene), sunder_destroy));
  mesh.tetrahedron_count = 2;
  REQUIRE_FALSE(Engine(sunder_create(&scene), sunder_destroy));
  REQUIRE(sunder_finding_count(nullptr) == 1);
  sunder_finding finding{};
  finding.size = sizeof finding;
  REQUIRE(sunder_get_finding(nullptr, 0, &finding) == SUNDER_OK);
  CHECK(finding.severity == 2);
  CHECK(finding.code == std::string("index_out_of_range"));
  REQUIRE(finding.id_count == 1);
  CHECK(finding.ids[0] == 1);
  CHECK_FALSE(std::string(finding.remedy).empty());
  CHECK(sunder_get_finding(nullptr, 1, &finding) == SUNDER_REFUSED);
  // An obstacle reads the same rows, and its reader checks no other way.
  const std::string obstacle = R"({"bodies": [{"mesh": "b"}], "obstacles": [{"mesh": "a"}]})";
  scene.text = obstacle.data();
  scene.text_size = obstacle.size();
  CHECK_FALSE(Engine(sunder_create(&scene), sunder_destroy));
  CHECK(std::string(sunder_error(nullptr)).find("cannot_open") != std::string::npos);
}

TEST_CASE("two contents of one name are refused", "[host]") {
  const sunder_file files[] = {{"a", "x", 1}, {"a", "y", 1}};
  const std::string text = R"({"bodies": [{"mesh": "a"}]})";
  sunder_scene scene = scene_of(text);
  scene.files = files;
  scene.file_count = 2;
  CHECK_FALSE(Engine(sunder_create(&scene), sunder_destroy));
  CHECK(std::string(sunder_error(nullptr)).find("repeated_name") != std::string::npos);
}

TEST_CASE("findings beyond their room are left out, and the text says so", "[host]") {
  std::string keys;
  for (int i = 0; i < 400; ++i) keys += "\"unknown_key_" + std::to_string(i) + "\": 1, ";
  const std::string text = "{" + keys + "\"bodies\": []}";
  sunder_scene scene = scene_of(text);
  CHECK_FALSE(Engine(sunder_create(&scene), sunder_destroy));
  CHECK(std::string(sunder_error(nullptr)).find("there is more") != std::string::npos);
  const std::uint32_t count = sunder_finding_count(nullptr);
  CHECK(count > 10);
  CHECK(count <= 64);
  sunder_finding finding{};
  finding.size = sizeof finding;
  REQUIRE(sunder_get_finding(nullptr, count - 1, &finding) == SUNDER_OK);
  CHECK_FALSE(std::string(finding.text).empty());
}
