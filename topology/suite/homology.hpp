// SPDX-License-Identifier: MIT
// Homology of a cut body: its orbits as a cell complex, Betti numbers over a field, and homology
// over Z by the Smith normal form.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "topology/suite/glue_twin.hpp"
#include "topology/suite/operation.hpp"

namespace sunder::suite {

/// The boundary of each cell of one dimension: (row of a cell one dimension lower, +1 or -1).
struct BoundaryTerm {
  std::uint32_t cell = 0;
  int sign = 1;
};

/// Vertex, edge, face and tetrahedron orbits with their boundaries. Every cell's corners are
/// ordered by the file's points, of which one tetrahedron has four different ones; so gluing never
/// reverses a cell, and the boundary is that of an ordered simplex (a Delta-complex).
struct OrbitComplex {
  /// Number of cells of dimension 0 to 3.
  std::array<std::size_t, 4> cells = {0, 0, 0, 0};
  /// boundary[d][c]: of cell c of dimension d (1 to 3); d + 1 terms each.
  std::array<std::vector<std::array<BoundaryTerm, 4>>, 4> boundary;
};

/// The complex of a body as it is now, by union-find. O(|T| log).
OrbitComplex orbit_complex(const GlueTwin& twin);

/// Betti numbers over the field of `prime` elements (2, 3, ... below 2^15). Gaussian elimination
/// after pairs of free cells are collapsed; a cube of 6 000 tetrahedra takes a fraction of a
/// second.
BettiNumbers betti_numbers(const OrbitComplex& complex, int prime);

/// Homology over Z. For maps of up to some thousand cells; exact: numbers that would not fit into
/// 64 bits are an assertion, not a wrong answer.
IntegerHomology integer_homology(const OrbitComplex& complex);

/// Whether all tetrahedra can be oriented alike across all glued faces.
bool is_orientable(const GlueTwin& twin);

}  // namespace sunder::suite
