// SPDX-License-Identifier: MIT
// Stress tensors of vertices: weighted means over the tetrahedra around them. No decision here.
#pragma once

#include <span>
#include <vector>

#include "mechanics/state/mechanics_state.hpp"

namespace sunder {

/// The input of an averaged node stress, one row per tetrahedron.
struct ElementStress {
  std::span<const Corners> corners;
  /// Pa, symmetric, in the rest frame of the tetrahedron's component.
  std::span<const Mat3> stress;
  /// Rest volume, m^3 (our default), or mass, kg (eq. 6 as printed); positive.
  std::span<const double> weight;
  /// At the corners of tetrahedra of second order, or empty (`ElementColumns::corner_stress`).
  std::span<const std::array<Mat3, 4>> corner_stress = {};

  /// At the corner of tetrahedron `t` at a place, Pa.
  const Mat3& at(std::size_t t, std::size_t place) const {
    return corner_stress.empty() ? stress[t] : corner_stress[t][place];
  }
};

/// Node stress of every vertex: sum w_e sigma_e / sum w_e over the tetrahedra around it (eq. 6,
/// after Koschier et al. 2014). The weights are summed for each vertex over its own star: the
/// paper's `4 m` holds only where every mass was just refreshed (docs/explanation/paper.md).
/// Writes |V| symmetric tensors, Pa, into `node_stress` (resized to `vertices`); zero for a row
/// that no tetrahedron uses. O(|T|), one pass, in the order of the rows.
void average_node_stress(std::vector<Mat3>& node_stress, const ElementStress& elements,
                         std::size_t vertices);

/// The same with room for the sums of weights, which is kept from call to call.
void average_node_stress(std::vector<Mat3>& node_stress, const ElementStress& elements,
                         std::size_t vertices, std::vector<double>& weight);

/// Adds the stress at the middles of edges of second order to `node_stress`, which has rows for
/// them. It is the mean, over the tetrahedra round the edge, of the stress half-way between its
/// ends. For display.
void add_edge_stress(std::vector<Mat3>& node_stress, const ElementStress& elements,
                     std::span<const EdgeNodes> edge_nodes);

/// The same for one vertex, from the corners of its star in the order of rows. Not empty.
Mat3 node_stress_of_star(const ElementStress& elements, std::span<const CornerId> star);

}  // namespace sunder
