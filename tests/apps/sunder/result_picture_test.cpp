// SPDX-License-Identifier: MIT
// Pictures of a finished run: which faces are seen, where pieces and obstacles are.
#include "apps/sunder/render/result_picture.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>

#include "apps/scene/obstacles_json.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "mechanics/contact/shapes/solid_surface.hpp"
#include "tests/support/program.hpp"

using namespace sunder;
using namespace sunder::test;
namespace fs = std::filesystem;

namespace {

/// Two tetrahedra that share a face, then each on rows of its own.
std::vector<ResultFrame> two_pieces() {
  ResultFrame whole;
  whole.reference = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}};
  whole.position = whole.reference;
  whole.tetrahedra = {{0, 1, 2, 3}, {0, 2, 1, 4}};
  whole.component = {0, 0};
  ResultFrame broken = whole;
  broken.component = {1, 0};
  broken.tetrahedra[0] = {5, 6, 7, 3};
  for (const std::size_t v : {0u, 1u, 2u}) broken.reference.push_back(whole.reference[v]);
  broken.position = broken.reference;
  return {whole, broken};
}

}  // namespace

TEST_CASE("faces that were inside at first are those of cracks", "[render]") {
  const std::vector<ResultFrame> frames = two_pieces();
  const std::vector<char> first = boundary_of(frames[0]);
  const FramePicture whole = frame_picture(frames[0], first, 0, Vec3::UnitZ());
  CHECK(whole.bodies.half_faces.size() == 6);
  CHECK(std::ranges::count(whole.bodies.face_class, render::FaceClass::crack) == 0);
  const FramePicture broken = frame_picture(frames[1], first, 0, Vec3::UnitZ());
  CHECK(broken.bodies.half_faces.size() == 8);
  CHECK(std::ranges::count(broken.bodies.face_class, render::FaceClass::crack) == 2);
  CHECK(broken.bodies.reference[3] == Vec3(0, 0, 1));
}

TEST_CASE("pieces drawn apart move from the middle, none of them down", "[render]") {
  const std::vector<ResultFrame> frames = two_pieces();
  const FramePicture apart = frame_picture(frames[1], boundary_of(frames[0]), 2, Vec3::UnitZ());
  const auto way = [&](std::size_t v) -> Vec3 {
    return apart.bodies.reference[v] - frames[1].reference[v];
  };
  CHECK((way(5) - way(3)).norm() < 1e-14);  // one piece
  CHECK((way(0) - way(4)).norm() < 1e-14);
  // Means of the two lie 1/2 apart along z.
  CHECK((way(3) - way(4) - Vec3(0, 0, 1)).norm() < 1e-14);
  CHECK(way(4).norm() < 1e-14);
}

TEST_CASE("moves of cracks show in pictures alone", "[render]") {
  std::vector<ResultFrame> frames = two_pieces();
  frames[1].crack_move.assign(frames[1].reference.size(), Vec3::Zero());
  frames[1].crack_move[5] = {0.1, 0, 0};
  const FramePicture picture = frame_picture(frames[1], boundary_of(frames[0]), 0, Vec3::UnitZ());
  CHECK(picture.bodies.reference[5] == Vec3(0.1, 0, 0));
  CHECK(picture.bodies.deformed[5] == Vec3(0.1, 0, 0));
  CHECK(frames[1].reference[5] == Vec3(0, 0, 0));
}

TEST_CASE("a film's camera sees large pieces, and none that flew far away", "[render]") {
  ResultFrame frame = two_pieces()[1];
  const render::Bounds start(Eigen::Vector3f(0, 0, -1), Eigen::Vector3f(1, 1, 1));
  CHECK(bounds_of_large(frame, start).max().isApprox(Eigen::Vector3f(1, 1, 1)));
  frame.reference[4] = {0, 0, -100};
  const float margin = start.diagonal().norm();
  CHECK(bounds_of_large(frame, start).min()[2] == Approx(-1 - margin));
  // Of 201 tetrahedra one is small.
  for (int k = 0; k < 199; ++k) {
    frame.tetrahedra.push_back(frame.tetrahedra[0]);
    frame.component.push_back(frame.component[0]);
  }
  CHECK(bounds_of_large(frame, start).min()[2] == 0);
}

TEST_CASE("obstacles of a report are read back", "[render]") {
  TriangleSurface cone;
  cone.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  cone.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));
  const std::vector<Obstacle> all = {
      {.shape = Plane{Vec3(0, 0.6, 0.8), 0.25}},
      {.shape = Sphere{{1, 2, 3}, 0.5}, .velocity = {4, 5, 6}, .mass = 7.0},
      {.shape = Box{{1, 2, 3}, turn, {0.1, 0.2, 0.3}}, .velocity = {1, 0, 0}},
      {.shape = Solid{
           std::make_shared<const SolidSurface>(*make_solid_surface(cone)), {1, 1, 1}, turn}}};
  const Result<std::vector<Obstacle>> read =
      read_obstacles(nlohmann::json::parse(obstacles_json(all).dump()));
  REQUIRE(read);
  REQUIRE(read->size() == all.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    CHECK((*read)[k].shape.index() == all[k].shape.index());
    CHECK((*read)[k].velocity == all[k].velocity);
    CHECK((*read)[k].mass == all[k].mass);
    const Vec3 place(0.3, 0.4, 0.9);
    CHECK(surface_distance((*read)[k].shape, place).gap ==
          surface_distance(all[k].shape, place).gap);
  }
  const auto bad = read_obstacles(nlohmann::json::parse(R"([{"plane": {"normal": [0, 0]}}])"));
  CHECK_FALSE(bad);
  CHECK(bad.findings.at(0).code == "bad_obstacles");
}

