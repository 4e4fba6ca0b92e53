// SPDX-License-Identifier: MIT
// Where a component is drawn: a pose that follows the simulated one smoothly (section 3.3). The
// paper's tau is its centre.
#pragma once

#include "mechanics/state/pose.hpp"

namespace sunder {

/// The current state after `dt` seconds of tending to a target at rest (section 3.3):
/// `tau += alpha (tau_target - tau)` with `alpha = 1 - exp(-dt / time_constant)`, and the rotation
/// that leads to the target taken to the power alpha, the short way round. The paper halves a
/// rotation several times by `q + 1`; a power is one operation, meets alpha exactly, and makes two
/// half steps equal to one whole step, so that nothing depends on the frame rate.
/// `dt` >= 0 and `time_constant` >= 0 in s; a time constant of 0 jumps to the target.
/// A half turn has two short ways: the sign that the quaternions happen to give decides.
Pose approach(const Pose& current, const Pose& target, double dt, double time_constant);

/// The current state moved along with its target, by the rigid motion from `target_before` to
/// `target_now`. Called before `approach` it leaves only the jump of a split to be smoothed;
/// without it, as in the paper, a body that flies at speed v is drawn `v * time_constant` behind.
Pose carry(const Pose& current, const Pose& target_before, const Pose& target_now);

/// The display state of a piece that has just come off: `R_new = R_old` and
/// `tau_new = tau_old + R_old (c0_new - c0_old)`. Every vertex of it is drawn exactly where it was.
/// `old_rest_center`, `new_rest_center`: mass centres of the rest positions (m) of the component
/// before and of the piece.
Pose split_off(const Pose& old, const Vec3& old_rest_center, const Vec3& new_rest_center);

}  // namespace sunder
