// SPDX-License-Identifier: MIT
// From operations to single steps, with arithmetic of the suite's own: nothing of topology/fan.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "topology/suite/fixture.hpp"
#include "topology/suite/glue_twin.hpp"
#include "topology/suite/operation.hpp"
#include "topology/tet_mesh.hpp"

namespace sunder::suite {

HalfFaceId half_face_of(const GlueTwin& twin, FaceSide side);
FaceSide side_of(const GlueTwin& twin, HalfFaceId face);

/// The points of a face, rising.
std::array<std::uint32_t, 3> points_of(const GlueTwin& twin, FaceSide side);

/// The tetrahedra of the vertex orbit that has this corner, rising.
std::vector<std::uint32_t> orbit_of(const GlueTwin& now, CornerAt corner);

/// The corner that names a vertex: by a point, that of its lowest tetrahedron.
CornerAt corner_of(const GlueTwin& now, const VertexName& vertex);

/// The steps an operation comes to on the body as the twin has it now; `intact` is the body as it
/// was loaded. A named face is split, or glued, whatever its state is; fans, planes and shatters
/// leave out faces that are split already.
/// Signs of tetrahedra: fan.hpp's rule, computed anew in extended precision.
/// Needs: faces and corners of the body. O(|T|) for planes and shatters, else local.
std::vector<Step> steps_of(const Operation& operation, const GlueTwin& intact, const GlueTwin& now,
                           const TetMesh& body);

/// The operation that is this one step.
Operation operation_of(const Step& step);

/// "split 1 4 14 from tetrahedron 3", "glue 1 4 14".
std::string text_of(const GlueTwin& twin, const Step& step);

}  // namespace sunder::suite
