// SPDX-License-Identifier: MIT
// Scenarios of bodies that meet: stacks, bursts, hits, mass ratios, thin plates and walls.
#include <algorithm>
#include <cmath>
#include <map>

#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "mechanics/element/energy.hpp"
#include "mechanics/rebuild.hpp"
#include "tests/stability/matrix.hpp"
#include "topology/suite/fixtures/shapes.hpp"

namespace sunder::stability {
namespace {

/// Bodies that meet, and the conditions on their run.
struct Encounter {
  Scene scene;
  int steps = 200;
  std::function<void(MechanicsState&)> begin = [](MechanicsState&) {};
  bool is_closed = false;  ///< nothing from outside: momenta stay
  bool ends_at_rest = false;
  /// Whether nothing has passed through anything.
  std::function<bool(const SimulationState&)> is_apart = [](const SimulationState&) {
    return true;
  };
};

BodySettings block(const suite::Cells& cells, const Vec3& size, const Vec3& low_corner,
                   double young_modulus = 1e7) {
  BodySettings body;
  body.mesh = suite::kuhn_box(cells, 1);
  for (Point& p : body.mesh.points) {
    p = {p[0] * size.x() / cells[0], p[1] * size.y() / cells[1], p[2] * size.z() / cells[2]};
  }
  body.material.young_modulus = young_modulus;
  body.translation = low_corner;
  return body;
}

Scene scene_of(std::vector<BodySettings> bodies, double time_step) {
  Scene scene;
  scene.bodies = std::move(bodies);
  scene.integrator.time_step = time_step;
  scene.fracture.mode = FractureMode::off;
  scene.energy_ledger = false;
  return scene;
}

/// Everything that moves: energy (J), momentum and angular momentum.
struct Sums {
  double energy = 0, kinetic = 0;
  Vec3 momentum = Vec3::Zero(), spin = Vec3::Zero();
};

Sums sums_of(const SimulationState& s, const Vec3& gravity) {
  const VertexColumns& v = s.mechanics.vertices;
  Sums sums{.kinetic = kinetic_energy(v), .momentum = momentum(v), .spin = angular_momentum(v)};
  sums.energy = sums.kinetic + strain_energy(s.mechanics) + gravity_energy(v, gravity);
  for (const Obstacle& ball : s.obstacles) {
    if (!ball.mass) continue;
    const Vec3& centre = std::get<Sphere>(ball.shape).center;
    sums.energy += 0.5 * *ball.mass * ball.velocity.squaredNorm() +
                   0.5 * moment_of_inertia(ball) * ball.spin.squaredNorm() -
                   *ball.mass * gravity.dot(centre);
    sums.momentum += *ball.mass * ball.velocity;
    sums.spin += *ball.mass * centre.cross(ball.velocity) + moment_of_inertia(ball) * ball.spin;
  }
  return sums;
}

void take_method(Scene& scene, const Method& method) {
  const double h = scene.integrator.time_step;
  scene.integrator = method.settings;
  scene.integrator.time_step = h;
  for (BodySettings& body : scene.bodies) body.order = static_cast<std::uint32_t>(method.order);
}

/// The springs that the lightest vertex of all shall have.
void set_springs(Simulation& sim, const Springs& springs) {
  if (springs.turn == 0) return;
  ContactSettings& contact = sim.scene.contact;
  const double m = std::ranges::min(sim.state->mechanics.vertices.mass);
  const double w = springs.turn / sim.scene.integrator.time_step;
  contact.method = ContactMethod::penalty;
  contact.penalty_stiffness = m * w * w;
  contact.penalty_damping = springs.damping * 2 * m * w;
  contact.ball_share = springs.ball_share;
}

/// Figure: the gain of energy over its start's (gains), kinetic energy at the end over the start's
/// energy (restless), the rest of the angular momentum (loses), else the drift of momentum.
Cell meet(Encounter encounter, const Method& method) {
  take_method(encounter.scene, method);
  Result<Simulation> built = build_simulation(std::move(encounter.scene));
  if (!built) return {Outcome::refuses, 0};
  Simulation& sim = *built;
  SimulationState& s = *sim.state;
  set_springs(sim, method.springs);
  encounter.begin(s.mechanics);
  const Vec3 gravity = sim.scene.gravity.acceleration;
  const Sums start = sums_of(s, gravity);
  Sums end;
  double most = start.energy;
  for (int i = 0; i < encounter.steps; ++i) {
    const StepReport report = advance(sim);
    if (report.status.outcome != StepOutcome::fine) return {Outcome::diverges, double(i)};
    end = sums_of(s, gravity);
    most = std::max(most, end.energy);
  }
  const double gain = (most - start.energy) / std::abs(start.energy);
  if (!(gain < (method.energy_swings ? 1e-2 : 1e-6))) return {Outcome::gains, gain};
  if (!encounter.is_apart(s)) return {Outcome::passes_through, 0};
  const double unrest = end.kinetic / std::abs(start.energy);
  if (encounter.ends_at_rest) return {unrest < 5e-3 ? Outcome::holds : Outcome::restless, unrest};
  if (!encounter.is_closed) return {Outcome::holds, gain};
  const double left = end.spin.norm() / start.spin.norm();
  if (left < 0.99) return {Outcome::loses, left};
  if (left > 1.01) return {Outcome::gains, left};
  const double drift = (end.momentum - start.momentum).norm() / start.momentum.norm();
  return {drift < 1e-12 ? Outcome::holds : Outcome::off_path, drift};
}

/// Whether each component's centre is higher than that of the one before by `least`, m.
std::function<bool(const SimulationState&)> stands(double least) {
  return [least](const SimulationState& s) {
    double below = -0.5 * least;
    for (const Component& c : s.mechanics.components) {
      if (!(c.centre.z() - below > least)) return false;
      below = c.centre.z();
    }
    return true;
  };
}

/// Three blocks of 0.2 m, each over the one below it: vertices settle between balls.
Encounter stack(double time_step) {
  std::vector<BodySettings> bodies;
  for (int k = 0; k < 3; ++k) {
    bodies.push_back(block({2, 2, 2}, {0.2, 0.2, 0.2}, {0, 0, 0.27 * k}));
  }
  Encounter e{scene_of(bodies, time_step), static_cast<int>(std::lround(0.5 / time_step))};
  e.scene.obstacles = {Obstacle{Plane{}}};
  e.ends_at_rest = true;
  e.is_apart = stands(0.15);
  return e;
}

/// A block in pieces of one tetrahedron each, which fly apart.
Encounter burst() {
  Encounter e{scene_of({block({2, 2, 2}, {0.2, 0.2, 0.2}, {0, 0, 0})}, 1e-3), 100};
  std::map<std::array<std::uint32_t, 3>, int> faces;
  for (const auto& t : e.scene.bodies[0].mesh.tetrahedra) {
    for (std::size_t left_out = 0; left_out < 4; ++left_out) {
      std::array<std::uint32_t, 3> face;
      for (std::size_t i = 0, k = 0; i < 4; ++i) {
        if (i != left_out) face[k++] = t[i];
      }
      std::ranges::sort(face);
      ++faces[face];
    }
  }
  FaceList inner;
  for (const auto& [face, count] : faces) {
    if (count == 2) inner.points.push_back(face);
  }
  e.scene.bodies[0].cuts = {{.faces = inner}};
  e.scene.gravity.acceleration.setZero();
  e.begin = [](MechanicsState& m) {
    for (std::size_t v = 0; v < m.vertices.size(); ++v) {
      const Vec3 arm = m.vertices.position[v] - Vec3(0.1, 0.1, 0.1);
      m.vertices.velocity[v] = Vec3(1, 0, 0) + 10 * arm + Vec3(0, 0, 5).cross(arm);
    }
    for (const Component& c : m.components) {
      if (!c.tetrahedra.empty()) reframe(m, c.id);
    }
  };
  e.is_closed = true;
  return e;
}

/// A block strikes another below its middle, with friction.
Encounter off_centre_hit() {
  Encounter e{scene_of({block({2, 2, 2}, {0.2, 0.2, 0.2}, {0, 0, 0}),
                        block({2, 2, 2}, {0.2, 0.2, 0.2}, {0.27, 0.12, 0.05})},
                       1e-3),
              100};
  e.scene.bodies[0].velocity = {3, 0, 0};
  e.scene.bodies[0].spin = {0, 0, 4};
  e.scene.gravity.acceleration.setZero();
  e.is_closed = true;
  e.is_apart = [](const SimulationState& s) {
    const auto& c = s.mechanics.components;
    return (c[1].centre - c[0].centre).norm() > 0.2 && c[1].momentum.x() > 0.1 * c[1].mass;
  };
  return e;
}

/// A block falls by 70 mm on one that is lighter by `ratio`.
Encounter heavy_on_light(double ratio) {
  Encounter e{scene_of({block({2, 2, 2}, {0.2, 0.2, 0.2}, {0, 0, 0}, 1e8),
                        block({2, 2, 2}, {0.2, 0.2, 0.2}, {0, 0, 0.27}, 1e8)},
                       1e-3),
              300};
  e.scene.bodies[0].material.density = 240;
  e.scene.bodies[1].material.density = 240 * ratio;
  e.scene.obstacles = {Obstacle{Plane{}}};
  e.is_apart = stands(0.15);
  return e;
}

/// A plate fifty times as wide as thick falls on the ground, a little askew.
Encounter thin_plate() {
  Encounter e{scene_of({block({8, 8, 1}, {0.8, 0.8, 0.016}, {0, 0, 0.06}, 1e8)}, 1e-3), 300};
  e.scene.bodies[0].rotation = Eigen::AngleAxisd(0.05, Vec3(1, 0.3, 0).normalized());
  e.scene.obstacles = {Obstacle{Plane{}}};
  e.is_apart = [](const SimulationState& s) { return s.mechanics.components[0].centre.z() > 0; };
  return e;
}

/// A block against a wall of 10 mm, faster than it is thick in a step.
Encounter thin_wall() {
  Encounter e{scene_of({block({2, 2, 2}, {0.2, 0.2, 0.2}, {0, 0, 0})}, 1e-3), 40};
  e.scene.bodies[0].velocity = {30, 0, 0};
  Box wall;
  wall.center = {0.4, 0, 0};
  wall.half_extent = {0.005, 2, 2};
  e.scene.obstacles = {Obstacle{wall}};
  e.scene.gravity.acceleration.setZero();
  e.is_apart = [](const SimulationState& s) { return s.mechanics.components[0].centre.x() < 0.4; };
  return e;
}

}  // namespace

std::vector<Scenario> contacts() {
  const Outcome gains = Outcome::gains, passes = Outcome::passes_through;
  const auto of = [](const char* name, std::function<Encounter()> make,
                     std::map<std::string, Outcome> expected,
                     std::map<std::string, Outcome> of_second_order = {}) {
    return Scenario{name, [make](const Method& m) { return meet(make(), m); }, std::move(expected),
                    std::move(of_second_order)};
  };
  const std::pair<const std::string, Outcome> verlet = {"verlet", Outcome::diverges};
  return {
      of("three blocks stacked, step 1 ms", [] { return stack(1e-3); },
         {verlet,
          {"sub-stepped", Outcome::restless},
          {"penalty", Outcome::restless},
          {"penalty, step too long", Outcome::diverges}}),
      // Springs that the step allows are too soft to carry the blocks.
      of("three blocks stacked, step 10 ms", [] { return stack(1e-2); },
         {verlet,
          {"sub-stepped", Outcome::restless},
          {"penalty", passes},
          {"penalty, damped", passes},
          {"penalty, step too long", gains}}),
      // Bounding balls overlap the moment that pieces come apart; at half the radius they do not.
      of("a body cut everywhere bursts", burst,
         {{"penalty", gains}, {"penalty, step too long", gains}}),
      of("a hit off centre, with friction", off_centre_hit,
         {verlet, {"penalty, step too long", gains}}),
      of("a block falls on one of 1 : 100 of its mass", [] { return heavy_on_light(100); },
         {verlet,
          {"sub-stepped", gains},
          {"penalty", passes},
          {"penalty, damped", passes},
          {"penalty, step too long", gains}},
         {{"sub-stepped", Outcome::holds}}),
      of("a block falls on one of 1 : 1000 of its mass", [] { return heavy_on_light(1000); },
         {verlet,
          {"sub-stepped", gains},
          {"implicit Euler, predicted", gains},
          {"Broyden, factor", gains},
          {"Newton with CG", gains},
          {"penalty", passes},
          {"penalty, damped", passes},
          {"penalty, step too long", gains}},
         {{"sub-stepped", Outcome::holds}}),
      of("a plate of 50 to 1 falls on the ground", thin_plate,
         {verlet, {"penalty", gains}, {"penalty, step too long", gains}},
         // More than 500 nodes.
         {{"modal", Outcome::refuses}}),
      of("30 m/s against a wall of 10 mm", thin_wall,
         {verlet,
          {"penalty", gains},
          {"penalty, damped", passes},
          {"penalty, step too long", gains}}),
  };
}

}  // namespace sunder::stability
