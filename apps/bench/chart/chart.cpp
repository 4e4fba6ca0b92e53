// SPDX-License-Identifier: MIT
// Makes a chart: the grid from the scene, the reference, the runs, the front.
#include "apps/bench/chart/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "apps/bench/chart/chart_ensemble.hpp"
#include "apps/bench/chart/chart_mesh.hpp"
#include "apps/bench/chart/chart_pareto.hpp"
#include "apps/scene/scene_text.hpp"
#include "apps/scene/words.hpp"
#include "mechanics/baselines/verlet.hpp"
#include "mechanics/contact/impact/impact.hpp"

namespace sunder {
namespace {

constexpr std::size_t most_tetrahedra = 20000;
/// Errors of rounding: nothing is more exact.
constexpr double rounding = 1e-15;
/// A reference may take so many times longer than a point.
constexpr double reference_patience = 10;
/// Pieces smaller than two cells of the first mesh in each direction are `debris`.
constexpr double debris_tetrahedra = 8;

Finding bad(const std::string& code, const std::string& text, const std::string& remedy) {
  return {.code = code, .ids = {}, .text = text, .remedy = remedy, .file = ""};
}

/// A chart in the making.
struct ChartWork {
  const ChartArguments& arguments;
  const std::function<void(const std::string&)>& told;
  ChartRunner runner;
  ChartGrid grid;
  Chart chart;
  double scene_step = 0;
  double reference_step = 0;  ///< s, twice the step of the reference
  std::vector<Finding> findings;

