// SPDX-License-Identifier: MIT
// Splits: x, v, P, L and kinetic energy go on; masses, frames and supports follow the pieces.
#include <catch2/catch.hpp>

#include <cmath>
#include <map>

#include "mechanics/element/energy.hpp"
#include "mechanics/solver/component_system.hpp"
#include "mechanics/state/living.hpp"
#include "tests/support/bodies.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// Cuts `body` into the tetrahedra with centres below `x` and the rest: copies the vertices of the
/// cut, gives the lower part a fresh component. Gives both ids.
std::vector<ComponentId> cut_at(MechanicsState& state, Body& body, double x) {
  const ComponentId fresh{state.components.size()};
  const auto low = [&](std::size_t t) {
    Vec3 centre = Vec3::Zero();
    for (VertexId v : body.corners[t]) centre += 0.25 * state.vertices.rest_position[v.index()];
    return centre.x() < x;
  };
  std::vector<bool> is_low(body.corners.size());
  std::vector<bool> in_high(state.vertices.size(), false);
  for (std::size_t t = 0; t < body.corners.size(); ++t) {
    is_low[t] = low(t);
    if (is_low[t]) state.elements.component[t] = fresh;
    if (!is_low[t]) {
      for (VertexId v : body.corners[t]) in_high[v.index()] = true;
    }
  }
  std::map<VertexId, VertexId> copies;
  for (std::size_t t = 0; t < body.corners.size(); ++t) {
    if (!is_low[t]) continue;
    for (VertexId& v : body.corners[t]) {
      if (!in_high[v.index()]) continue;
      if (!copies.contains(v)) copies[v] = append_copy(state.vertices, v);
      v = copies[v];
    }
  }
  return {ComponentId{0}, fresh};
}

struct Motion {
  Vec3 momentum, angular;
  double kinetic, mass;
};

Motion motion_of(const MechanicsState& state) {
  double mass = 0;
  for (double m : state.vertices.mass) mass += m;
  return {momentum(state.vertices), angular_momentum(state.vertices),
          kinetic_energy(state.vertices), mass};
}

void check_same(const Motion& a, const Motion& b) {
  CHECK((a.momentum - b.momentum).norm() < 1e-12 * a.momentum.norm());
  CHECK((a.angular - b.angular).norm() < 1e-12 * a.angular.norm());
  CHECK(b.kinetic == Approx(a.kinetic).epsilon(1e-12));
  CHECK(b.mass == Approx(a.mass).epsilon(1e-14));
}

