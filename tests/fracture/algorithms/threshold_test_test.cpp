// SPDX-License-Identifier: MIT
// Gershgorin's bound and the exact threshold test against eigenvalues.
#include "fracture/algorithms/threshold_test.hpp"

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

TEST_CASE("all ways to test give the same answer on a million tensors 1e-9 from the threshold",
          "[fracture]") {
  const std::uint64_t seed = std::random_device{}();
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> exponent(-9, 0);
  std::size_t wrong = 0, suspects = 0, tested = 0;
  while (tested < 1000000) {
    const Matrix3d m = random_symmetric(random, 1e6);
    const double value = largest_eigenvalue(m);
    // Of a threshold far below the entries 1e-9 is less than their rounding leaves of the minors.
    if (value < 1e5) continue;
    ++tested;
    const double away = 1.2 * std::pow(10, exponent(random));
    const bool above = tested % 2 == 0;
    const double xi = value * (above ? 1 - 0.9 * away : 1 + 1.2 * away);
    const auto expected = above ? ThresholdAnswer::reached : ThresholdAnswer::below;
    for (const ThresholdTest way : {ThresholdTest::eigenvalues, ThresholdTest::gershgorin,
                                    ThresholdTest::exact, ThresholdTest::chain}) {
      // Eigenvalues cost a hundred times the others: a sixteenth of the tensors will do.
      if (way == ThresholdTest::gershgorin && tested % 16 != 0) continue;
      if (way == ThresholdTest::eigenvalues && tested % 16 > 1) continue;
      wrong += test_threshold(m, xi, way, suspects) != expected;
    }
  }
  CHECK(wrong == 0);
}

TEST_CASE("no stress reaches an infinite threshold, whichever way it is tested", "[fracture]") {
  std::size_t suspects = 0;
  for (const ThresholdTest way : {ThresholdTest::eigenvalues, ThresholdTest::gershgorin,
                                  ThresholdTest::exact, ThresholdTest::chain}) {
    const double infinite = std::numeric_limits<double>::infinity();
    CHECK(test_threshold(1e9 * Matrix3d::Identity(), infinite, way, suspects) ==
          ThresholdAnswer::below);
  }
}
