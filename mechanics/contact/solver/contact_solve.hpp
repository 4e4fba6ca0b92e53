// SPDX-License-Identifier: MIT
// Projected Gauss-Seidel for contacts between bodies given by their response to impulses; no mesh.
#pragma once

#include <atomic>
#include <span>

#include "mechanics/contact/solver/contact_rows.hpp"

namespace sunder {

struct SolveLimits {
  double step = 0;       ///< h, s
  double tolerance = 0;  ///< m
  int max_iterations = 0;
  const std::atomic<bool>* hurry = nullptr;  ///< given and true: no further sweep
  bool ends_stalled = false;  ///< ends near the tolerance where the residual falls no more
};

struct SolveOutcome {
  int iterations = 0;
  double residual = 0;  ///< m: largest |gap - projected gap| in the last sweep
  double impulse = 0;   ///< N s: largest change of an impulse in it
  bool converged = true;
  bool stalled = false;  ///< converged near the tolerance only
};

/// Solves for the impulses of `rows`: the normal part within its bounds, complementary to the gap,
/// the tangential part inside Coulomb's disk and against the slip. Rounds of sweeps with disks of
/// fixed radius, a convex problem whose solution takes energy only (Tresca's friction); after each
/// the disks follow the normal impulses [Kaufman, Sueda, James, Pai 2008: staggered projections].
/// Disks that followed every visit of a row would let wedged pieces press each other harder and
/// harder. Sweeps go in the given order, each followed by a step of nonsmooth conjugate gradients;
/// the same to the bit on every run. Where a solve that was cut short would give the bodies energy,
/// impulses without friction that give none are taken in its place (not `converged`). So they are
/// where, not converged, impulses hold each other: alone they would give over 64 times what they
/// give together, and over 16 times what those without friction do. Those of a wedge grow so
/// without end. `bodies` accumulate the changes made by what was added to the impulses. A row that
/// can move nothing keeps its impulse. O(rows x slots) a sweep.
SolveOutcome solve_contacts(std::span<Constraint> rows, std::span<RespondingBody> bodies,
                            const SolveLimits& limits);

}  // namespace sunder
