// SPDX-License-Identifier: MIT
// The smoothing of section 3.3 and the display state of a new piece.
#include "mechanics/state/display_state.hpp"

#include <cmath>

#include "topology/base/assert.hpp"
#include "topology/base/elementary.hpp"

namespace sunder {
namespace {

/// The rotation `q` with its angle (the short way, at most pi) multiplied by `factor`.
Eigen::Quaterniond scaled_rotation(Eigen::Quaterniond q, double factor) {
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  const double length = q.vec().norm();
  if (length == 0) return Eigen::Quaterniond::Identity();
  const double half_angle = factor * direction_angle(length, q.w());
  Eigen::Quaterniond scaled;
  scaled.w() = cosine(half_angle);
  scaled.vec() = sine(half_angle) / length * q.vec();
  return scaled;
}

}  // namespace

Pose approach(const Pose& current, const Pose& target, double dt, double time_constant) {
  SUNDER_ASSERT(dt >= 0 && time_constant >= 0, "times cannot run backwards");
  if (time_constant == 0) return target;
  const double alpha = 1 - exponential(-dt / time_constant);
  const Eigen::Quaterniond to_target = target.orientation * current.orientation.conjugate();
  return {current.centre + alpha * (target.centre - current.centre),
          (scaled_rotation(to_target, alpha) * current.orientation).normalized()};
}

Pose carry(const Pose& current, const Pose& target_before, const Pose& target_now) {
  const Eigen::Quaterniond turn = target_now.orientation * target_before.orientation.conjugate();
  return {target_now.centre + turn * (current.centre - target_before.centre),
          (turn * current.orientation).normalized()};
}

Pose split_off(const Pose& old, const Vec3& old_rest_center, const Vec3& new_rest_center) {
  return {old.centre + old.orientation * (new_rest_center - old_rest_center), old.orientation};
}

}  // namespace sunder
