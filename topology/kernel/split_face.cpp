// SPDX-License-Identifier: MIT
// split_face and glue_face for the map that everyone uses.
#include "topology/kernel/split_face_impl.hpp"
#include "topology/kernel/volume_map.hpp"

namespace sunder {

template FaceSplit split_face<VolumeMap>(VolumeMap&, HalfFaceId);
template FaceGlue glue_face<VolumeMap>(VolumeMap&, HalfFaceId, HalfFaceId);

}  // namespace sunder
