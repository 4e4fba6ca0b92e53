// SPDX-License-Identifier: MIT
// Scenes and results of somebody else: files that they name outside their folders are not written
// and, on request, not read.
#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/sunder/run/saved/checkpoint.hpp"
#include "apps/sunder/run/saved/run_folder.hpp"
#include "tests/support/program.hpp"
#include "tests/support/struck_scene.hpp"

using namespace sunder;
using namespace sunder::test;
namespace fs = std::filesystem;
using Catch::Contains;
using nlohmann::json;

namespace {

/// A folder with a scene in it that names `file` by `key`, next to a folder with files of somebody
/// else.
struct Place {
  Workplace here;
  fs::path root = here.path("");

  Place() {
    fs::create_directories(root / "mine/meshes");
    fs::create_directories(root / "other");
    for (const char* folder : {"mine", "mine/meshes", "other"}) {
      fs::copy_file(sample_mesh("cube.msh"), root / folder / "cube.msh");
      fs::copy_file(sample_mesh("cube.msh"), root / folder / "cube.json");
    }
    here.write("other/faces.txt", "0 1 2\n");
    fs::create_symlink(root / "other/cube.msh", root / "mine/link.msh");
    fs::create_symlink(root / "other", root / "mine/linked");
    fs::create_symlink(root / "mine/meshes/cube.msh", root / "mine/own_link.msh");
  }

  std::string scene(const json& body, const json& obstacles = json::array()) const {
    return here.write("mine/scene.json", json{{"bodies", {body}},
                                              {"obstacles", obstacles},
                                              {"duration", 0.001},
                                              {"output", {{"frames", 0}}}}
                                             .dump(1));
  }
};

/// The files that the run writes outside `out`: names and bytes.
std::string snapshot(const fs::path& root, const fs::path& out) {
  std::string all;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    const fs::path path = entry.path();
    if (path.string().starts_with(out.string()) || !entry.is_regular_file()) continue;
    all += path.string() + "\n" + bytes_of(path);
  }
  return all;
}

}  // namespace

TEST_CASE("confined: reads the scene's own files and names key and file of others", "[confined]") {
  const Place p;
  const std::string out = p.here.path("out");
  const auto run = [&](const std::string& scene, const char* command) {
    std::vector<std::string> words = {command, scene, "--confined"};
    if (std::string(command) == "run") words.insert(words.end(), {"--quiet", "-o", out, "--force"});
    return p.here.run(words);
  };
  for (const char* mesh : {"cube.msh", "meshes/cube.msh", "meshes/../cube.msh", "own_link.msh"}) {
    INFO(mesh);
    const Outcome o = run(p.scene({{"mesh", mesh}}), "run");
    INFO(o.err);
    CHECK(o.exit_code == 0);
  }
  const std::string absolute = (p.root / "other/cube.msh").string();
  for (const std::string& mesh :
       {std::string("../other/cube.msh"), absolute, std::string("link.msh"),
        std::string("linked/cube.msh"), std::string("../mine/../other/cube.msh")}) {
    const std::string scene = p.scene({{"mesh", mesh}});
    INFO(mesh);
    for (const char* command : {"run", "static", "modes", "view"}) {
      const Outcome o = run(scene, command);
      INFO(command << ": " << o.text());
      CHECK(o.exit_code == 3);
      CHECK_THAT(o.err, Contains("outside_folder"));
      CHECK_THAT(o.err, Contains("scene.json:") && Contains("bodies.0.mesh (" + mesh + ")"));
    }
    // Without the option nothing has changed.
    const Outcome o = p.here.run({"run", scene, "--quiet", "-o", out, "--force"});
    INFO(o.text());
    CHECK(o.exit_code == 0);
  }
}

TEST_CASE("confined: holds for every key that names a file", "[confined]") {
  const Place p;
  const std::string out = p.here.path("out");
  const auto refused = [&](const std::string& scene, const std::string& place) {
    const Outcome o = p.here.run({"run", scene, "--confined", "--quiet", "-o", out, "--force"});
    INFO(o.text());
    CHECK(o.exit_code == 3);
    CHECK_THAT(o.err, Contains("outside_folder") && Contains(place));
  };
  refused(p.scene({{"mesh", "cube.msh"}, {"cuts", {{{"faces", "../other/faces.txt"}}}}}),
          "bodies.0.cuts.0.faces (../other/faces.txt)");
  refused(p.scene({{"mesh", "cube.msh"}}, {{{"mesh", {{"file", "../other/cube.msh"}}}}}),
          "obstacles.0.mesh.file (../other/cube.msh)");
}

TEST_CASE("confined: standard input is no file of the scene", "[confined]") {
  const Place p;
  const std::string scene = p.scene({{"mesh", "-"}});
  // By its name alone, so that the folder before `-` is empty.
  const auto run = [&](const std::string& confined) {
    const std::string command =
        "cd '" + (p.root / "mine").string() + "' && '" SUNDER_PROGRAM "' run scene.json " +
        confined + " --quiet -o '" + p.here.path("out") + "' <cube.msh >/dev/null 2>err";
    return std::system(command.c_str());
  };
  CHECK(run("--confined") != 0);
  CHECK_THAT(bytes_of(p.root / "mine/err"),
             Contains("not_a_file") && Contains("bodies.0.mesh (-)"));
  CHECK(run("") == 0);
}

