// SPDX-License-Identifier: MIT
// Which bodies are sub-stepped through impact windows, and which ones round them are carried.
#pragma once

#include <span>
#include <vector>

#include "fracture/scene/scene.hpp"
#include "fracture/simulation/state.hpp"
#include "mechanics/state/impulse.hpp"

namespace sunder {

/// The treatment of a component or ball in a step with impact windows.
enum class Role : char {
  other,    ///< takes the whole step and meets no sub-stepped body
  member,   ///< is sub-stepped: open, or within reach of an open component
  carried,  ///< takes the whole step, then repeats its motion as a rigid body of full mass
};

/// The roles of a step, and the values that carried bodies get back as it ends.
///
/// A carried body has already taken the whole step. It is moved back to the start rigidly, at its
/// end velocity, and repeats that motion in the sub-steps of the members. Gravity and loads do not
/// act again. Contact impulses act on its frame with full mass and inertia, so that momentum and
/// angular momentum balance like those of any two bodies. A carried body that nothing touches ends
/// with exactly the values of its whole step.
struct Boundary {
  std::vector<Role> component, ball;  ///< rows = ComponentId, obstacles
  std::vector<char> pushed;           ///< row = ComponentId: a carried body got an impulse
  std::vector<char> spread;           ///< row = ComponentId: its neighbours are carried too
  /// As the whole step ended: rungs, frames and rows of all.
  std::vector<Rung> rung;
  std::vector<Component> frame;
  std::vector<Vec3> position, velocity;
  /// Work of gravity, J, for motions of bodies outside of any part, and the momentum that gravity
  /// took back from them: for the ledgers.
  double gravity_work = 0;
  Impulse gravity_impulse = Impulse::Zero();
};

/// Distance (m) within which two bodies can meet in a step of length `h`, possibly through a third.
/// It is 4 h (v + h g), v the largest speed. One factor of two is for both bodies moving, the other
/// because an impact can double a speed.
double reach_of_step(const SimulationState& state, const Vec3& gravity, double h);

/// Assigns the roles of a step in which the windows of `open` are open and bodies meet within
/// `reach` (m). Members are the open components, free balls that could meet them through other
/// bodies, and bodies within reach of these. Bodies within reach of members are carried. Components
/// on the clock of the rubble (`RubbleState::apart`) have no part.
void assign_roles(Boundary& boundary, const SimulationState& state,
                  std::span<const ComponentId> open, double reach);

/// Moves carried bodies back by `time`, s, from the end of the whole step. Needs: roles, and the
/// step taken by all but the members.
void begin_boundary(Boundary& boundary, SimulationState& state, const Vec3& gravity, double time);

/// Notes which carried components `contacts` touched.
void note_pushed(Boundary& boundary, const MechanicsState& state,
                 std::span<const ContactPoint> contacts);

/// Makes bodies near strayed carried bodies carried too, so that nothing passes through them. A
/// carried body has strayed if, `left` s before the end, it would end farther than `tolerance` (m)
/// from its end in the whole step. Near is within `reach`.
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
