// SPDX-License-Identifier: MIT
// Members by windows, reach and the clock of the rubble.
#include "fracture/simulation/plan_members.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fracture/simulation/ladder.hpp"
#include "fracture/simulation/ledger/break_energy.hpp"
#include "mechanics/frame/affine_motion.hpp"
#include "mechanics/state/living.hpp"
#include "mechanics/state/wave_travel.hpp"
#include "topology/base/assert.hpp"
#include "topology/base/sort_unique.hpp"
#include "topology/base/whole_number.hpp"

namespace sunder {
namespace {

/// Removes components on the clock of the rubble from the members.
void leave_out(std::vector<char>& members, const std::vector<char>& apart) {
  SUNDER_ASSERT(apart.empty() || apart.size() == members.size(), "a row for everybody");
  for (std::size_t k = 0; k < apart.size(); ++k) members[k] = members[k] && !apart[k];
}

/// All components and balls with a role that `fits` become members of the next part.
template <class Fits>
void take_those(StepPlan& plan, const SimulationState& s, Fits fits) {
  plan.components.clear();
  for (Role role : plan.boundary.component) plan.components.push_back(fits(role));
  leave_out(plan.components, s.ladder.rubble.apart);
  plan.balls.clear();
  for (Role role : plan.boundary.ball) plan.balls.push_back(fits(role));
  leave_out(plan.balls, s.ladder.rubble.ball_apart);
}

/// m/s: the larger of two speeds. One vertex in a hundred of the members exceeds the first, against
/// the affine field that fits their vertices. The fastest obstacle has the second, against their
/// mean.
double speed_among_members(const StepPlan& plan, const SimulationState& s) {
  const VertexColumns& v = s.mechanics.vertices;
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < v.size(); ++i) {
    if (plan.members().has(v.component[i])) rows.push_back(i);
  }
  const AffineMotion field = fit_affine_motion(
      rows.size(), [&](std::size_t k) -> const Vec3& { return v.position[rows[k]]; },
      [&](std::size_t k) -> const Vec3& { return v.velocity[rows[k]]; });
  std::vector<double> squares;
  for (const std::size_t i : rows) {
    squares.push_back((v.velocity[i] - field.at(v.position[i])).squaredNorm());
  }
  double squared = 0;
  if (!squares.empty()) {
    const auto at = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() * 99 / 100);
    std::nth_element(squares.begin(), at, squares.end());
    squared = *at;
  }
  for (const Obstacle& obstacle : s.obstacles) {
    squared = std::max(squared, (obstacle.velocity - field.mean).squaredNorm());
  }
  return std::sqrt(squared);
}

}  // namespace

std::vector<ComponentId> cracked_by(std::span<const FanEvent> fans, const MechanicsState& m) {
  std::vector<ComponentId> cracked;
  const auto add = [&](VertexId v) { cracked.push_back(m.vertices.component[v.index()]); };
  for (const FanEvent& fan : fans) {
    add(fan.vertex);
    for (const FaceSplit& face : fan.faces) {
      for (int i = 0; i < face.vertex_count; ++i) {
        add(face.split_vertices[static_cast<std::size_t>(i)].new_row);
      }
    }
  }
  sort_unique(cracked);
  return cracked;
}

std::uint64_t sub_steps_of_contacts(const StepPlan& plan, const SimulationState& s, double left) {
  constexpr double share_of_cell = 0.1;
  double cell = std::numeric_limits<double>::infinity();  // m
  for (const ComponentId id : open_windows(s.impact)) {
    const Component& c = s.mechanics.components[id.index()];
    if (!c.tetrahedra.empty()) cell = std::min(cell, mean_cell(s.mechanics, c));
  }
  const double speed = speed_among_members(plan, s);
  double longest = left;
  if (speed > 0) longest = std::min(longest, share_of_cell * cell / speed);
  const double count = std::floor(longest / s.impact.sub_step * (1 + 1e-9));
  return whole_number<std::uint64_t>(std::max(1.0, count));
}

