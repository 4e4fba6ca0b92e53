// SPDX-License-Identifier: MIT
// Projected Gauss-Seidel for contacts between bodies given by their response to impulses; no mesh.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "mechanics/state/columns.hpp"

namespace sunder {

/// A body as the solver sees it: displacement of its points at the end of the step for impulses,
/// rigid part h (J/m + I^-1 T x arm) plus an elastic part between its slots,
///   turn (E + rest_arm x J0^-1 (rest_arm x .) - 1/m) turn^T,
/// the last two over all slots at once: what E has of rigid response and should not have. Kept
/// apart so that neither a turn of the body nor other slots cost a pass over E.
struct RespondingBody {
  double inverse_mass = 0;              ///< 1/kg; 0: does not move
  Mat3 inverse_inertia = Mat3::Zero();  ///< 1/(kg m^2), world
  Eigen::MatrixXd elastic;              ///< E, 3k x 3k, m/(N s), the body's own frame; empty: rigid
  Mat3 turn = Mat3::Identity();         ///< from that frame to the world
  double rigid_mass = 0;                ///< 1/m of the elastic part, m/(N s)
  Mat3 rigid_inertia = Mat3::Zero();    ///< J0^-1 of the elastic part, 1/(N s m)
  // What the solve accumulates:
  Vec3 velocity = Vec3::Zero();                        ///< m/s, change
  Vec3 spin = Vec3::Zero();                            ///< rad/s, change
  Eigen::VectorXd displacement;                        ///< 3k, m: change by E, own frame
  Vec3 impulse = Vec3::Zero(), moment = Vec3::Zero();  ///< on slots, own frame, N s and N s m
};

/// One of the points a contact acts on.
struct ContactEnd {
  static constexpr std::uint32_t rigid_slot = 0xffffffffu;
  std::uint32_t body = 0;
  std::uint32_t slot = rigid_slot;  ///< its place in the body's elastic response, or `rigid_slot`
  double weight = 1;                ///< share of the impulse: sums to +1 on side A, -1 on side B
  Vec3 arm = Vec3::Zero();          ///< m, from the body's mass centre
  Vec3 rest_arm = Vec3::Zero();     ///< m, of the slot at rest in the body's own frame
  VertexId vertex;  ///< of no concern to the solver; none() for a whole isolated tetrahedron
  /// m, of no concern to the solver: from the vertex (from the mass centre of an isolated
  /// tetrahedron) to where the contact acts. An impulse there turns the body by so much more.
  Vec3 lever = Vec3::Zero();
};

/// One row of three unknowns.
struct ContactRow {
  std::array<ContactEnd, 5> ends;
  std::uint32_t end_count = 0;
  Vec3 normal{0, 0, 1};
  double gap = 0;      ///< m: end-of-step gap with the impulse as it is, less its target
  Vec3 slip{0, 0, 0};  ///< m: relative displacement over the step with the impulse as it is
  double friction = 0;
  double compliance = 0;  ///< m/(N s): give of the contact itself
  double least = 0;       ///< N s: bounds of the normal impulse
  double most = std::numeric_limits<double>::infinity();
  Vec3 impulse{0, 0, 0};  ///< N s; in: what it is, out: what it should be
  Vec3 guess{0, 0, 0};    ///< N s: a change to begin with, say what the last step needed

  // Filled by `solve_contacts`, m/(N s):
  Mat3 response = Mat3::Zero();    ///< own 3 x 3 block
  double normal_response = 0;      ///< along the normal, compliance included
  double tangential_response = 0;  ///< the larger one in the contact plane
  double disk = 0;                 ///< N s: what friction may be in the sweeps at hand
};

struct SolveLimits {
  double step = 0;       ///< h, s
  double tolerance = 0;  ///< m
  int max_iterations = 0;
  const std::atomic<bool>* hurry = nullptr;  ///< given and true: no further sweep
};

struct SolveOutcome {
  int iterations = 0;
  double residual = 0;  ///< m: largest |gap - projected gap| in the last sweep
  bool converged = true;
};

/// Solves for the impulses of `rows`: the normal part within its bounds, complementary to the gap,
/// the tangential part inside Coulomb's disk and against the slip. Rounds of sweeps with disks of
/// fixed radius, a convex problem whose solution takes energy only (Tresca's friction); after each
/// the disks follow the normal impulses [Kaufman, Sueda, James, Pai 2008: staggered projections].
/// Disks that followed every visit of a row would let wedged pieces press each other harder and
/// harder. Sweeps go in the given order, each followed by a step of nonsmooth conjugate gradients;
/// the same to the bit on every run. Where a solve that was cut short would give the bodies energy,
/// impulses without friction that give none are taken in its place (not `converged`).
/// `bodies` accumulate the changes made by what was added to the impulses. A row that can move
/// nothing keeps its impulse. O(rows x slots) a sweep.
SolveOutcome solve_contacts(std::span<ContactRow> rows, std::span<RespondingBody> bodies,
                            const SolveLimits& limits);

}  // namespace sunder
