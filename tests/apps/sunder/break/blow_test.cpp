// SPDX-License-Identifier: MIT
// Scenes of one object that is broken.
#include "apps/sunder/break/blow.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "apps/scene/scene_json.hpp"
#include "fracture/scene/scene_doubts.hpp"
#include "tests/support/program.hpp"
#include "topology/io/mesh_file.hpp"
#include "topology/mesh/check.hpp"
#include "topology/mesh/solids/solids.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

constexpr std::array<BlowKind, 5> kinds = {BlowKind::drop, BlowKind::hurl, BlowKind::strike,
                                           BlowKind::press, BlowKind::bend};

TetMesh brick() {
  TetMesh mesh = box_solid({240, 115, 70}, {8, 4, 3});
  set_down(mesh, 1e-3, UpAxis::z);
  return mesh;
}

std::vector<std::string> codes_of(const TetMesh& mesh) {
  std::vector<std::string> codes;
  for (const Finding& f : check_mesh(mesh)) codes.push_back(f.code);
  return codes;
}

Blow blow_of(BlowKind kind) {
  return {.kind = kind, .height = 1.5, .speed = 3, .ball = {0.05, 20}, .tilt = 25};
}

}  // namespace

TEST_CASE("an object is set down on the ground whatever its axes", "[break]") {
  for (const UpAxis up :
       {UpAxis::x, UpAxis::minus_x, UpAxis::y, UpAxis::minus_y, UpAxis::z, UpAxis::minus_z}) {
    TetMesh mesh = box_solid({10, 20, 30}, {1, 1, 1});
    mesh.points.push_back({500, 500, 500});  // of no tetrahedron
    for (Point& p : mesh.points) p[0] += 7;
    set_down(mesh, 0.1, up);
    double low = 1e9, high = -1e9, middle = 0;
    for (std::size_t p = 0; p < 8; ++p) {
      low = std::min(low, mesh.points[p][2]);
      high = std::max(high, mesh.points[p][2]);
      middle += mesh.points[p][0] + mesh.points[p][1];
    }
    const int axis = static_cast<int>(up) / 2;
    CHECK(low == Approx(0).margin(1e-12));
    CHECK(high == Approx(1 + axis));
    CHECK(middle == Approx(0).margin(1e-12));
    // It is turned and not mirrored.
    CHECK(codes_of(mesh) == std::vector<std::string>{"unused_point"});
  }
}

TEST_CASE("each blow makes a scene that the reader takes", "[break]") {
  const Workplace here;
  const TetMesh mesh = brick();
  here.write("brick.msh", mesh);
  for (const BlowKind kind : kinds) {
    const Blow blow = blow_of(kind);
    const BrokenThing thing{"brick", "brick.msh", mesh, *find_material("brick")};
    const nlohmann::ordered_json json = break_scene(thing, blow, {}, true);
    INFO(json.dump(1));
    const Result<SceneFile> file = read_scene(here.write("brick.json", json.dump()));
    for (const Finding& f : file.findings) UNSCOPED_INFO(f.text);
    REQUIRE(file);
    CHECK(file->scene.duration / file->scene.integrator.time_step < 2000);
    CHECK(file->output.pictures.count == 6);
    CHECK(file->scene.bodies[0].material.density == 1900);
    // Nothing lies in anything else, and no unit is odd.
    for (const SettingFinding& doubt : scene_doubts(file->scene)) {
      UNSCOPED_INFO(doubt.finding.text);
      CHECK(doubt.finding.code != "overlap_at_start");
      CHECK(doubt.finding.code != "odd_unit");
      CHECK(doubt.finding.code != "run_too_short");
    }
    CHECK(json["description"].get<std::string>().find(blow_words(blow)) != std::string::npos);
  }
}

TEST_CASE("a drop begins above the ground with the speed of its fall", "[break]") {
  const TetMesh mesh = brick();
  const BrokenThing thing{"brick", "brick.msh", mesh, *find_material("brick")};
  const auto json = break_scene(thing, blow_of(BlowKind::drop), {1e-4, 0.02}, false);
  const auto& body = json["bodies"][0];
  CHECK(body["velocity"][2] == Approx(-std::sqrt(2 * 9.81 * 1.5)));
  CHECK(body["rotation"]["angle"] == 25);
  double lowest = 1e9;
  const double angle = 25 * M_PI / 180;
  for (const Point& p : mesh.points) {
    lowest = std::min(lowest, std::sin(angle) * p[1] + std::cos(angle) * p[2]);
  }
  const double gap = lowest + body["translation"][2].get<double>();
  CHECK(gap > 1e-4);
  CHECK(gap < 1e-3);
  CHECK(json["time_step"] == 1e-4);
  CHECK(json["duration"] == 0.02);
  CHECK_FALSE(json["output"].contains("pictures"));
}

TEST_CASE("a ball of steel comes along the thinnest side", "[break]") {
  const TetMesh mesh = brick();
  const BrokenThing thing{"brick", "brick.msh", mesh, *find_material("brick")};
  const auto ball = break_scene(thing, blow_of(BlowKind::strike), {}, false)["obstacles"][1];
  CHECK(ball["velocity"][2] == -20);
  CHECK(ball["sphere"]["center"][2].get<double>() > 0.07 + 0.025);
  CHECK(ball["mass"] == Approx(7850 * 4 * M_PI / 3 * std::pow(0.025, 3)));
}

TEST_CASE("a bend holds both ends and drives the middle against them", "[break]") {
  const TetMesh mesh = brick();
  const BrokenThing thing{"brick", "brick.msh", mesh, *find_material("brick")};
  const auto body = break_scene(thing, blow_of(BlowKind::bend), {}, false)["bodies"][0];
  REQUIRE(body["held"].size() == 3);
  CHECK(body["held"][0]["maximum"][0] < -0.1);
  CHECK(body["held"][1]["minimum"][0] > 0.1);
  CHECK(body["held"][2]["velocity"][2] == -3);
  for (const auto& held : body["held"]) {
    CHECK(held["axes"] == nlohmann::ordered_json{"z"});
    const auto inside = std::ranges::count_if(mesh.points, [&](const Point& p) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (p[k] < held["minimum"][k] || p[k] > held["maximum"][k]) return false;
      }
      return true;
    });
    CHECK(inside >= 3);
  }
}
