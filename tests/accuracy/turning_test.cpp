// SPDX-License-Identifier: MIT
// Cases 6 and 14 and the attitude of a free body: the effect of turning on stress and on the frame.
#include <catch2/catch.hpp>

#include "tests/support/accuracy_bodies.hpp"

using namespace sunder;
using namespace sunder::accuracy;

namespace {

/// A rigid body about its principal axes: w (body frame) and attitude, by Runge-Kutta of order 4 on
/// Euler's equations; shares nothing with the library.
struct RigidReference {
  Vec3 inertia;
  Vec3 w;
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();

  struct Rate {
    Vec3 w;
    Eigen::Vector4d q;
  };
  Rate rate(const Vec3& omega, const Eigen::Vector4d& attitude) const {
    const Vec3 L = inertia.cwiseProduct(omega);
    const Vec3 change = L.cross(omega).cwiseQuotient(inertia);
    const Eigen::Quaterniond turned =
        Eigen::Quaterniond(attitude) * Eigen::Quaterniond(0, omega.x(), omega.y(), omega.z());
    return {change, 0.5 * turned.coeffs()};
  }
  void advance(double h) {
    const Eigen::Vector4d a = q.coeffs();
    const Rate k1 = rate(w, a);
    const Rate k2 = rate(w + h / 2 * k1.w, a + h / 2 * k1.q);
    const Rate k3 = rate(w + h / 2 * k2.w, a + h / 2 * k2.q);
    const Rate k4 = rate(w + h * k3.w, a + h * k3.q);
    w += h / 6 * (k1.w + 2 * k2.w + 2 * k3.w + k4.w);
    q.coeffs() = (a + h / 6 * (k1.q + 2 * k2.q + 2 * k3.q + k4.q)).normalized();
  }
};

/// Error of attitude (rad) after 4 s, and the flips seen: times at which the spin about the middle
/// axis changes sign, in the library and in the reference.
struct Attitude {
  double error = 0;
  std::vector<double> flips, expected;
};

Attitude tumble(double h) {
  // Stiff, so that it is rigid to (w / w1)^2 = 1e-9. Sides 1, 0.6, 0.3: middle axis y.
  const Material material{.young_modulus = 1e12, .poisson_ratio = 0.2, .density = 2000};
  const Body body = test::kuhn_block({3, 2, 2}, Vec3(1, 0.6, 0.3));
  MechanicsState state = test::state_of(body, material);
  const Mat3 J = state.components[0].rest_inertia;
  // Kuhn's cells are not symmetric: the lumped inertia has its own axes.
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(J);
  Mat3 E = axes.eigenvectors();
  if (E.determinant() < 0) E.col(0) *= -1;
  RigidReference reference{axes.eigenvalues(), Vec3(0.3, 10, 0.4)};
  place(state, ComponentId{0}, {.spin = E * reference.w});
  MechanicsScratch scratch;
  Attitude seen;
  double before = 1, expected_before = 1;
  const auto record = [&](std::vector<double>& flips, double& last, double now) {
    if (last * now < 0) flips.push_back(state.time - h * now / (now - last));
    last = now;
  };
  const Loads none;
  const IntegratorSettings settings{.time_step = h};
  const int substeps = static_cast<int>(std::ceil(h / 1e-4));
  while (state.time < 4 - h / 2) {
    REQUIRE(advance(state, scratch, {body.corners, none, settings}).outcome == StepOutcome::fine);
    for (int i = 0; i < substeps; ++i) reference.advance(h / substeps);
    const Component& c = state.components[0];
    const Mat3 R = c.orientation.toRotationMatrix();
    const Vec3 w = J.ldlt().solve(R.transpose() * c.angular_momentum);
    record(seen.flips, before, E.col(1).dot(w));
    record(seen.expected, expected_before, reference.w.y());
  }
  const Eigen::Quaterniond attitude(E * reference.q.toRotationMatrix() * E.transpose());
  seen.error = attitude.angularDistance(state.components[0].orientation);
  return seen;
}

}  // namespace

