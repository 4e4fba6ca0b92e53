// SPDX-License-Identifier: MIT
// Where a component is drawn: a rigid state that follows the simulated one smoothly (section 3.3).
#pragma once

#include "mechanics/state/columns.hpp"

#include <Eigen/Geometry>

namespace sunder {

/// A rigid placement: a rest position `x0` is drawn at `rotation (x0 - c0) + translation`, where
/// `c0` is the rest centre of the component it belongs to.
struct DisplayState {
  /// Where the component's rest centre is drawn, m.
  Vec3 translation{0, 0, 0};
  /// Unit quaternion; its sign is of no importance.
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
};

/// The current state after `dt` seconds of tending to a target at rest (section 3.3):
/// `tau += alpha (tau_target - tau)` with `alpha = 1 - exp(-dt / time_constant)`, and the rotation
/// that leads to the target taken to the power alpha, the short way round. The paper halves a
/// rotation several times by `q + 1`; a power is one operation, meets alpha exactly, and makes two
/// half steps equal to one whole step, so that nothing depends on the frame rate.
/// `dt` >= 0 and `time_constant` >= 0 in s; a time constant of 0 jumps to the target.
/// A half turn has two short ways: the sign that the quaternions happen to give decides.
DisplayState approach(const DisplayState& current, const DisplayState& target, double dt,
                      double time_constant);

/// The current state moved along with its target, by the rigid motion from `target_before` to
/// `target_now`. Called before `approach` it leaves only the jump of a split to be smoothed;
/// without it, as in the paper, a body that flies at speed v is drawn `v * time_constant` behind.
DisplayState carry(const DisplayState& current, const DisplayState& target_before,
                   const DisplayState& target_now);

/// The display state of a piece that has just come off: `R_new = R_old` and
/// `tau_new = tau_old + R_old (c0_new - c0_old)`. Every vertex of it is drawn exactly where it was.
/// `old_rest_center`, `new_rest_center`: mass centres of the rest positions (m) of the component
/// before and of the piece.
DisplayState split_off(const DisplayState& old, const Vec3& old_rest_center,
                       const Vec3& new_rest_center);

}  // namespace sunder
