// SPDX-License-Identifier: MIT
// Obstacles of a finished run as tracks, like those of its pieces.
#pragma once

#include <vector>

#include "apps/sunder/export/piece_tracks.hpp"

namespace sunder {

/// Tracks "obstacle_0" and so on of all obstacles but planes, by their rows in the scene; balls as
/// 24 by 12 facets. Needs: the same obstacles in every frame. Centres are those of their masses.
std::vector<PieceTrack> obstacle_tracks(const std::vector<ResultFrame>& frames);

}  // namespace sunder
