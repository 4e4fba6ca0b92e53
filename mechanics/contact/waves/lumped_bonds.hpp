// SPDX-License-Identifier: MIT
// Cohesive bonds in explicit steps: each by its law, between two lumped masses.
#pragma once

#include <vector>

#include "mechanics/contact/cohesion/contact_ties.hpp"
#include "mechanics/contact/waves/lumped_rows.hpp"

namespace sunder {

/// A bond between two nodes of one body.
struct LumpedBond {
  std::uint32_t a = 0, b = 0;  ///< nodes
  std::uint32_t body = 0;
  Constraint row;                  ///< its law and impulse (N s, on A) in the step at hand
  Vec3 opening{0, 0, 0};           ///< m: A against B as the step begins
  double opening_end = 0;          ///< m: the smallest that ends a corner
  std::uint32_t first_corner = 0;  ///< of `LumpedBonds::opened_before`
  bool opens = false;              ///< farther than ever, in the part
  Vec3 total{0, 0, 0};             ///< N s, of the part
};

/// The bonds of a part.
struct LumpedBonds {
  std::vector<LumpedBond> bonds;
  /// Bonds that share nodes: those of one vertex before it split. Where each of these sets begins
  /// in `of_set`, and where the last one ends; rows of `bonds`.
  std::vector<std::uint32_t> set_first, of_set;
  std::vector<double> opened_before;  ///< m, of all corners as the part began
  TieReport report;
  double numerical = 0;  ///< J, taken from motion by bonds beyond their law
};

/// Makes the bonds of `pairs`, with the impulses (N s, on A) that `first` has for a step.
void make_bonds(LumpedBonds& bonds, std::span<const TiePair> pairs, std::span<const Vec3> first,
                const WaveBodies& waves);

/// Measures openings as a step begins, and applies the impulses of the last step. Bounds follow
/// from the openings that these lead to. The sweeps then solve a convex problem.
void begin_bonds(LumpedBonds& bonds, std::span<const TiePair> pairs, WaveNodes& nodes,
                 const RowStep& step);

/// Each bond takes the impulse of its secant at the opening with which the step ends, or all that
/// it bears. Set by set, each is swept until none is off by more than `tolerance`, `most` times at
/// most. Gives the largest distance of a bond from its law in the first sweeps, and in the last
/// ones, over the opening that ends it.
std::array<double, 2> sweep_bonds(LumpedBonds& bonds, std::span<const TiePair> pairs,
                                  WaveNodes& nodes, const RowStep& step, double tolerance,
                                  int most);

/// After the last sweep of a step: corners note their openings. The sides are apart, so their nodes
/// miss a part of the moments. `LumpedContacts::twist` gets that part.
void settle_bonds(LumpedBonds& bonds, std::span<TiePair> pairs, const WaveBodies& waves,
                  LumpedContacts& contacts, const RowStep& step);

/// The report of the part.
TieReport report_of(LumpedBonds& bonds, std::span<const TiePair> pairs, const WaveBodies& waves);

}  // namespace sunder
