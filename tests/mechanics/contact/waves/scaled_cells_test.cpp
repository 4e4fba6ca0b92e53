// SPDX-License-Identifier: MIT
// Bad cells and the larger inertia of their nodes: steps, momenta and energy.
#include "mechanics/contact/waves/scaled_cells.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "mechanics/contact/waves/wave_bodies.hpp"
#include "mechanics/rebuild.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/second_order.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

double least_volume(const Body& body) {
  double least = 1;
  for (const Corners& c : body.corners) {
    least = std::min(least, tetrahedron_volume({body.rest[c[0].index()], body.rest[c[1].index()],
                                                body.rest[c[2].index()], body.rest[c[3].index()]}));
  }
  return least;
}

/// A block with a vertex that nearly lies on a neighbour.
Body block_with_slivers() {
  const Body block = kuhn_block({6, 6, 6}, Vec3(1, 1, 1));
  for (const Corners& c : block.corners) {
    Body bad = block;
    Vec3& x = bad.rest[c[0].index()];
    x += 0.98 * (bad.rest[c[1].index()] - x);
    if (least_volume(bad) > 0) return bad;
  }
  throw std::logic_error("no vertex can be moved");
}

struct Fixture {
  Body body = block_with_slivers();
  MechanicsState state = state_of(body, {.young_modulus = 1, .poisson_ratio = 0.3, .density = 1});
  Loads loads;
  IntegratorSettings settings;
  StepPart part;
  WaveBodies waves;

  explicit Fixture(int order) {
    if (order == 1) return;
    MechanicsScratch scratch;
    const ComponentId all{0};
    raise_order(state, body.corners);
    rebuild(state, body.corners, {&all, 1}, scratch);
  }

  StepInput input() const {
    return {.corners = body.corners,
            .loads = loads,
            .settings = settings,
            .part = part,
            .measures_strain = true};
  }
  double pack(double viscosity) {
    part.deformation = Deformation::wave;
    part.viscosity = viscosity;
    pack_bodies(waves, state, input());
    const double h = 0.9 * stable_step(waves, waves.bodies[0]);
    prepare_scaled_cells(waves, state, input(), h);
    return h;
  }
  Vec3 momentum() const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < waves.nodes.size(); ++i) {
      sum += waves.nodes.mass[i] * row_of(waves.nodes.velocity, i);
    }
    return sum;
  }
  Vec3 turning() const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < waves.nodes.size(); ++i) {
      const Vec3 p = waves.nodes.mass[i] * row_of(waves.nodes.velocity, i);
      sum += row_of(waves.nodes.position, i).cross(p);
    }
    return sum;
  }
  double kinetic() const {
    double sum = 0;
    for (std::size_t i = 0; i < waves.nodes.size(); ++i) {
      sum += 0.5 * waves.nodes.mass[i] * row_of(waves.nodes.velocity, i).squaredNorm();
    }
    return sum;
  }
};

}  // namespace

TEST_CASE("slivers do not set the step, and motion stays bounded at it", "[mechanics][waves]") {
  const double viscosity = GENERATE(0.0, 0.3);
  const int order = GENERATE(1, 2);
  INFO("viscosity " << viscosity << ", order " << order);
  std::mt19937 random(21);
  Fixture f(order);
  for (Vec3& v : f.state.vertices.velocity) v = 1e-3 * random_vector(random);
  const double h = f.pack(viscosity);
  REQUIRE(!f.waves.nodes.scaled.empty());
  double unscaled = 1;
  const WaveNodes& nodes = f.waves.nodes;
  std::vector<double> stiffness(nodes.size(), 0.0);
  for (std::size_t t = 0; t < f.body.corners.size(); ++t) {
    const ElementNodes own = nodes_of(f.state.elements, f.body.corners, TetId{t});
    for (std::size_t a = 0; a < own.count; ++a) {
      stiffness[f.waves.node_of_vertex[own.row[a].index()]] += f.waves.stiffness[t][a];
    }
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    unscaled = std::min(unscaled, 2 / std::sqrt(stiffness[i] / nodes.mass[i]));
  }
  CHECK(h > 1.3 * unscaled);
  WaveBody& body = f.waves.bodies[0];
  const double start = f.kinetic();
  const Vec3 momentum = f.momentum(), turning = f.turning();
  double most = 0;
  for (int k = 0; k < 2000; ++k) {
    f.waves.velocity_before = f.waves.nodes.velocity;
    find_forces(f.waves, body);
    kick(f.waves, body, k == 0 ? 0.5 * h : h);
    measure_work(f.waves, body);
    drift(f.waves, body, h);
    most = std::max(most, f.kinetic());
  }
  CHECK(most < 1.2 * start);
  CHECK((f.momentum() - momentum).norm() < 1e-14);
  CHECK((f.turning() - turning).norm() < 1e-13);
  CHECK(body.work.inner == Approx(f.kinetic() - start).epsilon(1e-9));
}

TEST_CASE("an impulse at a scaled node brings its momentum and angular momentum",
          "[mechanics][waves]") {
  std::mt19937 random(22);
  Fixture f(GENERATE(1, 2));
  f.pack(0);
  REQUIRE(!f.waves.nodes.scaled.empty());
  begin_scaled_kick(f.waves.nodes, f.waves.bodies[0], Mat3::Identity());
  for (const std::uint32_t node : f.waves.nodes.scaled.front().node) {
    const Vec3 impulse = random_vector(random), x = row_of(f.waves.nodes.position, node);
    const Vec3 momentum = f.momentum(), turning = f.turning();
    const Vec3 before = row_of(f.waves.nodes.velocity, node);
    push_node(f.waves.nodes, node, impulse);
    CHECK((f.momentum() - momentum - impulse).norm() < 1e-12);
    CHECK((f.turning() - turning - x.cross(impulse)).norm() < 1e-12);
    const Vec3 expected = response_between(f.waves.nodes, node, node) * impulse;
    CHECK((row_of(f.waves.nodes.velocity, node) - before - expected).norm() <
          1e-9 * expected.norm());
    // More mass than its own is moved, never less.
    CHECK(impulse.dot(expected) <= impulse.squaredNorm() / f.waves.nodes.mass[node] * (1 + 1e-12));
  }
}
