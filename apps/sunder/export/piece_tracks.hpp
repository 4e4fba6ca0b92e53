// SPDX-License-Identifier: MIT
// The pieces at the end of a run with the way that each came: their rigid references, frame by
// frame.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "apps/sunder/export/result_frames.hpp"

namespace sunder {

/// A piece at the end of a run: its surface where it was in the first frame, about the mean of its
/// vertices there, and its motion since. Before it came off, it moved with its parent piece.
struct PieceTrack {
  std::string name;  ///< "piece_7"
  std::int64_t component = 0;
  bool is_obstacle = false;  ///< then there is no component
  std::vector<Vec3> vertex;  ///< m
  /// Rows of `vertex`, counterclockwise from outside: the body's own surface, and that of cracks.
  std::vector<std::array<std::uint32_t, 3>> outer, crack;
  /// One a frame: of `vertex` to the world. Neighbouring rotations lie on one half of the sphere.
  std::vector<Vec3> centre;
  std::vector<Eigen::Quaterniond> orientation;
  double departure = 0;  ///< m, farthest a reference vertex lies from its track
};

/// Tracks of all pieces, by component. Faces between tetrahedra of one piece that cracks have
/// opened are part of its surface. O(frames x tetrahedra).
std::vector<PieceTrack> piece_tracks(const std::vector<ResultFrame>& frames);

}  // namespace sunder
