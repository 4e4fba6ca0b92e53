// SPDX-License-Identifier: MIT
// A step with contact: bodies against obstacles, balls and each other's pieces; no cracks here.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "mechanics/contact/contact_point.hpp"
#include "mechanics/contact/contact_report.hpp"
#include "mechanics/contact/impact/impact.hpp"
#include "mechanics/contact/settings/contact_settings.hpp"
#include "mechanics/contact/shapes/obstacle.hpp"
#include "mechanics/contact/waves/wave_work.hpp"
#include "mechanics/state/impulse.hpp"
#include "mechanics/step.hpp"

namespace sunder {

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

/// Places of weight and works of forces in explicit steps, for the ledgers.
struct WaveTrace {
  std::vector<Vec3> weight_place;       ///< row = ComponentId, m
  std::vector<Vec3> ball_weight_place;  ///< row = obstacle, m
  std::vector<Impulse> loads;           ///< row = ComponentId, about the origin: of surface loads
  WaveWork work;
  RowWork contact;
  double bonds = 0;                ///< J, taken from motion by bonds beyond their law
  std::uint32_t scaled_cells = 0;  ///< with selective mass scaling (`ScaledCells`)
};

struct ContactStepResult {
  StepStatus status;
  ContactReport report;
  std::vector<ContactPoint> contacts;  ///< those with an impulse
  /// N m s, one per contact: moment about the origin that side A received.
  std::vector<Vec3> moments;
  TieReport ties;
  /// Rows = ComponentId, obstacles: those that received impulses, even if these were taken back
  /// later. Empty: none.
  std::vector<char> touched, ball_touched;
  std::optional<WaveTrace> trace;  ///< of explicit steps
  /// How many of `StepPart::sub_steps` were taken, and the length of the part then, s.
  std::uint32_t sub_steps = 1;
  double length = 0;
  Blows blows;  ///< only where `StepPart::impact` is given
  /// False: there are blows ahead, or pieces would pass each other; nothing was done.
  bool adopted = true;
  /// With `StepPart::divides`: pieces would pass each other, and shorter steps see them meet. How
  /// far they move against each other in the step, in mean edges of the smaller tetrahedron or in
  /// radii; 0: none.
  double passing_way = 0;
};

/// One whole step. It predicts the step without contact and finds contacts along the paths:
/// vertices, corners and spheres at faces, edges at edges. It solves for the impulses that leave
///   gap_end + C j_n / h >= 0,  j_n >= 0,  one of them zero,  |j_t| <= mu j_n against the slip,
/// by projected Gauss-Seidel with the bodies' own rigid and elastic response. It predicts the
/// touched bodies again, repeats that while the response's curvature matters, and adopts. No
/// restitution.
/// The impulse acts on the frame (P, L) at the start of the step and on the deformation as the
/// force j / h during it. For touched bodies the parabola of gravity likewise becomes an impulse at
/// the start. So a body at rest has v = 0 and its static stress. The same impulse on the
/// deformation would leave stiff vertices with the false velocity -j / 2m (rho_infinity = 0).
/// An impulse that pushed a lumped vertex off the other side too fast is then taken back in part,
/// never more than was given. So the impact of one lumped mass makes no bounce.
/// Needs: obstacles without findings, a state of `make_state`. Momentum and angular momentum are
/// conserved to rounding, for any tolerance. Both impulses of a contact act at one point, the place
/// of side A at the start of the step.
/// With `StepPart::impact` given, a step that would run into a blow is not taken: the result has
/// the blows ahead. `frozen` ignores blows, which belong to the next part. `wave` reports the
/// components inside a blow: touched, with a vertex that approaches or separates fast.
/// In a `wave` contact is solved for velocities:
///   v_end + max(gap_start, 0) / h >= 0,  j_n >= 0,  one of them zero,  friction against the slip,
/// the impulse being a force over the sub-step. A touching vertex then stays at rest while it is
/// pressed: no oscillation against the constraint and no bounce to take back. Work is done only by
/// friction, by the inelastic stop of touching vertices (a lumped mass each) and by the push-out.
/// With `ContactMethod::penalty`, vertices are tested as the step begins. A vertex in an obstacle,
/// or in the ball of a tetrahedron of another component, gets the impulse
///   h (k depth - c v_n) n >= 0 at its start, and against the slip h min(c |v_t|, mu f_n);
/// balls likewise. Needs: whole steps of everything, without `StepPart::impact`.
/// The first pass solves for the supports of resting bodies, the next ones for all other contacts
/// (`leave_to_next_pass`). Bodies so slide over seams between flush solids. Once all contacts
/// are solved, but in a wave, tetrahedra that overlap as the step ends are contacts too
/// (`find_overlaps`). With `StepPart::divides` a step in which pieces would pass each other is not
/// taken (`find_passing`).
/// Limits: corners move on straight lines through the step; edges of free obstacles do not meet
/// edges of others; pieces that begin deep in each other leave slowly. An outcome other than fine:
/// see `adopt`.
ContactStepResult advance_with_contact(const ContactWorld& world, const StepInput& input,
                                       const ContactSettings& settings,
                                       const ContactStepScratch& scratch);

}  // namespace sunder
