// SPDX-License-Identifier: MIT
// `quiet SCENE.json SECONDS [FROM]`: fans and impact windows in each twentieth of a run; and each
// fan after FROM seconds (SECONDS / 4) tried again: from a state saved 20 to 40 ms before it, with
// a quarter of the step, does the piece break again until 10 ms after? As two CSVs.
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <string>
#include <vector>

#include "apps/scene/scene_json.hpp"
#include "fracture/saving/saved_state.hpp"
#include "fracture/simulation/simulation_state.hpp"

using namespace sunder;

namespace {

constexpr double kept_for = 0.02, after = 0.01;  // s
constexpr int finer = 4;

using Place = std::array<double, 3>;

/// A vertex and all its copies have one place at rest.
Place place_of(const Vec3& rest) { return {rest[0], rest[1], rest[2]}; }

/// Components that hold a copy of a vertex.
std::set<ComponentId> holders_of(const Simulation& sim, const Place& place) {
  std::set<ComponentId> holders;
  const SimulationState& s = *sim.state;
  for (std::size_t v = 0; v < s.mechanics.vertices.size(); ++v) {
    if (place_of(s.mechanics.vertices.rest_position[v]) != place) continue;
    holders.insert(s.mechanics.vertices.component[v]);
  }
  return holders;
}

/// A fan of the run, and the result for its piece with finer steps.
struct Trial {
  double time = 0, share = 0;  ///< s; stress over strength
  std::size_t tetrahedra = 0;  ///< of the piece
  double speed = 0;            ///< m/s, of its centre 20 to 40 ms before
  double again = NAN;          ///< s, when it broke with finer steps
};

struct Past {
  std::string bytes;
  double time = -1;
};

Trial try_again(const Past& past, const StepReport& report, std::size_t row) {
  const FanEvent& fan = report.fracture.fans[row];
  Trial trial{report.fan_time[row], fan.stress / fan.strength};
  Result<Simulation> sim = restore(past.bytes);
  if (!sim) return trial;
  const std::set<ComponentId> pieces = holders_of(*sim, place_of(fan.rest_position));
  for (ComponentId id : pieces) {
    const Component& piece = sim->state->mechanics.components[id.index()];
    if (piece.tetrahedra.size() < trial.tetrahedra) continue;
    trial.tetrahedra = piece.tetrahedra.size();
    trial.speed = piece.momentum.norm() / piece.mass;
  }
  std::set<Place> places;
  const SimulationState& s = *sim->state;
  for (std::size_t v = 0; v < s.mechanics.vertices.size(); ++v) {
    if (pieces.contains(s.mechanics.vertices.component[v])) {
      places.insert(place_of(s.mechanics.vertices.rest_position[v]));
    }
  }
  sim->scene.integrator.time_step /= finer;
  while (s.mechanics.time < trial.time + after) {
    const StepReport step = advance(*sim);
    if (step.status.outcome != StepOutcome::fine) return trial;
    for (std::size_t k = 0; k < step.fracture.fans.size(); ++k) {
      if (!places.contains(place_of(step.fracture.fans[k].rest_position))) continue;
      trial.again = step.fan_time[k];
      return trial;
    }
  }
  return trial;
}

struct Interval {
  std::size_t fans = 0, opened = 0, window_steps = 0, steps = 0;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3 || argc > 4) {
    std::fputs("usage: quiet SCENE.json SECONDS [FROM]\n", stderr);
    return 2;
  }
  Result<SceneFile> file = read_scene(argv[1]);
  for (const Finding& f : file.findings) std::fprintf(stderr, "%s\n", f.text.c_str());
  if (!file) return 3;
  const double seconds = std::atof(argv[2]);
  const double from = argc > 3 ? std::atof(argv[3]) : seconds / 4;
  Result<Simulation> sim = build_simulation(file->scene);
  if (!sim || !(seconds > 0)) return 3;
  constexpr std::size_t rows = 20;
  std::vector<Interval> intervals(rows);
  std::vector<Trial> trials;
  Past older, newer;
  const double h = sim->scene.integrator.time_step;
  const auto steps = std::lround(seconds / h);
  for (long k = 0; k < steps; ++k) {
    const double now = sim->state->mechanics.time;
    if (now >= from - 2 * kept_for && now >= newer.time + kept_for) {
      older = std::move(newer);
      newer = {saved_state(*sim), now};
    }
    const StepReport report = advance(*sim);
    if (report.status.outcome != StepOutcome::fine) return 5;
    Interval& in = intervals[rows * static_cast<std::size_t>(k) / static_cast<std::size_t>(steps)];
    ++in.steps;
    in.fans += report.fracture.fans.size();
    in.opened += report.impact.opened;
    in.window_steps += report.impact.sub_steps > 0;
    for (std::size_t row = 0; row < report.fracture.fans.size(); ++row) {
      if (report.time >= from && older.time >= 0) trials.push_back(try_again(older, report, row));
    }
  }
  std::puts("until s,fans,windows opened,steps with windows,steps");
  for (std::size_t i = 0; i < rows; ++i) {
    const Interval& in = intervals[i];
    std::printf("%.4g,%zu,%zu,%zu,%zu\n", seconds * static_cast<double>(i + 1) / rows, in.fans,
                in.opened, in.window_steps, in.steps);
  }
  std::puts("\nfan s,stress / strength,tetrahedra,speed before m/s,again s");
  std::size_t again = 0;
  for (const Trial& t : trials) {
    again += !std::isnan(t.again);
    std::printf("%.6g,%.4g,%zu,%.3g,", t.time, t.share, t.tetrahedra, t.speed);
    std::puts(std::isnan(t.again) ? "no" : std::to_string(t.again).c_str());
  }
  std::printf("\n%zu of %zu fans after %g s come again with steps of a quarter\n", again,
              trials.size(), from);
}
