// SPDX-License-Identifier: MIT
// GUDHI as an outside oracle for homology: its input for a body, and its Betti numbers.
#pragma once

#include "topology/suite/homology/homology.hpp"

namespace sunder::test {

/// Whether no two cells have the same vertices: then the cells are the simplices of a simplicial
/// complex (no cut, no pinch, and a body large enough to be closed).
bool is_simplicial(const suite::OrbitComplex& complex);

/// Betti numbers over the field of `prime` elements by GUDHI's persistent cohomology of the complex
/// itself. Needs: `is_simplicial`. Throws std::logic_error when GUDHI holds another number of
/// simplices than the complex has cells.
suite::BettiNumbers gudhi_betti(const suite::OrbitComplex& complex, int prime);

/// The same of the barycentric subdivision: a vertex for each cell, a simplex for each chain of
/// cells, each in the boundary of the next. That is a simplicial complex for every cut body, of the
/// same homology: a tetrahedron's corners differ, so its cells all differ, so the complex is a
/// regular CW complex, and such a one is homeomorphic to the order complex of its cells.
/// 24 tetrahedra for each, about 100 simplices.
suite::BettiNumbers gudhi_betti_of_subdivision(const suite::OrbitComplex& complex, int prime);

}  // namespace sunder::test
