// SPDX-License-Identifier: MIT
// What a user chooses about contact.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "topology/kernel/finding.hpp"

namespace sunder {

/// What a user chooses about contact.
struct ContactSettings {
  /// Coulomb's coefficient of the bodies' own surface, >= 0.
  double friction = 0.5;
  /// Give of one contact point, m/N: 0 (hard) or the inverse of a stiffness. It is solved
  /// implicitly, so any value is stable; what is wanted is the body's own give, hence 0.
  double compliance = 0;
  /// Contacts that begin deeper than `allowed_penetration` are pushed out at this speed at most,
  /// m/s: a piece of mass m gains m v^2 / 2 by it, whatever the step, and no more.
  double push_out_speed = 0.01;
  /// Depth that is left alone, m.
  double allowed_penetration = 1e-5;
  /// Whether pieces repel each other; against obstacles they always do.
  bool between_pieces = true;
  /// Radius of a tetrahedron's ball as a share of its bounding ball's, in (0, 1]. At 1 (the
  /// paper's) the balls of crack faces interlock: a vertex cannot slide past the centres beside it,
  /// and wedged chips are squeezed without end. At 0.5 (1/3 is inscribed, in a regular tetrahedron)
  /// pieces slide, and touch a little late.
  double ball_share = 0.5;
  /// Sweeps of projected Gauss-Seidel a pass.
  int max_iterations = 200;
  /// Largest error of an end-of-step gap at which a sweep may end, relative to the deepest overlap
  /// that the step would have had without contact.
  double tolerance = 1e-5;
  /// How often a step may be predicted anew with the impulses found: the answer of a body that
  /// turns by theta in a step is curved, with an error of theta^2 a pass.
  int max_passes = 3;
  /// Contacts of one component in a pass: the deepest are taken, the rest wait for the next pass or
  /// step. Bounds memory (72 k^2 bytes) and time of the elastic answer.
  std::uint32_t max_contacts_per_component = 256;
};

/// What is wrong with the settings, each an error with value, range and remedy; `place` names them.
std::vector<Finding> check(const ContactSettings& settings, std::string_view place);

}  // namespace sunder
