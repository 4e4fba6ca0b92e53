// SPDX-License-Identifier: MIT
// Affine fields against fields that are affine, and against all others near them.
#include "mechanics/frame/affine_motion.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/bodies.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

AffineMotion fitted(const std::vector<Vec3>& x, const std::vector<Vec3>& u) {
  return fit_affine_motion(
      x.size(), [&](std::size_t k) { return x[k]; }, [&](std::size_t k) { return u[k]; });
}

double squares(const AffineMotion& field, const std::vector<Vec3>& x, const std::vector<Vec3>& u) {
  double sum = 0;
  for (std::size_t k = 0; k < x.size(); ++k) sum += (u[k] - field.at(x[k])).squaredNorm();
  return sum;
}

}  // namespace

TEST_CASE("an affine field is found again", "[mechanics][frame]") {
  std::mt19937 random(3);
  for (int trial = 0; trial < 20; ++trial) {
    const Mat3 A = random_matrix(random);
    const Vec3 b = random_vector(random);
    std::vector<Vec3> x, u;
    for (int k = 0; k < 30; ++k) {
      x.push_back(random_vector(random) + Vec3(5, 0, 0));
      u.push_back(A * x.back() + b);
    }
    const AffineMotion field = fitted(x, u);
    CHECK((field.gradient - A).norm() < 1e-6);
    for (std::size_t k = 0; k < x.size(); ++k) CHECK((field.at(x[k]) - u[k]).norm() < 1e-6);
  }
}

TEST_CASE("no other field fits better", "[mechanics][frame]") {
  std::mt19937 random(4);
  std::vector<Vec3> x, u;
  for (int k = 0; k < 30; ++k) {
    x.push_back(random_vector(random));
    u.push_back(random_vector(random));
  }
  const AffineMotion best = fitted(x, u);
  for (int trial = 0; trial < 50; ++trial) {
    AffineMotion other = best;
    other.mean += 0.01 * random_vector(random);
    other.gradient += 0.01 * random_matrix(random);
    CHECK(squares(other, x, u) > squares(best, x, u));
  }
}

TEST_CASE("points in a plane, on a line or at one place have a finite field",
          "[mechanics][frame]") {
  std::mt19937 random(5);
  const int dimensions = GENERATE(0, 1, 2);
  std::vector<Vec3> x, u;
  for (int k = 0; k < 10; ++k) {
    Vec3 place = random_vector(random);
    for (int i = dimensions; i < 3; ++i) place[i] = 1;
    x.push_back(place);
    u.push_back(0.1 * place);
  }
  const AffineMotion field = fitted(x, u);
  CHECK(field.gradient.allFinite());
  for (std::size_t k = 0; k < x.size(); ++k) CHECK((field.at(x[k]) - u[k]).norm() < 1e-6);
  CHECK(fitted({}, {}).gradient.isZero(0));
}

TEST_CASE("points that go with a field come nearer by its bound at most", "[mechanics][frame]") {
  std::mt19937 random(6);
  for (int trial = 0; trial < 1000; ++trial) {
    AffineMotion field;
    field.gradient = 0.2 * random_matrix(random);
    const Vec3 x = random_vector(random), y = random_vector(random);
    const double before = (x - y).norm();
    const double after = (x + field.at(x) - y - field.at(y)).norm();
    CHECK(before - after <= largest_approach(field) * before * (1 + 1e-9));
  }
}
