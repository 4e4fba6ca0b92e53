// SPDX-License-Identifier: MIT
// Algorithm 1: the conservative force is a gradient without force or torque; the paper's is not.
#include <catch2/catch.hpp>

#include <cmath>

#include "mechanics/element/elastic_force.hpp"
#include "tests/support/second_order.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

struct Forces {
  std::vector<Vec3> displacement, force;
  double energy = 0;
};

Forces forces_at(const MechanicsState& state, const Body& body, std::span<const Vec3> positions,
                 ElasticForce form) {
  Forces out{std::vector<Vec3>(positions.size()), std::vector<Vec3>(positions.size())};
  const ElasticInput input{state, body.corners, positions, form};
  deformation_forces({out.displacement, out.force}, input, state.components[0]);
  out.energy = elastic_energy(input, state.components[0], out.displacement);
  return out;
}

/// Net torque about the origin and the sum of its parts' sizes.
std::pair<Vec3, double> torque_of(const std::vector<Vec3>& positions,
                                  const std::vector<Vec3>& forces) {
  Vec3 net = Vec3::Zero();
  double size = 0;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    net += positions[v].cross(forces[v]);
    size += positions[v].cross(forces[v]).norm();
  }
  return {net, size};
}

struct Deformed {
  Body body;
  MechanicsState state;
};

Deformed deformed_block(double amount, std::mt19937& random, int order = 1) {
  Body body = shaken(kuhn_block({2, 2, 3}, Vec3(0.5, 0.5, 1)), 0.03, random);
  MechanicsState state =
      state_of_order(order, body, {.young_modulus = 1, .poisson_ratio = 0.3, .density = 1});
  place(state, ComponentId{0}, {.orientation = random_rotation(random)});
  deform(state, amount, random);
  return {std::move(body), std::move(state)};
}

}  // namespace

TEST_CASE("the conservative force is minus the gradient of the energy",
          "[mechanics][algorithm1][force]") {
  std::mt19937 random(31);
  INFO("seed 31");
  const double amount = GENERATE(0.01, 0.1);
  const int order = GENERATE(1, 2);
  const auto [body, state] = deformed_block(amount, random, order);
  std::vector<Vec3> x = state.vertices.position;
  const Forces at = forces_at(state, body, x, ElasticForce::conservative);
  double largest = 0, worst = 0, worst_paper = 0;
  const Forces paper = forces_at(state, body, x, ElasticForce::paper);
  // Central differences: the error of the rule is (h/L)^2 of the force, that of rounding eps E / h.
  const double h = 1e-5;
  for (std::size_t v = 0; v < x.size(); v += 3) {
    for (int axis = 0; axis < 3; ++axis) {
      const double here = x[v][axis];
      x[v][axis] = here + h;
      const double up = forces_at(state, body, x, ElasticForce::conservative).energy;
      x[v][axis] = here - h;
      const double down = forces_at(state, body, x, ElasticForce::conservative).energy;
      x[v][axis] = here;
      const double slope = (up - down) / (2 * h);
      largest = std::max(largest, std::abs(slope));
      worst = std::max(worst, std::abs(slope + at.force[v][axis]));
      worst_paper = std::max(worst_paper, std::abs(slope + paper.force[v][axis]));
    }
  }
  CHECK(worst < 1e-6 * largest);
  CHECK(worst_paper > 1e-4 * largest);  // of the order of the strain: the term matters
}

TEST_CASE("the conservative force has neither net force nor torque, the paper's has a ghost torque",
          "[mechanics][algorithm1][force]") {
  std::mt19937 random(32);
  INFO("seed 32");
  const int order = GENERATE(1, 2);
  double last_ghost = 0;
  for (double amount : {1e-1, 1e-2, 1e-3}) {
    random.seed(32);
    const auto [body, state] = deformed_block(amount, random, order);
    const std::vector<Vec3>& x = state.vertices.position;
    const Forces good = forces_at(state, body, x, ElasticForce::conservative);
    const Forces paper = forces_at(state, body, x, ElasticForce::paper);
    Vec3 net = Vec3::Zero();
    double size = 0;
    for (const Vec3& f : good.force) {
      net += f;
      size += f.norm();
    }
    CHECK(net.norm() < 1e-13 * size);
    const auto [torque, torque_size] = torque_of(x, good.force);
    CHECK(torque.norm() < 1e-13 * torque_size);
    const auto [ghost, ghost_size] = torque_of(x, paper.force);
    CHECK(ghost.norm() > 1e-3 * amount * ghost_size);
    // Relative to the forces it is of first order in the displacement.
    if (last_ghost > 0) {
      CHECK(ghost.norm() / ghost_size == Approx(last_ghost / 10).epsilon(order == 1 ? 0.3 : 0.5));
    }
    last_ghost = ghost.norm() / ghost_size;
  }
}

TEST_CASE("forces turn with the body and never push it along", "[mechanics][algorithm1]") {
  std::mt19937 random(33);
  INFO("seed 33");
  const auto [body, state] = deformed_block(0.02, random);
  const std::vector<Vec3>& x = state.vertices.position;
  const Forces at = forces_at(state, body, x, ElasticForce::conservative);
  const Eigen::Quaterniond Q = random_rotation(random);
  std::vector<Vec3> turned;
  for (const Vec3& p : x) turned.push_back(Q * p + Vec3(1, 2, 3));
  const Forces there = forces_at(state, body, turned, ElasticForce::conservative);
  double size = 0, difference = 0, work = 0;
  for (std::size_t v = 0; v < x.size(); ++v) {
    size += at.force[v].squaredNorm();
    difference += (there.force[v] - Q * at.force[v]).squaredNorm();
    const Component& component = state.components[0];
    work += at.force[v].dot(component.orientation * at.displacement[v]);
  }
  CHECK(std::sqrt(difference) < 1e-11 * std::sqrt(size));
  CHECK(work < 0);  // the sign (docs/explanation/paper.md): forces work against the displacement
}