TEST_CASE("a free body flips about its middle axis when a rigid body does",
          "[accuracy][attitude]") {
  const Attitude coarse = tumble(2e-3), fine = tumble(1e-3);
  INFO("errors " << coarse.error << " " << fine.error << " rad, flips " << fine.flips.size());
  REQUIRE(fine.expected.size() >= 2);
  REQUIRE(fine.flips.size() == fine.expected.size());
  for (std::size_t i = 0; i < fine.flips.size(); ++i) {
    INFO("flip " << i << " at " << fine.flips[i] << " s, expected " << fine.expected[i]);
    CHECK(fine.flips[i] == Approx(fine.expected[i]).epsilon(2e-3));
  }
  // Second order: half the step, a quarter of the error.
  CHECK(fine.error < 0.35 * coarse.error);
  CHECK(fine.error < 0.05);
}

TEST_CASE("case 6: a spinning disc carries (3 + nu) rho w^2 R^2 / 8 at its middle",
          "[accuracy][case6]") {
  const Material material{.young_modulus = 7e10, .poisson_ratio = 0.3, .density = 2500};
  const double radius = 0.5, w = 50;
  double share[2] = {};
  for (int i = 0; i < 2; ++i) {
    const std::size_t rings = std::size_t{6} << i;
    const Body body = disc(4 * rings, rings, radius, 0.02);
    MechanicsState state = test::state_of(body, material);
    place(state, ComponentId{0}, {.spin = Vec3(0, 0, w)});
    settle(state, body, 1e-2, {}, 30);
    const Mat3 middle = node_stress(state, body).back();
    share[i] = 0.5 * (middle(0, 0) + middle(1, 1)) /
               ((3 + material.poisson_ratio) / 8 * material.density * w * w * radius * radius);
  }
  INFO("6 and 12 rings: " << share[0] << " " << share[1]);
  CHECK(std::abs(1 - share[1]) < 0.5 * std::abs(1 - share[0]));
  CHECK(share[1] == Approx(1).margin(0.02));
}

TEST_CASE("case 14: one frame sees a false strain eps (L / t)^2 / 2 in a bent bar",
          "[accuracy][case14]") {
  const Material material{.young_modulus = 1e9, .poisson_ratio = 0};
  const int slenderness = GENERATE(10, 20, 40);
  const double thickness = 1.0 / slenderness, bend = 100;  // m, radius of the middle line
  const int cells = 4 * slenderness;
  const Body body = test::kuhn_block({cells, 1, 2}, Vec3(1, thickness, thickness));
  MechanicsState state = test::state_of(body, material);
  for (std::size_t v = 0; v < body.rest.size(); ++v) {
    const Vec3& x = body.rest[v];
    const double angle = x.x() / bend;
    state.vertices.position[v] = {(bend + x.z()) * std::sin(angle), x.y(),
                                  (bend + x.z()) * std::cos(angle) - bend};
  }
  reframe(state, ComponentId{0});
  MechanicsScratch scratch;
  measure_elements(state, scratch, body.corners);
  // A section's mean has no bending in it. Cells at the very ends, by the side of their middles.
  double strain = 0, volume = 0;
  for (std::size_t t = 0; t < body.corners.size(); ++t) {
    double x = 0;
    for (VertexId v : body.corners[t]) x += body.rest[v.index()].x() / 4;
    if (std::abs(x) < 0.5 - 1.0 / cells) continue;
    strain += state.elements.rest_volume[t] * state.elements.stress[t](0, 0) / 1e9;
    volume += state.elements.rest_volume[t];
  }
  const double eps = thickness / (2 * bend);
  const double theta = (0.5 - 0.5 / cells) / bend;
  const double expected = eps * eps * slenderness * slenderness / 2;  // (L / 2 R)^2 / 2
  INFO("L/t " << slenderness << ": " << -strain / volume / eps << " of eps");
  CHECK(expected == Approx(0.125 / (bend * bend)));
  // cos(theta) - 1 within a cell; the frame's own shift and the chord are of the order (h / R)^2.
  CHECK(-strain / volume == Approx(theta * theta / 2).epsilon(0.02));
  CHECK(-strain / volume == Approx(expected).epsilon(2.2 / cells + 0.02));
}
