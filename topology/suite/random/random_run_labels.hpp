// SPDX-License-Identifier: MIT
// Labels of cracks for random runs, and points to break by them.
#pragma once

#include <random>
#include <vector>

#include "topology/base/tet_mesh.hpp"
#include "topology/suite/fixtures/fixture.hpp"
#include "topology/suite/judge/glue_twin.hpp"

namespace sunder::suite {

/// Sides of every tetrahedron: of a plane, by chance, like a board, or of a region that grew over
/// faces still glued; sometimes with tetrahedra that have none.
CrackSides any_labels(const TetMesh& body, const GlueTwin& now, std::mt19937_64& random);

/// Breaks of one to three cracks with labels of their own, one to twelve in any order; most where a
/// face's sides differ, some where nothing will split, some twice.
std::vector<BreakPoint> any_breaks(const TetMesh& body, const GlueTwin& now,
                                   std::mt19937_64& random);

}  // namespace sunder::suite
