// SPDX-License-Identifier: MIT
// Explicit steps of free and held bodies against algorithm 1 as it stands, and their laws.
#include "mechanics/contact/waves/wave_bodies.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "mechanics/element/elastic_force.hpp"
#include "mechanics/state/dense_solve.hpp"
#include "tests/support/second_order.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

struct Packed {
  Body body;
  MechanicsState state;
  Loads loads = {};
  IntegratorSettings settings = {};
  WaveBodies waves = {};

  void pack(double viscosity) {
    StepPart part;
    part.deformation = Deformation::wave;
    part.viscosity = viscosity;
    pack_bodies(waves, state,
                {.corners = body.corners,
                 .loads = loads,
                 .settings = settings,
                 .part = part,
                 .measures_strain = true});
  }
  /// Half a kick, a drift and half a kick of the first body, with their works.
  void take_step(double h) {
    WaveBody& first = waves.bodies[0];
    for (const bool is_first : {true, false}) {
      waves.velocity_before = waves.nodes.velocity;
      find_forces(waves, first);
      kick(waves, first, 0.5 * h);
      measure_work(waves, first);
      if (is_first) drift(waves, first, h);
    }
  }
  double kinetic() const {
    double sum = 0;
    for (std::size_t i = 0; i < waves.nodes.size(); ++i) {
      sum += 0.5 * waves.nodes.mass[i] * row_of(waves.nodes.velocity, i).squaredNorm();
    }
    return sum;
  }
  std::vector<Vec3> column(const QuadColumn& values) const {
    std::vector<Vec3> rows(state.vertices.size());
    for (std::size_t i = 0; i < waves.nodes.size(); ++i) {
      rows[waves.nodes.vertex[i].index()] = row_of(values, i);
    }
    return rows;
  }
};

Packed deformed_block(int order, double amount, std::mt19937& random) {
  const Body body = shaken(kuhn_block({2, 2, 3}, Vec3(0.5, 0.5, 1)), 0.03, random);
  Packed packed{
      body, state_of_order(order, body, {.young_modulus = 1, .poisson_ratio = 0.3, .density = 1})};
  place(packed.state, ComponentId{0},
        {.orientation = random_rotation(random), .velocity = random_vector(random)});
  deform(packed.state, amount, random);
  return packed;
}

/// Kinetic and strain energy of the packed nodes, J.
double energy_of(const Packed& packed) {
  const std::vector<Vec3> x = packed.column(packed.waves.nodes.position);
  std::vector<Vec3> d(x.size()), f(x.size());
  const ElasticInput input{packed.state, packed.body.corners, x};
  deformation_forces({d, f}, input, packed.state.components[0]);
  return packed.kinetic() + elastic_energy(input, packed.state.components[0], d);
}

}  // namespace

TEST_CASE("a kick is algorithm 1 in its conservative form", "[mechanics][waves]") {
  std::mt19937 random(11);
  const int order = GENERATE(1, 2);
  const double amount = GENERATE(1e-4, 0.1);
  Packed packed = deformed_block(order, amount, random);
  packed.loads.gravity = {0.3, -0.2, 1};
  packed.pack(0);
  const std::vector<Vec3> before = packed.column(packed.waves.nodes.velocity);
  const std::size_t n = before.size();
  std::vector<Vec3> d(n), f(n);
  deformation_forces({d, f}, {packed.state, packed.body.corners, packed.state.vertices.position},
                     packed.state.components[0]);
  const double step = 0.01;
  find_forces(packed.waves, packed.waves.bodies[0]);
  kick(packed.waves, packed.waves.bodies[0], step);
  const std::vector<Vec3> after = packed.column(packed.waves.nodes.velocity);
  double largest = 0;
  for (std::size_t v = 0; v < n; ++v) {
    largest = std::max(largest, (f[v] / packed.state.vertices.mass[v]).norm());
  }
  for (std::size_t v = 0; v < n; ++v) {
    const Vec3 expected =
        before[v] + step * (f[v] / packed.state.vertices.mass[v] + packed.loads.gravity);
    CHECK((after[v] - expected).norm() < 1e-12 * (1 + step * largest));
  }
}

