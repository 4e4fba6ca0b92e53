// SPDX-License-Identifier: MIT
// Times of travel, from the mean size of cells and from the radius.
#include "mechanics/state/wave_travel.hpp"

#include "topology/base/elementary.hpp"

namespace sunder {

double mean_cell_travel(const MechanicsState& state, const Component& component) {
  double sum = 0;
  for (TetId t : component.tetrahedra) {
    sum += cube_root(6 * state.elements.rest_volume[t.index()]) /
           compression_wave_speed(material_of(state, t));
  }
  return sum / static_cast<double>(component.tetrahedra.size());
}

double mean_cell(const MechanicsState& state, const Component& component) {
  return component.cell_travel *
         compression_wave_speed(material_of(state, component.tetrahedra.front()));
}

double extent_travel(const MechanicsState& state, const Component& component) {
  return 2 * component.rest_radius /
         compression_wave_speed(material_of(state, component.tetrahedra.front()));
}

}  // namespace sunder
