// SPDX-License-Identifier: MIT
// Eq. 6, for all vertices at once and for one.
#include "fracture/algorithms/node_stress.hpp"

#include "topology/base/assert.hpp"

namespace sunder {

void average_node_stress(std::vector<Mat3>& node_stress, const ElementStress& elements,
                         std::size_t vertices, std::vector<double>& weight) {
  node_stress.assign(vertices, Mat3::Zero());
  weight.assign(vertices, 0.0);
  for (std::size_t t = 0; t < elements.corners.size(); ++t) {
    const double w = elements.weight[t];
    const Mat3 weighted = w * elements.stress[t];
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t v = elements.corners[t][k].index();
      if (elements.corner_stress.empty()) {
        node_stress[v] += weighted;
      } else {
        node_stress[v] += w * elements.corner_stress[t][k];
      }
      weight[v] += w;
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

void add_edge_stress(std::vector<Mat3>& node_stress, const ElementStress& elements,
                     std::span<const EdgeNodes> edge_nodes) {
  if (edge_nodes.empty()) return;
  std::vector<double> sum(node_stress.size(), 0);
  for (std::size_t t = 0; t < edge_nodes.size(); ++t) {
    if (edge_nodes[t][0].is_none()) continue;
    const double w = elements.weight[t];
    for (std::size_t e = 0; e < 6; ++e) {
      const std::size_t v = edge_nodes[t][e].index();
      const auto [i, j] = edge_ends[e];
      node_stress[v] += 0.5 * w *
                        (elements.at(t, static_cast<std::size_t>(i)) +
                         elements.at(t, static_cast<std::size_t>(j)));
      sum[v] += w;
    }
  }
  for (std::size_t v = 0; v < sum.size(); ++v) {
    if (sum[v] > 0) node_stress[v] /= sum[v];
  }
}

Mat3 node_stress_of_star(const ElementStress& elements, std::span<const CornerId> star) {
  SUNDER_ASSERT(!star.empty(), "a vertex without tetrahedra has no stress");
  Mat3 sum = Mat3::Zero();
  double total = 0;
  for (const CornerId c : star) {
    const std::size_t t = tetrahedron_of(c).index();
    sum += elements.weight[t] * elements.at(t, static_cast<std::size_t>(place_of(c)));
    total += elements.weight[t];
  }
  return sum / total;
}

}  // namespace sunder