  std::size_t meshes() const { return runner.refinements.size(); }
};

/// Rows of the methods that are asked for; all where none is.
void choose_methods(ChartWork& work) {
  std::vector<std::string> known;
  for (const ChartMethod& m : chart_methods()) known.emplace_back(m.name);
  for (const std::string& name : work.arguments.methods) {
    const auto row = std::ranges::find(known, name);
    if (row == known.end()) {
      work.findings.push_back(bad("unknown_method", fmt::format("there is no method '{}'", name),
                                  fmt::format("did you mean '{}'? Known: {}",
                                              nearest_word(name, known), fmt::join(known, "; "))));
    } else {
      work.grid.methods.push_back(static_cast<std::size_t>(row - known.begin()));
    }
  }
  for (std::size_t m = 0; work.arguments.methods.empty() && m < known.size(); ++m) {
    work.grid.methods.push_back(m);
  }
}

void choose_quantity(ChartWork& work) {
  std::vector<std::string> known;
  for (const QuantityTraits& q : quantities()) known.emplace_back(q.name);
  const auto row = std::ranges::find(known, work.arguments.quantity);
  if (row == known.end()) {
    work.findings.push_back(
        bad("unknown_quantity", fmt::format("'{}' is no quantity", work.arguments.quantity),
            fmt::format("did you mean {}? Known: {}", nearest_word(work.arguments.quantity, known),
                        fmt::join(known, ", "))));
    return;
  }
  work.runner.probe.quantity = quantities()[static_cast<std::size_t>(row - known.begin())].quantity;
}

/// `key=a,b,c` as `key=a`, `key=b`, `key=c`, crossed with those of the others before.
void choose_variants(ChartWork& work) {
  std::vector<std::string>& all = work.grid.variants;
  for (const std::string& text : work.arguments.variants) {
    const std::size_t sign = text.find('=');
    if (sign == std::string::npos || !all.empty()) {
      work.findings.push_back(bad("bad_setting", fmt::format("--vary {}", text),
                                  "give one KEY=VALUE,VALUE,... such as "
                                  "--vary contact.max_iterations=10,40,200"));
      return;
    }
    for (std::size_t at = sign + 1; at <= text.size();) {
      const std::size_t end = std::min(text.find(',', at), text.size());
      all.push_back(text.substr(0, sign + 1) + text.substr(at, end - at));
      at = end + 1;
    }
  }
}

/// Which meshes: files that are given, or refinements of the scene's.
void choose_meshes(ChartWork& work, std::size_t tetrahedra) {
  const ChartArguments& a = work.arguments;
  if (a.over_meshes && a.meshes.size() < 2) {
    work.findings.push_back(bad("bad_setting", "--ensemble meshes without two meshes",
                                "give two files or more: --mesh FILE --mesh FILE"));
  }
  if (!a.meshes.empty()) {
    for (const std::string& file : a.meshes) {
      // A scene names meshes relative to its own folder.
      work.runner.mesh_files.push_back(std::filesystem::absolute(file).string());
    }
    work.runner.refinements.assign(a.meshes.size(), 0);
    return;
  }
  const int levels = a.levels >= 0 ? a.levels : 8 * tetrahedra <= most_tetrahedra ? 1 : 0;
  work.runner.refinements.clear();
  for (int k = 0; k <= levels; ++k) work.runner.refinements.push_back(static_cast<std::size_t>(k));
}

/// Steps and windows around those of the scene.
void choose_steps(ChartWork& work, const Scene& scene) {
  const ChartArguments& a = work.arguments;
  work.grid.duration = work.chart.duration = scene.duration;
  work.scene_step = whole_step(scene.duration, scene.integrator.time_step);
  work.grid.steps = a.steps;
  const std::vector<double> factors =
      a.quick ? std::vector{4., 1., 1. / 4, 1. / 16}
              : std::vector{8., 4., 2., 1., 1. / 2, 1. / 4, 1. / 8, 1. / 16};
  for (const double f : factors) {
    if (a.steps.empty()) work.grid.steps.push_back(f * scene.integrator.time_step);
  }
  work.grid.wall_shares = a.quick ? std::vector{2., 0.9, 0.3} : std::vector{2., 0.9, 0.45, 0.2};
  if (scene.obstacles.empty() && scene.bodies.size() < 2) return;
  for (const std::string& word : a.windows) work.grid.windows.push_back(word == "on");
  if (a.windows.empty()) work.grid.windows = {0, 1};
}

/// The point of the scene to follow: given, or the farthest of the mesh's.
void choose_probe(ChartWork& work, const Scene& scene) {
  work.runner.probe.point = Vec3(farthest_point(scene.bodies.front().mesh).data());
  if (work.arguments.probe.empty()) return;
  if (const auto numbers = numbers_of(work.arguments.probe, 3)) {
    work.runner.probe.point = {(*numbers)[0], (*numbers)[1], (*numbers)[2]};
  } else {
    work.findings.push_back(bad("bad_setting", fmt::format("--probe {}", work.arguments.probe),
                                "give three numbers, m, as in --probe 1,0,0.05"));
  }
}

/// The runs of each setting. Meshes that are these are one row of the grid, with the least bound.
void choose_members(ChartWork& work) {
  Chart& chart = work.chart;
  chart.over_meshes = work.runner.over_meshes = work.arguments.over_meshes;
  chart.members = chart.over_meshes ? work.meshes() : work.arguments.members;
  if (!chart.over_meshes) return;
  const std::vector<std::size_t>& all = chart.tetrahedra;
  chart.tetrahedra = {std::accumulate(all.begin(), all.end(), std::size_t{0}) / all.size()};
  work.grid.bounds = {*std::ranges::min_element(work.grid.bounds)};
  work.runner.refinements = {0};
}

/// Everything that follows from the arguments and the scene as it is.
void prepare(ChartWork& work) {
  choose_quantity(work);
  choose_methods(work);
  choose_variants(work);
  work.runner.scene = work.arguments.scene;
  work.runner.changes = work.arguments.settings;
  work.runner.limit = work.arguments.limit;
  work.runner.refinements = {0};
  Result<Simulation> sim = chart_simulation(work.runner, {}, 0);
  work.findings.insert(work.findings.end(), sim.findings.begin(), sim.findings.end());
  if (!sim || has_error(work.findings)) return;
  work.chart.scene = sim->scene.name;
  choose_meshes(work, sim->state->cells.map.corners().size());
  choose_steps(work, sim->scene);
  choose_probe(work, sim->scene);
  for (std::size_t mesh = 0; mesh < work.meshes(); ++mesh) {
    sim = chart_simulation(work.runner, {}, mesh);
    if (!sim) {
      work.findings.insert(work.findings.end(), sim.findings.begin(), sim.findings.end());
      return;
    }
    const std::vector<double>& volumes = sim->state->mechanics.elements.rest_volume;
    work.chart.tetrahedra.push_back(volumes.size());
    if (mesh == 0) {
      work.runner.probe.debris_volume = debris_tetrahedra *
                                        std::accumulate(volumes.begin(), volumes.end(), 0.0) /
                                        static_cast<double>(volumes.size());
    }
    work.grid.bounds.push_back(damped_step_bound(explicit_step_bound(sim->state->mechanics),
                                                 sim->scene.integrator.damping.stiffness_factor));
  }
  choose_members(work);
  // Sub-steps of windows are a cell's travel: only a shorter step is finer.
  work.reference_step = *std::ranges::min_element(work.grid.steps);
  for (const Component& c : sim->state->mechanics.components) {
    if (work.grid.windows.empty() || c.tetrahedra.empty()) continue;
    work.reference_step = std::min(work.reference_step, c.cell_travel / 2);
  }
  work.chart.probe = work.runner.probe;
}

/// The default method on a mesh, at a part of the reference's step and with windows.
ChartOutcome reference_run(ChartWork& work, double part, std::size_t mesh) {
  ChartGrid grid = work.grid;
  grid.methods = {0};
  grid.steps = {part * work.reference_step};
  grid.variants.clear();
  if (!grid.windows.empty()) grid.windows = {1};
  grid.bounds.resize(1);
  const ChartSetting setting = chart_settings(grid).front();
  work.told(fmt::format("reference: step {:.4g} s on {} tetrahedra", setting.step,
                        work.chart.tetrahedra[mesh]));
  ChartRunner patient = work.runner;
  patient.limit *= reference_patience;
  ChartOutcome outcome = run_ensemble(patient, work.chart.members, setting.changes, mesh, false);
  if (outcome.end != ChartEnd::fine) {
    work.findings.push_back(
        bad("no_reference",
            fmt::format("the reference run at a step of {:.4g} s on {} tetrahedra ended as {}: {}",
                        setting.step, work.chart.tetrahedra[mesh], word_of(outcome.end),
                        outcome.reason),
            "give --exact, fewer --levels, longer --steps or a larger --limit"));
  }
  return outcome;
}

/// By a run at half the shortest step and window on the finest mesh, and its neighbours.
void converge_reference(ChartWork& work) {
  const std::size_t finest = work.meshes() - 1;
  const ChartOutcome best = reference_run(work, 0.5, finest);
  if (has_error(work.findings)) return;
  ChartReference& r = work.chart.reference;
  r.value = best.value;
  r.scale = best.scale;
  const double by_step = (reference_run(work, 1, finest).value - r.value).norm() / r.scale;
  // A crack comes at the end of a step or sub-step: two steps may agree by sharing that moment.
  const bool is_time = work.runner.probe.quantity == Quantity::first_fan_time;
  r.own_error = is_time ? std::max(by_step, work.reference_step / 2 / r.scale) : by_step;
  r.how = fmt::format(
      "{} at a step of {:.4g} s on {} tetrahedra; against twice the step and window {:.2g}",
      chart_methods()[0].name, whole_step(work.grid.duration, work.reference_step / 2),
      work.chart.tetrahedra[finest], by_step);
  if (finest == 0) {
    r.how += "; errors are those of time alone, not of the mesh";
  } else {
    const ChartOutcome coarse = reference_run(work, 0.5, finest - 1);
    const double by_mesh = (coarse.value - r.value).norm() / r.scale;
    r.own_error = std::max(by_step, by_mesh);
    r.how += fmt::format(", against the next coarser mesh {:.2g}", by_mesh);
  }
  if (best.values.size() > 1) {
    const double by_chance = band_of(best.values).deviation /
                             std::sqrt(static_cast<double>(best.values.size())) / r.scale;
    r.own_error = std::max(r.own_error, by_chance);
    r.how += fmt::format(", deviation of its mean {:.2g}", by_chance);
  }
}

/// The reference that the user gives.
void exact_reference(ChartWork& work) {
  const QuantityTraits& traits = traits_of(work.runner.probe.quantity);
  const Result<Simulation> sim = chart_simulation(work.runner, {}, work.meshes() - 1);
  const Measure measure(work.runner.probe, *sim);
  ChartReference& r = work.chart.reference;
  if (work.arguments.exact == "start") {
    r.value = measure.at_start();
    r.how = "the value at the start";
  } else if (const auto numbers = numbers_of(work.arguments.exact, traits.is_vector ? 3 : 1)) {
    r.value = traits.is_vector ? Vec3((*numbers)[0], (*numbers)[1], (*numbers)[2])
                               : Vec3((*numbers)[0], 0, 0);
    r.how = fmt::format("given: {} {}", work.arguments.exact, traits.unit);
  } else {
    work.findings.push_back(
        bad("bad_setting", fmt::format("--exact {}", work.arguments.exact),
            fmt::format("give {} {}, or start", traits.is_vector ? "three numbers," : "a number in",
                        traits.unit)));
  }
  r.scale = measure.scale(r.value);
}

std::string label_of(const ChartWork& work, const ChartSetting& s) {
  return fmt::format("{}{}{}, step {:.4g} s, {} tetrahedra", chart_methods()[s.method].name,
                     s.has_window ? ", window" : "", s.variant.empty() ? "" : ", " + s.variant,
                     s.step, work.chart.tetrahedra[s.mesh]);
}

/// Every point of the grid; a series that took too long is not tried at shorter steps.
void run_all(ChartWork& work) {
  std::vector<ChartSetting> settings = chart_settings(work.grid);
  std::vector<ChartPoint>& points = work.chart.points;
  for (std::size_t k = 0; k < settings.size(); ++k) {
    ChartPoint point{std::move(settings[k]), {}};
    work.told(fmt::format("{}/{}: {}", k + 1, settings.size(), label_of(work, point.setting)));
    const bool hopeless = !points.empty() && points.back().setting.series == point.setting.series &&
                          (points.back().outcome.end == ChartEnd::over_limit ||
                           points.back().outcome.end == ChartEnd::skipped);
    if (hopeless) {
      point.outcome.end = ChartEnd::skipped;
      point.outcome.reason = "a longer step was over the limit already";
    } else {
      point.outcome = run_ensemble(work.runner, work.chart.members, point.setting.changes,
                                   point.setting.mesh, true);
    }
    point.outcome.tetrahedra = work.chart.tetrahedra[point.setting.mesh];
    const ChartReference& r = work.chart.reference;
    if (point.outcome.end == ChartEnd::fine) {
      point.error = (point.outcome.value - r.value).norm() / r.scale;
    }
    points.push_back(std::move(point));
  }
}

/// Whether a point is the schema's default at the scene's step, and whether it may be the paper's
/// choice: its own method at a step that it solves; the cheapest of them is taken.
bool is_default(const ChartWork& work, const ChartSetting& s) {
  return s.mesh == 0 && s.method == 0 && s.variant.empty() &&
         s.has_window == !work.grid.windows.empty() &&
         std::abs(s.step / work.scene_step - 1) < 1e-9;
}
bool is_paper(const ChartPoint& p) {
  const ChartSetting& s = p.setting;
  return s.mesh == 0 && s.method == paper_method() && s.variant.empty() && p.outcome.given_up == 0;
}

/// Series run from long steps to short ones: the last point first.
void find_lasting_errors(std::vector<ChartPoint>& points) {
  double worst = 0;
  for (std::size_t k = points.size(); k-- > 0;) {
    ChartPoint& p = points[k];
    if (k + 1 == points.size() || points[k + 1].setting.series != p.setting.series) worst = 0;
    if (p.outcome.end == ChartEnd::fine) {
      worst = p.lasting_error = std::max(worst, p.error);
    } else if (p.outcome.end != ChartEnd::over_limit && p.outcome.end != ChartEnd::skipped) {
      worst = std::numeric_limits<double>::infinity();
    }
  }
}

/// The front, the cheapest within the error, and the two points that stand out.
void find_front(ChartWork& work) {
  Chart& chart = work.chart;
  find_lasting_errors(chart.points);
  std::vector<CostError> fine, lasting;
  std::vector<std::size_t> row;
  for (std::size_t k = 0; k < chart.points.size(); ++k) {
    const ChartPoint& p = chart.points[k];
    if (p.outcome.end != ChartEnd::fine) continue;
    fine.push_back({p.outcome.cost, counted_error(chart.reference, p.error)});
    lasting.push_back({p.outcome.cost, counted_error(chart.reference, p.lasting_error)});
    row.push_back(k);
    if (!chart.default_point && is_default(work, p.setting)) chart.default_point = k;
    const bool cheaper =
        !chart.paper_point || p.outcome.cost < chart.points[*chart.paper_point].outcome.cost;
    if (is_paper(p) && cheaper) chart.paper_point = k;
  }
  for (const std::size_t k : pareto_front(fine)) {
    chart.front.push_back(row[k]);
    chart.points[row[k]].on_front = true;
  }
  if (const auto k = cheapest_within(lasting, chart.within)) chart.cheapest = row[*k];
}

}  // namespace

double counted_error(const ChartReference& reference, double error) {
  return std::max({error, reference.own_error, rounding});
}

Result<Chart> make_chart(const ChartArguments& arguments,
                         const std::function<void(const std::string&)>& told) {
  ChartWork work{arguments, told, {}, {}, {}, 0, 0, {}};
  prepare(work);
  if (!has_error(work.findings)) {
    if (arguments.exact.empty()) {
      converge_reference(work);
    } else {
      exact_reference(work);
    }
  }
  Result<Chart> result;
  if (!has_error(work.findings)) {
    run_all(work);
    work.chart.within = arguments.within;
    find_front(work);
    result.value = std::move(work.chart);
  }
  result.findings = std::move(work.findings);
  return result;
}

}  // namespace sunder
