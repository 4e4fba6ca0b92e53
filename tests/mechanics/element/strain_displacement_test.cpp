// SPDX-License-Identifier: MIT
// Element matrices: derivatives, equal forms, rigid modes, the patch test; and bad bodies.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>

#include "mechanics/element/elastic_force.hpp"
#include "mechanics/element/strain_displacement.hpp"
#include "mechanics/frame/rotation.hpp"
#include "mechanics/solver/component_system.hpp"
#include "tests/support/bodies.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

std::array<Vec3, 4> random_tetrahedron(std::mt19937& random) {
  std::array<Vec3, 4> p;
  do {
    for (Vec3& x : p) x = random_vector(random);
  } while (tetrahedron_volume(p) < 0.05);  // well shaped enough for the tolerances below
  return p;
}

Eigen::Matrix<double, 12, 1> stacked(const CornerVectors& d) {
  return Eigen::Map<const Eigen::Matrix<double, 12, 1>>(d.data());
}

}  // namespace

TEST_CASE("strain from B is the derivative of an affine displacement", "[mechanics][element]") {
  std::mt19937 random(11);
  INFO("seed 11");
  for (int trial = 0; trial < 20; ++trial) {
    const std::array<Vec3, 4> p = random_tetrahedron(random);
    const ShapeGradient G = shape_gradients(p);
    Mat3 F;
    F << random_vector(random), random_vector(random), random_vector(random);
    CornerVectors d;
    for (int a = 0; a < 4; ++a) d.col(a) = F * p[static_cast<std::size_t>(a)] + Vec3(1, 2, 3);
    CHECK((displacement_gradient(G, d) - F).norm() < 1e-13);
    const Eigen::Matrix<double, 6, 1> strain = strain_displacement(G) * stacked(d);
    Eigen::Matrix<double, 6, 1> expected;
    expected << F(0, 0), F(1, 1), F(2, 2), F(1, 2) + F(2, 1), F(0, 2) + F(2, 0), F(0, 1) + F(1, 0);
    CHECK((strain - expected).norm() < 1e-13);
  }
}

TEST_CASE("shape gradients are what finite differences of barycentric coordinates give",
          "[mechanics][element]") {
  std::mt19937 random(12);
  INFO("seed 12");
  const std::array<Vec3, 4> p = random_tetrahedron(random);
  const ShapeGradient G = shape_gradients(p);
  const double whole = tetrahedron_volume(p);
  const double step = 1e-6;
  for (std::size_t a = 0; a < 4; ++a) {
    for (int axis = 0; axis < 3; ++axis) {
      // N_a(x) = volume with corner a moved to x / volume; linear, so the difference is exact.
      const auto value = [&](double shift) {
        std::array<Vec3, 4> q = p;
        q[a] = Vec3(0.1, 0.2, 0.3);
        q[a][axis] += shift;
        return tetrahedron_volume(q) / whole;
      };
      const double slope = (value(step) - value(-step)) / (2 * step);
      CHECK(G(axis, static_cast<Eigen::Index>(a)) == Approx(slope).margin(4 * eps / step * 20));
    }
  }
}

TEST_CASE("K_e = V B^T C B, its blocks and the shape-gradient force are one and the same",
          "[mechanics][element][eq1][eq2][eq5]") {
  std::mt19937 random(13);
  INFO("seed 13");
  const Lame constants = lame({.young_modulus = 2e11, .poisson_ratio = 0.3});
  for (int trial = 0; trial < 20; ++trial) {
    const std::array<Vec3, 4> p = random_tetrahedron(random);
    const ShapeGradient G = shape_gradients(p);
    const double V = tetrahedron_volume(p);
    const ElementStiffness K = element_stiffness(G, V, constants);
    CornerVectors d;
    for (int a = 0; a < 4; ++a) d.col(a) = random_vector(random);
    const Mat3 sigma = stress_of(displacement_gradient(G, d), constants);
    const Eigen::Matrix<double, 12, 1> force = K * stacked(d);
    CHECK((force - stacked(element_force(G, V, sigma))).norm() < 32 * eps * force.norm());
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < 4; ++b) {
        const Mat3 block = stiffness_block(G.col(a), G.col(b), V, constants);
        CHECK((K.block<3, 3>(3 * a, 3 * b) - block).norm() < 32 * eps * K.norm());
      }
    }
  }
}

TEST_CASE("an element has six rigid modes and six stiff ones", "[mechanics][element]") {
  std::mt19937 random(14);
  INFO("seed 14");
  for (int trial = 0; trial < 20; ++trial) {
    const std::array<Vec3, 4> p = random_tetrahedron(random);
    const ElementStiffness K =
        element_stiffness(shape_gradients(p), tetrahedron_volume(p), lame({}));
    const Eigen::SelfAdjointEigenSolver<ElementStiffness> solver(K);
    const double largest = solver.eigenvalues()[11];
    CHECK(solver.eigenvalues().head<6>().cwiseAbs().maxCoeff() < 1e-13 * largest);
    CHECK(solver.eigenvalues()[6] > 1e-6 * largest);
  }
}

