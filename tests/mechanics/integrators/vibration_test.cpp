// SPDX-License-Identifier: MIT
// Oscillations: axial frequency, sudden loads, Rayleigh damping, moving supports; and failures.
#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

#include "mechanics/element/energy.hpp"
#include "mechanics/state/settings/check_settings.hpp"
#include "mechanics/statics/static_solve.hpp"
#include "tests/support/bodies.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// A thin bar along x in its first axial mode: u = amplitude * sin(pi x / L), released at rest.
MechanicsState axial_mode(const Body& body, const Material& material, double amplitude) {
  MechanicsState state = state_of(body, material);
  for (Vec3& x : state.vertices.position) x.x() += amplitude * std::sin(pi * x.x());
  reframe(state, ComponentId{0});
  return state;
}

}  // namespace

TEST_CASE("a free bar rings at c / 2L", "[mechanics][vibration]") {
  // nu = 0: one-dimensional, so 20 cells of lumped masses ring at 0.99897 of the continuum.
  const Material material{.young_modulus = 7e10, .poisson_ratio = 0, .density = 2500};
  const Body body = kuhn_block({20, 1, 1}, Vec3(1, 0.05, 0.05));
  MechanicsState state = axial_mode(body, material, 1e-6);
  const double f = bar_wave_speed(material) / 2;
  REQUIRE(f == Approx(2645.75).epsilon(1e-5));
  const int per_period = 200, periods = 10;
  const double h = 1 / (f * per_period);
  const double rho = GENERATE(0.0, 0.5);
  // Crossings of zero, by linear interpolation.
  std::vector<double> crossings;
  double last = axial_amplitude(state);
  const double start = last;
  double amplitude = 0;
  int step = 0;
  run(state, body, {.time_step = h, .rho_infinity = rho}, per_period * periods, {}, [&] {
    ++step;
    const double now = axial_amplitude(state);
    if (last * now < 0) crossings.push_back((step - now / (now - last)) * h);
    if (step > per_period * (periods - 1)) amplitude = std::max(amplitude, now);
    last = now;
  });
  REQUIRE(crossings.size() == 2 * periods);
  const double measured =
      static_cast<double>(crossings.size() - 1) / (2 * (crossings.back() - crossings.front()));
  // 1 - (pi/40)^2/6 for lumping; rho 0 stretches periods by 5/12 (w h)^2 = 4e-4, rho 0.5 by less.
  // The side diagonals of Kuhn's cells couple a little bending in.
  CHECK(measured == Approx(2642.7).epsilon(2e-3));
  CHECK(amplitude > 0.97 * start);
  CHECK(amplitude < 1.001 * start);
}

TEST_CASE("a sudden load gives the static answer at once, without ringing",
          "[mechanics][vibration][supports]") {
  const Material material{.young_modulus = 3e10, .poisson_ratio = 0.2};
  const Body body = kuhn_block({8, 2, 2}, Vec3(1, 0.2, 0.2));
  MechanicsState state = state_of(body, material);
  state.motions.push_back({});
  for (std::size_t v = 0; v < body.rest.size(); ++v) {
    if (body.rest[v].x() < -0.49) state.vertices.support[v] = MotionId{0};
  }
  MechanicsScratch scratch;
  const std::vector<ComponentId> whole = {ComponentId{0}};
  rebuild(state, body.corners, whole, scratch);
  const Loads loads{.gravity = Vec3(9.81, 0, 0)};  // axial: slowest period 1.1 ms
  MechanicsState at_rest = state;
  REQUIRE(solve_static(at_rest, scratch, body.corners, loads).empty());
  const double energy = strain_energy(at_rest);
  double peak = 0, first = 0;
  const StepStatus status = run(state, body, {.time_step = 2e-2}, 50, loads, [&] {
    if (first == 0) first = strain_energy(state);
    peak = std::max(peak, strain_energy(state));
  });
  REQUIRE(status.outcome == StepOutcome::fine);
  CHECK(first == Approx(energy).epsilon(0.02));
  CHECK(peak < 1.02 * energy);
  CHECK(strain_energy(state) == Approx(energy).epsilon(1e-6));
}

