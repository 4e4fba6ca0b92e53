// SPDX-License-Identifier: MIT
// The result of breaks of labelled cracks, without an order: a union over the breaks.
#pragma once

#include <set>
#include <span>

#include "topology/base/ids.hpp"
#include "topology/suite/fixtures/fixture.hpp"
#include "topology/suite/judge/glue_twin.hpp"

namespace sunder::suite {

/// The faces that `breaks` split, in whatever order they come, each by its lower half-face: those
/// glued now of which some break has a point, with opposite sides of that break's crack across
/// (docs/explanation/cracks.md). Needs: one side for each tetrahedron.
std::set<HalfFaceId> crack_faces(const GlueTwin& now, std::span<const BreakPoint> breaks);

/// The body without the glue of these faces: its corner classes are the vertices after the breaks.
GlueTwin without_faces(GlueTwin twin, const std::set<HalfFaceId>& faces);

}  // namespace sunder::suite
