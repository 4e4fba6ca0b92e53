// SPDX-License-Identifier: MIT
// Splitting fields into a rigid part and one that obeys the mean-axis conditions.
#include "mechanics/mean_axis.hpp"

namespace sunder {
namespace {

/// x = S^-1 y for a symmetric positive definite 3 x 3.
Vec3 solve3(const Mat3& S, const Vec3& y) { return S.ldlt().solve(y); }

}  // namespace

RestShape rest_shape(const VertexColumns& vertices, std::span<const VertexId> order,
                     const Vec3& rest_centre) {
  const auto n = static_cast<Eigen::Index>(order.size());
  RestShape shape{Eigen::Matrix3Xd(3, n), Eigen::VectorXd(n), 0, Mat3::Zero()};
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t v = order[static_cast<std::size_t>(i)].index();
    shape.arm.col(i) = vertices.rest_position[v] - rest_centre;
    shape.mass[i] = vertices.mass[v];
    shape.total_mass += vertices.mass[v];
  }
  shape.inertia = inertia_of(shape.mass, shape.arm);
  return shape;
}

Mat3 inertia_of(const Eigen::VectorXd& mass, ConstLocalField q) {
  Mat3 second = Mat3::Zero();
  for (Eigen::Index i = 0; i < q.cols(); ++i) {
    second += mass[i] * q.col(i) * q.col(i).transpose();
  }
  Mat3 inertia = -second;
  inertia.diagonal().array() += second.trace();
  return inertia;
}

Vec3 moment_of(const Eigen::VectorXd& mass, ConstLocalField a, ConstLocalField b) {
  Vec3 sum = Vec3::Zero();
  for (Eigen::Index i = 0; i < a.cols(); ++i) {
    sum += mass[i] * Vec3(a.col(i)).cross(Vec3(b.col(i)));
  }
  return sum;
}

RigidField rigid_answer(const RestShape& shape, ConstLocalField load) {
  Vec3 force = Vec3::Zero();
  Vec3 torque = Vec3::Zero();
  for (Eigen::Index i = 0; i < load.cols(); ++i) {
    force += load.col(i);
    torque += Vec3(shape.arm.col(i)).cross(Vec3(load.col(i)));
  }
  return {force / shape.total_mass, solve3(shape.inertia, torque)};
}

RigidField project_load(LocalField load, const RestShape& shape) {
  const RigidField rigid = rigid_answer(shape, load);
  for (Eigen::Index i = 0; i < load.cols(); ++i) {
    load.col(i) -=
        shape.mass[i] * (rigid.translation + rigid.rotation.cross(Vec3(shape.arm.col(i))));
  }
  return rigid;
}

void project_acceleration(LocalField acceleration, const RestShape& shape) {
  const Vec3 mean = acceleration * shape.mass / shape.total_mass;
  const Vec3 alpha = solve3(shape.inertia, moment_of(shape.mass, shape.arm, acceleration));
  for (Eigen::Index i = 0; i < acceleration.cols(); ++i) {
    acceleration.col(i) -= mean + alpha.cross(Vec3(shape.arm.col(i)));
  }
}

RigidField project_rate(LocalField rate, const RestShape& shape, ConstLocalField q) {
  RigidField rigid;
  rigid.translation = rate * shape.mass / shape.total_mass;
  // sum m r0 x (phi x q) = (tr(Q) I - Q) phi with Q = sum m q r0^T.
  Mat3 H = Mat3::Zero();
  for (Eigen::Index i = 0; i < q.cols(); ++i) {
    H -= shape.mass[i] * q.col(i) * shape.arm.col(i).transpose();
  }
  H.diagonal().array() -= H.trace();
  rigid.rotation = H.partialPivLu().solve(moment_of(shape.mass, shape.arm, rate));
  for (Eigen::Index i = 0; i < rate.cols(); ++i) {
    rate.col(i) -= rigid.translation + rigid.rotation.cross(Vec3(q.col(i)));
  }
  return rigid;
}

}  // namespace sunder
