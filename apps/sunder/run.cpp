// SPDX-License-Identifier: MIT
// Read the scene, step it, write it down.
#include "apps/sunder/run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <cstdio>

#include "apps/sunder/progress.hpp"
#include "apps/sunder/recorder.hpp"
#include "apps/sunder/words.hpp"

namespace sunder {
namespace {

// A signal handler can reach nothing but a global.
volatile std::sig_atomic_t interrupted = 0;

/// Ctrl-C ends the run after its step; a second one ends the program at once.
void watch_for_interrupt() {
  interrupted = 0;
  struct sigaction action = {};
  action.sa_handler = [](int) { interrupted = 1; };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
}

void print(const std::vector<Finding>& findings) {
  fmt::print(stderr, "{}", finding_lines(findings));
}

/// Steps until the end, a failure, an interruption, or an output that cannot be written.
ExitCode step_to_end(Simulation& simulation, Recorder& recorder, bool quiet) {
  const std::uint64_t steps = step_count(simulation.scene);
  std::size_t fans = 0;
  Progress progress(quiet);
  while (simulation.state.step < steps) {
    const auto start = std::chrono::steady_clock::now();
    const StepReport report = advance(simulation);
    const std::chrono::duration<double, std::milli> ms = std::chrono::steady_clock::now() - start;
    const std::vector<Finding> unwritten = recorder.record(simulation, report, ms.count());
    print(unwritten);
    if (has_error(unwritten)) return ExitCode::not_written;
    if (const std::optional<Finding> failure = step_failure(report, simulation)) {
      print({*failure});
      return ExitCode::failed;
    }
    if (interrupted) return ExitCode::interrupted;
    fans += report.fracture.fans.size();
    progress.show({report.step, steps, report.time, report.components, fans});
  }
  return ExitCode::fine;
}

}  // namespace

ExitCode run_scene(const RunArguments& arguments) {
  Result<SceneFile> file = read_scene(arguments.scene, arguments.settings);
  print(file.findings);
  if (!file) return ExitCode::bad_input;
  Result<Simulation> simulation = build_simulation(file->scene);
  if (simulation) simulation->scratch.mechanics.threads = arguments.threads;
  print(simulation.findings);
  if (!simulation) return ExitCode::bad_input;

  watch_for_interrupt();
  const std::filesystem::path folder =
      arguments.folder.empty() ? "out" / arguments.scene.stem() : arguments.folder;
  Result<Recorder> recorder =
      Recorder::open({folder, *file}, *simulation, std::move(simulation.findings));
  print(recorder.findings);
  if (!recorder) return ExitCode::not_written;

  const ExitCode ended = step_to_end(*simulation, *recorder, arguments.quiet);
  const std::vector<Finding> unwritten =
      recorder->finish(*simulation, ended == ExitCode::fine          ? RunEnd::finished
                                    : ended == ExitCode::interrupted ? RunEnd::interrupted
                                                                     : RunEnd::failed);
  print(unwritten);
  const nlohmann::ordered_json& report = recorder->report();
  fmt::print("{}", arguments.json ? report.dump(2) + "\n" : summary_table(report));
  if (!arguments.json) fmt::print("{:<14} {}\n", "written to", folder.string());
  return ended == ExitCode::fine && has_error(unwritten) ? ExitCode::not_written : ended;
}

}  // namespace sunder
