// SPDX-License-Identifier: MIT
// Rotations from matrices of every kind, and the rigid reference of algorithm 2.
#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

#include "mechanics/frame/mean_axis.hpp"
#include "mechanics/frame/rigid_reference.hpp"
#include "mechanics/frame/rotation.hpp"
#include "tests/support/bodies.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

double angle_between(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  return 2 * (a.conjugate() * b).vec().norm();
}

bool is_rotation(const Eigen::Quaterniond& q) {
  return q.coeffs().allFinite() && std::abs(q.norm() - 1) < 8 * eps;
}

/// tr(R^T A), which the rotation maximises.
double agreement(const Eigen::Quaterniond& R, const Mat3& A) {
  return R.toRotationMatrix().cwiseProduct(A).sum();
}

}  // namespace

TEST_CASE("rotation vectors of every size turn by their length", "[mechanics][rotation]") {
  const Vec3 axis = Vec3(1, -2, 3).normalized();
  for (double angle : {0.0, 1e-12, 1e-8, 1e-4, 1.0001e-4, 0.1, 1.0, pi, 4.0, 100.0}) {
    const Eigen::Quaterniond q = rotation_of(angle * axis);
    const Mat3 expected = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    CHECK((q.toRotationMatrix() - expected).norm() < 8 * eps * (1 + angle));
  }
}

TEST_CASE("the rotation of R S is R, for S positive definite",
          "[mechanics][rotation][algorithm2]") {
  std::mt19937 random(21);
  INFO("seed 21");
  const double scale = GENERATE(1e-200, 1e-12, 1.0, 1e12, 1e200);  // chips to mountains
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Quaterniond R = random_rotation(random);
    const Mat3 B = random_matrix(random);
    const Mat3 S = B * B.transpose() + 0.05 * Mat3::Identity();
    const Mat3 A = scale * (R.toRotationMatrix() * S);
    // Condition of S is below 3 / 0.05.
    CHECK(angle_between(extract_rotation(A, random_rotation(random)), R) < 200 * eps);
    const Eigen::Quaterniond near = R * rotation_of(0.3 * random_vector(random));
    CHECK(angle_between(refine_rotation(A, near), R) < 400 * eps);
    CHECK(angle_between(refine_rotation(A, random_rotation(random)), R) < 400 * eps);
  }
}

TEST_CASE("a start that is half a turn off does not stay there", "[mechanics][rotation]") {
  const Mat3 A = Vec3(3, 2, 1).asDiagonal();
  for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 1, 0)}) {
    const Eigen::Quaterniond start = rotation_of(pi * axis.normalized());
    CHECK(angle_between(refine_rotation(A, start), Eigen::Quaterniond::Identity()) < 8 * eps);
  }
}

TEST_CASE("reflections give the best proper rotation", "[mechanics][rotation]") {
  std::mt19937 random(22);
  INFO("seed 22");
  for (int trial = 0; trial < 200; ++trial) {
    Mat3 A = random_matrix(random);
    if (A.determinant() > 0) A.col(0) = -A.col(0);
    const Eigen::Quaterniond R = extract_rotation(A, Eigen::Quaterniond::Identity());
    REQUIRE(is_rotation(R));
    CHECK(R.toRotationMatrix().determinant() == Approx(1).margin(16 * eps));
    for (int other = 0; other < 50; ++other) {
      CHECK(agreement(R, A) >= agreement(random_rotation(random), A) - 16 * eps * A.norm());
    }
    CHECK(agreement(refine_rotation(A, random_rotation(random)), A) ==
          Approx(agreement(R, A)).margin(32 * eps * A.norm()));
  }
}

TEST_CASE("flat shapes have their exact rotation", "[mechanics][rotation]") {
  std::mt19937 random(23);
  INFO("seed 23");
  for (int trial = 0; trial < 100; ++trial) {
    const Eigen::Quaterniond R = random_rotation(random);
    const Eigen::Quaterniond B = random_rotation(random);
    const Mat3 S =
        B.toRotationMatrix() * Vec3(1, 0.4, 0).asDiagonal() * B.toRotationMatrix().transpose();
    const Mat3 A = R.toRotationMatrix() * S;
    CHECK(angle_between(extract_rotation(A, Eigen::Quaterniond::Identity()), R) < 64 * eps);
    CHECK(angle_between(refine_rotation(A, R * rotation_of(Vec3(0.1, 0, 0))), R) < 64 * eps);
  }
}

TEST_CASE("collinear shapes turn the last rotation as little as possible",
          "[mechanics][rotation]") {
  std::mt19937 random(24);
  INFO("seed 24");
  for (int trial = 0; trial < 100; ++trial) {
    const Eigen::Quaterniond last = random_rotation(random);
    const Vec3 rest = random_vector(random).normalized();
    const Vec3 now = random_vector(random).normalized();
    const Mat3 A = now * rest.transpose();
    for (const Eigen::Quaterniond& R : {extract_rotation(A, last), refine_rotation(A, last)}) {
      REQUIRE(is_rotation(R));
      CHECK((R * rest - now).norm() <
            1e-7);  // the singular vectors of rank 1 are good to sqrt(eps)
      const double least = std::acos(std::clamp((last * rest).dot(now), -1.0, 1.0));
      CHECK(Eigen::AngleAxisd(R * last.conjugate()).angle() < least + 1e-6);
    }
  }
}

