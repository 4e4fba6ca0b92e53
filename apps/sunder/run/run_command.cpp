// SPDX-License-Identifier: MIT
// The command line of `sunder run`.
#include <fmt/format.h>

#include <memory>

#include "apps/output/output_columns.hpp"
#include "apps/scene/json_text.hpp"
#include "apps/scene/scene_schema.hpp"
#include "apps/sunder/program.hpp"
#include "apps/sunder/run/run.hpp"

namespace sunder {
namespace {

constexpr const char* run_footer = R"(
The scene is a JSON file in SI units: docs/reference/scene.md explains it, --schema prints every key.
Files in DIR (where an earlier run lies there, --force replaces it):
  frames.pvd, frames/*.vtu  the deformed bodies, for ParaView
  picture_*.png             with --png or the scene's output.pictures
  report.json               counts, times, momentum and energy, warnings
  fragments.csv             one line per piece
  events.jsonl              one line per fan and per release of ties; --replay repeats the run from it
  cracks.csv                area and energy of each crack
  history.csv               energies, work of loads, forces on obstacles and held regions, pieces:
                            one line per step, or per output.history of the scene
  obstacles.csv             free obstacles in each frame: place, turn, velocity, spin
  checkpoints/*.checkpoint  saved states for --resume: every ten minutes and at the end, or as
                            output.checkpoint of the scene
One run at a time writes to a folder. Events are written at once, tables and report with every
checkpoint too. One line before the first step names the scene. Progress follows at least every
second. --verbose adds the settings that "accuracy" chose, which report.json has too. --columns
prints the columns and keys of each file (docs/reference/output.md).

Exit codes: 0 done, 2 usage, 3 bad scene or mesh, 4 not written, 5 the simulation failed, 6 a replay
departed from its log, 7 done, with warnings, and --strict was given, 130 interrupted by Ctrl-C
(SIGINT), SIGTERM or SIGHUP. After 5, 6 and 130 the files hold the run up to that moment. A signal
leaves a checkpoint of the last whole step. A step that does not end within 2 s is cut short.
--resume goes on from the last checkpoint, also after a crash.

Examples:
  sunder run meshes/scenes/bunny.json -o out/bunny --png 6
  sunder run meshes/scenes/block.json --set gravity.ramp_time=2 \
    --set bodies.0.material.tensile_strength=3e6 --frame-interval 0.01
  sunder run meshes/scenes/bunny.json -o out/again --replay out/bunny/events.jsonl
  sunder run --resume out/bunny                # the same bytes as without the stop
  sunder run --resume out/bunny --until 2      # a finished run, extended to 2 s
  sunder run meshes/scenes/bunny.json --set gravity.acceleration=[0,0,0] \
    --resume out/bunny --from 120 -o out/branch
)";

/// `--frames 10` is `--set output.frames=10`: one way in, one place that checks.
CLI::Option* add_shortcut(CLI::App& command, const std::string& option, const std::string& key,
                          std::vector<std::string>& settings) {
  return command.add_option_function<std::string>(
      option,
      [key, &settings](const std::string& value) { settings.push_back(key + "=" + value); });
}

void add_options(CLI::App& command, RunArguments& arguments, std::vector<std::string>& shortcuts) {
  command.add_option("SCENE", arguments.scene, "Scene file (JSON)");
  command
      .add_option("-o,--output", arguments.folder,
                  "Folder for the files; default: out/ and the scene's name")
      ->type_name("DIR");
  command
      .add_option("--set", arguments.settings,
                  "Change a value of the scene: gravity.ramp_time=2; may be repeated")
      ->type_name("KEY=VALUE")
      ->take_all();
  add_confined_flag(command, arguments.reach);
  add_shortcut(command, "--png", "output.pictures.count", shortcuts)
      ->type_name("N")
      ->description("Draw N pictures spread over the run, with its start and end");
  add_shortcut(command, "--show", "output.pictures.show", shortcuts)
      ->type_name("reference|deformed|both")
      ->description("Draw this shape; default: the scene's, else reference");
  CLI::Option* frames = add_shortcut(command, "--frames", "output.frames", shortcuts)
                            ->type_name("N")
                            ->description("Write N VTU frames spread over the run; 0: none");
  add_shortcut(command, "--frame-interval", "output.frame_interval", shortcuts)
      ->type_name("SECONDS")
      ->description("Write a VTU frame after each such simulated time, instead of --frames")
      ->excludes(frames);
  CLI::Option* replay =
      command
          .add_option(
              "--replay", arguments.replay,
              "Repeat the cracks of this event log instead of testing for cracks; needs the "
              "same scene and --set")
          ->type_name("EVENTS");
  CLI::Option* resume = command
                            .add_option("--resume", arguments.resume,
                                        "Continue the run in this folder from its last checkpoint")
                            ->type_name("DIR")
                            ->excludes(replay);
  CLI::Option* until =
      command
          .add_option("--until", arguments.until, "With --resume: run to this simulated time, s")
          ->type_name("SECONDS")
          ->check(CLI::PositiveNumber)
          ->needs(resume);
  command
      .add_option(
          "--from", arguments.from,
          "With --resume and -o: continue from this step in another folder. With SCENE: use "
          "its settings from there on (not meshes, materials, obstacles, time_step)")
      ->type_name("STEP")
      ->needs(resume)
      ->excludes(until);
  command.add_flag("--force", arguments.force, "Replace an earlier run in the folder");
  command
      .add_option("--threads", arguments.threads,
                  "Threads for factors and contact of large pieces; results do not depend on them")
      ->capture_default_str()
      ->check(CLI::Range(1, 64));
  command.add_flag(
      "--realtime", arguments.realtime,
      "Real-time mode: 60 frames per second; reports how late each frame is. Limits cracks to 32 "
      "fans and 16 new pieces per frame unless the scene has its own fracture.mode budget");
  command.add_flag("--strict", arguments.strict,
                   "End with exit code 7 when the run has a warning: contacts left out or not "
                   "converged, too few sub-steps, an energy balance that does not close");
  command.add_flag(
      "--check-map", arguments.check_map,
      "Check the map, its darts, the labels of pieces and every number of the state, with its "
      "matrices, after every step. The run fails (exit code 5) at the first damaged step");
  add_telling_flags(command, arguments);
  command.add_flag("--json", arguments.json, "Print report.json instead of a table");
}

/// The files of a run with their columns and keys, as `--columns` prints them.
nlohmann::ordered_json columns_json() {
  nlohmann::ordered_json files = nlohmann::ordered_json::array();
  for (const OutputFile& file : output_files()) {
    nlohmann::ordered_json columns = nlohmann::ordered_json::array();
    for (const OutputColumn& column : file.columns) {
      columns.push_back({{"name", column.name},
                         {"unit", column.unit},
                         {"meaning", column.meaning},
                         {"when", column.when}});
    }
    files.push_back({{"file", file.file},
                     {"part", file.part},
                     {"meaning", file.meaning},
                     {"columns", std::move(columns)}});
  }
  return files;
}

}  // namespace

void add_run_command(CLI::App& program, ExitCode& exit_code) {
  CLI::App* command = program.add_subcommand("run", "Simulate a scene of bodies that break");
  const auto arguments = std::make_shared<RunArguments>();
  const auto shortcuts = std::make_shared<std::vector<std::string>>();
  const auto schema = std::make_shared<bool>(false), columns = std::make_shared<bool>(false);
  add_options(*command, *arguments, *shortcuts);
  command->add_flag("--schema", *schema, "Print the JSON schema of scenes and do nothing else");
  command->add_flag("--columns", *columns,
                    "Print the files of a run with their columns, keys and units as JSON, and do "
                    "nothing else");
  command->footer(run_footer);
  command->callback([=, &exit_code] {
    if (*schema) {
      print_json(scene_schema());
      return;
    }
    if (*columns) {
      print_json(columns_json());
      return;
    }
    const bool is_new = arguments->resume.empty(), branches = arguments->from.has_value();
    if (is_new && arguments->scene.empty()) throw CLI::RequiredError("SCENE");
    if (branches && arguments->folder.empty()) throw CLI::RequiredError("--from: -o DIR");
    if (!is_new && !branches && (!arguments->scene.empty() || !arguments->folder.empty())) {
      throw CLI::ValidationError("--resume",
                                 "continues in its own folder with its own settings; "
                                 "SCENE and -o need --from");
    }
    if (!is_new && arguments->scene.empty() &&
        !(arguments->settings.empty() && shortcuts->empty())) {
      throw CLI::ValidationError("--set",
                                 "a continued run keeps its settings; --from with SCENE "
                                 "changes them");
    }
    // An explicit --frames overrides a frame_interval of the scene.
    for (const std::string& setting : *shortcuts) {
      if (setting.starts_with("output.frames=")) {
        arguments->settings.push_back("output.frame_interval=0");
      }
      arguments->settings.push_back(setting);
    }
    exit_code = run_scene(*arguments);
  });
}

}  // namespace sunder