TEST_CASE("Rayleigh damping takes the energy it says and leaves rigid motion alone",
          "[mechanics][vibration][damping]") {
  std::mt19937 random(71);
  INFO("seed 71");
  const Body body = kuhn_block({4, 2, 2}, Vec3(1, 0.5, 0.5));
  MechanicsState state = state_of(body, {.young_modulus = 1e8});
  place(state, ComponentId{0}, {.velocity = Vec3(1, 2, 3), .spin = Vec3(1, 2, 0)});
  const double rigid = kinetic_energy(state.vertices);
  deform(state, 1e-4, random);
  const Vec3 P = momentum(state.vertices), L = angular_momentum(state.vertices);
  const bool by_mass = GENERATE(true, false);
  IntegratorSettings settings{.time_step = 2e-6, .rho_infinity = 0.5};
  settings.damping =
      by_mass ? RayleighDamping{.mass_factor = 500} : RayleighDamping{.stiffness_factor = 1e-4};
  MechanicsScratch scratch;
  const Loads none;
  double before = 0, taken = 0;
  for (int i = 0; i < 4000; ++i) {
    const StepStatus status = advance(state, scratch, {body.corners, none, settings});
    REQUIRE(status.outcome == StepOutcome::fine);
    CHECK(status.damping_work >= 0);
    // The first step still has no acceleration; count from its end on.
    if (i == 0) before = kinetic_energy(state.vertices) + strain_energy(state);
    if (i > 0) taken += status.damping_work;
  }
  const double lost = before - kinetic_energy(state.vertices) - strain_energy(state);
  CHECK(taken > 0.1 * (before - rigid));
  CHECK(lost == Approx(taken).epsilon(0.02));
  CHECK((momentum(state.vertices) - P).norm() < 1e-12 * P.norm());
  CHECK((angular_momentum(state.vertices) - L).norm() < 1e-12 * L.norm());
}

TEST_CASE("held vertices follow their motions, each its own", "[mechanics][supports]") {
  const Body body = kuhn_block({6, 2, 2}, Vec3(1, 0.3, 0.3));
  const Integrator integrator =
      GENERATE(Integrator::floating_frame, Integrator::implicit_euler, Integrator::verlet);
  MechanicsState state = state_of(body, {.young_modulus = 1e8, .poisson_ratio = 0});
  state.motions = {{.velocity = Vec3(0.2, 0, 0.1)}, {.velocity = Vec3(0.21, 0, 0.1)}};
  for (std::size_t v = 0; v < body.rest.size(); ++v) {
    if (body.rest[v].x() < -0.49) state.vertices.support[v] = MotionId{0};
    if (body.rest[v].x() > 0.49) state.vertices.support[v] = MotionId{1};
  }
  MechanicsScratch scratch;
  const std::vector<ComponentId> whole = {ComponentId{0}};
  rebuild(state, body.corners, whole, scratch);
  for (Vec3& v : state.vertices.velocity) v = state.motions[0].velocity;
  for (std::size_t v = 0; v < body.rest.size(); ++v) {
    if (!state.vertices.support[v].is_none()) {
      state.vertices.velocity[v] = state.motions[state.vertices.support[v].index()].velocity;
    }
  }
  reframe(state, ComponentId{0});
  const double h = 1e-4;
  const int steps = 2000;
  REQUIRE(run(state, body, {.time_step = h, .integrator = integrator}, steps).outcome ==
          StepOutcome::fine);
  const double t = steps * h;
  for (std::size_t v = 0; v < body.rest.size(); ++v) {
    const MotionId motion = state.vertices.support[v];
    if (motion.is_none()) continue;
    const Vec3 expected = body.rest[v] + t * state.motions[motion.index()].velocity;
    CHECK((state.vertices.position[v] - expected).norm() < 1e-12);
    CHECK((state.vertices.velocity[v] - state.motions[motion.index()].velocity).norm() < 1e-13);
  }
  // Pulled by 2 mm over 1 m: 0.002 E in the mean, whatever the waves do.
  double mean = 0, volume = 0;
  for (std::size_t e = 0; e < state.elements.size(); ++e) {
    mean += state.elements.rest_volume[e] * state.elements.stress[e](0, 0);
    volume += state.elements.rest_volume[e];
  }
  CHECK(mean / volume == Approx(0.002 * 1e8).epsilon(1e-9));
}

TEST_CASE("what is not a number is reported with its vertex, never passed on in silence",
          "[mechanics][failure]") {
  const Body body = kuhn_block({2, 2, 2}, Vec3(1, 1, 1));
  const double bad = GENERATE(std::numeric_limits<double>::quiet_NaN(),
                              std::numeric_limits<double>::infinity(), 1e308);
  const Integrator integrator =
      GENERATE(Integrator::floating_frame, Integrator::implicit_euler, Integrator::verlet);
  MechanicsState state = state_of(body, {});
  MechanicsScratch scratch;
  const IntegratorSettings settings{.integrator = integrator};
  Loads loads;
  loads.force.assign(body.rest.size(), Vec3::Zero());
  loads.force[7] = Vec3(0, bad, 0);
  StepStatus status;
  for (int i = 0; i < 5 && status.outcome == StepOutcome::fine; ++i) {
    status = advance(state, scratch, {body.corners, loads, settings});
  }
  REQUIRE(status.outcome != StepOutcome::fine);
  const Finding finding = to_finding(status);
  CHECK(finding.severity == Severity::error);
  CHECK(finding.ids.size() == 1);
  CHECK_FALSE(finding.remedy.empty());
}

