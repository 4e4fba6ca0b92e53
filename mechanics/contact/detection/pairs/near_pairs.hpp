// SPDX-License-Identifier: MIT
// Pairs of bodies' features that persist from step to step: searched with a margin, and left alone
// as long as neither body can have come near.
#pragma once

#include <cstdint>
#include <vector>

#include "mechanics/contact/shapes/box_pairs.hpp"
#include "mechanics/contact/shapes/manifold.hpp"
#include "mechanics/contact/shapes/piece_surface.hpp"

namespace sunder {

struct StepPaths;
struct SolidPairs;
struct DetectScratch;

/// How far the vertices of components have gone against the affine field that fits all of them, and
/// how far that field may bring them together: two features of two components that are `reach` or
/// less apart come nearer by the sum of both at most.
struct Travel {
  double reach = 0;             ///< m
  std::vector<Vec3> position;   ///< |V|, m: as the last step began
  std::vector<double> so_far;   ///< row = component: m, the farthest way in each step, summed
  std::vector<double> in_step;  ///< likewise, of the step at hand
  double farthest = 0;          ///< m, the largest of `in_step`
  /// Row = component: how many of its crack faces have come apart from others.
  std::vector<std::uint32_t> parted;

  double start_of(std::uint32_t a, std::uint32_t b) const { return so_far[a] + so_far[b]; }
  double end_of(std::uint32_t a, std::uint32_t b) const {
    return start_of(a, b) + in_step[a] + in_step[b];
  }
};

/// Adds the ways since the last call, and sets those of the step at hand. O(|V|). Needs: `reach`.
void update_travel(Travel& travel, const StepPaths& paths);

/// Two features that may meet, the lower number first.
struct NearPair {
  std::uint32_t a = 0, b = 0;
  std::uint32_t body_a = 0, body_b = 0;
  /// m: while the ways of both bodies add up to less the two cannot be near (`Travel::end_of`).
  double quiet = 0;
  /// Of crack faces that face each other: `Travel::parted` of both when that was seen, else 0.
  std::uint32_t facing = 0;
  PairAxis axis;  ///< the one that decided the pair last
};

/// Whether a pair is to be looked at in the step; else it cannot come near, or is of crack faces
/// that face each other.
bool is_due(const NearPair& pair, const Travel& travel);

/// Pairs, and the state of each component at its last search. May be thrown away at any time.
struct NearPairs {
  std::vector<NearPair> found;  ///< their order depends on earlier searches
  std::vector<double> limit;    ///< row = component: m, `so_far` from which it is searched again
  std::vector<std::uint64_t> shape;  ///< row = component: its surface then
  std::vector<char> is_stale;        ///< row = component: in the search at hand
  std::size_t searches = 0;          ///< in all, for tests
};

/// The input of `find_stale`.
struct NearQuery {
  const Travel& travel;
  const std::vector<std::uint64_t>& shape;  ///< row = component: changes with its surface
  double margin = 0;                        ///< m
};

/// Components with pairs that no longer hold, into `is_stale`: their surface has changed, or they
/// may go beyond the margin in the step. False: none. Pairs of such components are left out.
bool find_stale(NearPairs& pairs, const NearQuery& query);

/// How much wider the boxes of a component are to be, m. Needs: `find_stale`.
double width_of(const NearQuery& query, std::uint32_t component);

/// Pairs of boxes of stale components with all others, in any order. O(boxes + pairs). Needs:
/// `find_stale`; boxes at the start of the step, wider by `width_of`.
void find_stale_pairs(std::vector<RowPair>& found, NearPairs& pairs, SolidPairs& boxes);

/// Adds pairs of boxes: `number` is that of each box's feature, `body` its component.
void add_pairs(NearPairs& pairs, std::span<const RowPair> found,
               std::span<const std::uint32_t> body, std::span<const std::uint32_t> number);

/// Contacts of one pair: rows of `DetectScratch::found`.
struct PairContacts {
  std::uint32_t a = 0, b = 0;  ///< the pair's numbers
  std::size_t first = 0, end = 0;
};

/// Notes the contacts that a pair has just added behind row `first`, if any.
void note_contacts(std::vector<PairContacts>& noted, const NearPair& pair,
                   const DetectScratch& scratch, std::size_t first);

/// Sorts the contacts noted, which are the last ones found, by the numbers of their pairs: their
/// order must not depend on earlier searches.
void sort_contacts(DetectScratch& scratch, std::vector<PairContacts>& noted);

/// Row = component: a number that changes whenever its surface does.
void measure_shapes(std::vector<std::uint64_t>& shape, const PieceSurface& surface,
                    const ElementColumns& elements, std::size_t components);

}  // namespace sunder
