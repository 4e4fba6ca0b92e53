// SPDX-License-Identifier: MIT
// `sunder break` from outside: from a file to fragments, and every refusal.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "apps/scene/scene_json.hpp"
#include "apps/sunder/process/run_process.hpp"
#include "tests/apps/sunder/break/surfaces.hpp"
#include "tests/support/program.hpp"

using namespace sunder;
using namespace sunder::test;

TEST_CASE("a mesh breaks in one command, and its scene runs again to the same bytes", "[break]") {
  const Workplace here;
  const std::string folder = here.path("out");
  const std::vector<std::string> words = {"break",      sample_mesh("cube.msh"),
                                          "--size",     "20cm",
                                          "--material", "plaster",
                                          "--ball",     "60mm@30m/s",
                                          "--duration", "0.002",
                                          "-o",         folder};
  const Outcome outcome = here.run(words);
  INFO(outcome.text());
  REQUIRE(outcome.exit_code == 0);
  CHECK(outcome.out.find(" pieces, ") != std::string::npos);
  CHECK(outcome.out.find("% of the mass, largest ") != std::string::npos);
  for (const char* file : {"/cube.json", "/cube.msh", "/run/fragments.csv", "/run/frames.pvd"}) {
    CHECK(std::filesystem::exists(folder + file));
  }
#if defined(SUNDER_HAS_RENDERER)
  CHECK(outcome.out.find("picture_005.png") != std::string::npos);
#endif
  const Outcome again = here.run({"run", folder + "/cube.json", "-o", here.path("again")});
  REQUIRE(again.exit_code == 0);
  const auto bytes = [](const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  CHECK(bytes(folder + "/run/fragments.csv") == bytes(here.path("again") + "/fragments.csv"));
}

TEST_CASE("an STL becomes a scene of tetrahedra in metres", "[break]") {
  if (!find_program("tetgen") && !find_program("gmsh")) {
    WARN("skipped: tetgen is not installed");
    return;
  }
  const Workplace here;
  const std::string off = here.write("cube.off", cube_off());
  REQUIRE(here.run({"convert", off, here.path("cube.stl"), "--scale", "95"}).exit_code == 0);
  const Outcome made = here.run({"break", here.path("cube.stl"), "--scene-only", "--tetrahedra",
                                 "800", "--material", "porcelain", "-o", here.path("out")});
  INFO(made.text());
  REQUIRE(made.exit_code == 0);
  CHECK(made.err.find("guessed_unit") != std::string::npos);
  CHECK(made.err.find("filled it with") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(here.path("out") + "/run"));
  const Result<SceneFile> file = read_scene(here.path("out") + "/cube.json");
  REQUIRE(file);
  double top = 0, volume = 0;
  const TetMesh& mesh = file->scene.bodies[0].mesh;
  for (const Point& p : mesh.points) top = std::max(top, p[2]);
  for (const auto& t : mesh.tetrahedra) {
    std::array<Eigen::Vector3d, 4> x;
    for (std::size_t k = 0; k < 4; ++k) x[k] = Eigen::Vector3d(mesh.points[t[k]].data());
    volume += (x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]) / 6;
  }
  CHECK(top == Approx(0.095));
  CHECK(volume == Approx(0.095 * 0.095 * 0.095).epsilon(1e-3));
}

TEST_CASE("files with other contents stay unless --force is given", "[break]") {
  const Workplace here;
  const std::string out = here.path("out");
  const std::vector<std::string> words = {
      "break", sample_mesh("cube.msh"), "--size", "20cm", "--scene-only", "-o", out};
  auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = words;
    all.insert(all.end(), more.begin(), more.end());
    return here.run(all);
  };
  REQUIRE(with({}).exit_code == 0);
  CHECK(with({}).exit_code == 0);  // the same
  const Outcome refused = with({"--drop", "3m"});
  CHECK(refused.exit_code == 4);
  CHECK(refused.err.find("in_the_way") != std::string::npos);
  CHECK(with({"--drop", "3m", "--force"}).exit_code == 0);
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(out)) {
    names.push_back(file.path().filename());
  }
  CHECK(names.size() == 2);
}

