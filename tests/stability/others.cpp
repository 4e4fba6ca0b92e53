// SPDX-License-Identifier: MIT
// Scenarios that no integrator takes part in: rotations, contact, splits, input.
#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/SVD>

#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/element/energy.hpp"
#include "mechanics/frame/rotation.hpp"
#include "mechanics/state/settings/check_settings.hpp"
#include "tests/mechanics/contact/contact_scene.hpp"
#include "tests/stability/flight.hpp"
#include "tests/stability/matrix.hpp"
#include "topology/suite/fixtures/shapes.hpp"

namespace sunder::stability {
namespace {

Cell holds_below(double figure, double limit) {
  // A NaN fails.
  return {figure < limit ? Outcome::holds : Outcome::false_stress, figure};
}

/// The largest angle (rad) between the rotation of R S found from `last` and R, over random R.
double rotation_error(const Mat3& S, const Eigen::Quaterniond& off, bool refined) {
  std::mt19937 random(84);
  double worst = 0;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Quaterniond R = test::random_rotation(random);
    const Mat3 A = R.toRotationMatrix() * S;
    const Eigen::Quaterniond found =
        refined ? refine_rotation(A, R * off) : extract_rotation(A, R * off);
    const double error = 2 * (R.conjugate() * found).vec().norm();
    if (!(error <= worst)) worst = error;
  }
  return worst;
}

Cell exact_rotation(const Mat3& S, double off) {
  const Eigen::Quaterniond last = rotation_of(off * Vec3(0, 0, 1));
  return holds_below(std::max(rotation_error(S, last, false), rotation_error(S, last, true)), 1e-7);
}

/// Nothing to go by: the last rotation must come back.
Cell keeps_last(const Mat3& A) {
  const Eigen::Quaterniond last = rotation_of(Vec3(1, 2, 3));
  const double error = std::max(2 * (last.conjugate() * extract_rotation(A, last)).vec().norm(),
                                2 * (last.conjugate() * refine_rotation(A, last)).vec().norm());
  return holds_below(error, 1e-12);
}

/// Reflections: proper, and tr(R^T A) as large as the singular values allow. Figure: the missing
/// part.
Cell reflected() {
  std::mt19937 random(85);
  double worst = 0;
  for (int i = 0; i < 200; ++i) {
    Mat3 A = Mat3::NullaryExpr([&] { return std::normal_distribution<double>()(random); });
    if (A.determinant() > 0) A.col(0) *= -1;
    const Vec3 s = Eigen::JacobiSVD<Mat3>(A).singularValues();
    const double best = s[0] + s[1] - s[2];
    for (const bool refined : {false, true}) {
      const Eigen::Quaterniond start = Eigen::Quaterniond::Identity();
      const Mat3 R =
          (refined ? refine_rotation(A, start) : extract_rotation(A, start)).toRotationMatrix();
      worst = std::max(worst, std::abs(R.determinant() - 1));
      worst = std::max(worst, std::abs((R.transpose() * A).trace() - best) / s[0]);
    }
  }
  return holds_below(worst, 1e-12);
}

Cell refused_material(double poisson_ratio) {
  const bool refused =
      has_error(check_settings(Material{.poisson_ratio = poisson_ratio}, "material"));
  return {refused ? Outcome::refuses : Outcome::holds, poisson_ratio};
}

Cell refused_flat_tetrahedron() {
  test::Body body = test::single_tetrahedron(1);
  body.rest[3] = Vec3(0.3, 0.3, 0);
  const Material material;
  const auto made = make_state({body.rest, body.corners, {}, {}, {&material, 1}});
  return {made ? Outcome::holds : Outcome::refuses, 0};
}

/// Sweeps of contact cut after the first. The cut must be reported, momentum kept, energy not
/// grown. Figure: the drift of momentum, relative.
Cell contact_cut_short() {
  const test::SeveralBodies all = test::together(
      {test::kuhn_block({2, 2, 2}, {0.3, 0.3, 0.3}), test::kuhn_block({2, 2, 2}, {0.3, 0.3, 0.3})});
  test::ContactScene scene{all.body, test::state_of(all, test::material_of(1e9))};
  place(scene.state, ComponentId{0}, {.velocity = {2, 0, 0}});
  place(scene.state, ComponentId{1}, {.translation = {0.32, 0.02, 0.01}});
  scene.integrator.time_step = 1e-3;
  scene.contact.max_iterations = 1;
  const Vec3 P = scene.total_momentum();
  const double start = scene.energy();
  double drift = 0;
  bool told = false;
  for (int i = 0; i < 100; ++i) {
    const ContactStepResult result = scene.step();
    if (result.status.outcome != StepOutcome::fine) return {Outcome::diverges, double(i)};
    told = told || !result.report.converged;
    drift = std::max(drift, (scene.total_momentum() - P).norm() / P.norm());
    if (scene.energy() > start * (1 + 1e-6)) return {Outcome::gains, scene.energy() / start - 1};
  }
  return told ? holds_below(drift, 1e-12) : Cell{Outcome::false_stress, drift};
}

Simulation spinning_until_it_breaks(double strength, std::uint32_t max_fans) {
  Scene scene;
  BodySettings body;
  body.mesh = suite::kuhn_box({6, 3, 3}, 0.1);
  body.material.tensile_strength = strength;
  body.velocity = {1, 0, 0};
  body.spin = {10, 20, 50};
  scene.bodies = {body};
  scene.gravity.acceleration.setZero();
  scene.fracture.mode = FractureMode::budget;
  scene.fracture.max_fans = max_fans;
  return std::move(*build_simulation(std::move(scene)));
}

/// J, of all vertices but those that are left out; `is_left_out` may be shorter than the rows.
double kinetic_energy_but(const VertexColumns& v, const std::vector<bool>& is_left_out) {
  double sum = 0;
  for (std::size_t k = 0; k < v.size(); ++k) {
    if (k < is_left_out.size() && is_left_out[k]) continue;
    sum += 0.5 * v.mass[k] * v.velocity[k].squaredNorm();
  }
  return sum;
}

/// Bodies that an impact carries along rigidly. They get the motion of their deformation back as
/// the step ends, which is no work of cracks.
std::vector<bool> carried_vertices(const MechanicsState& state) {
  std::vector<bool> carried;
  for (const ComponentId id : state.vertices.component) {
    carried.push_back(state.components[id.index()].rung == Rung::carried);
  }
  return carried;
}

/// P, L and kinetic energy right before and after the cracks of each step. Figure: the worst jump.
Cell split_in_flight() {
  Simulation sim = spinning_until_it_breaks(1e5, 64);
  double worst = 0;
  std::size_t fans = 0;
  for (int i = 0; i < 60; ++i) {
    Vec3 P, L;
    double kinetic = 0;
    std::vector<bool> carried;
    const MechanicsState& state = sim.state->mechanics;
    const VertexColumns& v = state.vertices;
    const StepReport report = advance(sim, [&](const Simulation&, const PartReport&) {
      P = momentum(v);
      L = angular_momentum(v);
      carried = carried_vertices(state);
      kinetic = kinetic_energy_but(v, carried);
    });
    if (report.status.outcome != StepOutcome::fine) return {Outcome::diverges, double(i)};
    fans += report.fracture.fans.size();
    worst = std::max(worst, (momentum(v) - P).norm() / P.norm());
    worst = std::max(worst, (angular_momentum(v) - L).norm() / L.norm());
    // Pieces that turn rigid give their deformation up; it is reported.
    const double given = kinetic_energy_but(v, carried) - kinetic;
    worst = std::max(worst, given / kinetic);
    worst = std::max(worst, -(given + report.energy_released) / kinetic);
  }
  return fans > 100 ? holds_below(worst, 1e-12) : Cell{Outcome::not_for_it, double(fans)};
}

/// A body that would turn to dust at once, with a budget of cracks: every step is bounded and the
/// energy does not grow. Figure: the most fans in a step.
Cell budget_of_cracks() {
  Simulation sim = spinning_until_it_breaks(1e3, 16);
  const auto energy = [&] {
    return kinetic_energy(sim.state->mechanics.vertices) + strain_energy(sim.state->mechanics);
  };
  const double start = energy();
  std::size_t most = 0;
  for (int i = 0; i < 60; ++i) {
    const StepReport report = advance(sim);
    if (report.status.outcome != StepOutcome::fine) return {Outcome::diverges, double(i)};
    most = std::max(most, report.fracture.fans.size());
    if (energy() > start * 1.001) return {Outcome::gains, energy() / start};
  }
  return {most == 16 ? Outcome::holds : Outcome::false_stress, double(most)};
}

/// Pushed together by forces that keep their direction, at a step far too long. Figure: rad.
Cell overturned() {
  const test::Body body = flight_body();
  MechanicsState state = test::state_of(body, {});
  Loads loads;
  for (const Vec3& x : body.rest) {
    loads.force.emplace_back(x.x() > 0.4 ? -1e6 : x.x() < -0.4 ? 1e6 : 0, 0, 0);
  }
  const StepStatus status = test::run(state, body, {.time_step = 1}, 20, loads);
  if (status.outcome == StepOutcome::overturned) return {Outcome::refuses, status.turned};
  return {status.outcome == StepOutcome::fine ? Outcome::holds : Outcome::diverges, status.time};
}

/// A bar bent by 0.4 rad at each end: the turn that the run warns by. Figure: its error, relative.
Cell validity_warning() {
  const test::Body body = test::kuhn_block({40, 1, 1}, Vec3(40, 1, 1));
  MechanicsState state = test::state_of(body, {});
  const double radius = 50;
  for (std::size_t v = 0; v < body.rest.size(); ++v) {
    const Vec3& r = body.rest[v];
    const double from_axis = radius + r.z();
    state.vertices.position[v] = Vec3(from_axis * std::sin(r.x() / radius), r.y(),
                                      from_axis * std::cos(r.x() / radius) - radius);
  }
  reframe(state, ComponentId{0});
  MechanicsScratch scratch;
  measure_elements(state, scratch, body.corners);
  // The displacement gradient of a turn by theta has the skew part sin theta.
  return holds_below(std::abs(state.components[0].largest_turn / std::sin(19.5 / radius) - 1),
                     0.05);
}

}  // namespace

