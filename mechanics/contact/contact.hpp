// SPDX-License-Identifier: MIT
// A step with contact: bodies against obstacles, balls and each other's pieces; no cracks here.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "mechanics/contact/contact_report.hpp"
#include "mechanics/contact/settings/contact_settings.hpp"
#include "mechanics/contact/impact/impact.hpp"
#include "mechanics/contact/shapes/obstacle.hpp"
#include "mechanics/contact/shapes/partner.hpp"
#include "mechanics/ties/tie.hpp"
#include "mechanics/step.hpp"

namespace sunder {

/// One unilateral contact with friction. Side A is a vertex, a free sphere, or a corner of another
/// obstacle; side B an obstacle, a face of a tetrahedron (its ball for `penalty`), or the vertex of
/// it that was one with A before a crack (`Partner`). What B gets acts at the place of A, so that no angular
/// momentum is lost, and is shared among the corners by `weights`.
struct ContactPoint {
  static constexpr std::uint32_t none = 0xffffffffu;
  VertexId vertex;                ///< A, or
  std::uint32_t ball = none;      ///< A: row of a free sphere, or of an obstacle with corners,
  std::uint32_t corner = none;    ///< and which of them (`corners_of`)
  TetId tetrahedron;              ///< B, or
  std::uint32_t obstacle = none;  ///< B: row of an obstacle
  /// Of partners: the lowest crack face of A's side that the contact stands for; none() otherwise.
  HalfFaceId face;
  std::uint8_t place = 0;  ///< of the face of the tetrahedron that is met
  /// Of the corners of B, in the point of the tetrahedron that is nearest to A as they touch.
  std::array<double, 4> weights = {0.25, 0.25, 0.25, 0.25};
  Vec3 normal{0, 0, 1};  ///< from B to A
  /// gap = normal . (point A - reference of B) + offset, m; the reference of B is its point of
  /// `weights`, or how a driven obstacle has moved in the step; a free one is the frame itself, as
  /// it is turned at the start.
  double offset = 0;
  double gap_start = 0;  ///< m, negative: overlapped already
  double friction = 0;
  Vec3 impulse{0, 0, 0};  ///< N s, on A; B gets the opposite
};

/// What contact must remember from step to step; part of the saved state.
struct ContactMemory {
  /// A contact with the impulse that it last had, and the length of that step, s.
  struct Remembered {
    ContactPoint contact;
    double step = 0;
  };
  /// Where the next solve begins; sorted.
  std::vector<Remembered> last_contacts;
  /// Crack faces that still face each other, in the order in which they came apart. Whoever unsews
  /// a face adds it.
  std::vector<Partner> partners;
  /// Crack faces that still hold, within components, in the order in which they came apart. Whoever
  /// unsews a face adds it, and takes it away once it is spent; the step notes how far corners have
  /// opened.
  std::vector<Tie> ties;
};

/// Scratch of one step, kept for the next; all of it may be thrown away between steps.
struct ContactScratch {
  ContactScratch();
  ~ContactScratch();
  ContactScratch(ContactScratch&&) noexcept;
  ContactScratch& operator=(ContactScratch&&) noexcept;

  struct Buffers;
  std::unique_ptr<Buffers> buffers;
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
  std::vector<ContactPoint> contacts;  ///< those with an impulse
  /// N m s, of each of them about the origin: what side A got.
  std::vector<Vec3> moments;
  TieReport ties;
  /// Rows = ComponentId, obstacles: who got impulses, be they taken back; empty: nobody.
  std::vector<char> touched, ball_touched;
  Blows blows;  ///< only where `StepPart::impact` is given
  /// False: there are blows ahead, and nothing was done.
  bool adopted = true;
};

/// One whole step: predicts it without contact, finds what would overlap on the way (swept: fast
/// points do not pass thin obstacles), solves for the impulses that leave
///   gap_end + C j_n / h >= 0,  j_n >= 0,  one of them zero,  |j_t| <= mu j_n against the slip,
/// by projected Gauss-Seidel with the bodies' own rigid and elastic response, predicts what was
/// touched again, repeats that while the response's curvature matters, and adopts. No restitution.
/// The impulse acts on the frame (P, L) at the start of the step and on the deformation as the
/// force j / h during it; weight likewise turns from a parabola into a blow at the start for what
/// is touched. So a body at rest has v = 0 and its static stress. The same blow on the deformation
/// would leave stiff vertices with the false velocity -j / 2m (rho_infinity = 0).
/// An impulse that pushed a lumped vertex off the other side faster than it should is then taken
/// back in part (never more than was given): the impact of one lumped mass makes no bounce.
/// Needs: obstacles without findings, a state of `make_state`. Momentum and angular momentum are
/// conserved to rounding, whatever the tolerance: both impulses of a contact act at one point,
/// where side A is at the start of the step.
/// With `StepPart::impact` given: a step that would run into a blow is not taken but returned with
/// what lies ahead; `frozen` leaves blows alone, they are the next part's; `wave` tells which
/// components are in the midst of one: touched, with a vertex that comes or goes fast.
/// In a `wave` contact is solved for velocities:
///   v_end + max(gap_start, 0) / h >= 0,  j_n >= 0,  one of them zero,  friction against the slip,
/// the impulse being a force over the sub-step. A vertex that touches then stays at rest while it
/// is pressed: no oscillation against the constraint, no bounce to take back, and no work done but
/// by friction, by the inelastic stop of what touches (a lumped mass each) and by the push-out.
/// With `ContactMethod::penalty` every vertex that lies in an obstacle, or in the ball of a
/// tetrahedron of another component, as the step begins gets the impulse
///   h (k depth - c v_n) n >= 0 at its start, and against the slip h min(c |v_t|, mu f_n);
/// balls likewise. Needs: whole steps of everything, without `StepPart::impact`.
/// Limits: corners move on straight lines through the step; a free sphere smaller than a face can
/// enter between its vertices; pieces that pass each other by more than two radii of their
/// tetrahedra in a step can miss. An outcome other than fine: see `adopt`.
ContactStepResult advance_with_contact(const ContactWorld& world, const StepInput& input,
                                       const ContactSettings& settings,
                                       const ContactStepScratch& scratch);

}  // namespace sunder
