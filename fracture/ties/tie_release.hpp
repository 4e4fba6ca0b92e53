// SPDX-License-Identifier: MIT
// What one release of spent ties did.
#pragma once

#include <cstdint>
#include <vector>

#include "mechanics/ties/tie.hpp"
#include "topology/kernel/components.hpp"
#include "topology/kernel/split_face.hpp"

namespace sunder {

/// What one release of spent ties did, and when.
struct TieRelease {
  std::vector<Tie> ties;         ///< as they were, one a face
  std::vector<FaceSplit> faces;  ///< in the map of pieces
  ComponentUpdate components;
  double time = 0;         ///< s, the end of the sub-step in which they were spent
  std::uint32_t part = 0;  ///< before which search for fractures of its step, from 0
};

}  // namespace sunder
