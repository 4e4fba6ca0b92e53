// SPDX-License-Identifier: MIT
// The forces of ties in a sub-step of waves: many rows, no matrix between them.
#pragma once

#include <span>

#include "mechanics/contact/response/contact_bodies.hpp"
#include "mechanics/contact/cohesion/contact_ties.hpp"

namespace sunder {

/// How the ties of a part were solved for.
struct TieOutcome {
  int iterations = 0;   ///< back-solves
  double residual = 0;  ///< farthest a row is from its law, over the opening that ends it
};

/// Impulses of `pairs` (`rows`, one each: measured by `measure_tie` as velocities) in a wave, in
/// `rows[k].impulse`: accelerated projected gradients [Beck and Teboulle 2009; restarts of
/// O'Donoghue and Candes 2015], one back-solve of the component's factor an iteration. Steps are
/// those of the lumped masses, which the factor's matrix M + ... never responds beyond, so that no
/// eigenvalue is needed; in steps of about a cell the two differ little. Bounds begin as what ties
/// can bear at all and fall with the openings that the step ends with (`ends`, m, as predicted),
/// never rising: a tie holds as long as it can. Impulses of a pair are opposite and act at one
/// place, so the body's rigid motion stays. Ends at `tolerance`, a share of openings, or after
/// `most` back-solves, four times as many where ties are still far off. Needs: factors of the part
/// (`prepare`).
TieOutcome solve_ties(std::span<Constraint> rows, std::span<const TiePair> pairs,
                      std::span<const Vec3> ends, const ContactPass& pass, double tolerance,
                      int most);

}  // namespace sunder
