// SPDX-License-Identifier: MIT
// Runs a scene for a chart.
#include "apps/bench/chart/chart_run.hpp"

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "apps/bench/chart/chart_ensemble.hpp"
#include "apps/bench/chart/chart_mesh.hpp"
#include "apps/bench/clock.hpp"
#include "apps/scene/scene_json.hpp"
#include "apps/sunder/run/recorder.hpp"

namespace sunder {
namespace {

constexpr double timed_ms = 200;
constexpr std::size_t most_runs = 101;

/// Microseconds of work of all threads of the program.
double process_us() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return 1e6 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_nsec);
}

/// Computing time of a step, ms, without `Stage::display`.
double computing(const StepReport& report) {
  double ms = 0;
  for (const Stage stage : {Stage::mechanics, Stage::fracture, Stage::rebuild}) {
    ms += report.stage_ms[static_cast<std::size_t>(stage)];
  }
  return ms;
}

std::string first_error(const std::vector<Finding>& findings) {
  for (const Finding& f : findings) {
    if (f.severity == Severity::error) return fmt::format("{} [{}]", f.text, f.code);
  }
  return "";
}

/// Steps to the end, a failure or the limit; `measure` may be null. Gives the computing time, ms:
/// that of the stages on the wall, less the share in which the machine let others work.
double step_through(Simulation& sim, Measure* measure, double limit, ChartOutcome& outcome) {
  double ms = 0, watching_us = 0;
  StepObserver observe;
  if (measure != nullptr && measure->watches_parts()) {
    observe = [&](const Simulation& now, const PartReport&) {
      const double start = wall_us();
      measure->see_part(now);
      watching_us += wall_us() - start;
    };
  }
  const double start = wall_us(), start_of_work = process_us();
  const std::uint64_t steps = step_count(sim.scene);
  while (sim.state->step < steps) {
    const StepReport report = advance(sim, observe);
    ms += computing(report);
    if (measure != nullptr) {
      measure->see_step(sim, report);
      outcome.fans += report.fracture.fans.size();
      outcome.sub_steps += report.impact.sub_steps;
      outcome.given_up += report.status.solve.not_converged > 0;
      ++outcome.steps;
    }
    if (const std::optional<Finding> failure = step_failure(report, sim)) {
      outcome.end = ChartEnd::failed;
      outcome.reason = fmt::format("{} at {:.4g} s", failure->code, report.time);
      break;
    }
    const double wall = 1e-6 * (wall_us() - start);
    if (wall > limit && sim.state->step < steps) {
      outcome.end = ChartEnd::over_limit;
      outcome.reason = fmt::format("stopped after {:.3g} s at {:.3g} of {:.3g} s", wall,
                                   report.time, sim.scene.duration);
      break;
    }
  }
  const double wall = wall_us() - start, work = process_us() - start_of_work;
  if (measure != nullptr) outcome.wall = 1e-6 * wall;
  // An observer is called inside the stage `mechanics`.
  return (ms - 1e-3 * watching_us) * std::min(1.0, work / wall);
}

/// Repeats a fine run for its time: the same scene takes the same steps.
void time_again(const Simulation& start, ChartOutcome& outcome, std::vector<double> ms) {
  const double duration_ms = 1e3 * start.scene.duration;
  while (ms.size() < most_runs && std::accumulate(ms.begin(), ms.end(), 0.0) < timed_ms) {
    Result<Simulation> again = build_simulation(start.scene);
    if (!again) break;
    ChartOutcome ignored;
    ms.push_back(step_through(*again, nullptr, 1e9, ignored));
  }
  outcome.runs = ms.size();
  outcome.cost = median(std::move(ms)) / duration_ms;
}

}  // namespace

std::string_view word_of(ChartEnd end) {
  static constexpr auto words = std::to_array<std::string_view>(
      {"fine", "nothing_broke", "failed", "over_limit", "skipped", "refused"});
  return words[static_cast<std::size_t>(end)];
}

Result<Simulation> chart_simulation(const ChartRunner& runner, std::span<const std::string> changes,
                                    std::size_t mesh) {
  std::vector<std::string> all = runner.changes;
  if (!runner.mesh_files.empty()) {
    const std::size_t row = runner.over_meshes ? runner.member : mesh;
    all.push_back("bodies.0.mesh=" + runner.mesh_files[row]);
  }
  all.insert(all.end(), changes.begin(), changes.end());
  Result<SceneFile> file = read_scene(runner.scene, all);
  Result<Simulation> result;
  result.findings = std::move(file.findings);
  if (!file) return result;
  for (BodySettings& body : file->scene.bodies) {
    for (std::size_t k = 0; k < runner.refinements[mesh]; ++k) body.mesh = refined(body.mesh);
  }
  if (!runner.over_meshes) move_by_nothing(file->scene, runner.member);
  Result<Simulation> built = build_simulation(std::move(file->scene));
  for (Finding& f : built.findings) result.findings.push_back(std::move(f));
  result.value = std::move(built.value);
  return result;
}

ChartOutcome run_chart(const ChartRunner& runner, std::span<const std::string> changes,
                       std::size_t mesh, bool timed) {
  ChartOutcome outcome;
  Result<Simulation> sim = chart_simulation(runner, changes, mesh);
  if (!sim) {
    outcome.end = ChartEnd::refused;
    outcome.reason = first_error(sim.findings);
    return outcome;
  }
  outcome.tetrahedra = sim->state->cells.map.corners().size();
  Measure measure(runner.probe, *sim);
  outcome.at_start = measure.at_start();
  if (measure.watches_parts()) measure.see_part(*sim);
  const double ms = step_through(*sim, &measure, runner.limit, outcome);
  outcome.cost = ms / (1e3 * sim->scene.duration);
  outcome.runs = 1;
  if (outcome.end != ChartEnd::fine) return outcome;
  const std::optional<Vec3> value = measure.value(*sim);
  if (!value) {
    outcome.end = ChartEnd::nothing_broke;
    outcome.reason = "nothing broke";
    return outcome;
  }
  if (!value->allFinite()) {
    outcome.end = ChartEnd::failed;
    outcome.reason = "the quantity is not a number";
    return outcome;
  }
  outcome.value = *value;
  outcome.scale = measure.scale(*value);
  if (timed) time_again(*sim, outcome, {ms});
  return outcome;
}

}  // namespace sunder
