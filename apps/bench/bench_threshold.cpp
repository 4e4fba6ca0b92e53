// SPDX-License-Identifier: MIT
// Threshold tests timed on stresses of the three scenes and on random ones.
#include "apps/bench/bench_threshold.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <nlohmann/json.hpp>
#include <random>

#include "apps/bench/bench_figures.hpp"
#include "apps/bench/clock.hpp"
#include "apps/bench/paper/bench_paper_run.hpp"
#include "apps/bench/paper/bench_paper_tables.hpp"
#include "apps/scene/json_text.hpp"
#include "fracture/algorithms/threshold_test.hpp"
#include "topology/suite/fixtures/shapes.hpp"

namespace sunder {
namespace {

constexpr std::array<std::pair<std::string_view, ThresholdTest>, 4> tests = {
    {{"eigenvalues", ThresholdTest::eigenvalues},
     {"gershgorin", ThresholdTest::gershgorin},
     {"exact", ThresholdTest::exact},
     {"chain", ThresholdTest::chain}}};

/// Appends the part of a sample that stays below its thresholds.
void add_unbroken(StressSample& unbroken, const StressSample& sample) {
  for (std::size_t v = 0; v < sample.stress.size(); ++v) {
    if (test_threshold(sample.stress[v], sample.strength[v]) != ThresholdAnswer::below) continue;
    unbroken.stress.push_back(sample.stress[v]);
    unbroken.strength.push_back(sample.strength[v]);
  }
}

/// Symmetric tensors with entries uniform in [-1, 1] times a scale. The scale is uniform in
/// logarithm from 1e-3 to 1 times the threshold: most tensors are far below it, as in a body.
StressSample random_stresses(std::uint64_t seed) {
  constexpr double xi = 3e6;
  std::mt19937_64 random(seed);
  StressSample sample;
  while (sample.stress.size() < 100'000) {
    const double scale = xi * std::pow(10, -3 * suite::unit(random));
    Mat3 sigma;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j <= i; ++j) {
        sigma(i, j) = sigma(j, i) = scale * (2 * suite::unit(random) - 1);
      }
    }
    add_unbroken(sample, {{sigma}, {xi}});
  }
  return sample;
}

/// Median over the runs of the time of one pass, ns a tensor.
double time_test(const StressSample& sample, ThresholdTest way, int runs) {
  // The results must be used, or the compiler would leave out the computation.
  volatile std::size_t sink = 0;
  // Short samples are gone through several times, since the clock costs 0.3 us.
  const std::size_t passes = 1 + 20'000 / sample.stress.size();
  std::vector<double> ns;
  for (int k = 0; k <= runs; ++k) {
    std::size_t found = 0, suspects = 0;
    const double start = thread_us();
    for (std::size_t pass = 0; pass < passes; ++pass) {
      for (std::size_t v = 0; v < sample.stress.size(); ++v) {
        found += test_threshold(sample.stress[v], sample.strength[v], way, suspects) ==
                 ThresholdAnswer::reached;
      }
    }
    const double us = thread_us() - start;
    // The first run warms up.
    if (k > 0) ns.push_back(1e3 * us / static_cast<double>(passes * sample.stress.size()));
    sink = sink + found + suspects;
  }
  return median(std::move(ns));
}

void add_figures(ThresholdBench& bench, const std::string& source, const StressSample& sample) {
  if (sample.stress.empty()) return;
  std::size_t suspects = 0;
  for (std::size_t v = 0; v < sample.stress.size(); ++v) {
    test_threshold(sample.stress[v], sample.strength[v], ThresholdTest::chain, suspects);
  }
  const double n = static_cast<double>(sample.stress.size());
  for (const auto& [name, way] : tests) {
    bench.figures.push_back({source, sample.stress.size(), static_cast<double>(suspects) / n,
                             std::string(name), time_test(sample, way, bench.runs)});
  }
}

}  // namespace

Result<ThresholdBench> bench_threshold(const ThresholdBenchSettings& settings,
                                       const std::function<void(const std::string&)>& progress) {
  Result<ThresholdBench> result;
  ThresholdBench bench{machine_name(), std::max(1, settings.runs), settings.seed, {}};
  for (const PaperScene& scene : paper_scenes()) {
    progress(std::string(scene.name));
    // The beginnings reach into the cracks of each scene.
    PaperRunSettings run{.scene = settings.scenes / (std::string(scene.name) + ".json"),
                         .changes = {},
                         .steps = scene.quick_steps,
                         .sample_every = std::max<std::uint64_t>(1, scene.quick_steps / 20)};
    Result<PaperRun> made = run_paper_scene(run);
    for (Finding& f : made.findings) result.findings.push_back(std::move(f));
    if (!made) return result;
    StressSample unbroken;
    for (const StressSample& sample : made->stress_samples) add_unbroken(unbroken, sample);
    add_figures(bench, std::string(scene.name), unbroken);
  }
  progress("random tensors");
  add_figures(bench, "random", random_stresses(settings.seed));
  result.value = std::move(bench);
  return result;
}

std::string threshold_table(const ThresholdBench& bench) {
  std::string out = fmt::format(
      "{}; ns a tensor below its threshold, medians of {} passes, random tensors of seed {}\n"
      "\n{:<10}{:>9}{:>13}",
      bench.machine, bench.runs, bench.seed, "source", "tensors", "let through");
  for (const auto& [name, way] : tests) fmt::format_to(std::back_inserter(out), "{:>13}", name);
  std::string source;
  for (const ThresholdFigure& f : bench.figures) {
    if (f.source != source) {
      fmt::format_to(std::back_inserter(out), "\n{:<10}{:>9}{:>11.1f} %", f.source, f.tensors,
                     100 * f.let_through);
      source = f.source;
    }
    fmt::format_to(std::back_inserter(out), "{:>13.2f}", f.ns);
  }
  return out + "\n";
}

std::string threshold_csv(const ThresholdBench& bench) {
  std::string out = fmt::format("# sunder bench threshold on {}\n# medians of {} passes, seed {}\n",
                                bench.machine, bench.runs, bench.seed);
  out += "source,tensors,let_through,test,ns\n";
  for (const ThresholdFigure& f : bench.figures) {
    fmt::format_to(std::back_inserter(out), "{},{},{:.6g},{},{:.6g}\n", f.source, f.tensors,
                   f.let_through, f.test, f.ns);
  }
  return out;
}

std::string threshold_json(const ThresholdBench& bench) {
  nlohmann::ordered_json figures = nlohmann::ordered_json::array();
  for (const ThresholdFigure& f : bench.figures) {
    figures.push_back({{"source", f.source},
                       {"tensors", f.tensors},
                       {"let_through", f.let_through},
                       {"test", f.test},
                       {"ns", f.ns}});
  }
  const nlohmann::ordered_json answer = {
      {"machine", bench.machine}, {"runs", bench.runs}, {"seed", bench.seed}, {"figures", figures}};
  return json_text(answer) + "\n";
}

}  // namespace sunder
