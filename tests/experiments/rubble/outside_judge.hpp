// SPDX-License-Identifier: MIT
// What somebody sees of a frame who knows places alone: overlaps of pieces, the shape of a heap.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mechanics/rubble/polytope.hpp"

namespace sunder::test {

/// A convex part of a piece, in the world.
struct SeenPart {
  Polytope solid;
  std::uint32_t piece = 0;
};

/// Overlaps of parts of different pieces.
struct SeenOverlaps {
  double deepest = 0, mean = 0;  ///< m; the mean over all pairs that overlap
  std::size_t pairs = 0;         ///< that overlap
  double edge = 0;               ///< m, mean over all edges of all parts
  std::uint32_t piece_a = 0, piece_b = 0;  ///< of the deepest
};

/// By `separation_by_all_axes` of every pair whose bounds meet: parts sorted along x and swept, which
/// shares nothing with the search of the solver. O(parts^(5/3)) for heaps.
SeenOverlaps see_overlaps(std::span<const SeenPart> parts);

/// A mass at a place.
struct SeenMass {
  Vec3 place = Vec3::Zero();  ///< m
  double mass = 0;            ///< kg
};

/// The shape of a heap on the ground z = 0.
struct HeapShape {
  double height = 0;  ///< m, below which nine tenths of the mass lie
  double radius = 0;  ///< m, within which nine tenths lie, about the upright axis of the mass centre
  double centre = 0;  ///< m, height of the mass centre
};
HeapShape see_heap(std::span<const SeenMass> masses);

}  // namespace sunder::test
