// SPDX-License-Identifier: MIT
// Scenarios of bodies in motion: each integrator against stiffness, step, spin and shape.
#include <algorithm>
#include <cmath>

#include "mechanics/element/energy.hpp"
#include "mechanics/frame/rotation.hpp"
#include "tests/stability/flight.hpp"
#include "tests/stability/matrix.hpp"

namespace sunder::stability {
namespace {

using test::Body;

/// A vibrating block at a multiple of the explicit limit, free of weight and spin.
Cell near_the_explicit_limit(const Method& method, double multiple) {
  const Body body = flight_body();
  const Flight flight{.material = {.young_modulus = 1e9}, .steps = 400, .spin = Vec3(0, 0, 0.01)};
  Flight timed = flight;
  timed.time_step =
      multiple * 2 /
      highest_frequency(test::state_of_order(method.order, body, flight.material), body);
  timed.weight = false;
  return fly(timed, method);
}

/// The worst of several flights.
Cell worst_of(const Method& method, const std::vector<Flight>& flights) {
  Cell worst;
  for (const Flight& flight : flights) {
    const Cell cell = fly(flight, method);
    if (cell.outcome > worst.outcome ||
        (cell.outcome == worst.outcome && cell.figure > worst.figure)) {
      worst = cell;
    }
  }
  return worst;
}

Cell all_stiffnesses(const Method& method, double time_step) {
  std::vector<Flight> flights;
  for (const double E : {1e5, 1e7, 30e9, 1e12}) {
    flights.push_back({.material = {.young_modulus = E}, .time_step = time_step, .steps = 60});
  }
  return worst_of(method, flights);
}

Cell spin_in_equilibrium(const Method& method, double time_step) {
  return fly({.time_step = time_step,
              .steps = static_cast<int>(std::lround(1 / time_step)),
              .spin = Vec3(0, 0, 50),
              .deformation = 0,
              .weight = false},
             method);
}

/// A soft body at rest rings hard for a second. Figure: its spin at the end, rad/s.
Cell ghost_torque(const Method& method) {
  const Body body = flight_body();
  MechanicsState state = test::state_of_order(method.order, body, {.young_modulus = 1e7});
  std::mt19937 random(82);
  test::deform(state, 5e-2, random);
  IntegratorSettings settings = method.settings;
  settings.time_step = 2e-4;
  const StepStatus status = test::run(state, body, settings, 5000);
  if (status.outcome != StepOutcome::fine) return {Outcome::diverges, status.time};
  const double spin = angular_momentum(state.vertices).norm() /
                      state.components[0].rest_inertia.eigenvalues().real().maxCoeff();
  return {spin < 1e-11 ? Outcome::holds : Outcome::gains, spin};
}

/// Every tetrahedron turned inside out. Figure: the most energy there was over that of the start.
Cell inverted(const Method& method) {
  const Body body = test::kuhn_block({2, 2, 2}, Vec3(1, 1, 1));
  MechanicsState state = test::state_of_order(method.order, body, {.young_modulus = 1e6});
  for (Vec3& x : state.vertices.position) x = Vec3(-0.5 * x.x(), x.y(), 1.1 * x.z());
  reframe(state, ComponentId{0});
  MechanicsScratch scratch;
  measure_elements(state, scratch, body.corners);
  const double start = strain_energy(state);
  IntegratorSettings settings = method.settings;
  settings.time_step = 1e-3;
  // Strains of 150 per cent turn the frame as fast as the body rings; damped, nothing may grow.
  if (method.is_damped) settings.damping.stiffness_factor = 2e-3;
  double most = 0;
  const StepStatus status = test::run(state, body, settings, 1000, {}, [&] {
    most = std::max(most, strain_energy(state) + kinetic_energy(state.vertices));
  });
  if (status.outcome != StepOutcome::fine) return {Outcome::diverges, status.time};
  const double allowed = method.energy_swings ? 2 : 1.01;
  return {most < allowed * start ? Outcome::holds : Outcome::gains, most / start};
}

/// A single tetrahedron with one corner pushed through the face opposite. Figure: how far an edge
/// is off at the end, relative.
Cell tetrahedron_through_itself(const Method& method) {
  double worst = 0;
  for (int k = 1; k <= 20; ++k) {
    const Body body = test::single_tetrahedron(1);
    MechanicsState state = test::state_of_order(method.order, body, {});
    state.vertices.position[0] = 0.1 * k * Vec3(1, 1, 1) / 3;
    reframe(state, ComponentId{0});
    IntegratorSettings settings = method.settings;
    settings.time_step = 1e-2;
    const StepStatus status = test::run(state, body, settings, 100);
    if (status.outcome != StepOutcome::fine) return {Outcome::diverges, status.time};
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        const double rest = (body.rest[a] - body.rest[b]).norm();
        const double now = (state.vertices.position[a] - state.vertices.position[b]).norm();
        worst = std::max(worst, std::abs(now / rest - 1));
      }
    }
  }
  return {worst < 1e-12 ? Outcome::holds : Outcome::false_stress, worst};
}

