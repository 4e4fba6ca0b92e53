// SPDX-License-Identifier: MIT
// What a user chooses about contact.
#pragma once

#include <cstdint>

namespace sunder {

/// What keeps bodies apart.
enum class ContactMethod {
  impulses,  ///< unilateral contact, solved with the response of the bodies over the step
  penalty,   ///< the paper's: springs on what overlaps as the step begins
};

/// What a user chooses about contact. `penalty` takes of it `friction`, `between_pieces`,
/// `ball_share`, which it alone takes, and what bears its name.
struct ContactSettings {
  ContactMethod method = ContactMethod::impulses;
  /// N/m, > 0, of the spring of one vertex on one obstacle or ball.
  double penalty_stiffness = 1e5;
  /// N s/m, >= 0, of the damper beside it, which never pulls and brakes the slip by friction at
  /// most. At 0, the paper's, contact is elastic and slides freely.
  double penalty_damping = 0;
  /// Coulomb's coefficient of the bodies' own surface, >= 0.
  double friction = 0.5;
  /// Compliance of one contact point, m/N, the inverse of its stiffness; 0: hard. It is solved
  /// implicitly, so any value is stable. The body deforms by itself, so 0 is the realistic value.
  double compliance = 0;
  /// m/s: contacts that begin deeper than `allowed_penetration` are pushed apart at this speed at
  /// most. It works against what presses: interlocked pieces of a monolith of 1 440 kg gained 130 J
  /// in 0.4 s by ten times this speed.
  double push_out_speed = 0.001;
  /// Penetration that is not corrected, m.
  double allowed_penetration = 1e-5;
  /// Whether pieces collide with each other; with obstacles they always do.
  bool between_pieces = true;
  /// penalty: radius of a tetrahedron's ball as a share of its bounding ball's, in (0, 1]. At 1
  /// (the paper's) the balls of crack faces interlock: a vertex cannot slide past the centres beside
  /// it, and wedged chips are squeezed without end. At 0.5 (1/3 is inscribed, in a regular
  /// tetrahedron) pieces slide, and touch a little late.
  double ball_share = 0.5;
  /// Sweeps of projected Gauss-Seidel in a pass.
  int max_iterations = 200;
  /// Constraint violation of an end-of-step gap at which the sweeps end, relative to the deepest
  /// overlap that the step would have had without contact.
  double tolerance = 1e-5;
  /// How often a step may be predicted again with the impulses found. The response of a body that
  /// turns by theta in a step is not linear: an error of theta^2 is left after a single pass. At
  /// most 3 but for floating_frame and modal with rigid isolated tetrahedra.
  int max_passes = 10;
  /// Contacts between two bodies in a pass, those of a body's own crack faces too: of more, a set
  /// that spans the same patch is solved, deepest first. Bounds memory (72 k^2 bytes, k contacts of
  /// one component) and time of the elastic response.
  std::uint32_t max_contacts_per_pair = 128;
};

}  // namespace sunder
