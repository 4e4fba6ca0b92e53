// SPDX-License-Identifier: MIT
// A frame judged from places alone: overlaps of pieces, the shape of a heap.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mechanics/contact/shapes/polytope.hpp"

namespace sunder::test {

/// A convex part of a piece, in the world.
struct SeenPart {
  Polytope solid;
  std::uint32_t piece = 0;
};

/// Overlaps of parts of different pieces.
struct SeenOverlaps {
  double deepest = 0, mean = 0;          ///< m; the mean over all pairs that overlap
  std::size_t pairs = 0;                 ///< that overlap
  double edge = 0;                       ///< m, mean over all edges of all parts
  std::array<std::uint32_t, 2> where{};  ///< rows of the parts that overlap most, the lower first
};

/// Overlap of two parts is the least way that parts them, by all axes of faces and pairs of edges
/// (`separation_by_all_axes`); below a millionth of the mean edge it is none, as faces that were
/// one meet to rounding. Parts sorted along x and swept, which shares nothing with the search of
/// the solver. O(parts^(5/3)) for heaps.
SeenOverlaps see_overlaps(std::span<const SeenPart> parts);

/// The same by comparing each part with each: the slow twin for tests.
SeenOverlaps see_overlaps_slowly(std::span<const SeenPart> parts);

/// A mass at a place.
struct SeenMass {
  Vec3 place = Vec3::Zero();  ///< m
  double mass = 0;            ///< kg
};

/// The shape of a heap on the ground z = 0.
struct HeapShape {
  double height = 0;  ///< m, below which nine tenths of the mass lie
  double radius =
      0;  ///< m, within which nine tenths lie, about the upright axis of the mass centre
  double centre = 0;  ///< m, height of the mass centre
};
HeapShape see_heap(std::span<const SeenMass> masses);

}  // namespace sunder::test
