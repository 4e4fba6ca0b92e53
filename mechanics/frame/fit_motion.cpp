// SPDX-License-Identifier: MIT
// Frames fitted to moving vertices.
#include "mechanics/frame/fit_motion.hpp"

#include "mechanics/frame/mean_axis.hpp"

namespace sunder {
namespace {

/// P and L about `centre`, summed from x and v.
void sum_momenta(FittedMotion& motion, const MotionInput& input, const Component& component) {
  for (VertexId v : component.vertices) {
    const Vec3 p = input.vertices.mass[v.index()] * input.velocity[v.index()];
    motion.momentum += p;
    motion.angular_momentum += (input.position[v.index()] - motion.frame.centre).cross(p);
  }
}

void set_displacement(const DeformationOutput& output, const MotionInput& input,
                      const Component& component, const Pose& frame) {
  const Mat3 R = frame.orientation.toRotationMatrix();
  for (VertexId v : component.vertices) {
    output.displacement[v.index()] =
        R.transpose() * (input.position[v.index()] - frame.centre) -
        (input.vertices.rest_position[v.index()] - component.rest_centre);
  }
}

}  // namespace

FittedMotion fit_motion(const DeformationOutput& output, const MotionInput& input,
                        const Component& component) {
  FittedMotion motion{rigid_reference(component, input.vertices, input.position)};
  set_displacement(output, input, component, motion.frame);
  sum_momenta(motion, input, component);

  const RestShape shape = rest_shape(input.vertices, component.vertices, component.rest_centre);
  const auto n = shape.mass.size();
  const Mat3 R = motion.frame.orientation.toRotationMatrix();
  Eigen::Matrix3Xd q(3, n), rate(3, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t v = component.vertices[static_cast<std::size_t>(i)].index();
    q.col(i) = shape.arm.col(i) + output.displacement[v];
    rate.col(i) = R.transpose() * input.velocity[v];
  }
  project_rate(rate, shape, q);
  for (Eigen::Index i = 0; i < n; ++i) {
    output.rate[component.vertices[static_cast<std::size_t>(i)].index()] = rate.col(i);
  }
  return motion;
}

FittedMotion express_motion(const DeformationOutput& output, const MotionInput& input,
                            const Component& component, const Pose& frame) {
  FittedMotion motion{frame};
  set_displacement(output, input, component, frame);
  sum_momenta(motion, input, component);
  const Mat3 R = frame.orientation.toRotationMatrix();
  for (VertexId v : component.vertices) {
    output.rate[v.index()] = R.transpose() * (input.velocity[v.index()] - component.frame_velocity);
  }
  return motion;
}

}  // namespace sunder