TEST_CASE("confined: a packed file unfolds to no more than 256 MiB", "[confined]") {
  const Place p;
  const std::string mesh = (p.root / "mine/cube.msh.gz").string();
  const std::string zeros = "head -c 300000000 /dev/zero | gzip -1 > '" + mesh + "'";
  REQUIRE(std::system(zeros.c_str()) == 0);
  const Outcome o = p.here.run({"run", p.scene({{"mesh", "cube.msh.gz"}}), "--confined", "--quiet",
                                "-o", p.here.path("out")});
  CHECK(o.exit_code == 3);
  CHECK_THAT(o.err, Contains("too_large") && Contains("268435456"));
}

TEST_CASE("confined: waits for no pipe", "[confined]") {
  const Place p;
  REQUIRE(mkfifo((p.root / "mine/pipe.msh").c_str(), 0600) == 0);
  const Outcome o = p.here.run(
      {"run", p.scene({{"mesh", "pipe.msh"}}), "--confined", "--quiet", "-o", p.here.path("out")});
  CHECK(o.exit_code == 3);
  CHECK_THAT(o.err, Contains("not_a_file") && Contains("bodies.0.mesh (pipe.msh)"));
}

TEST_CASE("a run follows no link in its folder", "[confined]") {
  const Place p;
  const std::string scene = p.scene({{"mesh", "cube.msh"}});
  const fs::path out = p.root / "out";
  const std::pair<const char*, const char*> links[] = {
      {"frames", "other"},
      {"checkpoints", "other"},
      {"events.jsonl", "other/faces.txt"},
      {"report.json", "other/faces.txt"},
      {"run.lock", "other/faces.txt"},
      {"frames/frame_000000.vtu", "other/faces.txt"}};
  for (const auto& [name, target] : links) {
    INFO(name);
    fs::remove_all(out);
    fs::create_directories((out / name).parent_path());
    fs::create_symlink(p.root / target, out / name);
    const std::string before = snapshot(p.root, out);
    const Outcome o =
        p.here.run({"run", scene, "--quiet", "--force", "--frames", "2", "-o", out.string()});
    INFO(o.text());
    CHECK(o.exit_code == 4);
    CHECK_THAT(o.err, Contains(name));
    CHECK(snapshot(p.root, out) == before);
  }
  // The folder itself may be a link: that is the user's own word.
  fs::remove_all(out);
  fs::create_directories(p.root / "disk");
  fs::create_symlink(p.root / "disk", out);
  CHECK(p.here.run({"run", scene, "--quiet", "-o", out.string()}).exit_code == 0);
  CHECK(fs::exists(p.root / "disk/report.json"));
}

TEST_CASE("nothing is written outside the folder, whatever a scene is called", "[confined]") {
  const Place p;
  const json scene = {{"name", "../../other/name"},
                      {"bodies", {{{"mesh", "cube.msh"}, {"name", "/tmp/x"}}}},
                      {"duration", 0.001}};
  for (const char* name : {"mine/...json", "mine/..json", "mine/plain.json"}) {
    INFO(name);
    const std::string path = p.here.write(name, scene.dump());
    const fs::path start = p.root / "start/here";
    fs::create_directories(start);
    const std::string before = snapshot(p.root, start / "out");
    CHECK(std::system(("cd '" + start.string() + "' && '" SUNDER_PROGRAM "' run '" + path +
                       "' --quiet --force >/dev/null")
                          .c_str()) == 0);
    CHECK(snapshot(p.root, start / "out") == before);
    CHECK(fs::exists(start / "out"));
    fs::remove_all(start);
  }
}

TEST_CASE("a checkpoint whose frames lie elsewhere is damaged", "[confined]") {
  const Place p;
  json scene = struck_scene(0.4, 0.002);
  scene["output"] = {{"frames", 3}, {"checkpoint", {{"steps", 4}, {"minutes", 0}}}};
  const std::string path = p.here.write("mine/struck.json", scene.dump());
  const fs::path out = p.root / "out";
  REQUIRE(p.here.run({"run", path, "--quiet", "-o", out.string()}).exit_code == 0);
  Result<Checkpoint> whole = read_checkpoint(out);
  REQUIRE(whole);
  whole->record.frames.at(1).file = "../mine/scene.json";
  fs::remove_all(out / "checkpoints");
  fs::create_directories(out / "checkpoints");
  REQUIRE(write_checkpoint(out, checkpoint_bytes(whole->file, whole->record, whole->simulation), 0)
              .empty());
  const Result<Checkpoint> changed = read_checkpoint(out);
  CHECK(!changed);
  CHECK(changed.findings.back().code == "damaged");
}
