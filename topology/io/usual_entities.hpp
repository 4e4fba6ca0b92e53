// SPDX-License-Identifier: MIT
// Internal to the readers: entities that say nothing.
#pragma once

#include <algorithm>

#include "topology/mesh/file_mesh.hpp"

namespace sunder::io {

/// Clears entities that are all 0, the same as the regions, or all 1 without regions: writers put
/// them where a mesh has none.
inline void drop_usual_entities(CellColumns& cells) {
  const auto all = [&](std::int32_t entity) {
    return std::ranges::all_of(cells.entity, [&](auto e) { return e == entity; });
  };
  if (all(0) || cells.entity == cells.region || (cells.region.empty() && all(1))) {
    cells.entity.clear();
  }
}

}  // namespace sunder::io
