// SPDX-License-Identifier: MIT
// Patches, their weights, and which of them a split makes stale.
#include "fracture/algorithms/stress_fit.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>

#include "topology/base/sort_unique.hpp"
#include "topology/kernel/fan.hpp"

namespace sunder {
namespace {

constexpr std::uint32_t no_row = std::numeric_limits<std::uint32_t>::max();
/// Four unknowns a component; twice as many tetrahedra leave something to average.
constexpr std::size_t fewest = 8;
constexpr double singular = 1e-6;
constexpr double largest_reach = 25;

Vec3 to_vec3(const Point& p) { return {p[0], p[1], p[2]}; }

/// Vertices of the tetrahedra around one, itself among them, by rising row.
std::vector<VertexId> vertices_around(const VolumeMap& map, std::span<const TetId> star) {
  std::vector<VertexId> vertices;
  for (const TetId t : star) {
    for (const VertexId v : map.corners(t)) vertices.push_back(v);
  }
  sort_unique(vertices);
  return vertices;
}

std::vector<TetId> two_rings(const VolumeMap& map, std::span<const TetId> ring) {
  std::vector<TetId> patch;
  for (const VertexId v : vertices_around(map, ring)) {
    const std::vector<TetId> more = star(map, v);
    patch.insert(patch.end(), more.begin(), more.end());
  }
  sort_unique(patch);
  return patch;
}

/// Rest centre of a tetrahedron as seen from a vertex, m.
Vec3 arm(const VolumeMap& map, TetId t, const Vec3& from) {
  Vec3 sum = Vec3::Zero();
  for (const VertexId v : map.corners(t)) sum += to_vec3(map.point(v)) - from;
  return 0.25 * sum;
}

StressPatch mean_of_star(std::span<const TetId> ring, std::span<const double> volume) {
  StressPatch patch{.terms = {}, .valid = true, .fitted = false};
  double total = 0;
  for (const TetId t : ring) total += volume[t.index()];
  for (const TetId t : ring) patch.terms.push_back({volume[t.index()] / total, t});
  return patch;
}

}  // namespace

StressPatch make_stress_patch(const VolumeMap& map, std::span<const double> volume,
                              VertexId vertex) {
  const std::vector<TetId> ring = star(map, vertex);
  const std::vector<TetId> rows = two_rings(map, ring);
  if (rows.size() < fewest) return mean_of_star(ring, volume);
  const Vec3 at = to_vec3(map.point(vertex));
  std::vector<Vec3> centre;
  double total = 0;
  Vec3 mean = Vec3::Zero();
  for (const TetId t : rows) {
    centre.push_back(arm(map, t, at));
    total += volume[t.index()];
    mean += volume[t.index()] * centre.back();
  }
  mean /= total;
  Mat3 covariance = Mat3::Zero();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Vec3 from_mean = centre[i] - mean;
    covariance += volume[rows[i].index()] / total * from_mean * from_mean.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(covariance);
  const Vec3 spread = solver.eigenvalues();
  if (!(spread[0] > singular * spread[2])) return mean_of_star(ring, volume);
  const Vec3 along = solver.eigenvectors().transpose() * mean;
  const Vec3 slope = solver.eigenvectors() * along.cwiseQuotient(spread);
  if (slope.dot(mean) > largest_reach) return mean_of_star(ring, volume);
  StressPatch patch{.terms = {}, .valid = true, .fitted = true};
  patch.terms.reserve(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double share = volume[rows[i].index()] / total;
    patch.terms.push_back({share * (1 - slope.dot(centre[i] - mean)), rows[i]});
  }
  return patch;
}

void follow_splits(StressFit& fit, const VolumeMap& map) {
  const std::size_t before = fit.patches.size();
  if (before == map.vertices()) return;
  fit.patches.resize(map.vertices());
  fit.next_row.resize(map.vertices(), no_row);
  fit.first_row.resize(map.points().size(), no_row);
  for (std::size_t row = before; row < map.vertices(); ++row) {
    std::uint32_t& first = fit.first_row[map.point_of_vertex(VertexId{row})];
    fit.next_row[row] = first;
    first = static_cast<std::uint32_t>(row);
  }
  if (before == 0) return;
  for (std::size_t row = before; row < map.vertices(); ++row) {
    const std::uint32_t point = map.point_of_vertex(VertexId{row});
    for (std::uint32_t v = fit.first_row[point]; v != no_row; v = fit.next_row[v]) {
      for (const VertexId near : vertices_around(map, star(map, VertexId{v}))) {
        fit.patches[near.index()].valid = false;
      }
    }
  }
}

Mat3 fit_node_stress(StressFit& fit, const VolumeMap& map, const ElementStress& elements,
                     VertexId vertex) {
  StressPatch& patch = fit.patches[vertex.index()];
  if (!patch.valid) patch = make_stress_patch(map, elements.weight, vertex);
  Mat3 sum = Mat3::Zero();
  for (const PatchTerm& term : patch.terms) {
    sum += term.weight * elements.stress[term.tetrahedron.index()];
  }
  return sum;
}

void fit_node_stress(std::vector<Mat3>& node_stress, StressFit& fit, const VolumeMap& map,
                     const ElementStress& elements) {
  follow_splits(fit, map);
  node_stress.resize(map.vertices());
  for (std::size_t row = 0; row < node_stress.size(); ++row) {
    const VertexId v{row};
    node_stress[row] = map.incident_tetrahedron(v).is_none()
                           ? Mat3::Zero()
                           : fit_node_stress(fit, map, elements, v);
  }
}

}  // namespace sunder
