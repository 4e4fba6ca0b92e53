// SPDX-License-Identifier: MIT
// The longest explicit step against the matrices of whole bodies.
#include "mechanics/contact/waves/longest_step.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "mechanics/state/dense_solve.hpp"
#include "tests/support/second_order.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// M^-1/2 (h^2 K + 2 h C) M^-1/2 / 4 of packed nodes, from forces of displacements and rates.
Eigen::MatrixXd matrix_of_step(WaveBodies& waves, double h) {
  const WaveNodes& nodes = waves.nodes;
  const std::size_t n = nodes.size();
  const auto size = static_cast<Eigen::Index>(3 * n);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t i = 0; i < n; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      QuadColumn displacement(4 * n, 0.0), rate = displacement, inner = displacement;
      displacement[4 * i + static_cast<std::size_t>(axis)] = h * h / 4;
      rate[4 * i + static_cast<std::size_t>(axis)] = h / 2;
      const NodeMotion motion{displacement, rate, inner};
      add_block_forces(motion, waves.blocks);
      add_block_forces(motion, waves.second);
      for (std::size_t k = 0; k < n; ++k) {
        A.block<3, 1>(static_cast<Eigen::Index>(3 * k), static_cast<Eigen::Index>(3 * i) + axis) =
            std::sqrt(nodes.inverse_mass[k] * nodes.inverse_mass[i]) * row_of(inner, k);
      }
    }
  }
  return A;
}

double highest(const Eigen::MatrixXd& A) {
  return symmetric_eigen(A, Eigen::EigenvaluesOnly).eigenvalues().tail<1>()[0];
}

void pack(WaveBodies& waves, const Body& body, const MechanicsState& state, double viscosity) {
  StepPart part;
  part.deformation = Deformation::wave;
  part.viscosity = viscosity;
  pack_bodies(waves, state, {.corners = body.corners, .loads = {}, .settings = {}, .part = part});
}

Body random_block(std::mt19937& random) {
  return shaken(kuhn_block({3, 2, 2}, Vec3(1.5, 1, 0.7)), 0.08, random);
}

}  // namespace

TEST_CASE("the longest step is stable for the whole body's matrices, and near the most that is",
          "[mechanics][waves]") {
  std::mt19937 random(31);
  const double viscosity = GENERATE(0.0, 0.1, 0.3);
  for (int trial = 0; trial < 10; ++trial) {
    const Body body = random_block(random);
    MechanicsState state =
        state_of(body, {.young_modulus = 3e10, .poisson_ratio = 0.04 * trial, .density = 2400});
    if (trial % 2 == 1) hold_below(state, body, -0.5);
    WaveBodies waves;
    pack(waves, body, state, viscosity);
    const double h = longest_step(waves);
    CHECK(h == waves.longest_step);
    CHECK(h >= stable_step(waves, waves.bodies[0]));
    CHECK(highest(matrix_of_step(waves, h)) <= 1 + 1e-9);
    // Five sixths of the limit are taken.
    const double limit = 1.2 * h;
    const double share = highest(matrix_of_step(waves, limit));
    CHECK(share <= 1 + 1e-9);
    CHECK(share > 0.5);
    CHECK(limit > 1.1 * stable_step(waves, waves.bodies[0]));
  }
}

TEST_CASE("the bound of one element is its highest eigenvalue, or a little above",
          "[mechanics][waves]") {
  std::mt19937 random(32);
  std::uniform_real_distribution<double> mass(0.1, 3);
  for (int trial = 0; trial < 50; ++trial) {
    const Body body = shaken(single_tetrahedron(1), 0.2, random);
    const MechanicsState state = state_of(body, Material{});
    WaveBodies waves;
    waves.blocks.resize(1);
    for (std::size_t lane = 0; lane < 4; ++lane) {
      const Lame moduli = lane == 0 ? Lame{0.4, 0.7} : Lame{0, 0};
      set_element<4>(waves.blocks[0], lane, state.elements.shape_gradient[0], moduli, {0, 1, 2, 3});
    }
    std::array<double, 4> inverse{};
    for (std::size_t a = 0; a < 4; ++a) {
      inverse[a] = trial % 5 == 0 && a == 0 ? 0 : 1 / mass(random);
    }
    waves.nodes.vertex.resize(4);
    waves.nodes.inverse_mass.assign(inverse.begin(), inverse.end());
    const double exact = highest(matrix_of_step(waves, 2));
    const double bound = highest_of_element(waves.blocks[0], 0, inverse);
    CHECK(bound >= exact * (1 - 1e-9));
    CHECK(bound <= 1.12 * exact);
  }
}

TEST_CASE("the longest step is the same however the body came to be packed", "[mechanics][waves]") {
  std::mt19937 random(33);
  const Body body = random_block(random);
  MechanicsState state =
      state_of(body, {.young_modulus = 1e9, .poisson_ratio = 0.2, .density = 1000});
  WaveBodies used;
  pack(used, body, state, 0.1);
  const double before = used.longest_step;
  hold_below(state, body, -0.5);
  WaveBodies fresh;
  pack(used, body, state, 0.1);
  pack(fresh, body, state, 0.1);
  CHECK(used.longest_step == fresh.longest_step);
  CHECK(used.longest_step >= before);
}

TEST_CASE("without bodies every step is stable", "[mechanics][waves]") {
  WaveBodies none;
  CHECK(std::isinf(longest_step(none)));
}