TEST_CASE("free bodies keep energy to second order, and momenta to rounding",
          "[mechanics][waves]") {
  const int order = GENERATE(1, 2);
  const auto run = [&](double share, double viscosity) {
    std::mt19937 own(12);
    Packed packed = deformed_block(order, 0.02, own);
    packed.pack(viscosity);
    WaveBody& body = packed.waves.bodies[0];
    const double h = share * stable_step(packed.waves, body);
    const auto momenta = [&] {
      Vec3 p = Vec3::Zero(), l = Vec3::Zero();
      for (std::size_t i = 0; i < packed.waves.nodes.size(); ++i) {
        const Vec3 mv = packed.waves.nodes.mass[i] * row_of(packed.waves.nodes.velocity, i);
        p += mv;
        l += Vec3(row_of(packed.waves.nodes.position, i)).cross(mv);
      }
      return std::pair(p, l);
    };
    const auto [p, l] = momenta();
    const double start = energy_of(packed);
    double lowest = start, highest = start;
    for (int k = 0; k < 400; ++k) {
      packed.take_step(h);
      lowest = std::min(lowest, energy_of(packed));
      highest = std::max(highest, energy_of(packed));
    }
    const auto [p_end, l_end] = momenta();
    CHECK((p_end - p).norm() < 1e-11 * p.norm());
    CHECK((l_end - l).norm() < 1e-11 * (l.norm() + 1));
    return (highest - lowest) / start;
  };
  const double coarse = run(0.8, 0), fine = run(0.4, 0);
  CHECK(coarse < 0.02);
  CHECK(fine < 0.35 * coarse);
}

TEST_CASE("viscosity takes energy, never gives any, and as much as stress takes from motion",
          "[mechanics][waves]") {
  std::mt19937 random(13);
  Packed packed = deformed_block(1, 0.02, random);
  packed.pack(0.3);
  WaveBody& body = packed.waves.bodies[0];
  const double h = 0.9 * stable_step(packed.waves, body);
  const double start = energy_of(packed), kinetic_start = packed.kinetic();
  double last = start;
  for (int k = 0; k < 300; ++k) {
    packed.take_step(h);
    const double now = energy_of(packed);
    CHECK(now < last * (1 + 1e-3));
    last = now;
  }
  CHECK(last < start);
  CHECK(body.work.inner == Approx(packed.kinetic() - kinetic_start).epsilon(1e-9));
}

TEST_CASE("the stable step is that of the whole body's matrices or less", "[mechanics][waves]") {
  std::mt19937 random(14);
  const int order = GENERATE(1, 2);
  const double viscosity = GENERATE(0.0, 0.05, 0.3, 3.0);
  Packed packed = deformed_block(order, 0, random);
  packed.pack(viscosity);
  const std::size_t n = packed.waves.nodes.size();
  const auto size = static_cast<Eigen::Index>(3 * n);
  const double bound = stable_step(packed.waves, packed.waves.bodies[0]);
  // Columns of M^-1/2 (h^2 K + 2 h C) M^-1/2 / 4 from forces of displacements and rates.
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t i = 0; i < n; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      WaveNodes& nodes = packed.waves.nodes;
      QuadColumn displacement(4 * n, 0.0), rate = displacement, inner = displacement;
      displacement[4 * i + static_cast<std::size_t>(axis)] = bound * bound / 4;
      rate[4 * i + static_cast<std::size_t>(axis)] = bound / 2;
      const NodeMotion motion{displacement, rate, inner};
      add_block_forces(motion, packed.waves.blocks);
      add_block_forces(motion, packed.waves.second);
      for (std::size_t k = 0; k < n; ++k) {
        A.block<3, 1>(static_cast<Eigen::Index>(3 * k), static_cast<Eigen::Index>(3 * i) + axis) =
            row_of(inner, k) / std::sqrt(nodes.mass[k] * nodes.mass[i]);
      }
    }
  }
  const double highest = symmetric_eigen(A, Eigen::EigenvaluesOnly).eigenvalues().tail<1>()[0];
  CHECK(highest <= 1 + 1e-9);
  CHECK(highest > 0.25);
}