TEST_CASE("a run is drawn, exported with keys where it is struck, and its end written as a mesh",
          "[render]") {
  const Workplace here;
  const std::string out = here.path("out");
  REQUIRE(here.run({"run", (fs::path(SUNDER_MESHES) / "scenes/charts/monolith.json").string(), "-o",
                    out, "--frames", "3", "--quiet", "--set", "duration=0.06", "--set",
                    "output.frames_at_impacts=true"})
              .exit_code == 0);
  const Result<RunResult> run = read_run_result(out);
  REQUIRE(run);
  CHECK(run->frames.size() > 3);
  REQUIRE(run->frames.back().obstacles.size() == 3);
  CHECK(run->pieces.size() ==
        std::set(run->frames.back().component.begin(), run->frames.back().component.end()).size());
  for (const auto& [id, piece] : run->pieces) CHECK(piece.mass > 0);
  const Vec3 ball = pose_of(run->frames.back().obstacles[1].shape).centre;
  CHECK(ball.y() > pose_of(run->frames.front().obstacles[1].shape).centre.y() + 0.3);

  const auto drawn =
      here.run({"render", out, here.path("end.png"), "--explode", "0.5", "--size", "320,200"});
  CHECK(drawn.exit_code == 0);
  CHECK(fs::file_size(here.path("end.png")) > 1000);
  // A bent body is drawn elsewhere where it is bent more, and the rigid reference is not.
  const auto bent = [&](const char* shape, const char* factor) {
    const std::string picture = here.path("bent.png");
    CHECK(here.run({"render", out, picture, "--show", shape, "--magnify", factor, "--size",
                    "320,200"})
              .exit_code == 0);
    return bytes_of(picture);
  };
  CHECK(bent("both", "1") != bent("both", "500"));
  CHECK(bent("reference", "1") == bent("reference", "500"));
  const auto film = here.run({"render", out, here.path("film.png"), "--all", "--size", "64,64"});
  CHECK(film.exit_code == 0);
  CHECK(fs::exists(here.path("film_000000.png")));
  CHECK(here.run({"render", out, here.path("x.png"), "--eye", "1,2,3"}).exit_code == 2);
  CHECK(here.run({"render", here.path("nowhere"), here.path("x.png")}).exit_code == 3);
  const auto told = here.run({"render", out, here.path("x.png"), "--size", "64,64", "--json"});
  CHECK(told.json()["pictures"].size() == 1);
  CHECK(told.json()["pictures"][0]["file"] == here.path("x.png"));
  const auto refused = here.run({"render", here.path("nowhere"), here.path("x.png"), "--json"});
  CHECK(refused.json()["findings"][0]["code"] == "no_result");
  const auto exported = here.run({"export", out, here.path("told.glb"), "--json"});
  CHECK(exported.json()["pieces"] == run->pieces.size());
  CHECK(exported.json()["frames"] == run->frames.size());

  CHECK(here.run({"export", out, here.path("broken.msh")}).exit_code == 0);
  const auto checked = here.run({"check", here.path("broken.msh"), "--json"});
  CHECK(checked.json()["counts"]["components"] ==
        std::set(run->frames.back().component.begin(), run->frames.back().component.end()).size());
}

TEST_CASE("the demo breaks something, and keeps its hands off other files", "[demo]") {
  const Workplace here;
  const auto shell = [&](const std::string& words) {
    return std::system(("cd '" + here.path("") + "' && " + words).c_str());
  };
  REQUIRE(shell("'" SUNDER_PROGRAM "' demo -o demo >shown.txt 2>err.txt") == 0);
  CHECK(fs::file_size(here.path("demo/run/picture_005.png")) > 10000);
  // Its hints run as they stand.
  const std::string shown = bytes_of(here.path("shown.txt"));
  INFO(shown);
  const std::regex hint("\n[A-Za-z]+ +(\\S*sunder (render|run) [^\n(]*)");
  int hints = 0;
  for (std::sregex_iterator i(shown.begin(), shown.end(), hint), end; i != end; ++i, ++hints) {
    const std::string brief = i->str(2) == "run" ? " --set duration=0.002" : "";
    CHECK(shell(i->str(1) + brief + " --quiet >out.txt 2>&1") == 0);
  }
  CHECK(hints == 2);
  std::ofstream(here.path("demo/ball.json")) << "{}";
  const auto refused = here.run({"demo", "-o", here.path("demo")});
  CHECK(refused.exit_code == 4);
  CHECK(refused.err.find("in_the_way") != std::string::npos);
  CHECK(fs::file_size(here.path("demo/ball.json")) == 2);
}
