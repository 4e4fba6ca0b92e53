// SPDX-License-Identifier: MIT
// The rungs of components and the bounds that decide them.
#include "fracture/simulation/ladder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "fracture/simulation/ledger/momentum_ledger.hpp"
#include "mechanics/contact/impact/impact.hpp"
#include "mechanics/element/energy.hpp"
#include "mechanics/integrators/impulse_response.hpp"
#include "mechanics/state/dense_solve.hpp"
#include "mechanics/state/supports.hpp"

namespace sunder {
namespace {

/// The bound may reach this part of the strength: a component that takes its deformation up again
/// swings once about where it would have been.
constexpr double safe_part = 0.5;

/// Pa. The motion of unbreakable components is visible too: they count as breaking at a strain of
/// 1e-4.
double lowest_strength(const SimulationState& s, const Component& component) {
  double lowest = 1e-4 * material_of(s.mechanics, component.tetrahedra.front()).young_modulus;
  for (VertexId v : component.vertices) lowest = std::min(lowest, s.cells.strength[v.index()]);
  return lowest;
}

/// Marks components on a corner of which a surface load acts.
void find_loaded(std::vector<char>& loaded, const SimulationState& s) {
  loaded.assign(s.mechanics.components.size(), 0);
  for (const CornerLoad& load : s.loads) {
    const TetId t = tetrahedron_of(load.corner);
    loaded[s.mechanics.elements.component[t.index()].index()] = 1;
  }
}

}  // namespace

void find_tied(std::vector<char>& tied, const SimulationState& s) {
  tied.assign(s.mechanics.components.size(), 0);
  for (const Tie& tie : s.contact.ties) {
    const TetId t = tetrahedron_of(tie.face);
    tied[s.mechanics.elements.component[t.index()].index()] = 1;
  }
}

void find_separated(std::vector<char>& separated, const SimulationState& s) {
  separated.assign(s.mechanics.components.size(), 0);
  const std::vector<ComponentId>& parent = s.cells.labels.parent;
  for (std::size_t k = 0; k < parent.size(); ++k) {
    if (!parent[k].is_none()) separated[k] = separated[parent[k].index()] = 1;
  }
}

double stop_deforming(MechanicsState& state, const Component& component) {
  VertexColumns& vertices = state.vertices;
  double before = 0, after = 0;
  for (VertexId v : component.vertices) {
    before += 0.5 * vertices.mass[v.index()] * vertices.velocity[v.index()].squaredNorm();
  }
  const Vec3 spin = solve3(world_inertia(state, component), component.angular_momentum);
  for (VertexId v : component.vertices) {
    const Vec3 arm = vertices.position[v.index()] - component.centre;
    vertices.velocity[v.index()] = component.momentum / component.mass + spin.cross(arm);
    vertices.displacement_rate[v.index()].setZero();
    vertices.displacement_acceleration[v.index()].setZero();
    after += 0.5 * vertices.mass[v.index()] * vertices.velocity[v.index()].squaredNorm();
  }
  return before - after;
}

namespace {

/// Largest speed of a vertex in its component's frame over the critical speed xi / (rho c), at
/// which a wave would break it. An acceleration counts as its equivalent speed in the slowest mode.
double swing(const MechanicsState& state, const Component& component, double strength) {
  const Material& material = material_of(state, component.tetrahedra.front());
  const double period = extent_travel(state, component) / 3;
  double fastest = 0;
  for (VertexId v : component.vertices) {
    fastest =
        std::max(fastest, state.vertices.displacement_rate[v.index()].norm() +
                              period * state.vertices.displacement_acceleration[v.index()].norm());
  }
  return fastest * material.density * compression_wave_speed(material) / strength;
}

/// Whether no contact and no blow had to do with the component in this step.
bool is_left_alone(const SimulationState& s, const std::vector<char>& touched,
                   const Component& component) {
  return !touched[component.id.index()] &&
         s.impact.quiet[component.id.index()] == ImpactWindow::closed;
}

/// Whether the component may go rigid or stay so. The motion it gives up must be negligible:
/// outcomes of many blows are chaotic, and a millionth of the critical speed was seen in them late.
bool flies_safely(const SimulationState& s, const Component& component) {
  constexpr double nothing = 1e-7;
  if (component.supported || component.rigid) return false;
  const double strength = lowest_strength(s, component);
  return swing(s.mechanics, component, strength) < nothing &&
         flight_stress_bound(s.mechanics, component) < safe_part * strength;
}

/// Whether three held vertices lie off one line, or single axes held do as much. Else the component
/// turns about them freely, and K alone has no factor.
bool is_held_fast(const MechanicsState& state, const Component& component) {
  if (component.partly_held) return is_fixed_by_axes(state, component);
  constexpr double off_line = 1e-3;
  const VertexColumns& vertices = state.vertices;
  const auto is_held = [&](VertexId v) { return !vertices.support[v.index()].is_none(); };
  const auto first = std::ranges::find_if(component.vertices, is_held);
  if (first == component.vertices.end()) return false;
  const auto from_first = [&](VertexId v) -> Vec3 {
    return vertices.rest_position[v.index()] - vertices.rest_position[first->index()];
  };
  Vec3 along = Vec3::Zero();
  for (VertexId v : component.vertices) {
    if (is_held(v) && from_first(v).squaredNorm() > along.squaredNorm()) along = from_first(v);
  }
  return std::ranges::any_of(component.vertices, [&](VertexId v) {
    return is_held(v) && along.cross(from_first(v)).norm() > off_line * along.squaredNorm();
  });
}

/// Whether the component may go from equilibrium to equilibrium.
bool is_loaded_slowly(const SimulationState& s, const Component& component) {
  constexpr double slow = 1e-3;
  return component.supported && is_held_fast(s.mechanics, component) &&
         swing(s.mechanics, component, lowest_strength(s, component)) < slow;
}

double fastest_vertex(const MechanicsState& state, const Component& component) {
  double squared = 0;
  for (VertexId v : component.vertices) {
    squared = std::max(squared, state.vertices.velocity[v.index()].squaredNorm());
  }
  return std::sqrt(squared);
}

/// Whether the loads from outside are constant in the future.
bool loads_are_steady(const Scene& scene, const SimulationState& s) {
  const double now = s.mechanics.time;
  return now >= scene.gravity.ramp_time &&
         std::ranges::all_of(s.loads, [&](const CornerLoad& l) { return now >= l.ramp_time; });
}

bool is_carried(const MechanicsState& state, const Component& component) {
  return component.supported && std::ranges::any_of(component.vertices, [&](VertexId v) {
           const MotionId motion = state.vertices.support[v.index()];
           return !motion.is_none() && !state.motions[motion.index()].velocity.isZero(0);
         });
}

/// Takes rest from all components that are in contact with awake bodies, directly or through
/// others.
void keep_awake_with_neighbours(LadderScratch& ladder, const SimulationState& s) {
  using Sides = std::array<std::size_t, 2>;
  constexpr std::size_t outside = std::numeric_limits<std::size_t>::max();
  std::vector<char>& rested = ladder.rested;
  std::vector<Sides>& touching = ladder.touching;
  touching.clear();
  for (const ContactMemory::Remembered& last : s.contact.last_contacts) {
    const ContactPoint& c = last.contact;
    Sides sides{outside, outside};
    const auto moves = [&](std::uint32_t row) {
      return row != ContactPoint::none &&
             (s.obstacles[row].mass || !s.obstacles[row].velocity.isZero(0));
    };
    const bool moved = moves(c.ball) || moves(c.obstacle);
    if (c.is_body_a()) sides[0] = component_of_a(c, s.mechanics).index();
    if (c.is_body_b()) sides[1] = component_of_b(c, s.mechanics).index();
    for (const std::size_t side : sides) {
      if (moved && side != outside) rested[side] = 0;
    }
    if (sides[0] != outside && sides[1] != outside) touching.push_back(sides);
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [a, b] : touching) {
      if (rested[a] == rested[b]) continue;
      rested[a] = rested[b] = 0;
      changed = true;
    }
  }
}

/// Marks components that may sleep from now on.
void find_rested(LadderScratch& ladder, SimulationState& s, const Scene& scene) {
  const LadderSettings& settings = scene.ladder;
  // A component at rest may creep by the depth that contact tolerates, within `sleep_after`.
  const double still_speed = scene.contact.allowed_penetration / settings.sleep_after;
  const bool steady = loads_are_steady(scene, s);
  std::vector<char>& rested = ladder.rested;
  s.ladder.still.resize(rested.size(), 0);
  for (const Component& c : s.mechanics.components) {
    // The rubble has a clock of its own.
    if (c.tetrahedra.empty() || c.rung == Rung::rubble) continue;
    double& still = s.ladder.still[c.id.index()];
    const bool moves = !steady || is_carried(s.mechanics, c) ||
                       s.impact.quiet[c.id.index()] != ImpactWindow::closed ||
                       (c.rung != Rung::asleep && fastest_vertex(s.mechanics, c) > still_speed);
    still = moves ? 0 : still + scene.integrator.time_step;
    rested[c.id.index()] = c.rung == Rung::asleep || still >= settings.sleep_after;
  }
  keep_awake_with_neighbours(ladder, s);
}

void count(LadderReport& report, const Component& c) {
  ++report.components[static_cast<std::size_t>(c.rung)];
  report.tetrahedra[static_cast<std::size_t>(c.rung)] += c.tetrahedra.size();
}

/// Gives the kinetic energy that is lost, J.
double fall_asleep(MechanicsState& state, Component& component) {
  double energy = 0;
  component.rung = Rung::asleep;
  component.momentum.setZero();
  component.angular_momentum.setZero();
  for (VertexId v : component.vertices) {
    energy +=
        0.5 * state.vertices.mass[v.index()] * state.vertices.velocity[v.index()].squaredNorm();
    state.vertices.velocity[v.index()].setZero();
    state.vertices.displacement_rate[v.index()].setZero();
    state.vertices.displacement_acceleration[v.index()].setZero();
  }
  return energy;
}

}  // namespace

