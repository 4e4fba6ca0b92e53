// SPDX-License-Identifier: MIT
// Patches as rows of the rubble solver. For the sources of this room only.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mechanics/rubble/rubble_body.hpp"

namespace sunder {

/// A body while a tick is solved.
struct MovingBody {
  Vec3 velocity{0, 0, 0}, spin{0, 0, 0};  ///< m/s, rad/s
  double inverse_mass = 0;                ///< 1/kg
  Mat3 inverse_inertia = Mat3::Zero();    ///< 1/(kg m^2), world
  Vec3 centre{0, 0, 0};
  Mat3 turned = Mat3::Identity();  ///< its own axes to the world's
};

/// A manifold between two bodies, with its impulses.
struct RubblePatch {
  struct Point {
    Vec3 local_a, local_b;                  ///< in the bodies' own axes, about their centres, m
    Vec3 arm_a{0, 0, 0}, arm_b{0, 0, 0};    ///< of the place at which both are pushed, world, m
    Vec3 turn_a{0, 0, 0}, turn_b{0, 0, 0};  ///< change of the spins by a unit impulse
    double separation = 0;                  ///< m
    double response = 0;  ///< kg: inverse of the change of the approach by a unit impulse
    double impulse = 0;   ///< N s, of this sub-step
    std::uint32_t shape_a = 0, shape_b = 0;  ///< the two shapes of the point
  };
  std::uint32_t a = 0, b = 0;  ///< bodies
  Vec3 normal{0, 0, 1}, along{1, 0, 0}, across{0, 1, 0};
  double friction = 0;
  int count = 0;
  std::array<Point, 4> point;
  Vec3 arm_a{0, 0, 0}, arm_b{0, 0, 0};  ///< of the middle of the patch
  double friction_response = 0, twist_response = 0, reach = 0;
  std::array<double, 2> slip_impulse{};  ///< N s, along and across, on A
  double twist_impulse = 0;              ///< N m s, about the normal, on A
};

/// Parameters of the rows of a sweep. Overlap decays like that of a damped spring, implicit over
/// the sub-step: the stiffest that does not ring.
struct SweepRule {
  double over_step = 0;  ///< 1/s, over the length of a sub-step
  double rate = 0;       ///< 1/s, at which overlap beyond `slop` decays; 0: not at all
  double share = 1;      ///< of the rigid response where there is overlap
  double leak = 0;       ///< of the impulse that was there
  double slop = 0;       ///< m
  double push = 0;       ///< m/s, at which it goes away at most
};

/// Pushes overlaps out.
SweepRule pushing_rule(double sub_step, double slop, double push);
/// Leaves overlaps alone, and stops approaching points.
SweepRule relaxing_rule(double sub_step);

/// Arms and responses where the bodies are now.
void prepare_patches(std::span<RubblePatch> patches, std::span<const MovingBody> bodies);

/// Gives bodies the impulses that patches have.
void warm_start(std::span<const RubblePatch> patches, std::span<MovingBody> bodies);

/// Adds the blows of points that approach and will touch within `time` (s); row = body. Each point
/// is taken by itself: points of one patch count the same energy several times.
void note_blows(std::span<RubbleBlow> blows, std::span<const RubblePatch> patches,
                std::span<const MovingBody> bodies, double time);

/// One sweep of all rows in `order`, and one back: lower bodies bear higher ones.
void sweep_patches(std::span<RubblePatch> patches, std::span<const std::uint32_t> order,
                   std::span<MovingBody> bodies, const SweepRule& rule);

}  // namespace sunder
