// SPDX-License-Identifier: MIT
// Read the scene, step it, write it down.
#include "apps/sunder/run/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>

#include "apps/scene/json_text.hpp"
#include "apps/scene/scene_hash.hpp"
#include "apps/scene/words.hpp"
#include "apps/sunder/program.hpp"
#include "apps/sunder/run/due_steps.hpp"
#include "apps/sunder/run/interrupt.hpp"
#include "apps/sunder/run/progress.hpp"
#include "apps/sunder/run/realtime.hpp"
#include "apps/sunder/run/recorder.hpp"
#include "apps/sunder/run/replay.hpp"
#include "apps/sunder/run/report/scene_line.hpp"
#include "apps/sunder/run/report/settings_report.hpp"
#include "apps/sunder/run/saved/resume.hpp"
#include "apps/sunder/run/saved/run_folder.hpp"
#include "fracture/saving/state_numbers.hpp"
#include "fracture/simulation/rows.hpp"
#include "mechanics/state/living.hpp"
#include "topology/base/counted.hpp"
#include "topology/io/files/printing.hpp"

namespace sunder {
namespace {

#ifdef NDEBUG
constexpr bool is_debug_build = false;
#else
constexpr bool is_debug_build = true;
#endif

/// The result of `work`; while it runs, a line of progress has its name.
template <class Work>
auto with_progress(std::string_view name, const RunArguments& arguments, Work work) {
  const Heartbeat heartbeat(arguments.quiet, line_of_work(name));
  return work();
}

/// A run on its way; `replay` where it repeats another; `last_step` where it ends before its scene
/// does.
struct RunWork {
  Simulation& simulation;
  Recorder& recorder;
  std::optional<Replay>& replay;
  std::optional<std::uint64_t> last_step = {};

