// SPDX-License-Identifier: MIT
// Flights of a block and their judgement.
#include "tests/stability/flight.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "mechanics/element/energy.hpp"
#include "mechanics/element/second_order.hpp"
#include "mechanics/element/strain_displacement.hpp"
#include "mechanics/state/settings/check_settings.hpp"

namespace sunder::stability {
namespace {

double energy_of(const MechanicsState& state, const Loads& loads) {
  return kinetic_energy(state.vertices) + strain_energy(state) +
         gravity_energy(state.vertices, loads.gravity);
}

/// A block that spins about its axis of largest inertia, in its equilibrium or deformed.
MechanicsState start_of(const Flight& flight, const test::Body& body, int order) {
  MechanicsState state = test::state_of_order(order, body, flight.material);
  Vec3 spin = flight.spin;
  if (flight.deformation == 0) {
    const Eigen::SelfAdjointEigenSolver<Mat3> axes(state.components[0].rest_inertia);
    spin = flight.spin.norm() * axes.eigenvectors().col(2);
  }
  place(state, ComponentId{0}, {.velocity = Vec3(1, 2, 3), .spin = spin});
  if (flight.deformation > 0) {
    std::mt19937 random(81);
    test::deform(state, flight.deformation, random);
  } else {
    // The default method with long steps comes to the equilibrium of a spin by itself.
    const double turn = 0.2 / std::max(1.0, spin.norm());
    test::run(state, body, {.time_step = turn}, 40);
    place(state, ComponentId{0}, {.velocity = Vec3(1, 2, 3), .spin = spin});
    test::run(state, body, {.time_step = turn}, 40);
  }
  MechanicsScratch scratch;
  measure_elements(state, scratch, body.corners);
  return state;
}

/// The forces on the `count` nodes of a tetrahedron where node `b` moves by one along an axis, N.
NodeVectors forces_of(const ShapeGradient& G, double volume, const Lame& constants,
                      std::size_t count, std::size_t b, int axis) {
  NodeVectors forces;
  if (count == 4) {
    const Mat3 H = Vec3::Unit(axis) * G.col(static_cast<Eigen::Index>(b)).transpose();
    const Eigen::Matrix<double, 3, 4> f = volume * stress_of(H, constants) * G;
    for (std::size_t a = 0; a < 4; ++a) forces[a] = f.col(static_cast<Eigen::Index>(a));
    return forces;
  }
  NodeVectors d;
  d.fill(Vec3::Zero());
  d[b] = Vec3::Unit(axis);
  std::array<Mat3, 4> stress = corner_gradients(G, d);
  for (Mat3& at_corner : stress) at_corner = stress_of(at_corner, constants);
  for (std::size_t a = 0; a < count; ++a) forces[a] = second_order_force(G, volume, stress, a);
  return forces;
}

/// The figures of the run, worst of all its steps.
struct Seen {
  double start = 0, vibration = 0;   ///< J: at the start, and its part that is no rigid motion
  double gain = 0, motion_gain = 0;  ///< J: all, and without strain
  double stress = 0;                 ///< Pa
  double spin_left = 1;              ///< |L| / |L0|
  double off_parabola = 0;           ///< relative
};

Cell judged(const Seen& seen, const Method& method, double expected_stress) {
  const double allowed =
      1e-6 * std::abs(seen.start) + (method.energy_swings ? 2 : 1e-6) * seen.vibration;
  if (!(seen.motion_gain <= allowed)) return {Outcome::gains, seen.motion_gain / seen.start};
  if (seen.spin_left > 1.01) return {Outcome::gains, seen.spin_left};
  if (seen.gain > allowed || seen.stress > 2.5 * expected_stress) {
    return {Outcome::false_stress, seen.stress / expected_stress};
  }
  if (seen.spin_left < 0.99) return {Outcome::loses, seen.spin_left};
  if (!(seen.off_parabola < 1e-12)) return {Outcome::off_path, seen.off_parabola};
  return {Outcome::holds, seen.off_parabola};
}

}  // namespace

Rigid rigid_of(const MechanicsState& state) {
  const VertexColumns& v = state.vertices;
  Rigid r;
  for (std::size_t i = 0; i < v.size(); ++i) {
    r.mass += v.mass[i];
    r.centre += v.mass[i] * v.position[i];
  }
  r.centre /= r.mass;
  r.momentum = momentum(v);
  Mat3 inertia = Mat3::Zero();
  for (std::size_t i = 0; i < v.size(); ++i) {
    const Vec3 arm = v.position[i] - r.centre;
    r.spin += v.mass[i] * arm.cross(v.velocity[i]);
    inertia += v.mass[i] * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
  }
  r.energy =
      0.5 * r.momentum.squaredNorm() / r.mass + 0.5 * r.spin.dot(inertia.ldlt().solve(r.spin));
  return r;
}

double largest_stress(const MechanicsState& state) {
  double largest = 0;
  const auto look = [&largest](const Mat3& sigma) {
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(sigma, Eigen::EigenvaluesOnly);
    largest = std::max(largest, solver.eigenvalues()[2]);
  };
  std::ranges::for_each(state.elements.stress, look);
  for (const auto& corners : state.elements.corner_stress) std::ranges::for_each(corners, look);
  return largest;
}

test::Body flight_body(double sliver_angle) {
  test::Body body = test::kuhn_block({3, 2, 2}, Vec3(1, 0.5, 0.5));
  if (sliver_angle >= 45) return body;
  // The topmost corner comes down in its cell: of the cell's six tetrahedra the two that go up last
  // have their middle diagonal face and their bottom meet at this angle.
  body.rest.back().z() = 0.25 * std::tan(sliver_angle * M_PI / 180);
  return body;
}

double highest_frequency(const MechanicsState& state, const test::Body& body) {
  const auto n = static_cast<Eigen::Index>(3 * state.vertices.size());
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
  const Lame constants = lame(state.materials[0]);
  for (std::size_t t = 0; t < body.corners.size(); ++t) {
    const ShapeGradient& G = state.elements.shape_gradient[t];
    std::vector<VertexId> nodes(body.corners[t].begin(), body.corners[t].end());
    if (!state.elements.edge_nodes.empty()) {
      nodes.insert(nodes.end(), state.elements.edge_nodes[t].begin(),
                   state.elements.edge_nodes[t].end());
    }
    for (std::size_t b = 0; b < nodes.size(); ++b) {
      for (int axis = 0; axis < 3; ++axis) {
        const auto forces =
            forces_of(G, state.elements.rest_volume[t], constants, nodes.size(), b, axis);
        for (std::size_t a = 0; a < nodes.size(); ++a) {
          K.block<3, 1>(3 * nodes[a].value, 3 * nodes[b].value + axis) += forces[a];
        }
      }
    }
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      K(i, j) /= std::sqrt(state.vertices.mass[std::size_t(i / 3)] *
                           state.vertices.mass[std::size_t(j / 3)]);
    }
  }
  return std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K, Eigen::EigenvaluesOnly)
                       .eigenvalues()[n - 1]);
}