/// A single tetrahedron that spins for a second. Figure: the rest of the spin.
Cell tetrahedron_spin(const Method& method) {
  const Body body = test::single_tetrahedron(0.01);
  MechanicsState state = test::state_of_order(method.order, body, {});
  place(state, ComponentId{0}, {.spin = Vec3(30, 40, 5)});
  const double start = state.components[0].angular_momentum.norm();
  IntegratorSettings settings = method.settings;
  settings.time_step = 1e-2;
  const StepStatus status = test::run(state, body, settings, 100);
  if (status.outcome != StepOutcome::fine) return {Outcome::diverges, status.time};
  const Rigid end = rigid_of(state);
  const double left = end.spin.norm() / start;
  if (left < 0.99) return {Outcome::loses, left};
  return {left < 1.01 ? Outcome::holds : Outcome::gains, left};
}

/// A step of changing length, against the same with all caches thrown away. Figure: the difference.
Cell changing_step(const Method& method) {
  const Body body = flight_body();
  std::vector<Vec3> ends[2];
  for (const bool thrown : {false, true}) {
    MechanicsState state = test::state_of_order(method.order, body, {.young_modulus = 1e8});
    std::mt19937 random(83);
    test::deform(state, 1e-3, random);
    MechanicsScratch scratch;
    const Loads nothing;
    for (int i = 0; i < 30; ++i) {
      IntegratorSettings settings = method.settings;
      settings.time_step = i % 3 == 0 ? 1e-4 : i % 3 == 1 ? 2e-4 : 5e-5;
      if (thrown) scratch = MechanicsScratch{};
      const StepStatus status = advance(state, scratch, {body.corners, nothing, settings});
      if (status.outcome != StepOutcome::fine) return {Outcome::diverges, double(i)};
    }
    ends[thrown] = state.vertices.position;
  }
  double worst = 0;
  for (std::size_t v = 0; v < ends[0].size(); ++v) {
    worst = std::max(worst, (ends[0][v] - ends[1][v]).norm());
  }
  return {worst == 0 ? Outcome::holds : Outcome::false_stress, worst};
}

/// A bar bent exactly to a circle with outer strain 7e-4, forty times as long as thick. Figure: the
/// largest mean stress of a cross-section, which is zero in truth, over that of the outer fibre.
Cell slender(const Method& method) {
  const double strain = 7e-4, thickness = 1, length = 40;
  const Body body = test::kuhn_block({40, 1, 2}, Vec3(length, thickness, thickness));
  const Material material{.young_modulus = 1e9, .poisson_ratio = 0};
  MechanicsState state = test::state_of_order(method.order, body, material);
  const double radius = thickness / 2 / strain;
  const Vec3 shift = body.rest[0] - state.vertices.rest_position[0];
  for (std::size_t v = 0; v < state.vertices.size(); ++v) {
    const Vec3 r = state.vertices.rest_position[v] + shift;
    const double turn = r.x() / radius, from_axis = radius + r.z();
    state.vertices.position[v] =
        Vec3(from_axis * std::sin(turn), r.y(), from_axis * std::cos(turn) - radius);
  }
  reframe(state, ComponentId{0});
  MechanicsScratch scratch;
  IntegratorSettings settings = method.settings;
  settings.time_step = 1e-9;
  const Loads nothing;
  advance(state, scratch, {body.corners, nothing, settings});
  double mean[40] = {};  // twelve tetrahedra a cross-section
  for (std::size_t t = 0; t < body.corners.size(); ++t) {
    mean[t / 12] += state.elements.stress[t](0, 0) / 12;
  }
  double largest = 0;
  for (const double stress : mean) largest = std::max(largest, std::abs(stress));
  const double figure = largest / (material.young_modulus * strain);
  return {figure < 0.05 ? Outcome::holds : Outcome::false_stress, figure};
}

/// Whether the method iterates to a tolerance.
bool iterates(const Method& method) {
  const IntegratorSettings& s = method.settings;
  return s.integrator == Integrator::broyden || s.integrator == Integrator::newton_cg ||
         s.corotational_solve == CorotationalSolve::prefactored;
}

/// Iterations cut after two: the run must report it, keep momentum, and stay sound by the factor.
/// Figure: the drift of momentum, relative.
Cell cut_short(const Method& method) {
  if (!iterates(method)) return {};
  const Body body = flight_body();
  MechanicsState state = test::state_of_order(method.order, body, {});
  place(state, ComponentId{0}, {.velocity = Vec3(1, 2, 3)});
  std::mt19937 random(86);
  test::deform(state, 1e-4, random);
  const Vec3 P = momentum(state.vertices);
  MechanicsScratch scratch;
  measure_elements(state, scratch, body.corners);
  const double start = kinetic_energy(state.vertices) + strain_energy(state);
  IntegratorSettings settings = method.settings;
  settings.time_step = 1e-3;
  settings.max_iterations = 2;
  settings.tolerance = 1e-12;
  std::uint32_t told = 0;
  const Loads nothing;
  for (int i = 0; i < 50; ++i) {
    const StepStatus status = advance(state, scratch, {body.corners, nothing, settings});
    if (status.outcome != StepOutcome::fine) return {Outcome::diverges, double(i)};
    told += status.solve.not_converged;
    const double energy = kinetic_energy(state.vertices) + strain_energy(state);
    if (energy > (1 + 1e-9) * start) return {Outcome::gains, energy / start};
  }
  const double drift = (momentum(state.vertices) - P).norm() / P.norm();
  return {told > 0 && drift < 1e-12 ? Outcome::holds : Outcome::false_stress, drift};
}

}  // namespace

