// SPDX-License-Identifier: MIT
// From a mesh as files hold it to a 3-map: checks everything, sews every shared face.
#pragma once

#include "topology/base/finding.hpp"
#include "topology/base/tet_mesh.hpp"
#include "topology/kernel/volume_map.hpp"

namespace sunder {

/// Builds the 3-map of a mesh. The result has every finding of `check_mesh`, and no map if one of
/// them is an error.
///
/// Tetrahedra keep their rows. An inverted one has its last two corners exchanged
/// (`VolumeMap::reoriented` lists them all). Vertex rows: the mesh's points in their order, without
/// unused points. At a pinched point the first row goes to the orbit with the lowest tetrahedron.
/// The other orbits get rows after all points, in the order of their lowest tetrahedra (then of
/// their points). `point_of_vertex` leads back to the mesh's points. `bad_volume`: severity of flat
/// and folded tetrahedra, see check.hpp. `kernel`: the data structure of the map. Cost: O(|T| log
/// |T|) time, at most 4 µs and 900 bytes per tetrahedron (850 from 48 000 on) with darts.
Result<VolumeMap> build_map(const TetMesh& mesh, Severity bad_volume = Severity::error,
                            MapKernel kernel = MapKernel::lcc);

}  // namespace sunder