TEST_CASE("element forces do not depend on the order of the corners", "[mechanics][element]") {
  std::mt19937 random(15);
  INFO("seed 15");
  const std::array<Vec3, 4> p = random_tetrahedron(random);
  CornerVectors d;
  for (int a = 0; a < 4; ++a) d.col(a) = random_vector(random);
  const auto forces = [&](const std::array<int, 4>& order) {
    std::array<Vec3, 4> q;
    CornerVectors moved;
    for (std::size_t a = 0; a < 4; ++a) {
      q[a] = p[static_cast<std::size_t>(order[a])];
      moved.col(static_cast<Eigen::Index>(a)) = d.col(order[a]);
    }
    const ShapeGradient G = shape_gradients(q);
    const CornerVectors f = element_force(G, std::abs(tetrahedron_volume(q)),
                                          stress_of(displacement_gradient(G, moved), lame({})));
    CornerVectors back;
    for (std::size_t a = 0; a < 4; ++a) back.col(order[a]) = f.col(static_cast<Eigen::Index>(a));
    return back;
  };
  std::array<int, 4> order = {0, 1, 2, 3};
  const CornerVectors reference = forces(order);
  while (std::next_permutation(order.begin(), order.end())) {
    // 64 roundings: the gradients come out of other edges, of condition about 10 here.
    CHECK((forces(order) - reference).norm() < 64 * eps * reference.norm());
  }
}

TEST_CASE("patch test: affine boundary displacement makes the inside affine",
          "[mechanics][element][patch]") {
  std::mt19937 random(16);
  INFO("seed 16");
  Body body = kuhn_block({4, 4, 4}, Vec3(1, 1, 1));
  std::vector<bool> inner;
  for (const Vec3& x : body.rest) inner.push_back(x.cwiseAbs().maxCoeff() < 0.49);
  std::uniform_real_distribution<double> shift(-0.06, 0.06);  // a quarter of a cell: still positive
  for (std::size_t v = 0; v < body.rest.size(); ++v) {
    if (inner[v]) body.rest[v] += Vec3(shift(random), shift(random), shift(random));
  }
  MechanicsState state = state_of(body, {.young_modulus = 2e11, .poisson_ratio = 0.3});
  state.motions.push_back({});
  for (std::size_t v = 0; v < body.rest.size(); ++v) {
    if (!inner[v]) state.vertices.support[v] = MotionId{0};
  }
  Mat3 F;
  F << 1e-3, 2e-4, -3e-4, 5e-4, -2e-3, 1e-4, 7e-4, -6e-4, 4e-4;
  // Static: K_ff d_f = -K_fh d_h, with the system's own factor (no mass in A).
  ComponentSystem system;
  std::vector<std::uint32_t> local_row(body.rest.size());
  build_system(system, local_row, state, body.corners, state.components[0]);
  factor_system(system, {0, 1});
  Eigen::VectorXd exact(3 * body.rest.size()), d;
  for (std::size_t v = 0; v < body.rest.size(); ++v) {
    exact.segment<3>(3 * local_row[v]) = F * body.rest[v];
  }
  const auto dofs = static_cast<Eigen::Index>(3 * system.free_count);
  d = exact;
  d.head(dofs).setZero();
  Eigen::VectorXd force(d.size());
  multiply_stiffness(force, system, d);
  Eigen::VectorXd inside = -force.head(dofs);
  solve_system(system, inside);
  REQUIRE(system.free_count == 27);
  CHECK((inside - exact.head(dofs)).norm() < 1e-12 * exact.norm());
}

TEST_CASE("a rigid motion gives no force, whatever the rotation", "[mechanics][element]") {
  std::mt19937 random(17);
  INFO("seed 17");
  const Body body = shaken(kuhn_block({3, 3, 3}, Vec3(1, 0.7, 0.5)), 0.02, random);
  MechanicsState state = state_of(body, {});
  std::vector<Vec3> displacement(body.rest.size()), force(body.rest.size());
  for (int trial = 0; trial < 20; ++trial) {
    place(state, ComponentId{0},
          {.orientation = random_rotation(random), .translation = 10 * random_vector(random)});
    reframe(state, ComponentId{0});
    deformation_forces({displacement, force}, {state, body.corners, state.vertices.position},
                       state.components[0]);
    double largest = 0;
    for (const Vec3& f : force) largest = std::max(largest, f.norm());
    CHECK(largest < 1e-12 * 30e9 * 0.35);  // E A
  }
}

TEST_CASE("flat, inverted and misnumbered bodies are refused", "[mechanics][material]") {
  const Material material;
  const auto first_code = [&](const Body& body, std::vector<MaterialId> materials = {}) {
    const Result<MechanicsState> result =
        make_state({body.rest, body.corners, materials, {}, {&material, 1}});
    REQUIRE_FALSE(result);
    REQUIRE_FALSE(result.findings.empty());
    return result.findings.front().code;
  };
  Body body = single_tetrahedron(1);
  std::swap(body.corners[0][0], body.corners[0][1]);
  CHECK(first_code(body) == "inverted_tetrahedron");
  body = single_tetrahedron(1);
  body.rest[3] = Vec3(0.3, 0.3, 0);
  CHECK(first_code(body) == "flat_tetrahedron");
  body = single_tetrahedron(1);
  body.corners[0][2] = VertexId{7};
  CHECK(first_code(body) == "index_out_of_range");
  body = single_tetrahedron(1);
  body.rest[1].x() = std::numeric_limits<double>::quiet_NaN();
  CHECK(first_code(body) == "nan_coordinate");
  body = single_tetrahedron(1);
  body.rest.push_back(Vec3::Zero());
  CHECK(first_code(body) == "unused_vertex");
  CHECK(first_code(single_tetrahedron(1), {MaterialId{3}}) == "material_out_of_range");
  CHECK(first_code(single_tetrahedron(1), {MaterialId{0}, MaterialId{0}}) == "bad_column_length");
  CHECK(first_code(Body{}) == "no_tetrahedron");
}
