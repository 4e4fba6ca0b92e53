// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>

#include <cstring>
#include <nlohmann/json.hpp>

#include "apps/sunder/export/glb.hpp"
#include "apps/sunder/export/obstacle_tracks.hpp"
#include "apps/sunder/export/piece_tracks.hpp"
#include "apps/sunder/export/result_frames.hpp"
#include "tests/support/program.hpp"

using namespace sunder;

namespace {

/// Two tetrahedra that share a face in the first frame; in the second they are apart, and the upper
/// one, on rows of its own, has been turned and moved.
std::vector<ResultFrame> two_pieces(const Eigen::Quaterniond& turn, const Vec3& way) {
  ResultFrame first;
  first.reference = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}};
  first.position = first.reference;
  first.tetrahedra = {{0, 1, 2, 3}, {0, 2, 1, 4}};
  first.component = {0, 0};
  ResultFrame second = first;
  second.time = 0.5;
  second.component = {1, 0};
  second.tetrahedra[0] = {5, 6, 7, 3};
  for (const std::size_t v : {0u, 1u, 2u}) second.reference.push_back(first.reference[v]);
  for (const std::size_t v : {3u, 5u, 6u, 7u}) {
    second.reference[v] = turn * second.reference[v] + way;
  }
  second.position = second.reference;
  return {first, second};
}

nlohmann::json json_of(const std::string& glb) {
  std::uint32_t size = 0;
  std::memcpy(&size, glb.data() + 12, 4);
  return nlohmann::json::parse(glb.substr(20, size));
}

}  // namespace

TEST_CASE("tracks of pieces are their rigid motions", "[export]") {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(2.5, Vec3(1, 2, -1).normalized()));
  const Vec3 way(3, -1, 2);
  const std::vector<PieceTrack> tracks = piece_tracks(two_pieces(turn, way));
  REQUIRE(tracks.size() == 2);
  CHECK(tracks[1].component == 1);
  CHECK(tracks[1].departure < 1e-14);
  CHECK(tracks[1].orientation[0].isApprox(Eigen::Quaterniond::Identity(), 1e-14));
  CHECK(std::abs(tracks[1].orientation[1].dot(turn)) == Approx(1).epsilon(1e-14));
  CHECK((tracks[1].centre[1] - (turn * tracks[1].centre[0] + way)).norm() < 1e-14);
  CHECK((tracks[0].centre[1] - tracks[0].centre[0]).norm() < 1e-14);
}

TEST_CASE("faces that cracks made are told from the body's own", "[export]") {
  for (const PieceTrack& track :
       piece_tracks(two_pieces(Eigen::Quaterniond::Identity(), {0, 0, 1}))) {
    CHECK(track.outer.size() == 3);
    CHECK(track.crack.size() == 1);
    double volume = 0;
    for (const auto* list : {&track.outer, &track.crack}) {
      for (const auto& t : *list) {
        volume += track.vertex[t[0]].dot(track.vertex[t[1]].cross(track.vertex[t[2]])) / 6;
      }
    }
    CHECK(volume == Approx(1.0 / 6));  // all faces look outwards
  }
}

TEST_CASE("a GLB file has a node a piece, its mass and its track", "[export]") {
  const auto tracks = piece_tracks(two_pieces(Eigen::Quaterniond::Identity(), {0, 0, 1}));
  const std::string glb = glb_bytes(tracks, {0, 0.5}, {{1, {2.5, 7}}});
  std::uint32_t size = 0;
  std::memcpy(&size, glb.data() + 8, 4);
  CHECK(size == glb.size());
  const nlohmann::json root = json_of(glb);
  REQUIRE(root["nodes"].size() == 3);
  CHECK(root["nodes"][1]["name"] == "piece_1");
  CHECK(root["nodes"][1]["extras"]["mass"] == 2.5);
  CHECK(root["nodes"][1]["extras"]["birth_step"] == 7);
  CHECK(root["animations"][0]["channels"].size() == 4);
  REQUIRE(root["materials"].size() == 2);  // none for obstacles, which are not there
  const auto& primitives = root["meshes"][0]["primitives"];
  CHECK(root["materials"][primitives[0]["material"].get<std::size_t>()]["name"] == "outside");
  CHECK(root["materials"][primitives[1]["material"].get<std::size_t>()]["name"] == "crack");
}

