// SPDX-License-Identifier: MIT
// Bodies and obstacles that lie inside others as a scene starts.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "fracture/scene/body_measures.hpp"
#include "fracture/scene/scene.hpp"

namespace sunder {

/// A body that begins inside an obstacle or another body.
struct Overlap {
  std::size_t body = 0;
  /// Row of the obstacle, or of the other body.
  std::size_t other = 0;
  bool with_obstacle = false;
  /// m, how deep the deepest point seen lies.
  double depth = 0;
  /// Of two bodies: the middle of each lies in the box round the other.
  bool is_whole = false;
};

/// Of a body that lies whole in more others than these no further ones are looked for: contact of
/// so many at one place has no end (`scene_doubts` refuses it).
inline constexpr std::size_t most_whole_overlaps = 8;

/// Overlaps deeper than `allowed` (m). Looked at are vertices of bodies in obstacles, nearest
/// points of balls, corners of boxes in bodies, and vertices and centres of tetrahedra of one body
/// in those of another; edges that cross without any of these pass. `measures`: of each body. O(n)
/// in the tetrahedra, with a grid where the boxes round two bodies meet.
std::vector<Overlap> overlaps_at_start(const Scene& scene, std::span<const BodyMeasures> measures,
                                       double allowed);

}  // namespace sunder
