// SPDX-License-Identifier: MIT
// Who is sub-stepped through impact windows, and who stands round them as whole bodies.
#pragma once

#include <span>
#include <vector>

#include "fracture/scene/scene.hpp"
#include "fracture/simulation/state.hpp"
#include "mechanics/state/impulse.hpp"

namespace sunder {

/// What a step with impact windows does with a component or ball.
enum class Role : char {
  other,    ///< takes the whole step and meets nothing that is sub-stepped
  member,   ///< is sub-stepped: open, or within reach of what is open
  carried,  ///< takes the whole step, then goes its way again as a rigid body of full mass
};

/// The roles of a step, and what carried bodies must get back as it ends.
///
/// A carried body has taken the step: it is moved back in time from there, rigidly, at the velocity
/// that it ended with, and goes that way again in the sub-steps of the members, without weight and
/// loads, which it has had. Contact impulses act on its frame with full mass and inertia, so that
/// momentum and angular momentum balance like those of any two bodies. What none has touched ends
/// with the very bytes of its whole step.
struct Boundary {
  std::vector<Role> component, ball;  ///< rows = ComponentId, obstacles
  std::vector<char> pushed;           ///< row = ComponentId: a carried body got an impulse
  std::vector<char> spread;           ///< row = ComponentId: and what it may meet is carried too
  /// As the whole step ended: rungs, frames and rows of all.
  std::vector<Rung> rung;
  std::vector<Component> frame;
  std::vector<Vec3> position, velocity;
  /// Of gravity on ways that bodies were moved outside of any part, J, and what it took back of
  /// their momentum: for the ledgers.
  double gravity_work = 0;
  Impulse gravity_impulse = Impulse::Zero();
};

/// How near two things have to be that could meet in a step of length `h`, one through the other:
/// m. Twice the farthest way of anything is what two bodies do at the present speeds, and an impact
/// can double a speed.
double reach_of_step(const SimulationState& state, const Vec3& gravity, double h);

/// Who does what in a step in which the windows of `open` are open and things meet within `reach`
/// (m): members are what is open, free balls that could meet it through others, and what lies
/// within reach of those; carried is what lies within reach of members. Who is on the clock of the
/// rubble (`RubbleState::apart`) has no part.
void assign_roles(Boundary& boundary, const SimulationState& state,
                  std::span<const ComponentId> open, double reach);

/// Moves carried bodies back by `time`, s, from the end of the whole step. Needs: roles, and the
/// step taken by all but the members.
void begin_boundary(Boundary& boundary, SimulationState& state, const Vec3& gravity, double time);

/// Notes who among the carried was touched by `contacts`.
void note_pushed(Boundary& boundary, const MechanicsState& state,
                 std::span<const ContactPoint> contacts);

/// Carries also what lies within `reach` of carried bodies that would end farther than `tolerance`
/// (m) from where their whole step took them, with `left` s to go: nothing passes through them.
void spread_boundary(Boundary& boundary, SimulationState& state, const Vec3& gravity, double left,
                     double reach, double tolerance);

/// Makes a member of a carried component, say because it was struck, with `left` s to go: it gives
/// back its weight's impulse over that time, and deforms from here on.
void release(Boundary& boundary, SimulationState& state, ComponentId id, const Vec3& gravity,
             double left);

/// Gives carried bodies their rungs back; the rows of those that none has touched as they were, and
/// their deformation's part of the velocity to the others, which go on on the rung `full`.
void end_boundary(Boundary& boundary, SimulationState& state);

}  // namespace sunder