std::vector<Scenario> motions() {
  const Outcome loses = Outcome::loses, false_stress = Outcome::false_stress;
  const Outcome gains = Outcome::gains, diverges = Outcome::diverges;
  using Expected = std::map<std::string, Outcome>;
  using Names = std::vector<std::string>;
  // Implicit Euler linearised where the step begins, with methods that fall back on it; and at its
  // end.
  const Names at_start = {"implicit Euler", "Broyden", "corotational"};
  const Names at_end = {"implicit Euler, predicted", "Broyden, factor", "Newton with CG",
                        "corotational, prefactored"};
  const auto with = [](Expected expected, const Names& who, Outcome what) {
    for (const std::string& name : who) expected[name] = what;
    return expected;
  };
  const Expected explicit_fails = {{"verlet", diverges}};
  const Expected spinning = with(with(explicit_fails, at_start, false_stress), at_end, loses);
  Expected one_frame, direct;
  for (const Method& method : methods()) {
    if (method.settings.model == ElasticModel::rigid_reference) {
      one_frame[method.name] = false_stress;
    }
    if (!iterates(method)) direct[method.name] = Outcome::not_for_it;
  }
  return {
      {"vibration at 0.99 of the explicit limit",
       [](const Method& m) { return near_the_explicit_limit(m, 0.99); }},
      {"vibration at 1.01 of the explicit limit",
       [](const Method& m) { return near_the_explicit_limit(m, 1.01); }, explicit_fails},
      {"E 1e5 to 1e12, step 1 us", [](const Method& m) { return all_stiffnesses(m, 1e-6); }},
      {"E 1e5 to 1e12, step 1 ms", [](const Method& m) { return all_stiffnesses(m, 1e-3); },
       explicit_fails},
      {"E 1e5 to 1e12, step 1/30 s",
       [](const Method& m) { return all_stiffnesses(m, 1.0 / 30); },
       // Iterations that give up there are taken by the factor, linearised where the step begins
       // (1e10 Pa on). Modal, undamped, keeps the ringing that the spin's forces begin in the
       // softest body.
       {{"implicit Euler", false_stress},
        {"implicit Euler, predicted", loses},
        {"verlet", diverges},
        {"modal", false_stress},
        {"Broyden", false_stress},
        {"Broyden, factor", false_stress},
        {"Newton with CG", false_stress},
        {"corotational", false_stress},
        {"corotational, prefactored", false_stress}},
       // More than 10 000 sub-steps, which a scene is refused for.
       {{"sub-stepped", diverges}}},
      {"50 rad/s in equilibrium, 30 GPa, step 1 ms",
       [](const Method& m) { return spin_in_equilibrium(m, 1e-3); }, spinning},
      {"50 rad/s in equilibrium, 30 GPa, step 10 ms",
       [](const Method& m) { return spin_in_equilibrium(m, 1e-2); },
       spinning,
       // Given up, and taken by the factor, linearised where the step begins.
       {{"corotational, prefactored", false_stress}}},
      // The paper's force has a torque of second order; implicit Euler changes L by h^2 sum v x f.
      {"a soft body at rest rings for 1 s", ghost_torque,
       with(with({}, at_start, gains), at_end, gains)},
      {"a body turned inside out", inverted},
      {"a tetrahedron pushed through itself", tetrahedron_through_itself},
      {"a tetrahedron spins for 1 s, step 10 ms",
       tetrahedron_spin,
       {{"floating, tetrahedra projected", loses}, {"floating, tetrahedra by qr", loses}}},
      {"slivers of 2 degrees, 30 GPa, step 20 us",
       [](const Method& m) {
         return fly({.time_step = 2e-5, .steps = 400, .sliver_angle = 2, .weight = false}, m);
       },
       explicit_fails},
      {"nu 0.49, step 1 ms",
       [](const Method& m) {
         return fly({.material = {.poisson_ratio = 0.49}, .weight = false}, m);
       },
       explicit_fails},
      {"the step changes its length", changing_step},
      {"iterations cut after two", cut_short, direct},
      // Of one frame for the whole body: eps (L/t)^2 / 2 on top of eps.
      {"a bar of 40 to 1 bent by 7e-4", slender, one_frame},
  };
}

}  // namespace sunder::stability
