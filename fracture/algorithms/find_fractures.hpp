// SPDX-License-Identifier: MIT
// Algorithm 3: which vertices break.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "fracture/algorithms/cells.hpp"
#include "fracture/algorithms/fracture_plane.hpp"
#include "fracture/algorithms/fracture_report.hpp"
#include "fracture/algorithms/fracture_settings.hpp"
#include "fracture/algorithms/stress_fit.hpp"

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

/// The same anew, in numbers alone, for reports.
std::vector<Mat3> node_stress_of(const Cells& cells, const MechanicsState& mechanics,
                                 NodeStress mode);

/// Where a search for fractures looks, and what it does with what it finds.
struct FractureSearch {
  /// The threshold xi of a vertex, Pa; nothing for a vertex that is not looked at. Asked once a
  /// vertex, in rising order, when all node stresses are known.
  std::function<std::optional<double>(VertexId)> threshold;
  /// Algorithm 4 for a vertex that reaches its threshold, with its largest eigenvalue and the
  /// eigenvectors: at once, as in the paper (`split_fan`), or when its turn comes
  /// (`break_vertices`).
  std::function<void(VertexId, const PrincipalTension&)> split;
};

/// Algorithm 3, findFractures(): the stress of each vertex from those of the tetrahedra around it
/// (eq. 6), and a split of every vertex whose largest principal stress reaches its threshold.
/// `elements`: eq. 5, which `measure_elements` (mechanics/measure_elements.hpp) has evaluated with
/// the displacements, Pa. `field`: the result of eq. 6. Counts into `report`; stops at a stress
/// that is not a number, `report.not_a_number`, before anything more is split.
void find_fractures(FractureReport& report, NodeStressField& field, const Cells& cells,
                    const ElementStress& elements, const FractureSettings& settings,
                    const FractureSearch& search);

}  // namespace sunder
