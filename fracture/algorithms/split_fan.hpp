// SPDX-License-Identifier: MIT
// Algorithm 4: a crack at one vertex, from its plane to the new connected components.
#pragma once

#include "fracture/algorithms/cells.hpp"
#include "fracture/algorithms/fan_event.hpp"
#include "fracture/algorithms/fracture_settings.hpp"

namespace sunder {

/// `split_face` with the columns of `body.mechanics.vertices` and `body.cells` that follow: a copy
/// for every vertex that came apart, and in bodies of second order then for every edge, which is
/// appended to `nodes`.
FaceSplit part_face(BreakableBody body, HalfFaceId face, std::vector<VertexCopy>& nodes);

/// Algorithm 4, split(v, u): signs of the tetrahedra around `v` relative to the plane through it
/// with the normal `u`. Each face between a positive and a negative one is unsewn in turn. The
/// vertices that come apart get copies, and the oracle is evaluated after each face. At the end,
/// and only if it predicted new connected components, these are identified.
///
///        +   |   -            before: one vertex v        after: v on the positive side,
///      ______v______    ->    ______v | v'______          a copy on the other
///            |                      + | -
///
/// `v`: `vertex_star(map, vertex)`. A star that was taken before other fans were split serves too:
/// its fan then, without the faces that those fans have unsewn. `u`: rest frame, of any length but
/// 0; tetrahedra on the plane belong to the side it points to.
///
/// Appends the columns of every vertex that split, in `body.mechanics.vertices` and `body.cells`.
/// Brings component labels and the thresholds of the fan's vertices (crack tips) up to date. Masses
/// and frames are left to `rebuild`, `elements.component` to the caller. The caller fills in
/// stress, strength and round of the event.
/// Cost: the star, the faces' stars, the smaller sides of the parts that come off.
FanEvent split_fan(BreakableBody body, const VertexStar& v, const Vec3& u,
                   const FractureSettings& settings, ComponentScratch& scratch);

/// The same with the signs at hand, one flag for each tetrahedron of the star: of a crack that
/// keeps its sides they are its labels. `u` is only noted.
FanEvent split_fan(BreakableBody body, const VertexStar& v, const Vec3& u,
                   std::span<const char> positive, const FractureSettings& settings,
                   ComponentScratch& scratch);

}  // namespace sunder
