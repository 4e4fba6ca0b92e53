// SPDX-License-Identifier: MIT
// The mean-axis conditions: the rigid part of a vector field, and its exact removal.
#pragma once

#include <span>

#include <Eigen/Dense>

#include "mechanics/state/columns.hpp"

namespace sunder {

/// One vector a vertex of a component, body frame.
using LocalField = Eigen::Ref<Eigen::Matrix3Xd>;
using ConstLocalField = Eigen::Ref<const Eigen::Matrix3Xd>;

/// A component at rest, in the order of vertices of its maker.
struct RestShape {
  Eigen::Matrix3Xd arm;  ///< r0 = rest position - rest centre, m
  Eigen::VectorXd mass;  ///< lumped, kg
  double total_mass = 0;
  Mat3 inertia = Mat3::Zero();  ///< J0 = sum m (|r0|^2 I - r0 r0^T), kg m^2; positive definite
};

/// The rest shape of `order`, about `rest_centre`.
RestShape rest_shape(const VertexColumns& vertices, std::span<const VertexId> order,
                     const Vec3& rest_centre);

/// sum m (|q|^2 I - q q^T), kg m^2.
Mat3 inertia_of(const Eigen::VectorXd& mass, ConstLocalField q);

/// sum m a x b.
Vec3 moment_of(const Eigen::VectorXd& mass, ConstLocalField a, ConstLocalField b);

/// sum m a b^T.
Mat3 product_of(const Eigen::VectorXd& mass, ConstLocalField a, ConstLocalField b);

/// Velocity of a rigid motion at the rest positions: translation + rotation x r0.
struct RigidField {
  Vec3 translation = Vec3::Zero();
  Vec3 rotation = Vec3::Zero();
};

/// The rigid accelerations a load (N) gives: sum b / m and J0^-1 sum r0 x b.
RigidField rigid_response(const RestShape& shape, ConstLocalField load);

/// Removes the rigid part from a load (N): b -= m (a0 + alpha x r0), so that sum b = 0 and sum r0 x
/// b = 0. Gives the removed part. K, M and C map that subspace into itself.
RigidField project_load(LocalField load, const RestShape& shape);

/// Removes the rigid part from an acceleration field: sum m a = 0 and sum m r0 x a = 0.
void project_acceleration(LocalField acceleration, const RestShape& shape);

/// Takes the rigid part out of a velocity field: u -= u0 + phi x q, with sum m u = 0 and sum m r0 x
/// u = 0 afterwards. Rotations act on the present q, so that the removed part is the velocity of a
/// rigid motion exactly. Gives u0 and phi. Needs: sum m q = 0.
RigidField project_rate(LocalField rate, const RestShape& shape, ConstLocalField q);

}  // namespace sunder
