// SPDX-License-Identifier: MIT
// Second-order tetrahedra: blocks against quadrature, quadratic fields exact, weights, equilibria.
#include <catch2/catch.hpp>

#include <map>
#include <numbers>

#include "mechanics/element/energy.hpp"
#include "mechanics/element/second_order.hpp"
#include "mechanics/rebuild.hpp"
#include "mechanics/state/loads.hpp"
#include "mechanics/state/step_input.hpp"
#include "mechanics/statics/static_solve.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/second_order.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

const Material stone{.young_modulus = 3e10, .poisson_ratio = 0.27, .density = 2400};

/// Gradient of a shape function where the barycentric coordinates are L, as the textbook has it.
Vec3 gradient_at(const ShapeGradient& G, std::size_t node, const Eigen::Vector4d& L) {
  if (node < 4) {
    const auto a = static_cast<Eigen::Index>(node);
    return (4 * L[a] - 1) * G.col(a);
  }
  const auto [i, j] = edge_ends[node - 4];
  return 4 * (L[i] * G.col(j) + L[j] * G.col(i));
}

/// B of section 3.1 for ten nodes at one place.
Eigen::Matrix<double, 6, 30> strain_at(const ShapeGradient& G, const Eigen::Vector4d& L) {
  Eigen::Matrix<double, 6, 30> B = Eigen::Matrix<double, 6, 30>::Zero();
  for (std::size_t k = 0; k < 10; ++k) {
    const Vec3 g = gradient_at(G, k, L);
    B.block<6, 3>(0, static_cast<Eigen::Index>(3 * k)) << g.x(), 0, 0, 0, g.y(), 0, 0, 0, g.z(), 0,
        g.z(), g.y(), g.z(), 0, g.x(), g.y(), g.x(), 0;
  }
  return B;
}

/// Four points that are exact for polynomials of second order (Keast).
std::array<Eigen::Vector4d, 4> quadrature() {
  const double a = (5 - std::sqrt(5.0)) / 20, b = 1 - 3 * a;
  std::array<Eigen::Vector4d, 4> points;
  for (int k = 0; k < 4; ++k) {
    points[static_cast<std::size_t>(k)].setConstant(a);
    points[static_cast<std::size_t>(k)][k] = b;
  }
  return points;
}

std::array<Vec3, 4> random_tetrahedron(std::mt19937& random) {
  std::array<Vec3, 4> p;
  do {
    for (Vec3& x : p) x = random_vector(random);
  } while (tetrahedron_volume(p) < 0.05);
  return p;
}

/// u of a bar that is bent by moments at its ends, round an axis askew; div sigma is nothing.
Vec3 bent(const Vec3& x, double poisson_ratio) {
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  const Vec3 y = turn.transpose() * x;
  const double k = 1e-3, nu = poisson_ratio;
  return turn * Vec3(k * y[0] * y[2], -nu * k * y[1] * y[2],
                     -0.5 * k * (y[0] * y[0] + nu * (y[2] * y[2] - y[1] * y[1])));
}

}  // namespace

TEST_CASE("blocks of ten-node tetrahedra are what quadrature gives", "[mechanics][element]") {
  std::mt19937 random(31);
  const Lame constants = lame(stone);
  for (int trial = 0; trial < 20; ++trial) {
    const std::array<Vec3, 4> p = random_tetrahedron(random);
    const ShapeGradient G = shape_gradients(p);
    const double volume = tetrahedron_volume(p);
    Eigen::Matrix<double, 30, 30> K = Eigen::Matrix<double, 30, 30>::Zero(), ours = K;
    for (const Eigen::Vector4d& L : quadrature()) {
      const auto B = strain_at(G, L);
      K += volume / 4 * B.transpose() * elasticity_matrix(constants) * B;
    }
    for (std::size_t b = 0; b < 10; ++b) {
      for (std::size_t a = 0; a < 10; ++a) {
        Mat3 block = Mat3::Zero();
        add_second_order_block(block.data(), G, a, b,
                               {volume * constants.lambda, volume * constants.mu});
        ours.block<3, 3>(static_cast<Eigen::Index>(3 * a), static_cast<Eigen::Index>(3 * b)) =
            block;
      }
    }
    CHECK((ours - K).norm() < 1e-13 * K.norm());
  }
}

TEST_CASE("shares and weights of ten nodes sum to one and keep the centre",
          "[mechanics][element]") {
  const std::array<Vec3, 4> p = {Vec3(0, 0, 0), {1, 0, 0}, {0, 2, 0}, {0.3, 0.1, 1}};
  double share = 0, weight = 0;
  Vec3 centre = Vec3::Zero(), moment = Vec3::Zero();
  for (std::size_t k = 0; k < 10; ++k) {
    const Vec3 at = k < 4 ? p[k]
                          : Vec3(0.5 * (p[static_cast<std::size_t>(edge_ends[k - 4][0])] +
                                        p[static_cast<std::size_t>(edge_ends[k - 4][1])]));
    share += node_share(10, k);
    weight += node_weight(k);
    centre += node_share(10, k) * at;
    moment += node_weight(k) * at;
  }
  const Vec3 mean = 0.25 * (p[0] + p[1] + p[2] + p[3]);
  CHECK(share == Approx(1).epsilon(1e-15));
  CHECK(weight == Approx(1).epsilon(1e-15));
  CHECK((centre - mean).norm() < 1e-15);
  CHECK((moment - mean).norm() < 1e-15);
  CHECK(node_share(4, 2) == 0.25);
}

