// SPDX-License-Identifier: MIT
// Gershgorin's bound and the exact threshold test against eigenvalues.
#include "fracture/threshold_test.hpp"

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <limits>
#include <random>

using namespace sunder;
using Eigen::Matrix3d;

namespace {

Matrix3d random_symmetric(std::mt19937_64& random, double scale) {
  std::normal_distribution<double> normal(0, scale);
  Matrix3d m;
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) m(i, j) = m(j, i) = normal(random);
  }
  return m;
}

double largest_eigenvalue(const Matrix3d& m) {
  return Eigen::SelfAdjointEigenSolver<Matrix3d>(m, Eigen::EigenvaluesOnly).eigenvalues()(2);
}

}  // namespace

TEST_CASE("Gershgorin's bound (eq. 7) is never below the largest eigenvalue", "[fracture]") {
  std::mt19937_64 random(7);
  for (int i = 0; i < 20000; ++i) {
    const Matrix3d m = random_symmetric(random, 1e6);
    // The eigenvalue itself carries a few rounding errors of the largest entry.
    REQUIRE(gershgorin_bound(m) >= largest_eigenvalue(m) - 1e-14 * m.norm());
  }
  CHECK(gershgorin_bound(Eigen::Vector3d(1, 5, -2).asDiagonal()) == 5);
}

TEST_CASE("the exact test agrees with the largest eigenvalue away from the threshold",
          "[fracture]") {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> ratio(0.1, 3);
  int reached = 0;
  for (int i = 0; i < 100000; ++i) {
    const Matrix3d m = random_symmetric(random, 1e6);
    const double xi = 1e6 * ratio(random);
    const double value = largest_eigenvalue(m);
    if (std::abs(value - xi) < 1e-9 * xi) continue;
    const auto answer = test_threshold(m, xi);
    REQUIRE(answer == (value >= xi ? ThresholdAnswer::reached : ThresholdAnswer::below));
    reached += answer == ThresholdAnswer::reached;
  }
  CHECK(reached > 10000);
}

TEST_CASE("the exact test decides to 1e-9 of the threshold on both sides", "[fracture]") {
  std::mt19937_64 random(13);
  for (int i = 0; i < 20000; ++i) {
    const Matrix3d m = random_symmetric(random, 1e6);
    const double value = largest_eigenvalue(m);
    if (value < 1e5) continue;
    REQUIRE(test_threshold(m, value * (1 + 1e-9)) == ThresholdAnswer::below);
    REQUIRE(test_threshold(m, value * (1 - 1e-9)) == ThresholdAnswer::reached);
  }
}

TEST_CASE("pure compression never reaches a tensile threshold", "[fracture]") {
  CHECK(test_threshold(-1e12 * Matrix3d::Identity(), 1) == ThresholdAnswer::below);
  CHECK(test_threshold(Matrix3d::Zero(), 1) == ThresholdAnswer::below);
}

TEST_CASE("a tension of exactly the threshold reaches it", "[fracture]") {
  CHECK(test_threshold(Eigen::Vector3d(3e6, 0, 0).asDiagonal(), 3e6) == ThresholdAnswer::reached);
  CHECK(test_threshold(3e6 * Matrix3d::Identity(), 3e6) == ThresholdAnswer::reached);
}

TEST_CASE("a stress that is not a number is a failure and never a fracture", "[fracture]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      Matrix3d m = Matrix3d::Identity();
      m(i, j) = m(j, i) = nan;
      INFO("entry " << i << "," << j);
      CHECK(test_threshold(m, 10) == ThresholdAnswer::not_a_number);
      CHECK(std::isnan(gershgorin_bound(m)));
      m(i, j) = m(j, i) = std::numeric_limits<double>::infinity();
      CHECK(test_threshold(m, 10) == ThresholdAnswer::not_a_number);
    }
  }
  CHECK(test_threshold(Matrix3d::Identity(), nan) == ThresholdAnswer::not_a_number);
}