TEST_CASE("viscosity shortens the stable step by no more than its share of critical damping",
          "[mechanics][waves]") {
  std::mt19937 random(15);
  const int order = GENERATE(1, 2);
  Packed packed = deformed_block(order, 0, random);
  packed.pack(0);
  const double undamped = stable_step(packed.waves, packed.waves.bodies[0]);
  packed.pack(1e6);
  CHECK(stable_step(packed.waves, packed.waves.bodies[0]) ==
        Approx((std::sqrt(1.25) - 0.5) * undamped));
}

TEST_CASE("held nodes go on with their support, which does the work that is missing",
          "[mechanics][waves]") {
  Packed packed{kuhn_block({2, 1, 1}, Vec3(1, 0.5, 0.5)), {}};
  const Material material{.young_modulus = 1, .poisson_ratio = 0.3, .density = 1};
  packed.state = state_of(packed.body, material);
  const PrescribedMotion motion{.velocity = {0.01, 0, 0}};
  packed.state.motions = {motion};
  std::vector<MotionId>& support = packed.state.vertices.support;
  for (std::size_t v = 0; v < support.size(); ++v) {
    if (packed.body.rest[v].x() < -0.49) support[v] = MotionId{0};
  }
  const ComponentId id{0};
  MechanicsScratch scratch;
  rebuild(packed.state, packed.body.corners, {&id, 1}, scratch);
  packed.pack(0);
  WaveBody& body = packed.waves.bodies[0];
  const double h = 0.9 * stable_step(packed.waves, body);
  const double kinetic_start = packed.kinetic();
  for (int k = 0; k < 50; ++k) {
    packed.take_step(h);
  }
  const double kinetic_end = packed.kinetic();
  for (std::size_t i = 0; i < packed.waves.nodes.size(); ++i) {
    const std::size_t v = packed.waves.nodes.vertex[i].index();
    if (support[v].is_none()) continue;
    const Vec3 expected = packed.body.rest[v] + 50 * h * motion.velocity;
    CHECK((row_of(packed.waves.nodes.position, i) - expected).norm() < 1e-13);
  }
  CHECK(body.work.supports > 0);
  CHECK(body.work.inner + body.work.supports == Approx(kinetic_end - kinetic_start).epsilon(1e-9));
}

TEST_CASE("bodies that are packed already move as bodies that are packed again",
          "[mechanics][waves]") {
  std::mt19937 random(21);
  const int order = GENERATE(1, 2);
  Packed kept = deformed_block(order, 0.01, random);
  kept.pack(0.1);
  place(kept.state, ComponentId{0},
        {.orientation = random_rotation(random), .velocity = {1, 2, 3}});
  deform(kept.state, 0.02, random);
  Packed fresh{kept.body, kept.state};
  kept.pack(0.1);
  fresh.pack(0.1);
  kept.take_step(0.01);
  fresh.take_step(0.01);
  CHECK(kept.waves.nodes.position == fresh.waves.nodes.position);
  CHECK(kept.waves.nodes.velocity == fresh.waves.nodes.velocity);
  // A new viscosity or mass has the body packed again.
  kept.pack(0.2);
  fresh.waves = {};
  fresh.pack(0.2);
  CHECK(kept.waves.nodes.damping == fresh.waves.nodes.damping);
  kept.state.vertices.mass[3] *= 2;
  kept.pack(0.2);
  CHECK(kept.waves.nodes.mass[3] == kept.state.vertices.mass[3]);
}
