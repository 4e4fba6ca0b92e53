// SPDX-License-Identifier: MIT
// Judges contact by places alone: overlaps in one frame, and passes between two frames. Only the
// types of shapes come from the engine.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mechanics/contact/shapes/obstacle.hpp"
#include "tests/experiments/contact/overlap.hpp"

namespace sunder::test {

/// The part of a frame that viewers read.
struct ContactFrame {
  std::vector<Vec3> points;                              ///< m
  std::vector<std::array<std::uint32_t, 4>> tetrahedra;  ///< rows of points, the same in all frames
  std::vector<std::uint32_t> piece;                      ///< row = tetrahedron
  std::vector<Obstacle> obstacles;                       ///< at their places in the frame
};

/// m, mean over the edges of all tetrahedra.
double mean_edge(const ContactFrame& frame);

/// The two that overlap most.
struct DeepestPair {
  static constexpr std::uint32_t none = 0xffffffffu;
  double depth = 0;        ///< m
  std::uint32_t a = none;  ///< row of a tetrahedron
  std::uint32_t b = none;  ///< row of another, or
  std::uint32_t obstacle = none;
  double time = 0;  ///< between the frames, 0 to 1
};

/// Overlaps of one frame.
struct FrameOverlaps {
  std::size_t pairs = 0;  ///< of tetrahedra that overlap by more than a millionth of an edge
  double mean = 0;        ///< m, over these
  DeepestPair pieces, obstacles;  ///< the deepest of each kind
};
FrameOverlaps judge_overlaps(const ContactFrame& frame, double edge);

/// Two tetrahedra, or a tetrahedron and an obstacle. They are apart in the first of two frames, and
/// overlap between them or in the second.
struct Crossing {
  DeepestPair deepest;
  bool passed = false;  ///< apart again in the later frame
};

/// Crossings deeper than `tolerance` (m): the deepest of each two pieces, and of each piece and
/// obstacle. Corners, centres and rotations go evenly from frame to frame. Time is halved until the
/// motion left cannot reach the tolerance, so no crossing deeper than twice the tolerance is
/// missed, at any speed. Pairs that overlap in the first frame do not count, nor do pairs that are
/// one piece in the second.
std::vector<Crossing> judge_crossings(const ContactFrame& first, const ContactFrame& second,
                                      double tolerance);

}  // namespace sunder::test
