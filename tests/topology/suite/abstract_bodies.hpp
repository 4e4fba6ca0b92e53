// SPDX-License-Identifier: MIT
// Closed 3-manifolds and random pseudomanifolds as bare tetrahedra, for homology with torsion;
// they lie in no space, so their points have numbers only.
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "topology/suite/judge/glue_twin.hpp"

namespace sunder::test {

/// Four point numbers each.
using Tetrahedra = std::vector<std::array<std::uint32_t, 4>>;

/// The lens space L(p, q): the join of two circles of 2 p points (a 3-sphere), in its barycentric
/// subdivision, modulo the rotation of the one by 2 and of the other by 2 q points. A cell and its
/// images share no point, hence the quotient is a simplicial complex. 96 p tetrahedra.
/// Needs: p >= 2, q prime to p. L(2, 1) is the projective space RP3.
Tetrahedra lens_space(std::uint32_t p, std::uint32_t q);

/// The sphere (boundary of a tetrahedron) times a circle of `length` >= 3 points; `twisted`: closed
/// by a reflection, the bundle that is not orientable. 12 `length` tetrahedra.
Tetrahedra sphere_bundle(std::uint32_t length, bool twisted);

/// The torus of dimension 3: n^3 cubes of 6 Kuhn tetrahedra with opposite sides joined; n >= 3.
Tetrahedra three_torus(std::uint32_t n);

/// Up to `tetrahedra` of those on `points` points, each face with at most two of them: any gluing
/// at all, seldom a manifold, often not orientable.
Tetrahedra random_pseudomanifold(std::uint32_t points, std::size_t tetrahedra,
                                 std::mt19937_64& random);

/// The glued body of bare tetrahedra.
suite::GlueTwin glued(const Tetrahedra& tetrahedra);

/// Takes each glue away with this probability.
void cut_at_random(suite::GlueTwin& twin, double probability, std::mt19937_64& random);

}  // namespace sunder::test
