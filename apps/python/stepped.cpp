// SPDX-License-Identifier: MIT
#include "apps/python/stepped.hpp"

#include <algorithm>
#include <chrono>
#include <iterator>

#include "apps/python/findings.hpp"
#include "apps/sunder/run/due_steps.hpp"
#include "fracture/saving/state_numbers.hpp"
#include "fracture/scene/expected_time.hpp"
#include "fracture/simulation/simulation_state.hpp"

namespace sunder::python {

Stepped::Stepped(const SceneInput& input) {
  file = read_input(input, findings);
  Result<Simulation> built = build_simulation(file->scene);
  findings.insert(findings.end(), built.findings.begin(), built.findings.end());
  simulation = value_of(std::move(built));
  history_steps = due_history_rows(*file);
  simulation.reports_forces = true;
  history = begin_history(simulation);
}

Stepped::Stepped(Simulation saved) : simulation(std::move(saved)) {
  const std::uint64_t steps = step_count(simulation.scene);
  const std::uint64_t stride = usual_history_stride(steps);
  for (std::uint64_t s = 0; s < steps; s += stride) history_steps.push_back(s);
  simulation.reports_forces = true;
  history = begin_history(simulation);
}

StepReport step(Stepped& sim) {
  if (sim.failed) {
    throw Refused{
        {{.code = "simulation_failed",
          .text = "an earlier step of this simulation failed",
          .remedy = "make a new simulation, with shorter steps where they were the cause"}}};
  }
  Simulation& now = sim.simulation;
  const auto start = std::chrono::steady_clock::now();
  sim.failed = true;  // an exception leaves it so
  StepReport report = advance(now);
  const std::chrono::duration<double, std::milli> ms = std::chrono::steady_clock::now() - start;
  if (sim.recorder) refuse_errors(sim.recorder->record(now, report, ms.count()));
  add_step(sim.history, report);
  if (std::ranges::binary_search(sim.history_steps, report.step)) add_row(sim.history, now);
  std::vector<Finding> damaged = check_numbers(now, NumbersOf::columns);
  if (std::optional<Finding> failure = step_failure(report, now)) {
    damaged.push_back(std::move(*failure));
  }
  if (!damaged.empty()) throw Refused{std::move(damaged)};
  sim.failed = false;
  return report;
}

void open_run(Stepped& sim, const std::filesystem::path& folder, bool may_replace) {
  const auto refuse = [](const char* code, std::string text, const char* remedy) {
    throw Refused{{{.code = code, .text = std::move(text), .remedy = remedy}}};
  };
  if (sim.recorder) refuse("run_is_open", "this run is being written", "close the other iterator");
  if (!sim.file) {
    refuse("no_scene_file", "a simulation of a saved state has no settings for the files of a run",
           "run it without a folder, or resume with `sunder run --resume`");
  }
  if (steps_taken(sim.simulation) != 0 || sim.acted) {
    refuse("run_has_begun", "the files of a run begin with step 0 of its scene",
           "make the simulation again and give the folder to its first run");
  }
  sim.lock = value_of(FolderLock::take(folder));
  if (std::optional<Finding> link = link_among_files(folder)) throw Refused{{std::move(*link)}};
  if (!may_replace && holds_a_run(folder)) {
    refuse("folder_holds_a_run", "an earlier run lies in " + folder.string(),
           "give another folder, or force=True to replace it");
  }
  const ExpectedTime expected = expected_time(sim.file->scene);
  Result<Recorder> opened =
      Recorder::open({folder, *sim.file, nullptr, expected}, sim.simulation, sim.findings);
  sim.recorder.emplace(value_of(std::move(opened)));
}

std::vector<Finding> finish_run(Stepped& sim, RunEnd end) {
  if (!sim.recorder) return {};
  std::vector<Finding> findings = sim.recorder->finish(sim.simulation, end);
  sim.recorder.reset();
  sim.lock.reset();
  refuse_errors(findings);
  return findings;
}

std::string history_text(const Stepped& sim) {
  History history = sim.history;
  if (history.last_row != sim.simulation.state->step) add_row(history, sim.simulation);
  return history_csv(history, sim.simulation.scene);
}

}  // namespace sunder::python
