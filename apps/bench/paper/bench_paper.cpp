// SPDX-License-Identifier: MIT
// Which runs there are, and the figures that come of them.
#include "apps/bench/paper/bench_paper.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "apps/bench/bench_figures.hpp"
#include "apps/bench/clock.hpp"
#include "apps/bench/paper/bench_paper_fans.hpp"
#include "apps/bench/paper/bench_paper_phases.hpp"
#include "apps/bench/paper/bench_paper_run.hpp"
#include "apps/bench/paper/bench_paper_tables.hpp"

namespace sunder {
namespace {

/// As the paper has it: the test is made, and never reached.
constexpr const char* unreachable = "bodies.0.material.tensile_strength=1e30";
/// Moments of a run at which stresses are looked at.
constexpr std::uint64_t moments = 40;

/// The runs of one scene in one mode.
struct Columns {
  PaperRun corotational, model, fracture;
};

struct Bench {
  const PaperBenchSettings& settings;
  const std::function<void(const std::string&)>& progress;
  PaperBench result = {};
  std::vector<Finding> findings = {};

  bool failed() const { return has_error(findings); }
};

/// Adds the figures of one scene and mode.
struct PaperSink {
  std::vector<PaperFigure>& figures;
  std::string scene, mode;

  void operator()(std::string_view quantity, double value) const {
    figures.push_back({scene, mode, std::string(quantity), value});
  }
  void operator()(std::string_view quantity, std::size_t value) const {
    (*this)(quantity, static_cast<double>(value));
  }
  /// Nothing where there is no whole.
  void ratio(std::string_view quantity, double part, double whole) const {
    if (whole > 0) (*this)(quantity, part / whole);
  }
};

std::uint64_t steps_of(const Bench& bench, const PaperScene& scene) {
  return bench.settings.quick ? scene.quick_steps : scene.steps;
}

/// The settings of a run; `more`: of the column.
PaperRunSettings run_settings(const Bench& bench, const PaperScene& scene, const PaperMode& mode,
                              std::span<const std::string_view> more) {
  PaperRunSettings run;
  run.scene = bench.settings.scenes / (std::string(scene.name) + ".json");
  run.steps = steps_of(bench, scene);
  for (const std::string_view change : mode.changes) run.changes.emplace_back(change);
  for (const std::string_view change : more) run.changes.emplace_back(change);
  return run;
}

/// Runs a column; on errors of building, an empty run.
PaperRun run_column(Bench& bench, const PaperRunSettings& settings, const std::string& name) {
  if (bench.failed()) return {};
  bench.progress(name);
  Result<PaperRun> run = run_paper_scene(settings);
  for (Finding& f : run.findings) {
    if (f.severity == Severity::error) bench.findings.push_back(std::move(f));
  }
  if (!run) return {};
  if (!run->failure.empty()) {
    bench.result.notes.push_back(fmt::format("{}: {}", name, run->failure));
  }
  return std::move(*run);
}

Columns run_columns(Bench& bench, const PaperScene& scene, const PaperMode& mode) {
  const auto name = [&](const char* column) {
    return fmt::format("{}, {}, {}", scene.name, mode.text, column);
  };
  std::vector<std::string_view> corotational = mode.corotational;
  corotational.emplace_back(unreachable);
  const bool first = &mode == &paper_modes().front();
  const std::uint64_t every = std::max<std::uint64_t>(1, steps_of(bench, scene) / moments);
  const std::array<std::string_view, 1> unbroken = {unreachable};

  Columns columns;
  columns.corotational = run_column(bench, run_settings(bench, scene, mode, corotational),
                                    name("corotational without fractures"));
  PaperRunSettings model = run_settings(bench, scene, mode, unbroken);
  if (first) model.sample_every = every;
  columns.model = run_column(bench, model, name("without fractures"));
  PaperRunSettings fracture = run_settings(bench, scene, mode, {});
  if (first) fracture.sample_every = every;
  columns.fracture = run_column(bench, fracture, name("with fractures"));
  return columns;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

void add_times(const PaperSink& sink, const std::string& column, const PaperRun& run) {
  if (run.step_ms.empty()) return;
  sink(column + "_av", mean(run.step_ms));
  sink(column + "_max", *std::ranges::max_element(run.step_ms));
  sink(column + "_median", median(run.step_ms));
}

void add_table_2(const PaperSink& sink, const Columns& columns) {
  add_times(sink, "corotational", columns.corotational);
  add_times(sink, "model", columns.model);
  add_times(sink, "fracture", columns.fracture);
  sink("steps", columns.fracture.step_ms.size());
  sink.ratio("given_up", static_cast<double>(columns.model.given_up),
             static_cast<double>(columns.model.step_ms.size()));
}

void add_table_3(const PaperSink& sink, const PaperCounts& counts) {
  const auto number = [](std::size_t count) { return static_cast<double>(count); };
  sink.ratio("gershgorin_efficiency", number(counts.reached), number(counts.suspects));
  sink.ratio("gershgorin_retested", number(counts.reached + counts.still_empty),
             number(counts.suspects + counts.still_empty));
  sink("fractures", counts.fans);
  sink("creations", counts.separated);
  sink.ratio("creation_ratio", number(counts.separated), number(counts.fans));
  sink("predictions", counts.predicted);
  sink.ratio("prediction_ratio", number(counts.predicted), number(counts.fans));
  sink.ratio("oracle_efficiency", number(counts.predicted_rightly), number(counts.predicted));
  sink("face_predictions", counts.predicted_faces);
  sink("components_created", counts.created);
  sink.ratio("face_efficiency", number(counts.created), number(counts.predicted_faces));
}

void add_table_4(const PaperSink& sink, const FanReplay& replay) {
  constexpr std::array<const char*, 4> ways = {"walk", "dirty", "oracle", "exact"};
  constexpr std::array<const char*, 2> classes = {"_none", "_new"};
  for (std::size_t c = 0; c < classes.size(); ++c) {
    if (replay.fans[c] == 0) continue;
    for (std::size_t way = 0; way < ways.size(); ++way) {
      const FanTimes& times = replay.ways[way];
      const std::string name = std::string(ways[way]) + classes[c];
      sink(name, 1e-3 * (replay.choose_us[c] + times.split_us[c]));
      if (static_cast<Detection>(way) == Detection::dirty_counter) continue;
      sink(name + "_met", times.visited[c]);
    }
    sink(std::string("plane") + classes[c], 1e-3 * replay.choose_us[c]);
  }
  sink("missed", replay.missed);
  if (replay.fans[1] > 0) sink("oracle_cost", replay.oracle_cost);
}

/// The share of fractures in the time of the steps that have some.
void add_fracture_share(const PaperSink& sink, const PaperRun& run) {
  double part = 0, whole = 0;
  std::vector<double> per_fan;
  for (std::size_t k = 0; k < run.step_fans.size(); ++k) {
    if (run.step_fans[k] == 0) continue;
    part += run.fracture_ms[k];
    whole += run.stages_ms[k];
    per_fan.push_back(run.fracture_ms[k] / run.step_fans[k]);
  }
  sink.ratio("fracture_share", part, whole);
  if (!per_fan.empty()) sink("fracture_fan", median(std::move(per_fan)));
}

void add_phases(const PaperSink& sink, const PaperRun& run) {
  const FracturePhases phases = fracture_phases(run.step_ms, run.step_fans);
  if (phases.breaking_steps == 0) return;
  sink("fracture_max_step", phases.max_step);
  sink("first_break", phases.first_break);
  sink("breaking_steps", phases.breaking_steps);
  sink("phases", phases.phases);
  sink("max_breaks", std::size_t{phases.max_breaks});
  sink("max_in_phase", phases.max_in_phase);
  sink("phase_length", phases.phase_length);
  sink("later_near_max", phases.later_near_max);
}

void add_tests(const PaperSink& sink, const PaperRun& run) {
  const TestTimes times = time_threshold_tests(run.stress_samples, 5);
  if (times.bound == 0) return;
  sink("test_bound", times.bound);
  constexpr std::array<const char*, 4> names = {"test_eigenvalues", "test_gershgorin", "test_exact",
                                                "test_chain"};
  for (std::size_t way = 0; way < names.size(); ++way) sink(names[way], times.ways[way]);
  sink.ratio("test_speed", times.ways[0], times.ways[1]);
}

/// Forces and stresses of both models at the same positions.
void add_models(const PaperSink& sink, const PaperRun& run) {
  if (run.model_samples.empty()) return;
  std::vector<double> force, corotational;
  for (const ModelSample& sample : run.model_samples) {
    force.push_back(1e-3 * sample.force_us);
    corotational.push_back(1e-3 * sample.corotational_force_us);
  }
  sink("same_state_ratio",
       std::ranges::max_element(run.model_samples, {}, &ModelSample::largest)->ratio);
  sink("force", median(std::move(force)));
  sink("corotational_force", median(std::move(corotational)));
}

/// Cuts the fans of a run again.
void add_replay(Bench& bench, const PaperSink& sink, const PaperRunSettings& settings,
                const PaperRun& run) {
  if (bench.failed()) return;
  const Result<FanReplay> replay = replay_fans(settings, run.fans, bench.settings.quick ? 1 : 9);
  if (replay) add_table_4(sink, *replay);
}

/// Runs that shatter less: corotational elements (section 5), and one crack per step (section 7).
void add_gentler_fractures(Bench& bench, const PaperSink& sink, const PaperScene& scene,
                           const PaperMode& mode) {
  const auto add = [&](const char* name, std::span<const std::string_view> changes) {
    const PaperRun run = run_column(bench, run_settings(bench, scene, mode, changes),
                                    fmt::format("{}, {}, {}", scene.name, mode.text, name));
    sink(fmt::format("fractures_{}", name), run.counts.fans);
    sink(fmt::format("pieces_{}", name), run.pieces);
  };
  add("corotational", mode.corotational);
  constexpr std::array<std::string_view, 2> single = {"fracture.mode=budget",
                                                      "fracture.max_fans=1"};
  add("single", single);
}

void measure_mode(Bench& bench, const PaperScene& scene, const PaperMode& mode) {
  const Columns columns = run_columns(bench, scene, mode);
  if (bench.failed()) return;
  const PaperSink sink{bench.result.figures, std::string(scene.name), std::string(mode.name)};
  sink("tetrahedra", columns.model.tetrahedra);
  sink("vertices", columns.model.vertices);
  add_table_2(sink, columns);
  add_table_3(sink, columns.fracture.counts);
  add_fracture_share(sink, columns.fracture);
  add_phases(sink, columns.fracture);
  sink("peak_stress", columns.model.peak_stress);
  sink("peak_stress_corotational", columns.corotational.peak_stress);
  sink("pieces", columns.fracture.pieces);
  const bool first = &mode == &paper_modes().front();
  if (first || &mode == &paper_modes().back()) {
    add_replay(bench, sink, run_settings(bench, scene, mode, {}), columns.fracture);
  }
  if (!first) return;
  add_tests(sink, columns.fracture);
  add_models(sink, columns.model);
  add_gentler_fractures(bench, sink, scene, mode);
}

void add_printed(PaperBench& bench) {
  for (const PaperScene& scene : paper_scenes()) {
    for (const PaperQuantity& q : paper_quantities()) {
      const std::optional<double> value = paper_value(scene.name, q.name);
      if (value) {
        bench.figures.push_back(
            {std::string(scene.name), std::string(theirs), std::string(q.name), *value});
      }
    }
  }
}

/// The medians over repeats, figure by figure: every repeat has the same ones.
std::vector<PaperFigure> medians(const std::vector<std::vector<PaperFigure>>& repeats) {
  std::vector<PaperFigure> result = repeats.front();
  for (std::size_t k = 0; k < result.size(); ++k) {
    std::vector<double> values;
    for (const std::vector<PaperFigure>& repeat : repeats) values.push_back(repeat[k].value);
    result[k].value = median(std::move(values));
  }
  return result;
}

}  // namespace

std::optional<double> figure_of(const PaperBench& bench, std::string_view scene,
                                std::string_view mode, std::string_view quantity) {
  for (const PaperFigure& f : bench.figures) {
    if (f.scene == scene && f.mode == mode && f.quantity == quantity) return f.value;
  }
  return std::nullopt;
}

Result<PaperBench> bench_paper(const PaperBenchSettings& settings,
                               const std::function<void(const std::string&)>& progress) {
  std::vector<std::vector<PaperFigure>> repeats;
  Bench bench{settings, progress};
  for (int k = 0; k < settings.runs && !bench.failed(); ++k) {
    bench.result.figures.clear();
    bench.result.notes.clear();
    for (const PaperScene& scene : paper_scenes()) {
      for (const PaperMode& mode : paper_modes()) measure_mode(bench, scene, mode);
    }
    repeats.push_back(std::move(bench.result.figures));
  }
  Result<PaperBench> result;
  result.findings = std::move(bench.findings);
  if (has_error(result.findings)) return result;
  PaperBench& done = bench.result;
  done.machine = machine_name();
  done.runs = settings.runs;
  done.quick = settings.quick;
  done.figures = medians(repeats);
  add_printed(done);
  result.value = std::move(done);
  return result;
}

}  // namespace sunder
