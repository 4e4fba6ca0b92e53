// SPDX-License-Identifier: MIT
// Fans cut again and threshold tests, each timed by itself.
#include "apps/bench/paper/bench_paper_fans.hpp"

#include "apps/bench/clock.hpp"
#include "fracture/algorithms/choose_fan.hpp"
#include "fracture/algorithms/split_fan.hpp"
#include "fracture/algorithms/threshold_test.hpp"

namespace sunder {
namespace {

constexpr std::array<Detection, 4> all_ways = {Detection::walk, Detection::dirty_counter,
                                               Detection::oracle, Detection::exact};

/// One fan, once.
struct FanTime {
  double choose_us = 0, split_us = 0;
  std::size_t visited = 0;
  bool separated = false, predicted = false;
};

/// Cuts the fans of one round: their planes are known, the choice is only timed.
void cut_round(std::vector<FanTime>& times, Simulation& sim, std::span<const RecordedFan> fans,
               ComponentScratch& scratch) {
  Cells& cells = sim.state->cells;
  std::vector<VertexStar> stars;
  std::vector<double> choose_us;
  for (const RecordedFan& fan : fans) {
    const double start = wall_us();
    stars.push_back(vertex_star(cells.map, fan.vertex));
    choose_fan(cells, stars.back(), PrincipalTension{1, fan.normal});
    choose_us.push_back(wall_us() - start);
  }
  for (std::size_t k = 0; k < fans.size(); ++k) {
    const double start = wall_us();
    const FanEvent event = split_fan({cells, sim.state->mechanics}, stars[k], fans[k].normal,
                                     sim.scene.fracture, scratch);
    times.push_back({choose_us[k], wall_us() - start, event.visited, event.components.created > 0,
                     event.components.predicted > 0});
  }
}

std::vector<FanTime> cut_all(Simulation& sim, std::span<const RecordedFan> fans, Detection way) {
  sim.scene.fracture.detection = way;
  std::vector<FanTime> times;
  ComponentScratch scratch;
  for (std::size_t first = 0, end = 0; first < fans.size(); first = end) {
    end = first + 1;
    while (end < fans.size() && fans[end].same_round) ++end;
    cut_round(times, sim, fans.subspan(first, end - first), scratch);
  }
  return times;
}

/// Median over repeats of one quantity of fan `k`.
template <class Quantity>
double median_of(std::span<const std::vector<FanTime>> repeats, std::size_t k, Quantity quantity) {
  std::vector<double> values;
  for (const std::vector<FanTime>& run : repeats) values.push_back(run[k].*quantity);
  return median(std::move(values));
}

/// Sums by class turned into means.
void divide(std::array<double, 2>& sums, const std::array<std::size_t, 2>& counts) {
  for (std::size_t c = 0; c < 2; ++c) {
    if (counts[c] > 0) sums[c] /= static_cast<double>(counts[c]);
  }
}

void add_up(FanReplay& replay, std::span<const std::vector<FanTime>> repeats, Detection way) {
  FanTimes& times = replay.ways[static_cast<std::size_t>(way)];
  replay.fans = {};
  std::array<double, 2> choose{};
  for (std::size_t k = 0; k < repeats.front().size(); ++k) {
    const FanTime& fan = repeats.front()[k];
    const std::size_t c = fan.separated;
    ++replay.fans[c];
    times.split_us[c] += median_of(repeats, k, &FanTime::split_us);
    times.visited[c] += static_cast<double>(fan.visited);
    choose[c] += median_of(repeats, k, &FanTime::choose_us);
    if (way == Detection::walk) replay.missed += fan.separated && !fan.predicted;
  }
  divide(times.split_us, replay.fans);
  divide(times.visited, replay.fans);
  divide(choose, replay.fans);
  if (way == Detection::exact) replay.choose_us = choose;
}

/// Fan by fan, so that a few slow ones do not decide.
double oracle_cost(std::span<const std::vector<FanTime>> walk,
                   std::span<const std::vector<FanTime>> oracle) {
  std::vector<double> ratios;
  for (std::size_t k = 0; k < walk.front().size(); ++k) {
    if (!walk.front()[k].separated) continue;
    ratios.push_back(median_of(oracle, k, &FanTime::split_us) /
                     median_of(walk, k, &FanTime::split_us));
  }
  return ratios.empty() ? 1 : median(std::move(ratios));
}

double time_pass(std::span<const StressSample> samples, int repeats, const auto& test) {
  std::vector<double> ns;
  std::size_t tensors = 0;
  for (const StressSample& sample : samples) tensors += sample.stress.size();
  if (tensors == 0) return 0;
  // The results must be used, or the compiler would leave out the computation.
  volatile std::size_t sink = 0;
  for (int k = 0; k < repeats; ++k) {
    std::size_t found = 0;
    const double start = thread_us();
    for (const StressSample& sample : samples) {
      for (std::size_t v = 0; v < sample.stress.size(); ++v) {
        found += test(sample.stress[v], sample.strength[v]);
      }
    }
    ns.push_back(1e3 * (thread_us() - start) / static_cast<double>(tensors));
    sink = sink + found;
  }
  return median(std::move(ns));
}

}  // namespace

Result<FanReplay> replay_fans(const PaperRunSettings& settings, std::span<const RecordedFan> fans,
                              int repeats) {
  Result<FanReplay> result;
  std::array<std::vector<std::vector<FanTime>>, 4> times;
  for (int k = 0; k < repeats; ++k) {
    // In turn, so that a busy spell of the machine meets all ways alike.
    for (const Detection way : all_ways) {
      Result<Simulation> sim = paper_simulation(settings);
      result.findings = std::move(sim.findings);
      if (!sim) return result;
      times[static_cast<std::size_t>(way)].push_back(cut_all(*sim, fans, way));
    }
  }
  FanReplay replay;
  for (const Detection way : all_ways) add_up(replay, times[static_cast<std::size_t>(way)], way);
  replay.oracle_cost = oracle_cost(times[static_cast<std::size_t>(Detection::walk)],
                                   times[static_cast<std::size_t>(Detection::oracle)]);
  result.value = replay;
  return result;
}

TestTimes time_threshold_tests(std::span<const StressSample> samples, int repeats) {
  TestTimes times;
  times.bound = time_pass(
      samples, repeats, [](const Mat3& sigma, double xi) { return gershgorin_bound(sigma) >= xi; });
  for (std::size_t way = 0; way < times.ways.size(); ++way) {
    times.ways[way] = time_pass(samples, repeats, [&](const Mat3& sigma, double xi) {
      std::size_t suspects = 0;
      return test_threshold(sigma, xi, static_cast<ThresholdTest>(way), suspects) ==
             ThresholdAnswer::reached;
    });
  }
  return times;
}

}  // namespace sunder
