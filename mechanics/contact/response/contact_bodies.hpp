// SPDX-License-Identifier: MIT
// Components and balls as the contact solver sees them, and the effects of its impulses on them.
#pragma once

#include <vector>

#include "mechanics/contact/detection/contact_detect.hpp"
#include "mechanics/contact/solver/contact_solve.hpp"
#include "mechanics/integrators/impulse_response.hpp"

namespace sunder {

/// The bodies of one solve. Component and ball rows point into `bodies`.
struct ContactBodies {
  static constexpr std::uint32_t none = 0xffffffffu;
  std::vector<RespondingBody> bodies;
  std::vector<ComponentId> component;            ///< of each body; none() for a ball
  std::vector<std::uint32_t> ball;               ///< of each body; none for a component
  std::vector<std::vector<VertexId>> slots;      ///< vertices of each component's slots, ascending
  std::vector<std::uint32_t> body_of_component;  ///< row = ComponentId
  std::vector<std::uint32_t> body_of_ball;       ///< row = obstacle
  std::vector<std::uint32_t> slot_of_vertex;     ///< row = VertexId; valid for slots only
  std::vector<Constraint> rows;                  ///< one a contact
};

/// Impulses that touched bodies have received so far in this step.
struct StepBlows {
  std::vector<char> component_touched, ball_touched;
  std::vector<Vec3> vertex_impulse;     ///< |V|, N s: deforms components of floating_frame
  Loads without_gravity, with_gravity;  ///< `force` is filled by `predict_touched`
};

/// Everything a pass works with.
struct ContactPass {
  const StepInput& input;
  MechanicsState& state;
  std::vector<Obstacle>& obstacles;
  MechanicsScratch& mechanics;
};

/// True where an impulse is split between the frame and the deformation: floating_frame and
/// isolated tetrahedra. Other integrators take it as a jump of velocities at the start.
bool takes_split_blow(const ContactPass& pass, const Component& component);

/// m: a contact's vertex, the point of its ball, or the corner, in the state as it is.
Vec3 place_of_side_a(const ContactPass& pass, const ContactPoint& contact);

/// Makes the bodies that `contacts` act on, with their response over the coming step, and the ends
/// of their rows. Costs three back-solves for each contact vertex the first time it is met.
void gather_bodies(ContactBodies& bodies, std::span<const ContactPoint> contacts,
                   const ContactPass& pass);

/// The same bodies with the response of their velocities at this moment: lumped masses.
void gather_lumped_bodies(ContactBodies& bodies, std::span<const ContactPoint> contacts,
                          const ContactPass& pass);

/// The same bodies without a response: for impulses that need no solve.
void gather_rows(ContactBodies& bodies, std::span<const ContactPoint> contacts,
                 const ContactPass& pass);

/// Adds `change[k]` (N s, on side A of row k) to momenta and spins of bodies that take split blows
/// and to the velocities of all others. At its first touch a body gets its weight as an impulse.
void apply_changes(StepBlows& blows, const ContactBodies& bodies, std::span<const Vec3> change,
                   const ContactPass& pass);

/// Gives a free obstacle an impulse (N s) at `arm` (m) from its mass centre.
void strike_ball(Obstacle& ball, const Vec3& impulse, const Vec3& arm);

/// How a free obstacle is turned after `h` s in which its angular momentum goes from its present
/// value to `end` (`turn_through_step`). A sphere is not followed.
Eigen::Quaterniond turned_obstacle(const Obstacle& free, const Vec3& end, double h);

/// Predicts every touched component again, with its impulses so far.
void predict_touched(StepBlows& blows, const ContactPass& pass);

}  // namespace sunder
