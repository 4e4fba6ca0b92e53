// SPDX-License-Identifier: MIT
// Homology of a cut body: its orbits as a cell complex, Betti numbers over a field, and homology
// over Z.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "topology/suite/judge/glue_twin.hpp"
#include "topology/suite/kernels/operation.hpp"

namespace sunder::suite {

/// One cell in the boundary of another, with the sign of its orientation there.
struct BoundaryTerm {
  std::uint32_t cell = 0;
  int sign = 1;
  friend bool operator==(const BoundaryTerm&, const BoundaryTerm&) = default;
};

/// Vertex, edge, face and tetrahedron orbits with their boundaries. Every cell's corners are
/// ordered by the file's points, which differ within a tetrahedron and agree across a glued face;
/// so gluing never reverses a cell, and the boundary is that of an ordered simplex (a
/// Delta-complex): the cell left without its i-th corner has the sign (-1)^i. Two cells may have
/// the same corners after cuts, hence it is no simplicial complex; but the cells of one
/// tetrahedron all differ, hence it is a regular CW complex.
struct OrbitComplex {
  /// Number of cells of dimension 0 to 3. Cells are numbered by their lowest place in the file's
  /// tetrahedra; tetrahedra as in the file.
  std::array<std::size_t, 4> cells = {0, 0, 0, 0};
  /// boundary[d][c]: of cell c of dimension d (1 to 3); the first d + 1 terms hold.
  std::array<std::vector<std::array<BoundaryTerm, 4>>, 4> boundary;
};

/// The complex of a body as it is now, by union-find. O(|T|).
OrbitComplex orbit_complex(const GlueTwin& twin);

/// Whether the boundary of every boundary is zero, as it must be in a chain complex. O(cells).
bool boundaries_are_closed(const OrbitComplex& complex);

/// Betti numbers over the field of `prime` elements (a prime below 2^15): cells of dimension d less
/// the ranks of the boundary matrices of d and d + 1 (any textbook, e.g. Hatcher, Algebraic
/// Topology, 2.1). About 2 us per tetrahedron on cubes of 6 000 and 48 000, whole and cut; 10 to 20
/// us on closed manifolds.
BettiNumbers betti_numbers(const OrbitComplex& complex, int prime);

/// Homology over Z: torsion in dimension d are the elementary divisors > 1 of the boundary matrix
/// of d + 1. Exact: where a number outgrows 64 bits on the way it throws std::overflow_error
/// instead of giving a wrong answer (no body here comes near). About the cost of `betti_numbers`.
IntegerHomology integer_homology(const OrbitComplex& complex);

/// Whether the tetrahedra can be oriented so that any two disagree on the face they share, as in
/// space. True for no tetrahedron. O(|T|).
bool is_orientable(const GlueTwin& twin);

}  // namespace sunder::suite