double flight_stress_bound(const MechanicsState& state, const Component& component) {
  const Material& material = material_of(state, component.tetrahedra.front());
  double energy = 0;
  for (TetId t : component.tetrahedra) energy += element_strain_energy(state, t);
  double lightest = std::numeric_limits<double>::infinity();
  double squared_speed = 0;
  const Vec3 drift = component.momentum / component.mass;
  for (VertexId v : component.vertices) {
    const double m = state.vertices.mass[v.index()];
    lightest = std::min(lightest, m);
    energy += 0.5 * m * state.vertices.displacement_rate[v.index()].squaredNorm();
    squared_speed =
        std::max(squared_speed, (state.vertices.velocity[v.index()] - drift).squaredNorm());
  }
  const double smallest_star = 4 * lightest / material.density;
  const auto [lambda, mu] = lame(material);
  return std::sqrt(2 * (lambda + 2 * mu) * energy / smallest_star) +
         2 * material.density * squared_speed;
}

void note_touches(std::vector<char>& touched, const MechanicsState& m,
                  std::span<const ContactPoint> contacts) {
  for (const ContactPoint& c : contacts) {
    for_each_component(c, m, [&](ComponentId id) { touched[id.index()] = 1; });
  }
}

bool all_rest(const SimulationState& state) {
  return std::ranges::all_of(
             state.mechanics.components,
             [](const Component& c) { return c.tetrahedra.empty() || c.rung == Rung::asleep; }) &&
         std::ranges::all_of(state.obstacles,
                             [](const Obstacle& o) { return !o.mass && o.velocity.isZero(0); });
}