/// Frames and rows say the same: x = c + R (r0 + d), v = P/M + R (w x q + d').
double worst_disagreement(const MechanicsState& state) {
  double worst = 0;
  for (const Component& c : state.components) {
    const Mat3 R = c.orientation.toRotationMatrix();
    for (VertexId v : c.vertices) {
      const Vec3 q = state.vertices.rest_position[v.index()] - c.rest_centre +
                     state.vertices.displacement[v.index()];
      worst = std::max(worst, (state.vertices.position[v.index()] - c.centre - R * q).norm());
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("a split changes no position, velocity, momentum or kinetic energy",
          "[mechanics][split]") {
  std::mt19937 random(51);
  INFO("seed 51");
  Body body = shaken(kuhn_block({6, 2, 2}, Vec3(1.5, 0.5, 0.5)), 0.02, random);
  MechanicsState state = state_of(body, {.young_modulus = 1e9});
  place(state, ComponentId{0},
        {.orientation = random_rotation(random), .velocity = Vec3(3, 1, 2), .spin = Vec3(4, 9, 2)});
  deform(state, 1e-3, random);
  MechanicsScratch scratch;
  const IntegratorSettings settings{.time_step = 1e-4};
  const Loads none;
  for (int i = 0; i < 20; ++i) advance(state, scratch, {body.corners, none, settings});

  const Motion before = motion_of(state);
  const double strain = strain_energy(state);
  const std::vector<Vec3> x = state.vertices.position, v = state.vertices.velocity;
  const std::vector<ComponentId> touched = cut_at(state, body, 0.1);
  const RebuildReport report = rebuild(state, body.corners, touched, scratch);

  CHECK(report.energy_released == 0);
  check_same(before, motion_of(state));
  for (std::size_t i = 0; i < x.size(); ++i) {
    CHECK(state.vertices.position[i] == x[i]);
    CHECK(state.vertices.velocity[i] == v[i]);
  }
  CHECK(worst_disagreement(state) < 1e-14);
  CHECK(living_components(state) == touched);

  // The new frames are continuous in time too: a small step moves vertices by a small way.
  const StepStatus status =
      advance(state, scratch, {body.corners, none, IntegratorSettings{.time_step = 1e-9}});
  REQUIRE(status.outcome == StepOutcome::fine);
  for (std::size_t i = 0; i < x.size(); ++i) {
    CHECK((state.vertices.position[i] - x[i]).norm() < 1e-9 * 2 * v[i].norm() + 1e-14);
  }
  CHECK(strain_energy(state) < 1.2 * strain);

  for (int i = 0; i < 200; ++i) advance(state, scratch, {body.corners, none, settings});
  const Motion after = motion_of(state);
  CHECK((after.momentum - before.momentum).norm() < 1e-11 * before.momentum.norm());
  CHECK((after.angular - before.angular).norm() < 1e-11 * before.angular.norm());
}

TEST_CASE("a body at rest that is cut stays at rest", "[mechanics][split]") {
  std::mt19937 random(52);
  INFO("seed 52");
  Body body = kuhn_block({4, 2, 2}, Vec3(1, 0.5, 0.5));
  MechanicsState state = state_of(body, {});
  place(state, ComponentId{0}, {.orientation = random_rotation(random)});
  MechanicsScratch scratch;
  const IntegratorSettings settings;
  const Loads none;
  rebuild(state, body.corners, cut_at(state, body, 0), scratch);
  for (int i = 0; i < 10; ++i) advance(state, scratch, {body.corners, none, settings});
  // Shape matching leaves displacements of rounding, 1e-16 m; released at 30 GPa they move at
  // c / L times that, 1e-12 m/s at most, of 600 kg.
  CHECK(kinetic_energy(state.vertices) < 1e-20);
}

TEST_CASE("a tetrahedron that comes off turns rigid and reports what it gave up",
          "[mechanics][split][isolated]") {
  std::mt19937 random(53);
  INFO("seed 53");
  Body body = kuhn_block({1, 1, 1}, Vec3(1, 1, 1));
  MechanicsState state = state_of(body, {.young_modulus = 1e7});
  place(state, ComponentId{0}, {.velocity = Vec3(1, 2, 3), .spin = Vec3(5, 3, 1)});
  deform(state, 1e-2, random);
  MechanicsScratch scratch;
  const IntegratorSettings settings{.time_step = 1e-4};
  const Loads none;
  for (int i = 0; i < 5; ++i) advance(state, scratch, {body.corners, none, settings});

  const Motion before = motion_of(state);
  const double strain = strain_energy(state);
  // Every tetrahedron for itself.
  std::vector<ComponentId> touched;
  std::vector<bool> taken(state.vertices.size(), false);
  for (std::size_t t = 0; t < body.corners.size(); ++t) {
    touched.push_back(ComponentId{t});
    state.elements.component[t] = ComponentId{t};
    for (VertexId& v : body.corners[t]) {
      if (taken[v.index()]) v = append_copy(state.vertices, v);
      if (v.index() < taken.size()) taken[v.index()] = true;
    }
  }
  const RebuildReport report = rebuild(state, body.corners, touched, scratch);
  const Motion after = motion_of(state);
  CHECK((before.momentum - after.momentum).norm() < 1e-12 * before.momentum.norm());
  CHECK((before.angular - after.angular).norm() < 1e-12 * before.angular.norm());
  CHECK(report.energy_released > 0);
  CHECK(report.energy_released == Approx(strain + before.kinetic - after.kinetic).epsilon(1e-6));
  for (const Component& component : state.components) {
    CHECK(component.rigid);
    CHECK(component.vertices.size() == 4);
  }
  CHECK(strain_energy(state) == 0);
}

TEST_CASE("masses of all copies follow their stars and others stay to the bit",
          "[mechanics][split]") {
  std::mt19937 random(54);
  INFO("seed 54");
  Body body = shaken(kuhn_block({4, 2, 2}, Vec3(1, 0.5, 0.5)), 0.02, random);
  MechanicsState state = state_of(body, {});
  const std::vector<double> before = state.vertices.mass;
  const std::size_t rows = state.vertices.size();
  MechanicsScratch scratch;
  rebuild(state, body.corners, cut_at(state, body, 0), scratch);
  std::size_t changed = 0;
  for (std::size_t v = 0; v < rows; ++v) {
    if (state.vertices.mass[v] != before[v]) ++changed;
  }
  CHECK(changed == state.vertices.size() - rows);  // exactly those that have a copy
  std::vector<double> star(state.vertices.size(), 0);
  for (std::size_t t = 0; t < body.corners.size(); ++t) {
    for (VertexId v : body.corners[t]) star[v.index()] += 0.25 * state.elements.mass[t];
  }
  for (std::size_t v = 0; v < star.size(); ++v) CHECK(state.vertices.mass[v] == star[v]);
}

TEST_CASE("a piece that loses its last support falls free with continuous x and v",
          "[mechanics][split][supports]") {
  Body body = kuhn_block({6, 2, 2}, Vec3(1.5, 0.5, 0.5));
  MechanicsState state = state_of(body, {.young_modulus = 1e8});
  state.motions.push_back({});
  for (std::size_t v = 0; v < body.rest.size(); ++v) {
    if (body.rest[v].x() > 0.74) state.vertices.support[v] = MotionId{0};
  }
  MechanicsScratch scratch;
  const std::vector<ComponentId> whole = {ComponentId{0}};
  rebuild(state, body.corners, whole, scratch);
  REQUIRE(state.components[0].supported);
  const IntegratorSettings settings{.time_step = 1e-3};
  const Loads loads{.gravity = Vec3(0, 0, -9.81)};
  for (int i = 0; i < 30; ++i) advance(state, scratch, {body.corners, loads, settings});
  CHECK(state.components[0].orientation.coeffs() ==
        Eigen::Quaterniond::Identity().coeffs());  // the frame is the support's

  const std::vector<Vec3> x = state.vertices.position, v = state.vertices.velocity;
  const std::vector<Vec3> d = state.vertices.displacement;
  rebuild(state, body.corners, cut_at(state, body, 0.1), scratch);
  CHECK(state.components[0].supported);
  CHECK_FALSE(state.components[1].supported);
  CHECK(state.components[0].orientation.coeffs() == Eigen::Quaterniond::Identity().coeffs());
  for (std::size_t i = 0; i < x.size(); ++i) {
    CHECK(state.vertices.position[i] == x[i]);
    CHECK(state.vertices.velocity[i] == v[i]);
  }
  for (VertexId i : state.components[0].vertices) {
    if (i.index() < d.size()) {
      CHECK((state.vertices.displacement[i.index()] - d[i.index()]).norm() < 1e-15);
    }
  }
  const Component piece = state.components[1];
  for (int i = 0; i < 100; ++i) advance(state, scratch, {body.corners, loads, settings});
  const Vec3 expected =
      piece.centre + 0.1 * piece.momentum / piece.mass + 0.5 * 0.01 * loads.gravity;
  CHECK((state.components[1].centre - expected).norm() < 1e-13);
  CHECK((state.components[1].angular_momentum - piece.angular_momentum).norm() <
        1e-12 * (1 + piece.angular_momentum.norm()));
  for (VertexId i : state.components[0].vertices) {
    if (!state.vertices.support[i.index()].is_none()) {
      CHECK(state.vertices.position[i.index()] == body.rest[i.index()]);
    }
  }
}

TEST_CASE("scratch can be thrown away between two steps without any difference",
          "[mechanics][split]") {
  std::mt19937 random(55);
  INFO("seed 55");
  const Body body = kuhn_block({3, 2, 2}, Vec3(1, 0.5, 0.5));
  MechanicsState a = state_of(body, {.young_modulus = 1e8});
  place(a, ComponentId{0}, {.spin = Vec3(1, 2, 3)});
  deform(a, 1e-3, random);
  MechanicsState b = a;
  const IntegratorSettings settings;
  const Loads loads{.gravity = Vec3(0, 0, -9.81)};
  MechanicsScratch kept;
  for (int i = 0; i < 20; ++i) {
    MechanicsScratch fresh;
    advance(a, kept, {body.corners, loads, settings});
    advance(b, fresh, {body.corners, loads, settings});
  }
  for (std::size_t v = 0; v < body.rest.size(); ++v) {
    CHECK(a.vertices.position[v] == b.vertices.position[v]);
    CHECK(a.vertices.velocity[v] == b.vertices.velocity[v]);
  }
}
