// SPDX-License-Identifier: MIT
// Settings of contact.
#pragma once

#include <cstdint>

namespace sunder {

/// The method that keeps bodies apart.
enum class ContactMethod {
  impulses,  ///< unilateral contact, solved with the response of the bodies over the step
  penalty,   ///< the paper's: springs on overlaps at the start of the step
};

/// Settings of contact. The method `penalty` uses `friction`, `between_pieces`, `ball_share` (for
/// it alone) and the members with its name.
struct ContactSettings {
  ContactMethod method = ContactMethod::impulses;
  /// Stiffness of the spring of one vertex on one obstacle or ball, N/m, > 0.
  double penalty_stiffness = 1e5;
  /// Damping parallel to the spring, N s/m, >= 0. The damper never pulls, and brakes slip at most
  /// by friction. At 0, the paper's value, contact is elastic and slides freely.
  double penalty_damping = 0;
  /// Coulomb's coefficient of the bodies' own surface, >= 0.
  double friction = 0.5;
  /// Compliance of one contact point, m/N, the inverse of its stiffness; 0: hard. It is solved
  /// implicitly, so any value is stable. The bodies deform already, so 0 is the realistic value.
  double compliance = 0;
  /// Largest speed at which contacts deeper than `allowed_penetration` are pushed apart, m/s. The
  /// push adds energy: interlocked pieces of a monolith of 1 440 kg gained 130 J in 0.4 s at ten
  /// times this speed.
  double push_out_speed = 0.001;
  /// Penetration that is not corrected, m.
  double allowed_penetration = 1e-5;
  /// True: pieces collide with each other. They always collide with obstacles.
  bool between_pieces = true;
  /// penalty: radius of a tetrahedron's ball as a share of its bounding ball's, in (0, 1]. At 1
  /// (the paper's) the balls of crack faces interlock: a vertex cannot slide past neighbouring
  /// centres, and wedged chips stay squeezed. At 0.5 pieces slide, and touch a little late. In a
  /// regular tetrahedron 1/3 is the inscribed ball.
  double ball_share = 0.5;
  /// Most sweeps of projected Gauss-Seidel per pass.
  int max_iterations = 2000;
  /// Constraint violation of an end-of-step gap at which the sweeps end, relative to the deepest
  /// overlap that the step would have had without contact.
  double tolerance = 1e-5;
  /// Most passes: predictions of a step with the impulses found so far. The response of a body that
  /// turns by theta per step is not linear, and a single pass leaves an error of theta^2. At most
  /// 3, except for floating_frame and modal with rigid isolated tetrahedra.
  int max_passes = 10;
  /// Most contacts between two bodies per pass, and among a body's own crack faces. Of more
  /// contacts, a subset that spans the same patch is solved, deepest first. The limit bounds memory
  /// (72 k^2 bytes for k contacts of one component) and time of the elastic response.
  std::uint32_t max_contacts_per_pair = 128;
};

}  // namespace sunder