  std::uint64_t steps() const {
    return last_step ? *last_step : replay ? replay->steps : step_count(simulation.scene);
  }
};

/// Where a replay is no longer the run of its log. `ended`: nothing while it goes on.
std::optional<Finding> departure_of(const RunWork& work, std::optional<ExitCode> ended) {
  if (!work.replay) return std::nullopt;
  const std::optional<FanScript>& script = work.simulation.state->script;
  if (script && script->departure) return departure(*work.replay, *script->departure);
  if (ended == ExitCode::fine && work.replay->end == RunEnd::failed) {
    return missed_failure(*work.replay);
  }
  return compare_logs(*work.replay, work.recorder.events().text(), ended.has_value());
}

/// The faults of the state that a step leaves. Numbers are checked always; checks that cost as much
/// as a step are made where asked for or in a debug build.
std::vector<Finding> damage(const Simulation& simulation, bool check_map, bool is_broken) {
  const bool all = check_map || is_debug_build;
  std::vector<Finding> findings =
      check_numbers(simulation, all ? NumbersOf::everything : NumbersOf::columns);
  if (check_map || (is_debug_build && is_broken)) {
    for (Finding& f : sunder::check_map(simulation)) findings.push_back(std::move(f));
  }
  return findings;
}

/// Where the run stands after a step of `pieces`.
ProgressState progress_of(const RunWork& work, std::size_t pieces, const FrameClock* clock) {
  const SimulationState& state = *work.simulation.state;
  return {.step = state.step,
          .steps = work.steps(),
          .time = simulated_time(work.simulation),
          .pieces = pieces,
          .fans = state.fans,
          .slowed = clock ? clock->slowed() : 0};
}

/// Steps until the end, a failure, an interruption, a departure from the log, or an output that
/// cannot be written.
ExitCode step_to_end(const RunWork& work, const RunArguments& arguments, FrameClock* clock) {
  Simulation& simulation = work.simulation;
  const std::uint64_t steps = work.steps();
  if (const std::vector<Finding> damaged = damage(simulation, arguments.check_map, false);
      !damaged.empty()) {
    tell_beside(damaged, arguments);
    return ExitCode::failed;
  }
  const std::size_t pieces = living_components(simulation.state->mechanics).size();
  const double end = static_cast<double>(steps) * simulation.scene.integrator.time_step;
  Progress progress(arguments.quiet, progress_of(work, pieces, nullptr),
                    {work.recorder.expected(), simulated_time(simulation), end});
  const auto say = [&](const std::vector<Finding>& findings) {
    if (findings.empty()) return;
    const auto held = progress.hold();
    tell_beside(findings, arguments);
  };
  const StepObserver note_part = [&](const Simulation& now, const PartReport&) {
    progress.reach(simulated_time(now), now.state->fans);
  };
  const auto keep = [&] { start_is_kept = work.recorder.keep(simulation); };
  keep();
  while (simulation.state->step < steps) {
    if (was_interrupted) return ExitCode::interrupted;
    const auto start = std::chrono::steady_clock::now();
    const StepReport report = advance(simulation, note_part);
    start_is_kept = false;  // the step has come to its end: nothing of it is to be cut short
    const std::chrono::duration<double, std::milli> ms = std::chrono::steady_clock::now() - start;
    const std::vector<Finding> unwritten = work.recorder.record(simulation, report, ms.count());
    say(unwritten);
    if (has_error(unwritten)) return ExitCode::not_written;
    if (const std::optional<Finding> departed = departure_of(work, {})) {
      say({*departed});
      return ExitCode::departed;
    }
    std::vector<Finding> damaged =
        damage(simulation, arguments.check_map, !report.fracture.fans.empty());
    if (std::optional<Finding> failure = step_failure(report, simulation)) {
      damaged.push_back(std::move(*failure));
    }
    // A step that was cut short took its rest at once, and may fail by that alone.
    if (!damaged.empty() && !hurry) {
      say(damaged);
      return ExitCode::failed;
    }
    if (was_interrupted) return ExitCode::interrupted;
    keep();
    if (clock) clock->keep_up(report.time);
    progress.show(progress_of(work, report.components, clock));
  }
  return ExitCode::fine;
}

/// How a run ended, for its files: a replay ends as the run of its log.
RunEnd end_of(ExitCode ended, const std::optional<Replay>& replay) {
  if (ended == ExitCode::fine) return replay ? replay->end : RunEnd::finished;
  return ended == ExitCode::interrupted ? RunEnd::interrupted : RunEnd::failed;
}

/// The log to repeat, if one is wanted, and whether all is well.
bool read_log(std::optional<Replay>& replay, const RunArguments& arguments, const SceneFile& file,
              const std::filesystem::path& folder) {
  if (arguments.replay.empty()) return true;
  std::error_code missing;
  if (std::filesystem::equivalent(arguments.replay, folder / "events.jsonl", missing)) {
    tell_beside({{.code = "log_in_output_folder",
                  .text = fmt::format("{} would be replaced by the replay's own log",
                                      arguments.replay.string()),
                  .remedy = "give another folder with -o"}},
                arguments);
    return false;
  }
  Result<Replay> log = read_replay(arguments.replay, {scene_hash(file), step_count(file.scene)});
  tell(log.findings, arguments);
  replay = std::move(log.value);
  return replay.has_value();
}

/// out/NAME for NAME.json; a name of dots alone would lead elsewhere.
std::filesystem::path usual_folder(const std::filesystem::path& scene) {
  const std::string name = scene.stem().string();
  return std::filesystem::path("out") / (name == "." || name == ".." ? "scene" : name);
}

/// The folder for one run, or why not: somebody writes there, or an earlier run lies there.
std::optional<FolderLock> take_folder(const std::filesystem::path& folder, bool may_replace,
                                      const Telling& telling) {
  Result<FolderLock> lock = FolderLock::take(folder);
  tell(lock.findings, telling);
  if (!lock) return std::nullopt;
  if (const std::optional<Finding> link = link_among_files(folder)) {
    tell({*link}, telling);
    return std::nullopt;
  }
  if (!may_replace && holds_a_run(folder)) {
    tell(
        {{.code = "folder_holds_a_run",
          .text = fmt::format("an earlier run lies in {}", folder.string()),
          .remedy = fmt::format("give another folder with -o, replace it with --force, or continue "
                                "it: sunder run --resume {}",
                                folder.string())}},
        telling);
    return std::nullopt;
  }
  return std::move(*lock);
}

/// Steps a run to its end and writes the results that are only known there.
ExitCode end_run(const RunWork& work, const RunArguments& arguments,
                 const std::filesystem::path& folder) {
  const Simulation& simulation = work.simulation;
  Recorder& recorder = work.recorder;
  std::optional<FrameClock> clock;
  if (arguments.realtime) clock.emplace();
  Stages stages(arguments);
  ExitCode ended = step_to_end(work, arguments, clock ? &*clock : nullptr);
  stages.done(fmt::format("stepped to step {}, {:.6g} s", steps_taken(simulation),
                          simulated_time(simulation)));
  if (ended == ExitCode::fine) {
    if (const std::optional<Finding> fault = recorder.report_fault(simulation)) {
      tell_beside({*fault}, arguments);
      ended = ExitCode::failed;
    }
  }
  const std::vector<Finding> unwritten = with_progress("writing the last files", arguments, [&] {
    return recorder.finish(simulation, end_of(ended, work.replay));
  });
  tell_beside(unwritten, arguments);
  if (ended == ExitCode::fine || ended == ExitCode::failed) {
    if (const std::optional<Finding> departed = departure_of(work, ended)) {
      tell_beside({*departed}, arguments);
      ended = ExitCode::departed;
    }
  }
  stages.done("finished the files");
  const std::vector<Finding> warnings = all_warnings(recorder.statistics(), simulation.scene);
  tell_beside(warnings_on_the_way(recorder.statistics(), simulation.scene), arguments);
  if (ended == ExitCode::fine && arguments.strict && !warnings.empty()) ended = ExitCode::warned;
  const nlohmann::ordered_json& report = recorder.report();
  if (arguments.json) {
    print_json(report);
  } else {
    print_text(stdout, summary_table(report));
  }
  if (clock) print(arguments.json ? stderr : stdout, "{}", frame_line(clock->report()));
  if (!arguments.json) print("{:<14} {}\n", "written to", folder.string());
  if (const std::optional<std::uint64_t> step = recorder.saved_step()) {
    remark(fmt::format("saved after step {}: sunder run --resume {} goes on from there\n", *step,
                       shell_word(folder.string())),
           arguments);
  }
  const bool reached_end = ended == ExitCode::fine || ended == ExitCode::warned;
  return reached_end && has_error(unwritten) ? ExitCode::not_written : ended;
}

/// A run that goes on, or the exit code of why it does not.
struct Resumed {
  std::optional<RunOnItsWay> run;
  ExitCode refused = ExitCode::bad_input;
};

Resumed taken_up(Result<RunOnItsWay> run, const RunArguments& arguments) {
  tell(run.findings, arguments);
  const auto is_about_writing = [](const Finding& f) { return f.code == "cannot_write"; };
  if (!run) {
    return {{},
            std::ranges::any_of(run.findings, is_about_writing) ? ExitCode::not_written
                                                                : ExitCode::bad_input};
  }
  run->simulation.threads = arguments.threads;
  run->simulation.reports_forces = !due_history_rows(run->file).empty();
  run->simulation.hurry = &hurry;
  return {std::move(*run)};
}

Result<SceneFile> read_with_progress(const RunArguments& arguments) {
  return with_progress("reading the scene", arguments, [&] {
    return read_scene(arguments.scene, arguments.settings, arguments.reach);
  });
}

/// The run of a folder at step `from` in another one; by the scene's settings from there on, if a
/// scene is given.
Resumed branch_off(const RunArguments& arguments) {
  std::optional<SceneFile> changed;
  if (!arguments.scene.empty()) {
    Result<SceneFile> file = read_with_progress(arguments);
    tell(file.findings, arguments);
    if (!file) return {};
    changed = std::move(*file);
  }
  const auto copy = [&] { return copy_run(arguments.resume, *arguments.from, arguments.folder); };
  Resumed start = taken_up(with_progress("reading the checkpoint", arguments, copy), arguments);
  if (!start.run) return start;
  if (const std::uint64_t steps = step_count(start.run->simulation.scene);
      *arguments.from > steps) {
    tell_beside({{.code = "step_after_end",
                  .text = fmt::format("the run has {}; there is no step {}", counted(steps, "step"),
                                      *arguments.from),
                  .remedy = "give an earlier step; --until extends a run"}},
                arguments);
    return {};
  }
  std::optional<Replay> none;
  const RunWork work{start.run->simulation, start.run->recorder, none, arguments.from};
  if (const ExitCode ended = step_to_end(work, arguments, nullptr); ended != ExitCode::fine) {
    return {{}, ended};
  }
  std::vector<Finding> unwritten = start.run->recorder.save(start.run->simulation);
  if (unwritten.empty() && changed) {
    start = taken_up(change_settings(arguments.folder, *changed), arguments);
    if (start.run) unwritten = start.run->recorder.save(start.run->simulation);
  }
  tell_beside(unwritten, arguments);
  if (has_error(unwritten)) return {{}, ExitCode::not_written};
  return start;
}

/// Goes on with the run of a folder, in it or (`from`) in another.
ExitCode go_on_with(const RunArguments& arguments) {
  if (!holds_a_run(arguments.resume)) {
    tell(read_checkpoint(arguments.resume).findings, arguments);
    return ExitCode::bad_input;
  }
  const std::filesystem::path folder = arguments.from ? arguments.folder : arguments.resume;
  const std::optional<FolderLock> lock =
      take_folder(folder, !arguments.from || arguments.force, arguments);
  if (!lock) return ExitCode::not_written;
  writes_files = true;
  Stages stages(arguments);
  const auto resume = [&] { return resume_run(folder, arguments.until); };
  Resumed resumed =
      arguments.from
          ? branch_off(arguments)
          : taken_up(with_progress("reading the checkpoint", arguments, resume), arguments);
  if (!resumed.run) return resumed.refused;
  stages.done(fmt::format("took up the run of {}", arguments.resume.string()));
  const Simulation& simulation = resumed.run->simulation;
  remark(fmt::format("{}; goes on from step {} (t = {:.6g} s)\n", scene_line(simulation.scene),
                     steps_taken(simulation), simulated_time(simulation)),
         arguments);
  std::optional<Replay> none;
  return end_run({resumed.run->simulation, resumed.run->recorder, none}, arguments, folder);
}

}  // namespace

ExitCode run_scene(const RunArguments& arguments) {
  watch_for_interrupt();
  if (!arguments.resume.empty()) return go_on_with(arguments);
  Stages stages(arguments);
  Result<SceneFile> file = read_with_progress(arguments);
  tell(file.findings, arguments);
  if (!file) return ExitCode::bad_input;
  stages.done(fmt::format("read {} with its meshes", arguments.scene.string()));
  if (arguments.realtime) set_frame_budget(file->scene.fracture);
  const std::filesystem::path folder =
      arguments.folder.empty() ? usual_folder(arguments.scene) : arguments.folder;
  std::optional<Replay> replay;
  if (!read_log(replay, arguments, *file, folder)) return ExitCode::bad_input;
  const ExpectedTime expected = expected_time(file->scene);
  const double seconds = expected.between(0, file->scene.duration);
  remark(
      fmt::format("{}; {} of computing expected\n", scene_line(file->scene), time_words(seconds)),
      arguments);
  if (arguments.verbose) remark(settings_lines(*file, expected), arguments);
  Result<Simulation> simulation = with_progress("building the simulation", arguments,
                                                [&] { return build_simulation(file->scene); });
  tell(simulation.findings, arguments);
  if (!simulation) return ExitCode::bad_input;
  stages.done(fmt::format("built the simulation, bodies: {}", file->scene.bodies.size()));
  simulation->threads = arguments.threads;
  simulation->reports_forces = !due_history_rows(*file).empty();
  // With the criterion `energy` strengths come from the search: it is made and compared with the
  // log.
  if (replay && file->scene.fracture.criterion != FractureCriterion::energy) {
    simulation->state->script = replay->script;
  }

  writes_files = true;
  simulation->hurry = &hurry;
  const std::optional<FolderLock> lock = take_folder(folder, arguments.force, arguments);
  if (!lock) return ExitCode::not_written;
  Result<Recorder> recorder = with_progress("opening the files", arguments, [&] {
    return Recorder::open(
        {folder, *file, replay ? replay->counts : nlohmann::ordered_json(), expected}, *simulation,
        std::move(simulation.findings));
  });
  tell(recorder.findings, arguments);
  if (!recorder) return ExitCode::not_written;
  stages.done(fmt::format("opened the files of {}", folder.string()));
  return end_run({*simulation, *recorder, replay}, arguments, folder);
}

}  // namespace sunder
