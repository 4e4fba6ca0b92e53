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

/// Solves for the impulses of `rows`. The normal part is within its bounds, complementary to the
/// gap. The tangential part is inside Coulomb's disk and against the slip. Rounds of sweeps have
/// disks of fixed radius, a convex problem with a solution that takes energy only (Tresca's
/// friction). After each round the disks follow the normal impulses [Kaufman, Sueda, James, Pai
/// 2008: staggered projections]. Disks that followed every visit of a row would let wedged pieces
/// press each other harder and harder. Sweeps go in the given order, each followed by a step of
/// nonsmooth conjugate gradients; the result is the same to the bit on every run.
/// Where a solve that was cut short would give the bodies energy, impulses without friction that
/// give none take its place (not `converged`). The same holds for wedges, where impulses mostly
/// cancel and would grow without end. A wedge has not converged, and the impulses, each alone, give
/// over 64 times the energy of all together. They also give over 16 times the energy of those
/// without friction.
/// `bodies` accumulate the motion from the changes of the impulses. A row that can move nothing
/// keeps its impulse. O(rows x slots) per sweep.
SolveOutcome solve_contacts(std::span<Constraint> rows, std::span<RespondingBody> bodies,
                            const SolveLimits& limits);

}  // namespace sunder
