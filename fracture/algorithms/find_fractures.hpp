// SPDX-License-Identifier: MIT
// Algorithm 3: which vertices break.
#pragma once

#include <concepts>
#include <optional>
#include <vector>

#include "fracture/algorithms/cells.hpp"
#include "fracture/algorithms/fracture_plane.hpp"
#include "fracture/algorithms/fracture_report.hpp"
#include "fracture/algorithms/fracture_settings.hpp"
#include "fracture/algorithms/stress_fit.hpp"
#include "fracture/algorithms/threshold_test.hpp"

namespace sunder {

/// Node stresses and the room they are made in.
struct NodeStressField {
  std::vector<Mat3> value;     ///< |V|, Pa, symmetric, rest frame of each component
  std::vector<double> weight;  ///< |V|, of `average_node_stress`
  StressFit fit;               ///< of the node stress `fit`
};

/// Element stresses of a state with the weights of a node stress: rest volume, or mass (eq. 6 as
/// printed). Spans of both arguments.
ElementStress element_stress(const Cells& cells, const MechanicsState& mechanics, NodeStress mode);

/// Node stress of every vertex: eq. 6, or the fit in its place.
void measure_node_stress(NodeStressField& field, const VolumeMap& map,
                         const ElementStress& elements, NodeStress mode);

/// The node stresses, measured again, in numbers alone, for reports.
std::vector<Mat3> node_stress_of(const Cells& cells, const MechanicsState& mechanics,
                                 NodeStress mode);

/// Where a search for fractures looks, and what it does with the vertices found. `threshold(v)`:
/// the threshold xi of a vertex, Pa; nothing for a vertex outside the search. Called once per
/// vertex, in rising order, when all node stresses are known. `split(v, tension)`: algorithm 4 for
/// a vertex that reaches its threshold, with its largest eigenvalue and the eigenvectors. It splits
/// at once, as in the paper (`split_fan`), or when its turn comes (`break_vertices`).
template <class Search>
concept FractureSearch = requires(Search& search, VertexId v, const PrincipalTension& tension) {
  { search.threshold(v) } -> std::same_as<std::optional<double>>;
  search.split(v, tension);
};

/// Algorithm 3, findFractures(): the stress of each vertex from those of the tetrahedra around it
/// (eq. 6), and a split of every vertex with a largest principal stress that reaches its threshold.
/// `elements`: eq. 5, which `measure_elements` (mechanics/measure_elements.hpp) has evaluated with
/// the displacements, Pa. `field`: the result of eq. 6. Counts into `report`; stops at a stress
/// that is not a number, `report.not_a_number`, before anything more is split.
template <FractureSearch Search>
void find_fractures(FractureReport& report, NodeStressField& field, const Cells& cells,
                    const ElementStress& elements, const FractureSettings& settings,
                    Search search) {
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