LadderReport choose_rungs(GivenUp& given_up, SimulationState& s, const RungInput& input,
                          LadderScratch& scratch) {
  const LadderSettings& settings = input.scene.ladder;
  const bool climbs = input.scene.integrator.integrator == Integrator::floating_frame;
  scratch.rested.assign(s.mechanics.components.size(), 0);
  if (climbs && settings.sleep) find_rested(scratch, s, input.scene);
  find_loaded(scratch.loaded, s);
  find_tied(scratch.tied, s);
  LadderReport report;
  for (Component& c : s.mechanics.components) {
    if (c.tetrahedra.empty()) continue;
    const std::size_t row = c.id.index();
    if (c.rung == Rung::rubble) {
      count(report, c);
      continue;
    }
    const bool may_leave = climbs && is_left_alone(s, input.touched, c);
    if (scratch.rested[row]) {
      if (c.rung != Rung::asleep) {
        given_up.momentum += momentum_of(c);
        given_up.energy += fall_asleep(s.mechanics, c);
      }
    } else if (may_leave && settings.rigid && !scratch.loaded[row] && flies_safely(s, c)) {
      if (c.rung != Rung::rigid) given_up.energy += stop_deforming(s.mechanics, c);
      c.rung = Rung::rigid;
    } else if (may_leave && settings.quasi_static && !scratch.tied[row] && is_loaded_slowly(s, c)) {
      c.rung = Rung::quasi_static;
    } else {
      c.rung = Rung::full;
    }
    count(report, c);
  }
  return report;
}

}  // namespace sunder