TEST_CASE("where there is nothing to go by the last rotation stays", "[mechanics][rotation]") {
  const Eigen::Quaterniond last = rotation_of(Vec3(1, 2, 3));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  for (const Mat3& A : {Mat3(Mat3::Zero()), Mat3(Mat3::Constant(nan)), Mat3(Mat3::Constant(inf))}) {
    CHECK(extract_rotation(A, last).coeffs() == last.coeffs());
    CHECK(refine_rotation(A, last).coeffs() == last.coeffs());
  }
  // Nothing decides between turns about the axis of a reflection with equal small values.
  const Mat3 reflected = Vec3(-1, -1, -1).asDiagonal();
  CHECK(is_rotation(refine_rotation(reflected, last)));
  CHECK(is_rotation(extract_rotation(Mat3(Vec3(1, 1, -1).asDiagonal()), last)));
}

TEST_CASE("no matrix of any kind gives anything but a rotation", "[mechanics][rotation]") {
  std::mt19937 random(25);
  INFO("seed 25");
  std::uniform_int_distribution<int> kind(0, 3);
  std::uniform_real_distribution<double> exponent(-300, 300);
  for (int trial = 0; trial < 20000; ++trial) {
    Mat3 A = random_matrix(random);
    for (int c = 0; c < 3; ++c) {
      if (kind(random) == 0) A.col(c).setZero();
      if (kind(random) == 0) A.col(c) = A.col((c + 1) % 3);
    }
    A *= std::pow(10.0, exponent(random));
    const Eigen::Quaterniond last = random_rotation(random);
    if (!is_rotation(extract_rotation(A, last)) || !is_rotation(refine_rotation(A, last))) {
      FAIL("not a rotation for\n" << A);
    }
  }
}

TEST_CASE("the rigid reference of a moved body is the motion",
          "[mechanics][algorithm2][eq3][eq4]") {
  std::mt19937 random(26);
  INFO("seed 26");
  for (const Body& body : {kuhn_block({3, 2, 2}, Vec3(1, 0.5, 0.3)), single_tetrahedron(1e-3)}) {
    MechanicsState state = state_of(body, {});
    const Component& component = state.components[0];
    for (int trial = 0; trial < 20; ++trial) {
      const Eigen::Quaterniond R = random_rotation(random);
      const Vec3 shift = random_vector(random);
      std::vector<Vec3> moved;
      for (const Vec3& x : body.rest) moved.push_back(R * x + shift);
      const Pose frame = rigid_reference(component, state.vertices, moved);
      // Positions of size 1 carry roundings of eps into arms of 1e-3.
      CHECK(angle_between(frame.orientation, R) < 100 * eps / component.rest_radius);
      CHECK((frame.centre - (R * component.rest_centre + shift)).norm() < 32 * eps);
    }
  }
}

TEST_CASE("shape matching with masses is the mean-axis frame",
          "[mechanics][algorithm2][eq3][eq4]") {
  std::mt19937 random(27);
  INFO("seed 27");
  const Body body = shaken(kuhn_block({3, 2, 2}, Vec3(1, 0.5, 0.3)), 0.02, random);
  MechanicsState state = state_of(body, {});
  place(state, ComponentId{0}, {.orientation = random_rotation(random)});
  deform(state, 0.05, random);
  const Component& component = state.components[0];
  Vec3 mean = Vec3::Zero(), moment = Vec3::Zero();
  for (VertexId v : component.vertices) {
    const Vec3 d = state.vertices.displacement[v.index()];
    const Vec3 r0 = state.vertices.rest_position[v.index()] - component.rest_centre;
    mean += state.vertices.mass[v.index()] * d;
    moment += state.vertices.mass[v.index()] * r0.cross(d);
  }
  CHECK(mean.norm() < 1e-14 * component.mass);
  CHECK(moment.norm() < 1e-14 * component.mass);
}

TEST_CASE("the rigid reference does not depend on where the rest origin is",
          "[mechanics][algorithm2][eq3][eq4]") {
  std::mt19937 random(28);
  INFO("seed 28");
  const Body body = shaken(kuhn_block({3, 2, 2}, Vec3(1, 0.5, 0.3)), 0.02, random);
  Body far = body;
  for (Vec3& x : far.rest) x += Vec3(5, -3, 2);
  MechanicsState a = state_of(body, {}), b = state_of(far, {});
  std::vector<Vec3> now;
  for (const Vec3& x : body.rest) now.push_back(x + 0.02 * random_vector(random));
  const Pose fa = rigid_reference(a.components[0], a.vertices, now);
  const Pose fb = rigid_reference(b.components[0], b.vertices, now);
  CHECK(angle_between(fa.orientation, fb.orientation) < 100 * eps);
}