void stiffen_members(StepPlan& plan, SimulationState& s) {
  std::vector<char> deforms, separated;
  find_tied(deforms, s);
  for (const ComponentId id : open_windows(s.impact)) deforms[id.index()] = 1;
  find_separated(separated, s);
  for (Component& c : s.mechanics.components) {
    const std::size_t row = c.id.index();
    if (c.rung == Rung::stiff && deforms[row]) c.rung = Rung::full;
    const bool may = plan.members().has(c.id) && c.rung == Rung::full && !c.supported && !c.rigid;
    if (!may || c.tetrahedra.empty() || deforms[row] || !separated[row]) continue;
    plan.released += stop_deforming(s.mechanics, c);
    c.rung = Rung::stiff;
  }
}

void unstiffen_members(SimulationState& s) {
  for (Component& c : s.mechanics.components) {
    if (c.rung == Rung::stiff) c.rung = Rung::full;
  }
}

std::vector<ComponentId> open_windows(const ImpactWindow& window) {
  std::vector<ComponentId> open;
  for (std::size_t c = 0; c < window.quiet.size(); ++c) {
    if (window.quiet[c] != ImpactWindow::closed) open.emplace_back(c);
  }
  return open;
}

void gather_members(StepPlan& plan, const SimulationState& s, double h) {
  plan.reach = reach_of_step(s, plan.gravity, h);
  assign_roles(plan.boundary, s, open_windows(s.impact), plan.reach);
}

void begin_without_rubble(StepPlan& plan, const SimulationState& s) {
  const RubbleState& rubble = s.ladder.rubble;
  if (rubble.apart.empty()) return;
  plan.components.assign(s.mechanics.components.size(), 1);
  leave_out(plan.components, rubble.apart);
  plan.balls.assign(s.obstacles.size(), 1);
  leave_out(plan.balls, rubble.ball_apart);
}

bool anybody_moves(const StepPlan& plan, const SimulationState& s) {
  bool any = false;
  for_each_living(s.mechanics, plan.members(), [&](const Component&) { any = true; });
  for (std::size_t k = 0; k < s.obstacles.size(); ++k) {
    any = any || (s.obstacles[k].mass && plan.members().has_ball(k));
  }
  return any;
}

bool take_the_others(StepPlan& plan, const SimulationState& s) {
  take_those(plan, s, [](Role role) { return role != Role::member; });
  return anybody_moves(plan, s);
}

void take_the_members(StepPlan& plan, const SimulationState& s) {
  take_those(plan, s, [](Role role) { return role != Role::other; });
  std::uint32_t members = 0, carried = 0;
  for_each_living(s.mechanics, {}, [&](const Component& c) {
    members += plan.boundary.component[c.id.index()] == Role::member;
    carried += plan.boundary.component[c.id.index()] == Role::carried;
  });
  plan.impact.components = std::max(plan.impact.components, members);
  plan.impact.carried = std::max(plan.impact.carried, carried);
}

void note_strengths(StepPlan& plan, const Scene& scene, const SimulationState& s) {
  // With the criterion `energy` thresholds of crack tips follow the deformation.
  plan.knows_strengths = scene.fracture.criterion != FractureCriterion::energy;
  note_lowest_strengths(plan.strength, s.mechanics, s.cells);
  for (std::size_t k = 0; k < plan.declared.size(); ++k) {
    if (plan.declared[k]) plan.strength[k] = std::numeric_limits<double>::infinity();
  }
  plan.threshold.clear();
  if (!scene.impact.by_energy) return;
  note_break_energies(plan.threshold, s.mechanics, s.cells, scene.fracture.node_stress,
                      plan.break_energy);
  for (std::size_t k = 0; k < plan.declared.size(); ++k) {
    if (plan.declared[k]) plan.threshold[k] = std::numeric_limits<double>::infinity();
  }
  // Loads can add energy without a bound.
  for (const CornerLoad& load : s.loads) {
    const TetId t = tetrahedron_of(load.corner);
    plan.threshold[s.mechanics.elements.component[t.index()].index()] = 0;
  }
}

}  // namespace sunder