Cell ball_on_block(const BallOnBlock& pile, const Method& method) {
  test::ContactScene scene{test::kuhn_block({3, 3, 3}, {1, 1, 1}), {}};
  scene.state = test::state_of_order(method.order, scene.body, test::material_of(1e9));
  place(scene.state, ComponentId{0}, {.translation = {0, 0, 0.5}});
  // On the four vertices in the middle of the top.
  const double height = std::sqrt(0.25 - 1.0 / 18);
  Obstacle ball{.shape = Sphere{{0, 0, 1 + height}, 0.5}};
  const double mass = scene.state.components[0].mass;
  ball.mass = mass / pile.ratio;
  scene.obstacles = {Obstacle{Plane{}}, ball};
  scene.loads.gravity = {0, 0, -9.81};
  scene.integrator = method.settings;
  scene.integrator.time_step = pile.time_step;
  if (method.is_damped) scene.integrator.damping.stiffness_factor = 1e-3;
  const double start = scene.energy();
  double floor = 0, under = 0;
  const int counted = pile.steps / 2;
  for (int i = 0; i < pile.steps; ++i) {
    const ContactStepResult result = scene.step();
    if (result.status.outcome != StepOutcome::fine) return {Outcome::diverges, double(i)};
    if (i < pile.steps - counted) continue;
    floor += result.report.impulse_of(0).z();
    under -= result.report.impulse_of(1).z();
  }
  // Weight may push it down, which gives gravity's energy to strain: none may be made.
  const double gain = scene.energy() - start;
  if (!(gain < (method.energy_swings ? 1e-5 : 1e-9) * std::abs(start)))
    return {Outcome::gains, gain / std::abs(start)};
  const double time = counted * pile.time_step * 9.81;
  const double error = std::max(std::abs(floor / (mass * (1 + 1 / pile.ratio) * time) - 1),
                                std::abs(under / (mass / pile.ratio * time) - 1));
  return {Outcome::holds, error};
}

