// SPDX-License-Identifier: MIT
// The choice of rubble, a tick, and the way back to components.
#include "fracture/simulation/rubble/rubble_tick.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "fracture/simulation/ladder.hpp"
#include "fracture/simulation/ledger/break_energy.hpp"
#include "fracture/simulation/rubble/islands.hpp"
#include "fracture/simulation/rubble/rigid_pieces.hpp"
#include "fracture/simulation/rubble/rubble_world.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/contact/impact/impact.hpp"
#include "mechanics/contact/impact/impact_energy.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "mechanics/integrators/rigid_motion.hpp"
#include "mechanics/state/dense_solve.hpp"
#include "topology/base/sort_unique.hpp"
#include "topology/base/whole_number.hpp"

namespace sunder {
namespace {

void write_rows(MechanicsState& state, const Component& c, const RubbleBody& body) {
  VertexColumns& vertices = state.vertices;
  const Mat3 R = c.orientation.toRotationMatrix();
  const Vec3 velocity = c.momentum / c.mass;
  const Vec3 own = R.transpose() * c.angular_momentum;
  const Vec3 spin = R * solve3(body.inertia, own);
  for (VertexId v : c.vertices) {
    const std::size_t i = v.index();
    const Vec3 arm = R * (vertices.rest_position[i] - c.rest_centre + vertices.displacement[i]);
    vertices.position[i] = c.centre + arm;
    vertices.velocity[i] = velocity + spin.cross(arm);
  }
}

/// Stops the deformation of a component that takes the rung. Gives its kinetic energy before, J.
double stop_swinging(MechanicsState& state, Component& c) {
  double energy = 0;
  if (c.rung == Rung::asleep || c.rung == Rung::rubble) return energy;
  VertexColumns& vertices = state.vertices;
  for (VertexId v : c.vertices) {
    energy += 0.5 * vertices.mass[v.index()] * vertices.velocity[v.index()].squaredNorm();
    vertices.displacement_rate[v.index()].setZero();
    vertices.displacement_acceleration[v.index()].setZero();
  }
  return energy;
}

/// Bodies back to components and balls.
void take_back(SimulationState& s, const RubbleWorld& world) {
  s.ladder.still.resize(s.mechanics.components.size(), 0);
  for (Component& c : s.mechanics.components) {
    const std::uint32_t row = world.of_component[c.id.index()];
    if (row == RubbleWorld::no_row) continue;
    const RubbleBody& body = world.bodies[row];
    s.ladder.still[c.id.index()] = body.still;
    if (body.asleep && c.rung == Rung::asleep) continue;
    c.centre = body.centre;
    c.orientation = body.orientation;
    c.momentum = body.momentum;
    c.angular_momentum = body.angular_momentum;
    c.rung = body.asleep ? Rung::asleep : Rung::rubble;
    write_rows(s.mechanics, c, body);
  }
  for (std::size_t k = 0; k < s.obstacles.size(); ++k) {
    Obstacle& o = s.obstacles[k];
    if (!o.mass || world.of_obstacle[k] == RubbleWorld::no_row) continue;
    const RubbleBody& body = world.bodies[world.of_obstacle[k]];
    put(o.shape, {body.centre, body.orientation});
    o.velocity = body.momentum / body.mass;
    o.spin = spin_of(o, body.angular_momentum);
  }
}

void add_tick(StepReport& report, const RubbleReport& tick) {
  report.energy.gravity += tick.gravity_work;
  report.energy.contact += tick.contact_work;
  report.energy.numerical += tick.numerical;
  report.energy_released += tick.sleep_energy;
  report.momentum.gravity += tick.gravity;
  report.momentum.obstacles += tick.contact;
  report.momentum.sleep -= tick.sleep;
  report.rubble.ticks += 1;
  report.rubble.awake = std::max(report.rubble.awake, tick.awake);
  report.rubble.asleep = std::max(report.rubble.asleep, tick.asleep);
  report.rubble.points = std::max(report.rubble.points, tick.points);
  report.rubble.deepest = std::max(report.rubble.deepest, tick.deepest);
}

/// m/s, below which chips of a heap are still: a hundredth of the speed after a fall by their own
/// size.
double still_speed(const RubbleWorld& world, const Scene& scene, const Vec3& gravity) {
  double size = 0, count = 0;
  for (const RubbleBody& body : world.bodies) {
    if (body.mass == 0 || !body.in_ledger) continue;
    size += body.radius;
    ++count;
  }
  const double own = scene.contact.allowed_penetration / scene.ladder.sleep_after;
  return std::max(own, 0.005 * std::sqrt(gravity.norm() * size / std::max(count, 1.0)));
}

/// Forgets contacts of the elastic solver with bodies that it steps no more.
void forget_contacts(SimulationState& s, const std::vector<char>& apart) {
  std::erase_if(s.contact.last_contacts, [&](const ContactMemory::Remembered& last) {
    bool is_apart = false;
    for_each_component(last.contact, s.mechanics,
                       [&](ComponentId id) { is_apart = is_apart || apart[id.index()]; });
    return is_apart;
  });
}

/// Components leave the rung if they are not among `members`. Their losses on the rung are
/// forgotten.
void leave_rung(SimulationState& s, const std::vector<char>& members) {
  s.ladder.rubble.spent.resize(s.mechanics.components.size(), 0);
  for (Component& c : s.mechanics.components) {
    const std::size_t k = c.id.index();
    if (k < members.size() && members[k]) continue;
    s.ladder.rubble.spent[k] = 0;
    if (c.rung == Rung::rubble) c.rung = Rung::full;
  }
}

void note_declared_share(StepReport& report, const RubbleTickScratch& scratch,
                         const SimulationState& s) {
  double mass = 0, all = 0;
  for (const Component& c : s.mechanics.components) {
    all += c.mass;
    report.rubble.rigid += c.rigid && !is_isolated(c);
    if (scratch.declared[c.id.index()] != static_cast<char>(Unbreakable::declared)) continue;
    ++report.rubble.declared;
    mass += c.mass;
  }
  report.rubble.declared_share = mass / all;
}

double kinetic_of(const RubbleWorld& world) {
  double sum = 0;
  for (const RubbleBody& body : world.bodies) {
    if (!body.asleep) sum += kinetic_energy(body);
  }
  return sum;
}

RubbleSettings settings_of(const Simulation& sim, const RubbleWorld& world, double tick,
                           const Vec3& gravity) {
  RubbleSettings settings;
  settings.length = tick;
  settings.gravity = gravity;
  settings.slop = sim.scene.contact.allowed_penetration;
  settings.still_speed = still_speed(world, sim.scene, gravity);
  settings.sleep_after = sim.scene.ladder.sleep ? sim.scene.ladder.sleep_after : 0;
  settings.threads = sim.threads;
  return settings;
}

/// Ticks of the rubble that the simulation has not taken over yet.
struct Ticks {
  RubbleWorld world;            ///< as the last one ends
  std::vector<double> kinetic;  ///< J, row = body, as the first one begins
  RubbleMemory memory;
  std::vector<RubbleReport> reports;
  double spent = 0;  ///< J, that contacts took
};

Ticks take_ticks(Simulation& sim, const RubbleChoice& choice, const RubbleClock& clock,
                 const Vec3& gravity) {
  Ticks ticks{.world = make_rubble_world(sim, choice.component, choice.ball),
              .kinetic = {},
              .memory = sim.state->ladder.rubble.memory,
              .reports = {}};
  RubbleWorld& world = ticks.world;
  for (const RubbleBody& body : world.bodies) ticks.kinetic.push_back(kinetic_energy(body));
  const RubbleSettings settings = settings_of(sim, world, clock.tick, gravity);
  for (std::uint64_t k = 0; k < clock.ticks; ++k) {
    const double before = kinetic_of(world);
    const RubbleReport& tick = ticks.reports.emplace_back(
        advance_rubble(world.bodies, world.shapes, ticks.memory, settings,
                       sim.scratch->rubble.solver, nullptr, world.partners));
    ticks.spent += std::max(0.0, before + tick.gravity_work - kinetic_of(world));
  }
  return ticks;
}

/// Whether a blow of the ticks could break the component.
bool is_struck(const Simulation& sim, const Ticks& ticks, const Component& c) {
  const RubbleTickScratch& scratch = sim.scratch->rubble;
  const std::uint32_t row = ticks.world.of_component[c.id.index()];
  if (row == RubbleWorld::no_row || scratch.declared[c.id.index()]) return false;
  const double strength = scratch.strength[c.id.index()];
  return std::ranges::any_of(ticks.reports, [&](const RubbleReport& tick) {
    if (tick.blow.empty()) return false;
    const RubbleBlow& blow = tick.blow[row];
    return blow.energy >= scratch.threshold[c.id.index()] &&
           is_blow(sim.state->mechanics, c, blow.speed, strength, sim.scene.impact);
  });
}

/// Takes islands out of the choice in which a piece is struck. Gives their number.
std::uint32_t leave_out_struck(RubbleChoice& choice, const Simulation& sim, const Ticks& ticks) {
  const std::vector<Component>& components = sim.state->mechanics.components;
  std::vector<std::uint32_t> struck;
  for (const Component& c : components) {
    if (is_struck(sim, ticks, c)) struck.push_back(choice.island[c.id.index()]);
  }
  sort_unique(struck);
  if (struck.empty()) return 0;
  choice.any_awake = false;
  for (std::size_t k = 0; k < choice.island.size(); ++k) {
    const bool is_ball = k >= components.size();
    char& member = is_ball ? choice.ball[k - components.size()] : choice.component[k];
    if (std::ranges::binary_search(struck, choice.island[k])) member = 0;
    choice.any_awake =
        choice.any_awake || (member && (is_ball || components[k].rung != Rung::asleep));
  }
  return static_cast<std::uint32_t>(struck.size());
}

void add_ticks(StepReport& report, Simulation& sim, Ticks&& ticks) {
  RubbleState& rubble = sim.state->ladder.rubble;
  rubble.memory = std::move(ticks.memory);
  for (const RubbleReport& tick : ticks.reports) {
    add_tick(report, tick);
    for (std::size_t o = 0; o < ticks.world.of_obstacle.size() && !tick.given.empty(); ++o) {
      const std::uint32_t row = ticks.world.of_obstacle[o];
      if (row == RubbleWorld::no_row || !sim.reports_forces) continue;
      report.forces.obstacle[o] += tick.given[row];
    }
  }
  // All lost energy counts for every component: islands are not distinguished.
  for (std::size_t c = 0; c < ticks.world.of_component.size(); ++c) {
    if (ticks.world.of_component[c] != RubbleWorld::no_row) rubble.spent[c] += ticks.spent;
  }
}

/// Stops the deformation of components that become rubble. Gives the kinetic energy that they lose,
/// J.
double stop_members(SimulationState& s, const Ticks& ticks) {
  double swinging = 0;
  for (Component& c : s.mechanics.components) {
    const std::uint32_t row = ticks.world.of_component[c.id.index()];
    if (row == RubbleWorld::no_row) continue;
    const bool is_new = c.rung != Rung::asleep && c.rung != Rung::rubble;
    swinging += stop_swinging(s.mechanics, c);
    if (is_new) swinging -= ticks.kinetic[row];
    // No declared piece breaks in a window.
    if (c.id.index() < s.impact.quiet.size()) s.impact.quiet[c.id.index()] = ImpactWindow::closed;
  }
  return swinging;
}

/// The rubble of the tick. Pieces that came off are watched.
RubbleChoice choose_members(StepReport& report, Simulation& sim, double length,
                            const Vec3& gravity) {
  const SimulationState& s = *sim.state;
  RubbleTickScratch& scratch = sim.scratch->rubble;
  note_break_energies(scratch.threshold, s.mechanics, s.cells, sim.scene.fracture.node_stress,
                      sim.scratch->break_energy);
  scratch.watched.assign(s.mechanics.components.size(), 0);
  if (sim.scene.ladder.rubble == RubbleMode::until_struck) {
    find_separated(scratch.watched, s);
    note_lowest_strengths(scratch.strength, s.mechanics, s.cells);
  }
  RubbleChoice choice =
      choose_rubble(sim, {scratch.threshold, scratch.declared, scratch.watched, gravity, length});
  report.rubble.refused += choice.refused;
  report.rubble.mixed += choice.mixed;
  report.rubble.solids += choice.solids;
  return choice;
}

}  // namespace

RubbleClock rubble_clock(double time_step) {
  constexpr double wanted = 1.0 / 240;
  RubbleClock clock;
  clock.steps = whole_number<std::uint64_t>(std::max(1.0, std::round(wanted / time_step)));
  if (clock.steps == 1) {
    clock.ticks = whole_number<std::uint64_t>(std::max(1.0, std::round(time_step / wanted)));
  }
  clock.tick = time_step * static_cast<double>(clock.steps) / static_cast<double>(clock.ticks);
  return clock;
}

void begin_rubble(StepReport& report, Simulation& sim) {
  const Scene& scene = sim.scene;
  SimulationState& s = *sim.state;
  RubbleTickScratch& scratch = sim.scratch->rubble;
  harden_pieces(report, sim);
  note_declared_share(report, scratch, s);
  if (scene.ladder.rubble == RubbleMode::off) return;
  const RubbleClock clock = rubble_clock(scene.integrator.time_step);
  RubbleState& rubble = s.ladder.rubble;
  if (s.step % clock.steps != 0) return;
  // The choice has no effect then; it is made again when something moves.
  if (all_rest(s)) return;
  const double whole = clock.tick * static_cast<double>(clock.ticks);
  const Vec3 gravity = gravity_at(scene.gravity, s.mechanics.time + whole);
  RubbleChoice choice = choose_members(report, sim, whole, gravity);
  std::optional<Ticks> ticks;
  if (choice.any_awake) ticks = take_ticks(sim, choice, clock, gravity);
  if (ticks && scene.ladder.rubble == RubbleMode::until_struck) {
    const std::uint32_t struck = leave_out_struck(choice, sim, *ticks);
    report.rubble.struck += struck;
    if (struck > 0) ticks.reset();
    if (struck > 0 && choice.any_awake) ticks = take_ticks(sim, choice, clock, gravity);
  }
  leave_rung(s, choice.component);
  rubble.apart = std::move(choice.component);
  rubble.ball_apart = std::move(choice.ball);
  if (!ticks) {
    if (std::ranges::find(rubble.apart, char{1}) == rubble.apart.end()) {
      rubble.apart.clear();
      rubble.ball_apart.clear();
    }
    return;
  }
  forget_contacts(s, rubble.apart);
  report.energy_released += stop_members(s, *ticks);
  take_back(s, ticks->world);
  add_ticks(report, sim, std::move(*ticks));
}

}  // namespace sunder
