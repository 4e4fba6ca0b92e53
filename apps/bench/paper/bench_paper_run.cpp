// SPDX-License-Identifier: MIT
// Steps a scene and keeps the data for the paper's tables.
#include "apps/bench/paper/bench_paper_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "apps/bench/clock.hpp"
#include "apps/sunder/run/recorder.hpp"
#include "fracture/algorithms/threshold_test.hpp"
#include "mechanics/element/corotational_force.hpp"
#include "mechanics/element/elastic_force.hpp"
#include "mechanics/state/living.hpp"

namespace sunder {
namespace {

std::vector<double> principal_stresses(std::span<const Mat3> node_stress) {
  std::vector<double> values;
  values.reserve(node_stress.size());
  for (const Mat3& sigma : node_stress) values.push_back(largest_principal_stress(sigma));
  return values;
}

/// Vertices that `break_vertices` would look at now.
StressSample sample_stress(const Simulation& now) {
  const MechanicsState& mechanics = now.state->mechanics;
  const std::vector<Mat3> stress =
      node_stress_of(now.state->cells, mechanics, now.scene.fracture.node_stress);
  StressSample sample;
  for (std::size_t v = 0; v < stress.size(); ++v) {
    const ComponentId id = mechanics.vertices.component[v];
    if (!deforms(mechanics.components[id.index()].rung)) continue;
    sample.stress.push_back(stress[v]);
    sample.strength.push_back(now.state->cells.strength[v]);
  }
  return sample;
}

void time_forces(ModelSample& sample, const Simulation& now) {
  const MechanicsState& state = now.state->mechanics;
  const ElasticInput input{state, now.state->cells.map.corners(), state.vertices.position,
                           ElasticForce::paper};
  const Component& largest = *std::ranges::max_element(
      state.components, {}, [](const Component& c) { return c.tetrahedra.size(); });
  std::vector<Vec3> force(state.vertices.size()), displacement(state.vertices.size());
  const auto time = [](const auto& work) {
    std::array<double, 3> us;
    for (double& each : us) {
      const double start = wall_us();
      work();
      each = wall_us() - start;
    }
    return median({us.begin(), us.end()});
  };
  sample.force_us = time([&] { deformation_forces({displacement, force}, input, largest); });
  sample.corotational_force_us = time([&] { corotational_forces(force, input, largest); });
}

ModelSample sample_models(const Simulation& now) {
  const Cells& cells = now.state->cells;
  MechanicsState state = now.state->mechanics;
  const auto principal = [&](ElasticModel model) {
    MechanicsScratch scratch;
    measure_elements(state, scratch, cells.map.corners(), {.model = model});
    return principal_stresses(node_stress_of(cells, state, NodeStress::mass));
  };
  const std::vector<double> ours = principal(ElasticModel::rigid_reference);
  const std::vector<double> theirs = principal(ElasticModel::corotational);
  ModelSample sample{*std::ranges::max_element(ours), *std::ranges::max_element(theirs)};
  std::vector<double> ratios;
  for (std::size_t v = 0; v < ours.size(); ++v) {
    if (ours[v] > 0 && ours[v] >= 0.5 * sample.largest) ratios.push_back(theirs[v] / ours[v]);
  }
  sample.ratio = ratios.empty() ? 1 : median(std::move(ratios));
  time_forces(sample, now);
  return sample;
}

void add_fan(PaperRun& run, const FanEvent& fan, bool same_round) {
  PaperCounts& counts = run.counts;
  const ComponentUpdate& found = fan.components;
  ++counts.fans;
  counts.faces += fan.faces.size();
  counts.separated += found.created > 0;
  counts.predicted += found.predicted > 0;
  counts.predicted_rightly += found.predicted > 0 && found.created > 0;
  counts.predicted_faces += found.predicted;
  counts.created += found.created;
  run.fans.push_back({fan.vertex, fan.normal, same_round});
}

void add_step(PaperRun& run, const Simulation& now, const StepReport& report) {
  const auto ms = [&](Stage stage) { return report.stage_ms[static_cast<std::size_t>(stage)]; };
  run.step_fans.push_back(static_cast<std::uint32_t>(report.fracture.fans.size()));
  run.fracture_ms.push_back(ms(Stage::fracture) + ms(Stage::rebuild));
  run.stages_ms.push_back(std::accumulate(report.stage_ms.begin(), report.stage_ms.end(), 0.0));
  run.counts.tested += report.fracture.tested;
  run.counts.suspects += report.fracture.suspects;
  run.counts.reached += report.fracture.reached;
  run.counts.still_empty += report.fracture.still_empty;
  const std::vector<FanEvent>& fans = report.fracture.fans;
  for (std::size_t row = 0; row < fans.size(); ++row) {
    add_fan(run, fans[row],
            row > 0 && report.fan_part[row] == report.fan_part[row - 1] &&
                fans[row].round == fans[row - 1].round);
  }
  run.given_up += report.status.solve.not_converged > 0;
  for (const Mat3& sigma :
       node_stress_of(now.state->cells, now.state->mechanics, now.scene.fracture.node_stress)) {
    run.peak_stress = std::max(run.peak_stress, largest_principal_stress(sigma));
  }
}

void count_pieces(PaperRun& run, const Simulation& now) {
  for_each_living(now.state->mechanics, {}, [&](const Component& c) {
    ++run.pieces;
    run.single_tetrahedra += c.tetrahedra.size() == 1;
  });
}

}  // namespace

Result<Simulation> paper_simulation(const PaperRunSettings& settings) {
  Result<SceneFile> file = read_scene(settings.scene, settings.changes);
  Result<Simulation> result;
  result.findings = std::move(file.findings);
  if (!file) return result;
  Result<Simulation> built = build_simulation(std::move(file->scene));
  for (Finding& f : built.findings) result.findings.push_back(std::move(f));
  result.value = std::move(built.value);
  return result;
}

Result<PaperRun> run_paper_scene(const PaperRunSettings& settings) {
  Result<Simulation> sim = paper_simulation(settings);
  Result<PaperRun> result;
  result.findings = std::move(sim.findings);
  if (!sim) return result;
  PaperRun run;
  run.tetrahedra = sim->state->cells.map.tetrahedra();
  run.vertices = sim->state->cells.map.vertices();
  const std::uint64_t steps = std::min(settings.steps, step_count(sim->scene));
  while (sim->state->step < steps && run.failure.empty()) {
    const bool sampled =
        settings.sample_every > 0 && (sim->state->step + 1) % settings.sample_every == 0;
    double watching_us = 0;
    StepObserver observe;
    if (sampled) {
      observe = [&, seen = false](const Simulation& now, const PartReport&) mutable {
        const double start = thread_us();
        if (!seen) run.stress_samples.push_back(sample_stress(now));
        seen = true;
        watching_us += thread_us() - start;
      };
    }
    const double start = thread_us();
    const StepReport report = advance(*sim, observe);
    run.step_ms.push_back(1e-3 * (thread_us() - start - watching_us));
    add_step(run, *sim, report);
    if (sampled) run.model_samples.push_back(sample_models(*sim));
    if (const std::optional<Finding> failure = step_failure(report, *sim)) {
      run.failure = fmt::format("{} at step {} of {}", failure->code, report.step, steps);
    }
  }
  count_pieces(run, *sim);
  result.value = std::move(run);
  return result;
}

}  // namespace sunder