std::vector<Scenario> others() {
  const auto any = [](Cell (*run)()) { return [run](const Method&) { return run(); }; };
  const auto refuses = [](const char* name, std::function<Cell(const Method&)> run) {
    return Scenario{name, std::move(run), {{"floating frame", Outcome::refuses}}};
  };
  const Mat3 flat = Vec3(2, 1, 0).asDiagonal();
  const Mat3 chip = 1e-12 * Vec3(3, 2, 1).asDiagonal().toDenseMatrix();
  const Mat3 plain = Vec3(3, 2, 1).asDiagonal();
  return {
      {"rotation of a flat shape", [=](const Method&) { return exact_rotation(flat, 0.3); }},
      {"rotation of a chip, |A| = 1e-12", [=](const Method&) { return exact_rotation(chip, 0.3); }},
      {"rotation from half a turn off", [=](const Method&) { return exact_rotation(plain, M_PI); }},
      {"rotation of a reflection", any(reflected)},
      {"rotation of nothing", [](const Method&) { return keeps_last(Mat3::Zero()); }},
      {"rotation of what is not a number",
       [](const Method&) {
         return keeps_last(Mat3::Constant(std::numeric_limits<double>::quiet_NaN()));
       }},
      {"nu = 0.49", [](const Method&) { return refused_material(0.49); }},
      refuses("nu = 0.5", [](const Method&) { return refused_material(0.5); }),
      refuses("a flat tetrahedron", any(refused_flat_tetrahedron)),
      {"masses 1 : 1e6 on top of each other",
       [](const Method& method) {
         const Cell cell = ball_on_block({}, method);
         return cell.outcome == Outcome::holds ? holds_below(cell.figure, 1e-6) : cell;
       }},
      {"sweeps of contact cut short", any(contact_cut_short)},
      {"a body breaks in flight", any(split_in_flight)},
      {"a budget of cracks", any(budget_of_cracks)},
      refuses("a load that overturns a body", any(overturned)),
      {"the turn that the warning goes by", any(validity_warning)},
  };
}

}  // namespace sunder::stability