TEST_CASE("second order bends exactly: interior nodes of a bar under moments, and its stresses",
          "[mechanics][element]") {
  // Nothing but the boundary is given; straight cells of any shape hold every quadratic field.
  Body body = jittered(kuhn_block({4, 2, 2}, {2, 0.6, 0.5}), 0.05, 5);
  MechanicsState state = state_of(body, stone);
  raise_order(state, body.corners);
  const std::vector<bool> outside = boundary_nodes(state, body.corners);
  state.motions.push_back({});
  std::size_t inside = 0;
  for (std::size_t v = 0; v < state.vertices.size(); ++v) {
    if (!outside[v]) {
      ++inside;
      continue;
    }
    state.vertices.support[v] = MotionId{0};
  }
  REQUIRE(inside > 20);
  MechanicsScratch scratch;
  const ComponentId id{0};
  rebuild(state, body.corners, {&id, 1}, scratch);
  for (std::size_t v = 0; v < state.vertices.size(); ++v) {
    if (outside[v]) state.vertices.displacement[v] = bent(state.vertices.rest_position[v], 0.27);
  }
  REQUIRE(solve_static(state, scratch, body.corners, {}).empty());
  double largest = 0, off = 0;
  for (std::size_t v = 0; v < state.vertices.size(); ++v) {
    const Vec3 exact = bent(state.vertices.rest_position[v], 0.27);
    largest = std::max(largest, exact.norm());
    off = std::max(off, (state.vertices.displacement[v] - exact).norm());
  }
  CHECK(off < 1e-12 * largest);

  // sigma = E k z' along the bar and nothing else; its energy is 1/2 d^T K d.
  const Vec3 along = Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()) * Vec3::UnitX();
  const Vec3 up = Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()) * Vec3::UnitZ();
  double energy = 0;
  for (std::size_t t = 0; t < body.corners.size(); ++t) {
    const std::array<Mat3, 4>& stress = state.elements.corner_stress[t];
    for (std::size_t c = 0; c < 4; ++c) {
      const Vec3& x = state.vertices.rest_position[body.corners[t][c].index()];
      const Mat3 exact = 3e10 * 1e-3 * up.dot(x) * along * along.transpose();
      CHECK((stress[c] - exact).norm() < 1e-10 * 3e7);
    }
    energy += linear_stress_energy(stress, state.elements.rest_volume[t], StressEnergy(stone));
  }
  double work = 0;
  const std::vector<Vec3> force = support_forces(scratch, state, body.corners, {});
  for (std::size_t v = 0; v < force.size(); ++v) {
    work += 0.5 * force[v].dot(state.vertices.displacement[v]);
  }
  CHECK(energy == Approx(work).epsilon(1e-11));
}

TEST_CASE("a constant strain under even traction is exact, by mid-edge nodes alone",
          "[mechanics][element]") {
  Body body = jittered(kuhn_block({3, 2, 2}, {1.5, 1, 1}), 0.04, 6);
  MechanicsState state = state_of(body, stone);
  raise_order(state, body.corners);
  Loads loads;
  // A pressure on all of the boundary: u = - p (1 - 2 nu) / E x, six motions left to the supports.
  const double pressure = 2e6;
  std::vector<CornerLoad> all;
  for (const auto& [t, place] : boundary_faces_of(body.corners)) {
    for (const CornerLoad& load : face_pressure(state.elements, t, place, pressure)) {
      CHECK(load.edge >= 0);
      all.push_back(load);
    }
  }
  // Single nodes on three planes are held: the lowest corner in all axes, two more in some.
  // axes.
  state.motions = {{}, {.axes = {false, true, true}}, {.axes = {false, false, true}}};
  const auto at = [&](const Vec3& x) {
    for (std::size_t v = 0; v < body.rest.size(); ++v) {
      if ((body.rest[v] - x).norm() < 1e-9) return v;
    }
    FAIL("no such corner");
    return std::size_t{0};
  };
  const Vec3 low = lowest_corner(body);
  state.vertices.support[at(low)] = MotionId{0};
  state.vertices.support[at(low + Vec3(1.5, 0, 0))] = MotionId{1};
  state.vertices.support[at(low + Vec3(0, 1, 0))] = MotionId{2};
  MechanicsScratch scratch;
  const ComponentId id{0};
  rebuild(state, body.corners, {&id, 1}, scratch);
  add_corner_loads(loads.force, all, state, body.corners, 0);
  REQUIRE(solve_static(state, scratch, body.corners, loads).empty());
  const double strain = -pressure * (1 - 2 * 0.27) / 3e10;
  for (std::size_t v = 0; v < state.vertices.size(); ++v) {
    const Vec3 exact = strain * (state.vertices.rest_position[v] - low);
    CHECK((state.vertices.displacement[v] - exact).norm() < 1e-12 * std::abs(strain) * 2);
  }
}

TEST_CASE("the weight of second-order tetrahedra has no sum and no moment beyond the masses'",
          "[mechanics][element]") {
  Body body = jittered(kuhn_block({2, 2, 2}, {1, 1, 1}), 0.04, 7);
  MechanicsState state = state_of(body, stone);
  raise_order(state, body.corners);
  MechanicsScratch scratch;
  const ComponentId id{0};
  rebuild(state, body.corners, {&id, 1}, scratch);
  std::vector<Vec3> force;
  const Vec3 g(0, 1, -9.81);
  add_consistent_weight(force, state, body.corners, g);
  Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
  double size = 0;
  for (std::size_t v = 0; v < force.size(); ++v) {
    sum += force[v];
    moment += state.vertices.rest_position[v].cross(force[v]);
    size += force[v].norm();
  }
  CHECK(size > 0);
  CHECK(sum.norm() < 1e-13 * size);
  CHECK(moment.norm() < 1e-13 * size);
  CHECK(state.components[0].mass == Approx(2400).epsilon(1e-12));
}
