// SPDX-License-Identifier: MIT
// glTF 2.0 in one file of bytes: a node a piece with its track.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "apps/sunder/export/piece_tracks.hpp"

namespace sunder {

/// The bytes of a GLB file. Each track is a node of its name; materials are outside, crack and
/// obstacle, pieces have mass, kg, and birth_step as extras; an animation moves all of them, keys
/// at `times` (s, from 0 on), between which viewers turn and move evenly. glTF is y up: a node
/// above all turns z up to it. Numbers are floats, as glTF has them. Needs: as many keys in each
/// track as times.
std::string glb_bytes(const std::vector<PieceTrack>& tracks, const std::vector<double>& times,
                      const std::map<std::int64_t, ResultPiece>& pieces);

}  // namespace sunder
