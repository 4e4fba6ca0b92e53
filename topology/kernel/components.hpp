// SPDX-License-Identifier: MIT
// Which connected component every tetrahedron and vertex belongs to, kept right while faces split.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "topology/base/ids.hpp"
#include "topology/kernel/kernel.hpp"
#include "topology/kernel/split_face.hpp"

namespace sunder {

/// Labels of the components of a map. Ids grow and are never reused.
struct Components {
  std::vector<ComponentId> of_tetrahedron;
  /// None for a retired row.
  std::vector<ComponentId> of_vertex;
  /// Tetrahedra in each component, by id; its length is the next id.
  std::vector<std::size_t> size;
  /// The component each one came off, by id; none for those of the first labelling.
  std::vector<ComponentId> parent;
};

/// How separations are found. All four give the same labels; they differ in their cost.
enum class Detection {
  /// Walk the whole component after every change (the paper's baseline).
  walk,
  /// Count the vertices of the component that came apart since its labels were last right; walk it
  /// whole when there are three or more, for the face that parts a component parts three at once.
  /// Never misses, as the oracle; but three vertices that came apart at different faces of a fan
  /// count as well.
  dirty_counter,
  /// Walk it only when the oracle says so (the paper's algorithm 4).
  oracle,
  /// Search in lockstep from the faces the oracle points at: cost of the smaller sides. Default.
  exact
};

/// Whether a way of detection looks for new components only when the oracle predicts some.
constexpr bool asks_oracle(Detection detection) {
  return detection == Detection::oracle || detection == Detection::exact;
}

/// What one `update_components` found.
struct ComponentUpdate {
  /// Faces whose three vertices split: what the oracle predicts from.
  std::size_t predicted = 0;
  /// New ids are first_new, first_new + 1, ...: `created` of them.
  ComponentId first_new;
  std::size_t created = 0;
  /// Tetrahedra the search looked at (a measure of its cost).
  std::size_t visited = 0;
};

/// Working memory of `update_components` and of the search below it (part_search.hpp): 12 bytes a
/// tetrahedron. Kept between calls so that nothing is allocated after the first.
struct ComponentScratch {
  std::vector<std::uint32_t> stamp, owner, next;
  std::uint32_t now = 0;
  struct Part {
    std::uint32_t parent = 0;  // union-find among the parts
    std::uint32_t todo_head = 0, todo_tail = 0, done_head = 0, done_tail = 0;
    std::size_t found = 0;  // tetrahedra in both lists
    TetId lowest;
  };
  std::vector<Part> parts;
  std::vector<std::uint32_t> live, closed;
  struct Source {
    ComponentId component;
    TetId tetrahedron;
    int parted = 0;  // vertices that came apart at the face; on one of its two sides only
  };
  std::vector<Source> sources;
};

/// Labels everything by a full walk; ids in the order of the components' lowest tetrahedra. O(|T|).
template <Kernel K>
Components label_components(const K& map);

/// Brings `labels` up to date after `splits` (one face, one fan, or all fans of a step, in order).
///
/// exact: for every old component that a suspect face touches, parts grow breadth-first, one
/// tetrahedron each in turn, from both sides of all its suspect faces; parts that meet become one;
/// the search ends when at most one part still grows [a separation costs its smaller side only].
/// The largest part keeps the id, on a tie the one with the lowest tetrahedron; the others get
/// fresh ids in the order of their lowest tetrahedra (old components in the order of their ids).
/// Needs: `labels` right before the first of `splits`, nothing else split since, nothing glued
/// (gluing can join components: label anew after it). Leaves vertex labels right too, for appended
/// rows as well.
template <Kernel K>
ComponentUpdate update_components(const K& map, std::span<const FaceSplit> splits,
                                  Detection detection, Components& labels,
                                  ComponentScratch& scratch);

}  // namespace sunder
