// SPDX-License-Identifier: MIT
// Wave speeds over the sizes of cells and components.
#include "mechanics/state/wave_travel.hpp"

#include <cmath>

namespace sunder {
namespace {

double wave_speed(const MechanicsState& state, TetId t) {
  return compression_wave_speed(state.materials[state.elements.material[t.index()].index()]);
}

}  // namespace

double cell_travel(const MechanicsState& state, const Component& component) {
  double sum = 0;
  for (const TetId t : component.tetrahedra) {
    sum += std::cbrt(6 * state.elements.rest_volume[t.index()]) / wave_speed(state, t);
  }
  return sum / static_cast<double>(component.tetrahedra.size());
}

double extent_travel(const MechanicsState& state, const Component& component) {
  return 2 * component.rest_radius / wave_speed(state, component.tetrahedra.front());
}

}  // namespace sunder
