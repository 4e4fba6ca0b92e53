// SPDX-License-Identifier: MIT
// Effect of one release of spent ties.
#pragma once

#include <cstdint>
#include <vector>

#include "mechanics/ties/tie.hpp"
#include "topology/kernel/components.hpp"
#include "topology/kernel/split_face.hpp"

namespace sunder {

/// Effect and time of one release of spent ties.
struct TieRelease {
  std::vector<Tie> ties;         ///< before the release, one per face
  std::vector<FaceSplit> faces;  ///< splits in the map of pieces
  ComponentUpdate components;
  double time = 0;         ///< s, end of the sub-step that spent them
  std::uint32_t part = 0;  ///< search for fractures of the step that follows, from 0
};

}  // namespace sunder
