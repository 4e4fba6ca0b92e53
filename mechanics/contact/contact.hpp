// SPDX-License-Identifier: MIT
// A step with contact: bodies against obstacles, balls and each other's pieces; no cracks here.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "mechanics/contact/contact_grid.hpp"
#include "mechanics/contact/impact.hpp"
#include "mechanics/contact/obstacle.hpp"
#include "mechanics/step.hpp"

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

/// One unilateral contact with friction. Side A is a vertex or a ball; side B an obstacle (driven
/// or a ball) or the bounding ball of a tetrahedron, in equal parts on its four vertices.
struct ContactPoint {
  static constexpr std::uint32_t none = 0xffffffffu;
  VertexId vertex;                ///< A, or
  std::uint32_t ball = none;      ///< A: row of a free sphere
  TetId tetrahedron;              ///< B, or
  std::uint32_t obstacle = none;  ///< B: row of an obstacle
  Vec3 normal{0, 0, 1};           ///< from B to A
  /// gap = normal . (point A - reference of B) + offset, m; the reference of B is the centre of its
  /// ball, or the displacement of a driven obstacle since the step began.
  double offset = 0;
  double gap_start = 0;  ///< m, negative: overlapped already
  double friction = 0;
  Vec3 impulse{0, 0, 0};  ///< N s, on A; B gets the opposite
};

/// What contact must remember from step to step; part of the saved state.
struct ContactMemory {
  /// Overlap that a (tetrahedron, vertex) pair may keep, m: the one it had when its components
  /// first differed, shrunk since to the least it has had. Sorted by pair.
  struct Allowance {
    SpherePair pair;
    double overlap = 0;
  };
  std::vector<Allowance> allowances;
  /// A contact with the impulse that it last had, and the length of that step, s.
  struct Remembered {
    ContactPoint contact;
    double step = 0;
  };
  /// Where the next solve begins; sorted.
  std::vector<Remembered> last_contacts;
  /// Components as the last step saw them; that is how a separation is noticed.
  std::vector<ComponentId> vertex_component, tetrahedron_component;
};

/// How contact went; never silent.
struct ContactReport {
  std::uint32_t candidates = 0;  ///< contacts solved for
  std::uint32_t contacts = 0;    ///< those with an impulse
  int passes = 0;                ///< predictions with impulses
  int iterations = 0;            ///< sweeps, all passes
  double residual = 0;           ///< m, largest error of an end-of-step gap that is left
  double tolerated = 0;          ///< m, what `ContactSettings::tolerance` came to
  bool converged = true;         ///< residual <= tolerated in the sweeps of every pass
  double deepest = 0;            ///< m, deepest overlap at the end of the step, >= 0
  std::uint32_t left_out = 0;    ///< contacts over `max_contacts_per_component`
  /// Row = obstacle: impulse (N s) that it gave the bodies and balls it touched; empty where there
  /// was no contact.
  std::vector<Vec3> obstacle_impulse;

  Vec3 impulse_of(std::size_t obstacle) const {
    return obstacle_impulse.empty() ? Vec3::Zero() : obstacle_impulse[obstacle];
  }
};

/// Room of one step, kept for the next; all of it may be thrown away between steps.
struct ContactScratch {
  ContactScratch();
  ~ContactScratch();
  ContactScratch(ContactScratch&&) noexcept;
  ContactScratch& operator=(ContactScratch&&) noexcept;

  std::vector<ContactPoint> contacts;  ///< of the last step, with their impulses
  struct Room;
  std::unique_ptr<Room> room;
};

/// Everything that moves in a step.
struct ContactWorld {
  MechanicsState& state;
  std::vector<Obstacle>& obstacles;
  ContactMemory& memory;
};

struct ContactStepScratch {
  MechanicsScratch& mechanics;
  ContactScratch& contact;
};

struct ContactStepResult {
  StepStatus status;
  ContactReport report;
  Blows blows;  ///< only where `StepPart::impact` is given
  /// False: there are blows ahead, and nothing was done.
  bool adopted = true;
};

/// One whole step: predicts it without contact, finds what would overlap on the way (swept: fast
/// points do not pass thin obstacles), solves for the impulses that leave
///   gap_end + C j_n / h >= 0,  j_n >= 0,  one of them zero,  |j_t| <= mu j_n against the slip,
/// by projected Gauss-Seidel with the bodies' own rigid and elastic answer, predicts what was
/// touched again, repeats that while the answer's curvature matters, and adopts. No restitution.
/// The impulse acts on the frame (P, L) at the start of the step and on the deformation as the
/// force j / h during it; weight likewise turns from a parabola into a blow at the start for what
/// is touched. So a body at rest has v = 0 and its static stress. The same blow on the deformation
/// would leave stiff vertices with the false velocity -j / 2m (rho_infinity = 0).
/// An impulse that pushed a lumped vertex off the other side faster than it should is then taken
/// back in part (never more than was given): the impact of one lumped mass makes no bounce.
/// Needs: obstacles without findings, a state of `make_state`. Momentum between pieces and balls is
/// conserved to rounding, whatever the tolerance. Angular momentum too, but for contacts between
/// pieces: their reaction acts on the middle of the tetrahedron, off the line of friction and off a
/// normal that turned before they touched (0.4 per cent of L in the test).
/// With `StepPart::impact` given: a step that would run into a blow is not taken but returned with
/// what lies ahead; `frozen` leaves blows alone, they are the next part's; `wave` tells which
/// components are in the midst of one: touched, with a vertex that comes or goes fast.
/// In a `wave` contact is solved for velocities:
///   v_end + max(gap_start, 0) / h >= 0,  j_n >= 0,  one of them zero,  friction against the slip,
/// the impulse being a force over the sub-step. A vertex that touches then stays at rest while it
/// is pressed: no oscillation against the constraint, no bounce to take back, and no work done but
/// by friction, by the inelastic stop of what touches (a lumped mass each) and by the push-out.
/// Limits: pieces are balls of tetrahedra and meet early or late (`ball_share`); a ball smaller
/// than a face can enter between its vertices; pieces that pass each other by more than two radii
/// in a step can miss. An outcome other than fine: see `adopt`.
ContactStepResult advance_with_contact(const ContactWorld& world, const StepInput& input,
                                       const ContactSettings& settings,
                                       const ContactStepScratch& scratch);

}  // namespace sunder
