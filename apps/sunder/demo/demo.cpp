// SPDX-License-Identifier: MIT
// Writes a scene with its mesh, runs it, and prints the picture to look at and further commands.
#include "apps/sunder/demo/demo.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

#include "apps/sunder/demo/demo_files.hpp"
#include "apps/sunder/program.hpp"
#include "apps/sunder/run/pictures.hpp"
#include "apps/sunder/run/run.hpp"
#if defined(SUNDER_HAS_VIEW)
#include "apps/sunder/view/view.hpp"
#endif
#include "topology/io/files/output_file.hpp"
#include "topology/io/files/printing.hpp"

namespace sunder {
namespace {

namespace fs = std::filesystem;

constexpr const char* demo_footer = R"(
A ball of plaster, 0.2 m wide, of 1303 tetrahedra, falls from 1.8 m on a stone floor. The run lasts
0.02 s. DIR holds the scene and its mesh, which you can change and run again.
DIR/run holds the files of `sunder run`. An existing scene or mesh with other contents is not
overwritten.

Exit codes: 0 done, 2 usage, 4 not written, 5 the simulation failed, 130 interrupted by Ctrl-C.
)";

bool holds(const fs::path& path, std::string_view text) {
  std::ifstream in(path, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(in), {}) == text;
}

/// Writes a file of the demo; a file that a user has changed stays.
std::optional<Finding> put(const fs::path& path, std::string_view text) {
  if (!file_exists(path)) return write_file(path, text);
  if (holds(path, text)) return std::nullopt;
  return Finding{.code = "in_the_way",
                 .text = fmt::format("{} is there and is not the demo's", path.string()),
                 .remedy = "give another folder: sunder demo -o DIR",
                 .file = path.string()};
}

ExitCode show_demo(const fs::path& folder, const Telling& telling) {
  if (const std::optional<Finding> finding = make_folder(folder)) {
    tell({*finding}, telling);
    return ExitCode::not_written;
  }
  const fs::path scene = folder / "ball.json";
  for (const auto& [path, text] :
       {std::pair{scene, demo_scene}, std::pair{folder / demo_mesh_name, demo_mesh}}) {
    if (const std::optional<Finding> finding = put(path, text)) {
      tell({*finding}, telling);
      return ExitCode::not_written;
    }
  }
  RunArguments run{telling};
  run.scene = scene;
  run.folder = folder / "run";
  run.force = true;
  run.settings = {"output.frames=26"};
  const bool draws = may_draw(telling);
  if (draws) run.settings.push_back("output.pictures.count=6");
  const ExitCode code = run_scene(run);
  if (code != ExitCode::fine) return code;
  const std::string sunder = program_word();
  const auto in_folder = [&](const char* name) { return shell_word((folder / name).string()); };
  if (draws) {
    print("\nLook at   {}\nThen      {} render {} pieces.png --explode 0.6\n",
          in_folder("run/picture_005.png"), sunder, in_folder("run"));
  } else {
    print("\nLook at   {} with ParaView\n", in_folder("run/frames.pvd"));
  }
#if defined(SUNDER_HAS_VIEW)
  print("and       {} view {}    ({})\n", sunder, in_folder("ball.json"),
        page_is_built() ? "in the browser: throw balls, pull, cut"
                        : "in the browser, once `./bootstrap all` has built the page");
#endif
  print("and       {} run {} --set bodies.0.material.toughness=4e5\n", sunder,
        in_folder("ball.json"));
  return ExitCode::fine;
}

}  // namespace

void add_demo_command(CLI::App& program, ExitCode& exit_code) {
  CLI::App* command =
      program.add_subcommand("demo", "Break something within half a minute, without any file");
  const auto folder = std::make_shared<fs::path>("sunder_demo");
  command->add_option("-o,--output", *folder, "Folder for the files")
      ->type_name("DIR")
      ->capture_default_str();
  const auto telling = std::make_shared<Telling>();
  add_telling_flags(*command, *telling);
  command->footer(demo_footer);
  command->callback([=, &exit_code] { exit_code = show_demo(*folder, *telling); });
}

}  // namespace sunder
