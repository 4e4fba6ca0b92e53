// SPDX-License-Identifier: MIT
// The connected component of every tetrahedron and vertex, kept up to date while faces split.
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
  /// none() for a retired row.
  std::vector<ComponentId> of_vertex;
  /// Number of tetrahedra of each component, by id. The length of the list is the next id.
  std::vector<std::size_t> size;
  /// The component that each component came off, by id; none() for those of the first labelling.
  std::vector<ComponentId> parent;
};

/// Methods of finding separations. All four give the same labels at different costs.
enum class Detection {
  /// Walk the whole component after every change (the paper's baseline).
  walk,
  /// Count the vertices of the component that split since its last labelling, and walk the whole
  /// component at three or more. A face that separates a component splits three vertices at once,
  /// so no separation is missed. Three vertices that split at different faces count too.
  dirty_counter,
  /// Walk the component only if the oracle predicts a separation (the paper's algorithm 4).
  oracle,
  /// Search in lockstep from the faces that the oracle marks. The cost is that of the smaller
  /// sides. Default.
  exact
};

/// True if a method searches for new components only after a prediction of the oracle.
constexpr bool asks_oracle(Detection detection) {
  return detection == Detection::oracle || detection == Detection::exact;
}

/// Result of one `update_components`.
struct ComponentUpdate {
  /// Faces with all three vertices split: the oracle predicts a component for each.
  std::size_t predicted = 0;
  /// New ids are first_new, first_new + 1, ...: `created` of them.
  ComponentId first_new;
  std::size_t created = 0;
  /// Tetrahedra that the search visited: a measure of its cost.
  std::size_t visited = 0;
};

/// Working memory of `update_components` and of its search (part_search.hpp): 12 bytes per
/// tetrahedron. It is kept between calls, so only the first call allocates.
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

/// Labels all cells by a full walk; ids in the order of the components' lowest tetrahedra. O(|T|).
template <Kernel K>
Components label_components(const K& map);

/// Brings `labels` up to date after `splits` (one face, one fan, or all fans of a step, in order).
///
/// exact: for every old component that a suspect face touches, parts grow breadth-first, one
/// tetrahedron each in turn, from both sides of all its suspect faces. Parts that meet become one.
/// The search ends when at most one part still grows, so a separation costs only its smaller side.
/// The largest part keeps the id, among equal parts the one with the lowest tetrahedron. The others
/// get new ids in the order of their lowest tetrahedra (old components in the order of their ids).
/// Requires: `labels` correct before the first of `splits`, no other split since, and no gluing
/// (gluing can join components: label again after it). Vertex labels are updated too, including
/// appended rows.
template <Kernel K>
ComponentUpdate update_components(const K& map, std::span<const FaceSplit> splits,
                                  Detection detection, Components& labels,
                                  ComponentScratch& scratch);

}  // namespace sunder
