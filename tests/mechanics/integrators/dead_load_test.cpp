// SPDX-License-Identifier: MIT
// Free bodies under forces that keep their direction while the body turns.
#include <catch2/catch.hpp>

#include <cmath>

#include "mechanics/element/energy.hpp"
#include "tests/support/bodies.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// Forces of `pull` N in all on each end of a body along its rest x axis, outwards for pull > 0, in
/// equal parts on its vertices: no moment.
Loads pulled(const MechanicsState& state, double half_length, double pull) {
  Loads loads;
  loads.force.assign(state.vertices.size(), Vec3::Zero());
  for (int side : {-1, 1}) {
    double count = 0;
    const auto is_end = [&](std::size_t v) {
      return side * state.vertices.rest_position[v].x() > half_length - 1e-9;
    };
    for (std::size_t v = 0; v < state.vertices.size(); ++v) {
      count += is_end(v);
    }
    for (std::size_t v = 0; v < state.vertices.size(); ++v) {
      if (is_end(v)) loads.force[v] = side * pull / count * Vec3::UnitX();
    }
  }
  return loads;
}

double load_energy(const MechanicsState& state, const Loads& loads) {
  double sum = 0;
  for (std::size_t v = 0; v < state.vertices.size(); ++v) {
    sum -= loads.force[v].dot(state.vertices.position[v]);
  }
  return sum;
}

}  // namespace

TEST_CASE("a free body that is pulled apart comes to rest at steps of any length",
          "[mechanics][dead_load]") {
  const double h = GENERATE(1e-3, 1e-2, 0.1, 1.0);
  const Body body = kuhn_block({4, 4, 4}, Vec3(1, 1, 1));
  MechanicsState state = state_of(body, {.young_modulus = 30e9});
  const Loads loads = pulled(state, 0.5, 1e6);
  const StepStatus status = run(state, body, {.time_step = h}, 200, loads);
  REQUIRE(status.outcome == StepOutcome::fine);
  // Kuhn's diagonals are not symmetric: the body turns as its deformation moves the forces' arms.
  CHECK(state.components[0].angular_momentum.norm() / 400 < 1e-3);
  double tension = 0;
  for (std::size_t t = 0; t < state.elements.size(); ++t) {
    tension += state.elements.rest_volume[t] * state.elements.stress[t](0, 0);
  }
  if (h > 1e-2) CHECK(tension == Approx(1e6).epsilon(1e-3));
}

TEST_CASE("a bar hung between two forces swings with the period of a pendulum and keeps its energy",
          "[mechanics][dead_load]") {
  const double pull = 1e4, tilt = 0.2;
  const Body body = GENERATE(kuhn_block({4, 1, 1}, Vec3(1, 0.2, 0.2)), single_tetrahedron(1));
  MechanicsState state = state_of(body, {.young_modulus = 30e9});
  Loads loads = pulled(state, 0.5, pull);
  if (state.components[0].rigid) {
    loads.force = {-pull * Vec3::UnitX(), pull * Vec3::UnitX(), Vec3::Zero(), Vec3::Zero()};
  }
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(tilt, Vec3(0, 0.6, 0.8)));
  place(state, ComponentId{0}, {.orientation = turn});
  const double inertia = state.components[0].rest_inertia(2, 2);
  const double h = 2e-3;
  const double start = load_energy(state, loads);
  const double least = load_energy(state_of(body, {}), loads);
  double worst = 0, seen = 0;
  const StepStatus status = run(state, body, {.time_step = h}, 5000, loads, [&] {
    const double now =
        load_energy(state, loads) + kinetic_energy(state.vertices) + strain_energy(state);
    worst = std::max(worst, std::abs(now - start));
    seen = std::max(seen, kinetic_energy(state.vertices));
  });
  REQUIRE(status.outcome == StepOutcome::fine);
  INFO("I " << inertia << ", swing " << seen << " of " << start - least << " J, energy off "
            << worst);
  // It went through its lowest place, and after 10 s nothing was fed in or taken.
  CHECK(seen > 0.8 * (start - least));
  CHECK(worst < 0.01 * (start - least));
}

TEST_CASE("a pressure that turns with its body gives a spinning one no moment",
          "[mechanics][dead_load]") {
  const Body body = kuhn_block({4, 2, 2}, Vec3(1, 0.3, 0.2));
  MechanicsState state = state_of(body, {.young_modulus = 30e9});
  place(state, ComponentId{0}, {.spin = Vec3(0, 0, 20)});
  const Vec3 L = state.components[0].angular_momentum;
  MechanicsScratch scratch;
  const Loads rest = pulled(state, 0.5, -1e4);
  for (int i = 0; i < 200; ++i) {
    Loads loads;
    for (const Vec3& f : rest.force) loads.force.push_back(state.components[0].orientation * f);
    loads.turning = loads.force;
    const IntegratorSettings settings{.time_step = 1e-2};
    const StepStatus status = advance(state, scratch, {body.corners, loads, settings});
    REQUIRE(status.outcome == StepOutcome::fine);
  }
  // Forces of constant direction would give 1e3 N m for 2 s, six times L. Forces that turn act on
  // ends that their own load moved.
  CHECK((state.components[0].angular_momentum - L).norm() < 1e-3 * L.norm());
}

TEST_CASE("a load that overturns a body within one step is refused with the reason",
          "[mechanics][dead_load]") {
  const Body body = kuhn_block({4, 4, 4}, Vec3(1, 1, 1));
  MechanicsState state = state_of(body, {.young_modulus = 30e9});
  // Pushed together by forces that keep their direction, a free body is unstable in truth.
  const StepStatus status = run(state, body, {.time_step = 1}, 20, pulled(state, 0.5, -1e6));
  REQUIRE(status.outcome == StepOutcome::overturned);
  const Finding finding = to_finding(status);
  CHECK(finding.code == "overturned");
  CHECK(finding.text.find("turn it by") != std::string::npos);
  CHECK(finding.remedy.find("pressure") != std::string::npos);
}