TEST_CASE("a single bad velocity is found in a body of many", "[mechanics][failure]") {
  const Body body = kuhn_block({2, 1, 1}, Vec3(2, 1, 1));
  // Two bodies in one state: the first stays sound, the second is ill.
  Body two = body;
  const std::size_t n = body.rest.size();
  for (const Vec3& x : body.rest) two.rest.push_back(x + Vec3(0, 0, 5));
  for (Corners c : body.corners) {
    for (VertexId& v : c) v = VertexId{v.index() + n};
    two.corners.push_back(c);
  }
  std::vector<ComponentId> component(two.corners.size(), ComponentId{0});
  std::fill(component.begin() + static_cast<std::ptrdiff_t>(body.corners.size()), component.end(),
            ComponentId{1});
  const Material material;
  MechanicsState state = *make_state({two.rest, two.corners, {}, component, {&material, 1}});
  REQUIRE(state.components.size() == 2);
  state.vertices.velocity[n + 3].x() = std::numeric_limits<double>::quiet_NaN();
  reframe(state, ComponentId{1});
  MechanicsScratch scratch;
  const Loads none;
  const IntegratorSettings settings;
  const StepStatus status = advance(state, scratch, {two.corners, none, settings});
  CHECK(status.outcome == StepOutcome::not_a_number);
  CHECK(status.component == ComponentId{1});
  CHECK(status.vertex.index() >= n);
}

TEST_CASE("a displacement far beyond the body is called divergence", "[mechanics][failure]") {
  const Body body = kuhn_block({2, 2, 2}, Vec3(1, 1, 1));
  MechanicsState state = state_of(body, {.young_modulus = 1e3});
  state.motions.push_back({});
  for (std::size_t v = 0; v < 9; ++v) state.vertices.support[v] = MotionId{0};
  MechanicsScratch scratch;
  const std::vector<ComponentId> whole = {ComponentId{0}};
  rebuild(state, body.corners, whole, scratch);
  const Loads loads{.gravity = Vec3(0, 0, -1e4)};
  const StepStatus status = run(state, body, {.time_step = 0.1}, 100, loads);
  REQUIRE(status.outcome == StepOutcome::diverged);
  CHECK(status.displacement > 10 * state.components[0].rest_radius);
  CHECK(to_finding(status).code == "diverged");
}

TEST_CASE("bad integrator settings are found with place, value and remedy",
          "[mechanics][failure]") {
  CHECK(check_settings(IntegratorSettings{}, "integrator").empty());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto only = [](const IntegratorSettings& settings) {
    const std::vector<SettingFinding> findings = setting_findings(settings, "integrator");
    REQUIRE(findings.size() == 1);
    CHECK(findings[0].finding.text.find(findings[0].place) == 0);
    CHECK_FALSE(findings[0].finding.remedy.empty());
    return findings[0].finding.code + " " + findings[0].place;
  };
  CHECK(only({.rho_infinity = 0.8}) == "out_of_range integrator.rho_infinity");
  CHECK(only({.damping = {.mass_factor = -1}}) == "out_of_range integrator.damping.mass_factor");
  CHECK(only({.damping = {.stiffness_factor = nan}}) ==
        "out_of_range integrator.damping.stiffness_factor");
  CHECK(only({.tolerance = 0.2}) == "out_of_range integrator.tolerance");
  CHECK(only({.max_iterations = 0}) == "out_of_range integrator.max_iterations");
  CHECK(only({.integrator = Integrator::verlet, .damping = {.mass_factor = 1}}) ==
        "damping_not_supported integrator.damping.mass_factor");
  CHECK(setting_findings(IntegratorSettings{.integrator = Integrator::verlet,
                                            .damping = {.stiffness_factor = 1}},
                         "integrator")
            .empty());
  CHECK(only({.integrator = Integrator::modal, .damping = {.stiffness_factor = 1}}) ==
        "damping_not_supported integrator.damping.stiffness_factor");
  CHECK(only({.model = ElasticModel::corotational}) == "model_not_supported integrator.method");
}

TEST_CASE("a body pushed through itself comes back", "[mechanics][failure]") {
  const Body body = kuhn_block({2, 2, 2}, Vec3(1, 1, 1));
  MechanicsState state = state_of(body, {.young_modulus = 1e6});
  // Turned inside out about its middle plane and squeezed: every tetrahedron is inverted.
  for (Vec3& x : state.vertices.position) x = Vec3(-0.5 * x.x(), x.y(), 1.1 * x.z());
  reframe(state, ComponentId{0});
  MechanicsScratch scratch;
  measure_elements(state, scratch, body.corners);
  const double energy = strain_energy(state);
  // Strains of 150 per cent turn the frame as fast as the body rings, far outside of the scheme's
  // range; with a tenth of critical damping nothing grows and the shape returns.
  const IntegratorSettings settings{.time_step = 1e-3, .damping = {.stiffness_factor = 2e-3}};
  double most = 0;
  const StepStatus status = run(state, body, settings, 2000, {}, [&] {
    most = std::max(most, strain_energy(state) + kinetic_energy(state.vertices));
  });
  REQUIRE(status.outcome == StepOutcome::fine);
  CHECK(most < 1.01 * energy);
  double worst = 0;
  for (const Vec3& d : state.vertices.displacement) worst = std::max(worst, d.norm());
  CHECK(worst < 0.01);  // of 0.75 m at the start
}
