// SPDX-License-Identifier: MIT
// Node stresses of a state, eq. 6 or the fit.
#include "fracture/algorithms/find_fractures.hpp"

#include "fracture/algorithms/node_stress.hpp"

namespace sunder {

ElementStress element_stress(const Cells& cells, const MechanicsState& mechanics, NodeStress mode) {
  const ElementColumns& e = mechanics.elements;
  return {cells.map.corners(), e.stress, mode == NodeStress::mass ? e.mass : e.rest_volume,
          e.corner_stress};
}

void measure_node_stress(NodeStressField& field, const VolumeMap& map,
                         const ElementStress& elements, NodeStress mode) {
  if (mode == NodeStress::fit) return fit_node_stress(field.value, field.fit, map, elements);
  average_node_stress(field.value, elements, map.vertices(), field.weight);
}

std::vector<Mat3> node_stress_of(const Cells& cells, const MechanicsState& mechanics,
                                 NodeStress mode) {
  NodeStressField field;
  const ElementStress elements = element_stress(cells, mechanics, mode);
  measure_node_stress(field, cells.map, elements, mode);
  add_edge_stress(field.value, elements, mechanics.elements.edge_nodes);
  return std::move(field.value);
}

}  // namespace sunder
