// SPDX-License-Identifier: MIT
// Eq. 6, for all vertices at once and for one.
#include "fracture/algorithms/node_stress.hpp"

#include "mechanics/element/second_order.hpp"
#include "topology/base/assert.hpp"

namespace sunder {

void average_node_stress(std::vector<Mat3>& node_stress, const ElementStress& elements,
                         std::size_t vertices, std::vector<double>& weight) {
  node_stress.assign(vertices, Mat3::Zero());
  weight.assign(vertices, 0.0);
  for (std::size_t t = 0; t < elements.corners.size(); ++t) {
    const double w = elements.weight[t];
    const Mat3 weighted = w * elements.stress[t];
    for (const VertexId v : elements.corners[t]) {
      node_stress[v.index()] += weighted;
      weight[v.index()] += w;
    }
  }
  for (std::size_t v = 0; v < vertices; ++v) {
    if (weight[v] > 0) node_stress[v] /= weight[v];
  }
}

void average_node_stress(std::vector<Mat3>& node_stress, const ElementStress& elements,
                         std::size_t vertices) {
  std::vector<double> weight;
  average_node_stress(node_stress, elements, vertices, weight);
}

void average_corner_stress(std::vector<Mat3>& node_stress, const MechanicsState& state,
                           std::span<const Corners> corners, std::span<const double> weight) {
  node_stress.assign(state.vertices.size(), Mat3::Zero());
  std::vector<double> sum(state.vertices.size(), 0.0);
  for (std::size_t t = 0; t < corners.size(); ++t) {
    const std::array<Mat3, 4> at = corner_stress(state, corners, TetId{t});
    const ElementNodes nodes = nodes_of(state.elements, corners, TetId{t});
    for (std::size_t k = 0; k < nodes.count; ++k) {
      const std::size_t v = nodes.row[k].index();
      sum[v] += weight[t];
      if (k < 4) {
        node_stress[v] += weight[t] * at[k];
      } else {
        const auto [i, j] = edge_ends[k - 4];
        node_stress[v] += 0.5 * weight[t] *
                          (at[static_cast<std::size_t>(i)] + at[static_cast<std::size_t>(j)]);
      }
    }
  }
  for (std::size_t v = 0; v < sum.size(); ++v) {
    if (sum[v] > 0) node_stress[v] /= sum[v];
  }
}

Mat3 node_stress_of_star(const ElementStress& elements, std::span<const TetId> star) {
  SUNDER_ASSERT(!star.empty(), "a vertex without tetrahedra has no stress");
  Mat3 sum = Mat3::Zero();
  double total = 0;
  for (const TetId t : star) {
    sum += elements.weight[t.index()] * elements.stress[t.index()];
    total += elements.weight[t.index()];
  }
  return sum / total;
}

}  // namespace sunder
