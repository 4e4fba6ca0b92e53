// SPDX-License-Identifier: MIT
// Ties in the step with contact: one row for each pair of vertices, besides the contacts.
#pragma once

#include <span>
#include <vector>

#include "mechanics/contact/detection/contact_detect.hpp"
#include "mechanics/contact/solver/contact_rows.hpp"

namespace sunder {

/// Corners of ties between the same two vertices, one plane: they open alike and are one row.
struct TiePair {
  VertexId a, b;           ///< a < b
  HalfFaceId face;         ///< of A: identifies pairs of the same vertices
  TetId tetrahedron;       ///< of B
  std::uint8_t place = 0;  ///< of B among its nodes
  Vec3 normal{0, 0, 1};    ///< of the crack, world, from B to A, as the step begins
  double area = 0;         ///< m^2, of all corners
  ShearLaw shear;          ///< of all of them
  std::vector<TieCorner*> corners;
};

/// Pairs of living members that ties still hold or keep from overlapping, sorted by vertices.
/// `memory` is changed by `settle_ties` alone.
std::vector<TiePair> gather_ties(ContactMemory& memory, const StepPaths& paths);

/// m: by how much A is off B, world, where the step is predicted to end.
Vec3 opening_at_end(const TiePair& pair, const StepPaths& paths);

/// N, effective: the force that all corners of a pair bear together, on average over the openings
/// from the largest so far to `opening` (m, world).
double tie_bound(const TiePair& pair, const Vec3& opening);

/// The factor on `tie_bound` for the mode of an impulse (on A), or of the opening if there is none:
/// sqrt(`mode_ratio`).
double mode_factor(const TiePair& pair, const Vec3& impulse, const Vec3& opening);

/// m: the smallest opening that ends a corner of a pair.
double opening_end_of(const TiePair& pair);

/// The tie as a contact: its sides A and B, and its direction.
ContactPoint contact_of(const TiePair& pair);

/// Opening, give and bound of a row of a tie for a step as it is predicted: bounds are the means of
/// the law over the openings predicted, so that each solve is convex and the next pass follows the
/// law. Gives how far the row is from its law, m.
double measure_tie(Constraint& row, const TiePair& pair, const Vec3& impulse,
                   const StepPaths& paths);

/// m, world: by how much A is off B before and after.
struct TieOpening {
  Vec3 start, end;
};

/// The corners of a pair note their openings, and the report notes the energies. `force`: N, on A,
/// the mean on the way. True: a corner opened farther than ever.
bool settle_tie(TieReport& report, TiePair& pair, const TieOpening& opening, const Vec3& force);

/// Whether a corner of a pair has opened by more than 1 % of the opening that ends it, from
/// `opened_before` (m, one a corner).
bool has_torn(const TiePair& pair, std::span<const double> opened_before);

/// m/(N s) of a pair's row for a step of `h` s: give of its secants; bounds rule where nothing is
/// left of the stiffness.
double give_of(const TiePair& pair, double h);

/// After the last pass: corners note how far they have opened. `impulse`: N s, on A, of each pair.
TieReport settle_ties(std::span<TiePair> pairs, std::span<const Vec3> impulse,
                      const StepPaths& paths);

}  // namespace sunder
