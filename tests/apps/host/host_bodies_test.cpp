// SPDX-License-Identifier: MIT
// Bodies that come and go through the C functions.
#include <catch2/catch.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "apps/host/sunder.h"
#include "tests/apps/host/host_engine.hpp"

using namespace sunder::test;

namespace {

const double points[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
const std::uint32_t rows[] = {0, 1, 2, 3, 1, 2, 3, 4};

/// A text of a scene or body that names the mesh "a".
struct Text {
  explicit Text(std::string words) : text(std::move(words)) {
    scene.size = sizeof scene;
    scene.text = text.data();
    scene.text_size = text.size();
    scene.name = "test";
    scene.meshes = meshes;
    scene.mesh_count = 1;
  }
  Text(const Text&) = delete;
  Text& operator=(const Text&) = delete;

  std::string text;
  sunder_mesh mesh = mesh_of_arrays(points, rows);
  const sunder_mesh* meshes[1] = {&mesh};
  sunder_scene scene{};
};

Engine one_body() {
  const Text text(R"({"bodies": [{"mesh": "a"}], "time_step": 1e-3, "duration": 1})");
  return {sunder_create(&text.scene), sunder_destroy};
}

std::uint64_t hash(const Engine& engine) {
  std::uint64_t value = 0;
  REQUIRE(sunder_hash(engine.get(), &value) == SUNDER_OK);
  return value;
}

std::string first_code(const Engine& engine) {
  REQUIRE(sunder_finding_count(engine.get()) > 0);
  sunder_finding finding{};
  finding.size = sizeof finding;
  sunder_get_finding(engine.get(), 0, &finding);
  return finding.code;
}

std::vector<std::uint32_t> whole_numbers(const Engine& engine, sunder_column kind) {
  sunder_span span{};
  REQUIRE(sunder_read(engine.get(), kind, &span) == SUNDER_OK);
  std::vector<std::uint32_t> values(span.size / sizeof(std::uint32_t));
  std::memcpy(values.data(), span.bytes, span.size);
  return values;
}

const char* const second = R"({"mesh": "a", "translation": [0, 0, 3], "velocity": [0, 0, -2]})";

}  // namespace

TEST_CASE("the struct of a change has the layout that hosts know", "[host][bodies]") {
  CHECK(sizeof(sunder_body_change) == 88);
  CHECK(offsetof(sunder_body_change, mass) == 16);
  CHECK(offsetof(sunder_body_change, angular_momentum) == 64);
}

TEST_CASE("a body comes and goes between steps", "[host][bodies]") {
  const auto sequence = [] {
    Engine engine = one_body();
    REQUIRE(engine);
    REQUIRE(sunder_step(engine.get(), nullptr) == SUNDER_OK);
    sunder_report report{};
    report.size = sizeof report;
    sunder_last_report(engine.get(), &report);
    const std::uint32_t shape = report.shape;
    const Text body(second);
    sunder_body_change come{}, gone{};
    come.size = gone.size = sizeof come;
    REQUIRE(sunder_add_body(engine.get(), &body.scene, &come) == SUNDER_OK);
    CHECK(come.body == 1);
    CHECK(come.pieces == 1);
    CHECK(come.first_piece == 1);
    CHECK(come.kinetic == Approx(2 * come.mass));
    CHECK(come.momentum[2] == Approx(-2 * come.mass));
    sunder_last_report(engine.get(), &report);
    CHECK(report.pieces == 2);
    CHECK(report.shape > shape);
    CHECK(whole_numbers(engine, SUNDER_BODY) == std::vector<std::uint32_t>{0, 1});
    CHECK(whole_numbers(engine, SUNDER_PIECE).size() == 10);
    for (int i = 0; i < 5; ++i) REQUIRE(sunder_step(engine.get(), nullptr) == SUNDER_OK);
    REQUIRE(sunder_remove_body(engine.get(), 0, &gone) == SUNDER_OK);
    CHECK(gone.mass == Approx(come.mass));
    CHECK(whole_numbers(engine, SUNDER_PIECE) == std::vector<std::uint32_t>(5, 1));
    CHECK(whole_numbers(engine, SUNDER_TETRAHEDRA) == std::vector<std::uint32_t>{0, 2});
    sunder_last_report(engine.get(), &report);
    CHECK(report.pieces == 1);
    REQUIRE(sunder_step(engine.get(), &report) == SUNDER_OK);
    CHECK(report.pieces == 1);
    sunder_span saved{};
    sunder_save(engine.get(), &saved);
    const Engine again(sunder_restore(saved.bytes, saved.size), sunder_destroy);
    REQUIRE(again);
    CHECK(hash(again) == hash(engine));
    return hash(engine);
  };
  CHECK(sequence() == sequence());
}

TEST_CASE("a body with faults is refused, and nothing has changed", "[host][bodies]") {
  const Engine engine = one_body();
  REQUIRE(engine);
  REQUIRE(sunder_step(engine.get(), nullptr) == SUNDER_OK);
  const std::uint64_t before = hash(engine);
  const auto refused = [&](const std::string& words) {
    const Text body(words);
    CHECK(sunder_add_body(engine.get(), &body.scene, nullptr) == SUNDER_REFUSED);
    return first_code(engine);
  };
  CHECK(refused(R"({"mesh": "b"})") == "cannot_open");
  CHECK(refused(R"({"mesh": "a", "colour": 3})") == "unknown_key");
  CHECK(refused(R"({"mesh": "a"}, {"mesh": "a"})") == "not_one_body");
  CHECK(refused(R"({"mesh": "a"}], "duration": 3, "obstacles": [)") == "not_one_body");
  CHECK(refused(R"({"mesh": "a")") == "syntax_error");
  CHECK_FALSE(refused(R"({"mesh": "a", "material": {"density": -1}})").empty());
  Text flat(second);
  flat.mesh.tetrahedron_count = 1;
  const std::uint32_t none[] = {0, 1, 2, 9};
  flat.mesh.tetrahedra = none;
  CHECK(sunder_add_body(engine.get(), &flat.scene, nullptr) == SUNDER_REFUSED);
  CHECK(first_code(engine) == "index_out_of_range");
  flat.scene.size = 8;
  CHECK(sunder_add_body(engine.get(), &flat.scene, nullptr) == SUNDER_REFUSED);
  CHECK(first_code(engine) == "bad_size");
  CHECK(sunder_remove_body(engine.get(), 0, nullptr) == SUNDER_REFUSED);
  CHECK(first_code(engine) == "last_body");
  CHECK(sunder_remove_body(engine.get(), 7, nullptr) == SUNDER_REFUSED);
  CHECK(first_code(engine) == "no_such_body");
  CHECK(hash(engine) == before);
  CHECK(sunder_step(engine.get(), nullptr) == SUNDER_OK);
}

TEST_CASE("hosts with an older struct of a scene or a change are served", "[host][bodies]") {
  const Engine engine = one_body();
  REQUIRE(engine);
  Text body(R"({"shape": {"box": {"size": [1, 1, 1]}, "cell": 0.5}, "translation": [0, 0, 9]})");
  body.scene.size = offsetof(sunder_scene, reserved);  // its first version, without meshes
  struct {
    sunder_body_change change;
    std::uint64_t behind;
  } old{};
  old.change.size = offsetof(sunder_body_change, kinetic);
  old.change.kinetic = -7;
  REQUIRE(sunder_add_body(engine.get(), &body.scene, &old.change) == SUNDER_OK);
  CHECK(old.change.body == 1);
  CHECK(old.change.mass > 0);
  CHECK(old.change.kinetic == -7);
  CHECK(old.change.size == offsetof(sunder_body_change, kinetic));
}