Cell fly(const Flight& flight, const Method& method) {
  if (!check_settings(flight.material, "material").empty()) return {Outcome::refuses, 0};
  const test::Body body = flight_body(flight.sliver_angle);
  MechanicsState state = start_of(flight, body, method.order);
  const Loads loads{.gravity = flight.weight ? Vec3(0, 0, -9.81) : Vec3::Zero()};
  IntegratorSettings settings = method.settings;
  settings.time_step = flight.time_step;

  const Rigid start = rigid_of(state);
  Seen seen;
  seen.start = energy_of(state, loads);
  seen.vibration = kinetic_energy(state.vertices) + strain_energy(state) - start.energy;
  // Of the deformation it begins with, and a spin that sets in suddenly.
  const double w = flight.spin.norm();
  const double spin_stress = flight.material.density * w * w / 8;
  const double expected = 2 * largest_stress(state) + 2 * spin_stress;
  int taken = 0;
  const StepStatus status = test::run(state, body, settings, flight.steps, loads, [&] {
    ++taken;
    const double gained = energy_of(state, loads) - seen.start;
    seen.gain = std::max(seen.gain, gained);
    seen.motion_gain = std::max(seen.motion_gain, gained - strain_energy(state));
    seen.stress = std::max(seen.stress, largest_stress(state));
  });
  if (status.outcome == StepOutcome::overturned) return {Outcome::refuses, status.turned};
  if (status.outcome != StepOutcome::fine) return {Outcome::diverges, double(taken)};
  const Rigid end = rigid_of(state);
  seen.spin_left = end.spin.norm() / start.spin.norm();
  const double time = flight.steps * flight.time_step;
  const Vec3 expected_centre =
      start.centre + time / start.mass * start.momentum + 0.5 * time * time * loads.gravity;
  seen.off_parabola = (end.centre - expected_centre).norm() / (1 + expected_centre.norm());
  return judged(seen, method, expected);
}

}  // namespace sunder::stability
