// SPDX-License-Identifier: MIT
// Principal tension and the normals it allows.
#include "fracture/algorithms/fracture_plane.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

using namespace sunder;
using Eigen::Matrix3d;
using Eigen::Vector3d;

TEST_CASE("a single largest tension gives its own axis as the only normal", "[fracture]") {
  const Matrix3d turn = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()).matrix();
  const Matrix3d sigma = turn * Vector3d(-1e6, 2e6, 5e6).asDiagonal() * turn.transpose();
  const PrincipalTension tension = principal_tension(sigma);
  CHECK(tension.value == Approx(5e6).epsilon(1e-12));
  const auto normals = candidate_normals(tension, {Vector3d::UnitX()});
  REQUIRE(normals.size() == 1);
  CHECK(normals[0].cross(turn.col(2)).norm() < 1e-12);
  // Of n and -n the canonical one, whichever the solver has.
  CHECK(normals[0].maxCoeff() >= -normals[0].minCoeff());
  const auto folded = candidate_normals(tension, {}, Vector3d(-1, -1, -1));
  CHECK((folded[0] + normals[0]).norm() < 1e-12);
}

TEST_CASE("equal tensions offer the faces' normals within their plane, then the axes",
          "[fracture]") {
  // Equal tension in x and y: any direction of that plane is right, none outside it.
  const Matrix3d sigma = Vector3d(4e6, 4e6, 1e6).asDiagonal();
  const PrincipalTension tension = principal_tension(sigma);
  REQUIRE(tension.directions.cols() == 2);
  const auto normals =
      candidate_normals(tension, {Vector3d(1, 1, 1).normalized(), Vector3d::UnitZ()});
  REQUIRE(normals.size() == 3);  // the slanted face, x and y; z is at right angles to all of them
  CHECK((normals[0] - Vector3d(1, 1, 0).normalized()).norm() < 1e-12);
  CHECK((normals[1] - Vector3d::UnitX()).norm() < 1e-12);
  CHECK((normals[2] - Vector3d::UnitY()).norm() < 1e-12);
}

TEST_CASE("three equal tensions offer every face's normal", "[fracture]") {
  const PrincipalTension tension = principal_tension(2e6 * Matrix3d::Identity());
  REQUIRE(tension.directions.cols() == 3);
  const Vector3d face = Vector3d(3, -1, 2).normalized();
  CHECK((candidate_normals(tension, {face})[0] - face).norm() < 1e-12);
}