TEST_CASE("obstacles are tracks with closed surfaces that look outwards", "[export]") {
  std::vector<ResultFrame> frames = two_pieces(Eigen::Quaterniond::Identity(), {0, 0, 1});
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.4, Vec3::UnitX()));
  for (ResultFrame& f : frames) {
    const Vec3 at(0, 0, f.time);
    f.obstacles = {{.shape = Plane{}},
                   {.shape = Sphere{at, 0.5}, .mass = 2.0},
                   {.shape = Box{at, turn, {1, 2, 3}}}};
  }
  const std::vector<PieceTrack> tracks = obstacle_tracks(frames);
  REQUIRE(tracks.size() == 2);
  CHECK(tracks[0].name == "obstacle_1");
  CHECK(tracks[0].centre[1] == Vec3(0, 0, 0.5));
  CHECK(tracks[1].orientation[1].coeffs() == turn.coeffs());
  const auto volume = [](const PieceTrack& track) {
    double sum = 0;
    for (const auto& t : track.outer) {
      sum += track.vertex[t[0]].dot(track.vertex[t[1]].cross(track.vertex[t[2]])) / 6;
    }
    return sum;
  };
  CHECK(volume(tracks[0]) == Approx(4.0 / 3 * 3.14159265 * 0.125).epsilon(0.05));
  CHECK(volume(tracks[1]) == Approx(48));
}

TEST_CASE("what is no result of a run is refused", "[export]") {
  const Result<RunResult> run = read_run_result("/nonexistent");
  CHECK_FALSE(run);
  REQUIRE(run.findings.size() == 1);
  CHECK(run.findings[0].code == "no_result");
}

TEST_CASE("a report that was damaged is refused, lists in lists too", "[export]") {
  const test::Workplace here;
  REQUIRE(here.run({"run", SUNDER_SCENES "/charts/monolith.json", "-o", here.path("run"), "--quiet",
                    "--set", "duration=0.001"})
              .exit_code == 0);
  REQUIRE(read_run_result(here.path("run")));
  const std::string deep = std::string(60'000, '[') + std::string(60'000, ']');
  here.write("run/report.json", R"({"gravity": [0, 0, -1], "obstacles": )" + deep + "}");
  const Result<RunResult> nested = read_run_result(here.path("run"));
  CHECK_FALSE(nested);
  CHECK(nested.findings.back().code == "nested_too_deeply");
  here.write("run/report.json", R"({"gravity": [0, 0)");
  CHECK(read_run_result(here.path("run")).findings.back().code == "syntax_error");
}

TEST_CASE("commands make the folder of a file where only its last part is missing",
          "[export][output]") {
  const test::Workplace here;
  const std::string scene = SUNDER_SCENES "/charts/monolith.json";
  const std::string mesh = test::sample_mesh("two_tets.msh");
  REQUIRE(here.run({"run", scene, "-o", here.path("out/run"), "--quiet", "--set", "duration=0.001",
                    "--set", "output.frames=1"})
              .exit_code == 0);
  const std::string run = here.path("out/run");
  std::vector<std::vector<std::string>> commands;
  for (const std::string place : {"one/", "one/"}) {  // the second time it is there
    commands.push_back({"export", run, here.path(place + "x.obj")});
  }
  commands.push_back({"export", run, here.path("two/x.glb")});
  commands.push_back({"export", run, here.path("three/x.msh")});
  commands.push_back({"convert", mesh, here.path("four/x.vtu")});
  commands.push_back({"split", mesh, "--plane", "0,0,1,0", "-o", here.path("five/x.msh")});
  commands.push_back({"cut", mesh, here.path("seven/x.msh"), "--plane", "0,0,1,0.1"});
  for (const std::vector<std::string>& command : commands) {
    const test::Outcome outcome = here.run(command);
    INFO(command[0] << ": " << outcome.text());
    CHECK(outcome.exit_code == 0);
  }
  CHECK(std::filesystem::exists(here.path("one/x_000000.obj")));
  for (std::vector<std::string> command : commands) {
    const std::size_t place = command[0] == "split" ? command.size() - 1 : 2;
    command[place] = here.path("far/" + command[0] + "/x" +
                               std::filesystem::path(command[place]).extension().string());
    const test::Outcome outcome = here.run(command);
    INFO(command[0] << ": " << outcome.text());
    CHECK(outcome.exit_code == 4);
    CHECK(outcome.err.find("mkdir -p " + here.path("far/" + command[0])) != std::string::npos);
  }
  CHECK_FALSE(std::filesystem::exists(here.path("far")));
}