TEST_CASE("each mistake of sunder break has its exit code and leaves no file", "[break]") {
  const Workplace here;
  const std::string cube = here.write("cube.off", cube_off()), out = here.path("out");
  const std::string open = here.write("open.off", cube_off(true));
  const std::string crossing = here.write("crossing.off", crossing_off());
  const struct {
    std::vector<std::string> words;
    int exit_code;
    const char* said;
  } cases[] = {{{open}, 3, "open_surface"},
               {{crossing, "--repair", "none"}, 3, "self_intersection"},
               {{here.path("none.stl")}, 3, "cannot_open"},
               {{cube, "--material", "glas"}, 2, "did you mean glass?"},
               {{cube, "--drop", "1m", "--press"}, 2, "excludes"},
               {{cube, "--drop", "-1m"}, 2, "is no length"},
               {{cube, "--ball", "50mm"}, 2, "DIAMETER@SPEED"},
               {{cube, "--speed", "1m/s"}, 2, "--press or --bend"},
               {{cube, "--tetrahedra", "0"}, 2, ""},
               {{cube, "--mesher", "blender"}, 2, ""},
               {{cube, "--repair", "magic"}, 2, ""},
               {{cube, "--time-budget", "soon"}, 2, "is no time"},
               {{cube, "--time-budget", "2min", "--tetrahedra", "500"}, 2, "excludes"},
               {{cube, "--units", "parsec"}, 2, ""}};
  for (const auto& c : cases) {
    std::vector<std::string> words = {"break", "-o", out};
    words.insert(words.end(), c.words.begin(), c.words.end());
    const Outcome outcome = here.run(words);
    INFO(outcome.text());
    CHECK(outcome.exit_code == c.exit_code);
    CHECK(outcome.text().find(c.said) != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(out));
  }
  const std::string before = std::getenv("PATH");
  setenv("PATH", "/nonexistent", 1);
  const Outcome outcome = here.run({"break", cube, "-o", out});
  setenv("PATH", before.c_str(), 1);
  CHECK(outcome.exit_code == 3);
  CHECK(outcome.err.find("no_mesher") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(out));
}

TEST_CASE("options about filling are not ignored in silence for a file of tetrahedra", "[break]") {
  const Workplace here;
  const std::vector<std::string> words = {
      "break", sample_mesh("cube.msh"), "--size", "20cm", "--scene-only", "-o", here.path("out")};
  CHECK(here.run(words).err.find("filled_already") == std::string::npos);
  std::vector<std::string> more = words;
  for (const char* word : {"--tetrahedra", "900", "--mesher", "gmsh"}) more.emplace_back(word);
  const Outcome noted = here.run(more);
  CHECK(noted.exit_code == 0);
  CHECK(noted.err.find("--tetrahedra, --mesher without effect") != std::string::npos);
  CHECK(noted.err.find("sunder refine") != std::string::npos);
}

TEST_CASE("a time budget chooses cells, and says where none are few enough", "[break]") {
  const Workplace here;
  const Outcome solid =
      here.run({"break", sample_mesh("bunny.msh"), "--size", "15cm", "--drop", "3m",
                "--time-budget", "1s", "--scene-only", "-o", here.path("solid")});
  INFO(solid.text());
  CHECK(solid.exit_code == 0);
  CHECK(solid.err.find("over_budget") != std::string::npos);
  CHECK(solid.err.find("no film: it would take") != std::string::npos);
  if (!find_program("tetgen") && !find_program("gmsh")) {
    WARN("skipped: tetgen is not installed");
    return;
  }
  const std::string cube = here.write("cube.off", cube_off());
  std::vector<std::size_t> counts;
  for (const char* budget : {"50s", "5min"}) {
    const std::string out = here.path(std::string("out") + budget);
    const Outcome made = here.run({"break", cube, "--size", "20cm", "--drop", "3m", "--material",
                                   "plaster", "--time-budget", budget, "--scene-only", "-o", out});
    INFO(made.text());
    REQUIRE(made.exit_code == 0);
    CHECK(made.err.find(std::string("fit into ") + budget) != std::string::npos);
    const Result<SceneFile> file = read_scene(out + "/cube.json");
    REQUIRE(file);
    counts.push_back(file->scene.bodies[0].mesh.tetrahedra.size());
  }
  CHECK(2 * counts[0] < counts[1]);
}
