// SPDX-License-Identifier: MIT
// Whether two simulations are in the same state, byte by byte.
#pragma once

#include <cstring>
#include <string>
#include <vector>

#include "fracture/simulation/simulation_state.hpp"

namespace sunder::test {

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// The first column in which they differ; empty where none does.
inline std::string first_difference(const Simulation& one, const Simulation& other) {
  const SimulationState &a = *one.state, &b = *other.state;
  const VertexColumns &v = a.mechanics.vertices, &w = b.mechanics.vertices;
  if (a.step != b.step || a.mechanics.time != b.mechanics.time) return "time";
  if (a.fans != b.fans) return "fans";
  if (!same_bytes(v.position, w.position)) return "position";
  if (!same_bytes(v.velocity, w.velocity)) return "velocity";
  if (!same_bytes(v.displacement, w.displacement)) return "displacement";
  if (!same_bytes(v.displacement_rate, w.displacement_rate)) return "displacement_rate";
  if (!same_bytes(a.mechanics.elements.stress, b.mechanics.elements.stress)) return "stress";
  if (!same_bytes(a.mechanics.elements.component, b.mechanics.elements.component)) {
    return "component";
  }
  if (a.cells.strength.size() != b.cells.strength.size()) return "strength";
  return {};
}

}  // namespace sunder::test
