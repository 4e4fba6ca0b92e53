// SPDX-License-Identifier: MIT
// Consequences of fans: masses, frames and display of the pieces.
#pragma once

#include <span>
#include <vector>

#include "fracture/simulation/state.hpp"
#include "mechanics/rebuild.hpp"

namespace sunder {

/// The component that `id` was part of when there were `count` of them.
ComponentId ancestor(const Components& labels, ComponentId id, std::size_t count);

/// Brings mechanics, display, impact windows and open cracks or ties up to date with fans that were
/// just split. O(|T|).
RebuildReport rebuild_pieces(SimulationState& state, std::span<const FanEvent> fans,
                             MechanicsScratch& scratch);

/// The same for pieces that came off as ties were released (`release_ties`).
RebuildReport rebuild_released(SimulationState& state, MechanicsScratch& scratch);

/// Appends the rows of components that came since `rows` was made: those of their ancestors. Empty
/// `rows` stand for all and stay so.
template <class T>
void inherit(std::vector<T>& rows, const Components& labels) {
  if (rows.empty()) return;
  const std::size_t before = rows.size();
  for (std::size_t id = before; id < labels.size.size(); ++id) {
    const T inherited = rows[ancestor(labels, ComponentId{id}, before).index()];
    rows.push_back(inherited);
  }
}

}  // namespace sunder
