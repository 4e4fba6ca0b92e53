// SPDX-License-Identifier: MIT
// CGAL's own way to split faces, timed, as a comparison for the kernel's own way.
#pragma once

#include <span>

#include "topology/base/ids.hpp"
#include "topology/kernel/volume_map.hpp"

namespace sunder::suite {

/// Splits `faces` of a copy of the map's darts by CGAL's `unsew<3>` with managed attributes (the
/// same 0- and 3-attributes that the map has, no functors). Gives the microseconds a face of this
/// thread's time; making the copy is not in them.
/// Needs: `faces` interior, each face once, not empty.
double managed_unsew_us(const VolumeMap& map, std::span<const HalfFaceId> faces);

}  // namespace sunder::suite
