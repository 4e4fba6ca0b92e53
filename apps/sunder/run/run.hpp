// SPDX-License-Identifier: MIT
// `sunder run`: steps a scene and writes its events and results.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/scene/scene_json.hpp"
#include "apps/sunder/exit_code.hpp"
#include "apps/sunder/telling.hpp"

namespace sunder {

/// The arguments of `sunder run`.
struct RunArguments : Telling {
  std::filesystem::path scene;
  /// Empty: out/ and the scene file's name without its ending.
  std::filesystem::path folder;
  /// `dotted.path=value` changes of the scene, in their order.
  std::vector<std::string> settings;
  /// Which files the scene may name.
  SceneReach reach = SceneReach::anywhere;
  /// Event log of an earlier run to repeat; empty: none.
  std::filesystem::path replay;
  /// Folder of a run to continue; empty: none. It holds the whole scene.
  std::filesystem::path resume;
  /// With `resume`: to this time, s; 0: to the run's own end.
  double until = 0;
  /// With `resume`: from this step on, in `folder`, by the scene's settings if one is given.
  std::optional<std::uint64_t> from;
  /// Whether files of an earlier run in the folder may be replaced.
  bool force = false;
  /// Threads for factors; the result is the same for any number.
  unsigned threads = 1;
  /// A run with warnings ends with an exit code of its own.
  bool strict = false;
  /// Map and every number of the state are checked after every step, and the run fails where one is
  /// damaged; without it columns alone.
  bool check_map = false;
  /// In step with the wall clock, with a budget for cracks per frame.
  bool realtime = false;
};

/// Reads the scene, or goes on with an earlier run, steps it to its end, to a failure or to a
/// signal (SIGINT, SIGTERM, SIGHUP), and writes its files; a replay stops where it departs from its
/// log. Findings go to stderr, the result to stdout.
ExitCode run_scene(const RunArguments& arguments);

/// Adds the subcommand `run` to the program; `exit_code` is set when it has run.
void add_run_command(CLI::App& program, ExitCode& exit_code);

}  // namespace sunder
