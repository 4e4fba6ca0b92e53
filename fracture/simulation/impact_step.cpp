// SPDX-License-Identifier: MIT
// Impact windows: which components are stepped finely, from when, until when.
#include <algorithm>
#include <cmath>

#include "fracture/simulation/step_work.hpp"
#include "mechanics/contact/obstacle_geometry.hpp"
#include "mechanics/state/living.hpp"

namespace sunder {
namespace {

/// L/c for which a window stays open after its component last felt a blow: the waves of the last
/// push go to the far end and come back once.
constexpr double waves_stay = 2;

bool is_open(const ImpactWindow& window, std::size_t component) {
  return window.quiet[component] != ImpactWindow::closed;
}

std::vector<ComponentId> open_windows(const ImpactWindow& window) {
  std::vector<ComponentId> open;
  for (std::size_t c = 0; c < window.quiet.size(); ++c) {
    if (is_open(window, c)) open.emplace_back(c);
  }
  return open;
}

/// Opens windows for what is struck. The first one decides the sub-step: the step over a power of
/// two, so that runs whose steps differ by such a power take the same sub-steps.
void open(StepWork& work, const Blows& blows) {
  ImpactWindow& window = work.sim.state->impact;
  if (open_windows(window).empty()) {
    const double halvings =
        std::ceil(std::log2(work.sim.scene.integrator.time_step / blows.sub_step));
    window.sub_step = work.sim.scene.integrator.time_step * std::exp2(-std::max(0.0, halvings));
  }
  for (ComponentId id : blows.struck) {
    work.report.impact.opened += !is_open(window, id.index());
    window.quiet[id.index()] = 0;
  }
}

/// A ball around a component or free sphere.
struct Around {
  Vec3 center;
  double radius;
  char* member;
};

double fastest_speed(const SimulationState& s) {
  double squared = 0;
  for (const Vec3& v : s.mechanics.vertices.velocity) squared = std::max(squared, v.squaredNorm());
  for (const Obstacle& o : s.obstacles) squared = std::max(squared, o.velocity.squaredNorm());
  return std::sqrt(squared);
}

/// Makes members of `seeds` and of all that they could meet in this step, one through the other:
/// whose balls are nearer than four times the farthest way of anything. Twice that is what two
/// bodies do at the present speeds, and an impact can double a speed.
void gather_members(StepWork& work, std::span<const ComponentId> seeds) {
  const SimulationState& s = *work.sim.state;
  const double h = work.sim.scene.integrator.time_step;
  const double way = h * (fastest_speed(s) + h * work.loads.gravity.norm());
  work.components.assign(s.mechanics.components.size(), 0);
  work.balls.assign(s.obstacles.size(), 0);
  std::vector<Around> others, reached;
  for (const Component& c : s.mechanics.components) {
    if (c.tetrahedra.empty()) continue;
    // A deformed body is larger than at rest, by less than this.
    others.push_back({c.centre, 1.1 * c.rest_radius, &work.components[c.id.index()]});
  }
  for (std::size_t k = 0; k < s.obstacles.size(); ++k) {
    if (!s.obstacles[k].mass) continue;
    const Sphere& ball = std::get<Sphere>(s.obstacles[k].shape);
    others.push_back({ball.center, ball.radius, &work.balls[k]});
  }
  for (ComponentId id : seeds) work.components[id.index()] = 1;
  const auto seeds_end =
      std::partition(others.begin(), others.end(), [](const Around& a) { return *a.member == 0; });
  reached.assign(seeds_end, others.end());
  others.erase(seeds_end, others.end());
  while (!reached.empty()) {
    const Around near = reached.back();
    reached.pop_back();
    const auto out = std::partition(others.begin(), others.end(), [&](const Around& other) {
      return (other.center - near.center).norm() > near.radius + other.radius + 4 * way;
    });
    for (auto it = out; it != others.end(); ++it) {
      *it->member = 1;
      reached.push_back(*it);
    }
    others.erase(out, others.end());
  }
}

/// Turns members into all others. True when there are any that could move.
bool take_the_others(StepWork& work) {
  for (char& member : work.components) member = !member;
  for (char& member : work.balls) member = !member;
  const SimulationState& s = *work.sim.state;
  bool any = !living_components(s.mechanics, work.members()).empty();
  for (std::size_t k = 0; k < s.obstacles.size(); ++k) {
    any = any || (s.obstacles[k].mass && work.balls[k]);
  }
  return any;
}

/// One sub-step of the members, with its fractures.
void take_sub_step(StepWork& work) {
  SimulationState& s = *work.sim.state;
  const double length = s.impact.sub_step;
  const PartResult result =
      take_part(work, {{Deformation::wave, 0, &work.sim.scene.impact}, length});
  ImpactReport& report = work.report.impact;
  ++report.sub_steps;
  report.time += length;
  report.coarseness = std::max(report.coarseness, length / result.blows.sub_step);
  for (const Component& c : s.mechanics.components) {
    double& quiet = s.impact.quiet[c.id.index()];
    if (quiet == ImpactWindow::closed) continue;
    quiet += length;
    if (c.tetrahedra.empty() || quiet > waves_stay * extent_travel(s.mechanics, c)) {
      quiet = ImpactWindow::closed;
    }
  }
  for (ComponentId id : result.blows.struck) {
    report.opened += !is_open(s.impact, id.index());
    s.impact.quiet[id.index()] = 0;
  }
  break_members(work);
}

/// Goes on to the sub-step in which the first blow falls, deformations frozen. `left` in sub-steps;
/// gives how many it took.
std::uint64_t approach(StepWork& work, std::uint64_t left, double time) {
  const double sub_step = work.sim.state->impact.sub_step;
  const double most = static_cast<double>(left - 1);
  const auto count = static_cast<std::uint64_t>(std::clamp(std::floor(time / sub_step), 0.0, most));
  if (count == 0) return 0;
  take_part(work, {{Deformation::frozen, 0, &work.sim.scene.impact},
                   static_cast<double>(count) * sub_step});
  return count;
}

/// What is left of the step at once, or the way to the next blow. `left` in sub-steps; gives how
/// many it took.
std::uint64_t take_coarsely(StepWork& work, std::uint64_t left) {
  Simulation& sim = work.sim;
  const ImpactSettings* impact = work.report.impact.stopped ? nullptr : &sim.scene.impact;
  const PartResult rest =
      take_part(work, {{Deformation::catch_up, sim.scene.integrator.time_step, impact},
                       static_cast<double>(left) * sim.state->impact.sub_step});
  if (rest.adopted) {
    break_members(work);
    return left;
  }
  open(work, rest.blows);
  return approach(work, left, rest.blows.time);
}

/// The step of the members, whose first blow falls at `blow` (s). Steps that are no longer than a
/// window lasts at least are sub-stepped whole: to freeze what moves for a part of them would cost
/// more accuracy than it saves.
void advance_members(StepWork& work, double blow) {
  Simulation& sim = work.sim;
  ImpactReport& report = work.report.impact;
  report.components = std::max(
      report.components,
      static_cast<std::uint32_t>(living_components(sim.state->mechanics, work.members()).size()));
  const double count = std::round(sim.scene.integrator.time_step / sim.state->impact.sub_step);
  const bool throughout = count <= waves_stay / sim.scene.impact.fraction;
  auto left = static_cast<std::uint64_t>(count);
  if (!throughout) left -= approach(work, left, blow);
  while (left > 0 && !work.failed()) {
    report.stopped = report.sub_steps >= sim.scene.impact.max_sub_steps;
    const bool fine = throughout || !open_windows(sim.state->impact).empty();
    if (fine && !report.stopped) {
      take_sub_step(work);
      --left;
    } else {
      left -= take_coarsely(work, left);
    }
  }
  if (report.stopped) {
    std::fill(sim.state->impact.quiet.begin(), sim.state->impact.quiet.end(), ImpactWindow::closed);
  }
}

}  // namespace

void advance_with_windows(StepWork& work) {
  Simulation& sim = work.sim;
  SimulationState& s = *sim.state;
  const double h = sim.scene.integrator.time_step;
  const double start = s.mechanics.time;
  const PartPlan whole{{Deformation::whole, 0, &sim.scene.impact}, h};
  double blow = 0;
  if (open_windows(s.impact).empty()) {
    const PartResult all = take_part(work, whole);
    if (all.adopted) return break_members(work);
    open(work, all.blows);
    blow = all.blows.time;
  }
  // The others go first, as long as no blow makes members of them.
  const std::vector<Obstacle> obstacles = s.obstacles;
  for (;;) {
    gather_members(work, open_windows(s.impact));
    if (!take_the_others(work)) break;
    const PartResult others = take_part(work, whole);
    if (others.adopted) break;
    open(work, others.blows);
    blow = std::min(blow, others.blows.time);
  }
  break_members(work);
  if (work.failed()) return;
  for (std::size_t k = 0; k < obstacles.size(); ++k) {
    if (!obstacles[k].mass) s.obstacles[k] = obstacles[k];
  }
  take_the_others(work);
  s.mechanics.time = start;
  advance_members(work, blow);
  if (work.failed()) return;
  for (std::size_t k = 0; k < obstacles.size(); ++k) {
    if (obstacles[k].mass) continue;
    s.obstacles[k] = obstacles[k];
    translate(s.obstacles[k].shape, h * obstacles[k].velocity);
  }
  s.mechanics.time = start + h;
}

}  // namespace sunder
