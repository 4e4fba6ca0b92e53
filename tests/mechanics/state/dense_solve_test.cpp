// SPDX-License-Identifier: MIT
#include "mechanics/state/dense_solve.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace sunder;

TEST_CASE("small systems are solved, symmetric and not", "[mechanics][dense_solve]") {
  Mat3 A;
  A << 4, 1, -2, 0, 3, 5, 1, -1, 6;
  const Mat3 S = A * A.transpose();
  const Vec3 y(1, -2, 3);
  CHECK((S * solve3(S, y) - y).norm() < 1e-13);
  CHECK((A * solve3_by_lu(A, y) - y).norm() < 1e-13);
}

TEST_CASE("eigenvalues of a symmetric matrix rise, from its lower triangle",
          "[mechanics][dense_solve]") {
  Eigen::MatrixXd A(2, 2);
  A << 2, 1e9, 1, 2;
  const auto solver = symmetric_eigen(A);
  CHECK((solver.eigenvalues() - Eigen::Vector2d(1, 3)).norm() < 1e-14);
  CHECK(std::abs(solver.eigenvectors().col(1).dot(Eigen::Vector2d(1, 1))) ==
        Approx(std::sqrt(2.0)));
  CHECK((symmetric_eigen(A, Eigen::EigenvaluesOnly).eigenvalues() - solver.eigenvalues()).norm() <
        1e-14);
}
