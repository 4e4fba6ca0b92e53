// SPDX-License-Identifier: MIT
// Algorithm 3.
#include "fracture/algorithms/find_fractures.hpp"

#include "fracture/algorithms/node_stress.hpp"
#include "fracture/algorithms/threshold_test.hpp"

namespace sunder {

ElementStress element_stress(const Cells& cells, const MechanicsState& mechanics, NodeStress mode) {
  const ElementColumns& e = mechanics.elements;
  return {cells.map.corners(), e.stress, mode == NodeStress::mass ? e.mass : e.rest_volume};
}

void measure_node_stress(NodeStressField& field, const VolumeMap& map,
                         const ElementStress& elements, NodeStress mode) {
  if (mode == NodeStress::fit) return fit_node_stress(field.value, field.fit, map, elements);
  average_node_stress(field.value, elements, map.vertices(), field.weight);
}

std::vector<Mat3> node_stress_of(const Cells& cells, const MechanicsState& mechanics,
                                 NodeStress mode) {
  NodeStressField field;
  measure_node_stress(field, cells.map, element_stress(cells, mechanics, mode), mode);
  return std::move(field.value);
}

// Algorithm 3: findFractures().
void find_fractures(FractureReport& report, NodeStressField& field, const Cells& cells,
                    const ElementStress& elements, const FractureSettings& settings,
                    const FractureSearch& search) {
  // Compute each tetrahedron stress tensor [eq. 5, done: `elements`] and report it to its vertices;
  // average each vertex stress tensor (eq. 6).
  measure_node_stress(field, cells.map, elements, settings.node_stress);
  // Check where a fracture occurs.
  const std::size_t vertices = cells.map.vertices();
  for (std::size_t row = 0; row < vertices; ++row) {
    const VertexId v{row};
    const std::optional<double> xi = search.threshold(v);
    if (!xi) continue;
    ++report.tested;
    // gerschgorinTest(v.sigma, xi) (eq. 7), and whether the largest eigenvalue reaches xi.
    const ThresholdAnswer answer =
        test_threshold(field.value[row], *xi, settings.test, report.suspects);
    if (answer == ThresholdAnswer::below) continue;
    if (answer == ThresholdAnswer::not_a_number) {
      report.not_a_number = v;
      return;
    }
    ++report.reached;
    // split(v, eigenvec(max(eigenval))).
    search.split(v, principal_tension(field.value[row]));
  }
}

}  // namespace sunder
