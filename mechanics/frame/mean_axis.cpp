// SPDX-License-Identifier: MIT
// Splitting fields into a rigid part and one that obeys the mean-axis conditions.
#include "mechanics/frame/mean_axis.hpp"

#include "mechanics/state/dense_solve.hpp"

namespace sunder {

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
  // Six sums in registers.
  double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;
  for (Eigen::Index i = 0; i < q.cols(); ++i) {
    const double* p = q.col(i).data();
    const double mx = mass[i] * p[0], my = mass[i] * p[1], mz = mass[i] * p[2];
    xx += mx * p[0];
    yy += my * p[1];
    zz += mz * p[2];
    xy += mx * p[1];
    xz += mx * p[2];
    yz += my * p[2];
  }
  Mat3 inertia;
  inertia << yy + zz, -xy, -xz, -xy, xx + zz, -yz, -xz, -yz, xx + yy;
  return inertia;
}

Vec3 moment_of(const Eigen::VectorXd& mass, ConstLocalField a, ConstLocalField b) {
  double x = 0, y = 0, z = 0;
  for (Eigen::Index i = 0; i < a.cols(); ++i) {
    const double* p = a.col(i).data();
    const double* q = b.col(i).data();
    x += mass[i] * (p[1] * q[2] - p[2] * q[1]);
    y += mass[i] * (p[2] * q[0] - p[0] * q[2]);
    z += mass[i] * (p[0] * q[1] - p[1] * q[0]);
  }
  return {x, y, z};
}

Mat3 product_of(const Eigen::VectorXd& mass, ConstLocalField a, ConstLocalField b) {
  double s[9] = {};
  for (Eigen::Index i = 0; i < a.cols(); ++i) {
    const double* p = a.col(i).data();
    const double* q = b.col(i).data();
    for (int c = 0; c < 3; ++c) {
      const double mq = mass[i] * q[c];
      for (int r = 0; r < 3; ++r) s[3 * c + r] += p[r] * mq;
    }
  }
  return Eigen::Map<const Mat3>(s);
}

RigidField rigid_response(const RestShape& shape, ConstLocalField load) {
  Vec3 force = Vec3::Zero();
  Vec3 torque = Vec3::Zero();
  for (Eigen::Index i = 0; i < load.cols(); ++i) {
    force += load.col(i);
    torque += Vec3(shape.arm.col(i)).cross(Vec3(load.col(i)));
  }
  return {force / shape.total_mass, solve3(shape.inertia, torque)};
}

RigidField project_load(LocalField load, const RestShape& shape) {
  const RigidField rigid = rigid_response(shape, load);
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
  Mat3 H = -product_of(shape.mass, q, shape.arm);
  H.diagonal().array() -= H.trace();
  rigid.rotation = solve3_by_lu(H, moment_of(shape.mass, shape.arm, rate));
  for (Eigen::Index i = 0; i < rate.cols(); ++i) {
    rate.col(i) -= rigid.translation + rigid.rotation.cross(Vec3(q.col(i)));
  }
  return rigid;
}

}  // namespace sunder
