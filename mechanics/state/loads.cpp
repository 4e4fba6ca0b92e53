// SPDX-License-Identifier: MIT
// Corner loads from pressures and forces, and their sum on vertices.
#include "mechanics/state/loads.hpp"

#include <algorithm>

#include "mechanics/state/step_input.hpp"

namespace sunder {

std::array<CornerLoad, 3> face_pressure(const ElementColumns& elements, TetId t, int place,
                                        double pressure) {
  const Vec3 force =
      pressure * elements.rest_volume[t.index()] * elements.shape_gradient[t.index()].col(place);
  std::array<CornerLoad, 3> loads;
  for (int k = 0; k < 3; ++k) {
    const int at = (place + 1 + k) % 4, next = (place + 1 + (k + 1) % 3) % 4;
    loads[static_cast<std::size_t>(k)] = {
        corner(t, at), is_second_order(elements, t) ? edge_between(at, next) : -1, force, true};
  }
  return loads;
}

void add_vertex_force(std::vector<CornerLoad>& loads, const MechanicsState& state,
                      std::span<const CornerId> star, const Vec3& force) {
  double mass = 0;
  for (CornerId c : star) mass += state.elements.mass[tetrahedron_of(c).index()];
  for (CornerId c : star) {
    const double share = state.elements.mass[tetrahedron_of(c).index()] / mass;
    loads.push_back({.corner = c, .force = share * force});
  }
}

VertexId node_of(const CornerLoad& load, const ElementColumns& elements,
                 std::span<const Corners> corners) {
  const std::size_t t = tetrahedron_of(load.corner).index();
  return load.edge < 0 ? corners[t][static_cast<std::size_t>(place_of(load.corner))]
                       : elements.edge_nodes[t][static_cast<std::size_t>(load.edge)];
}

Vec3 force_at(const CornerLoad& load, double time, const Eigen::Quaterniond& orientation) {
  const double raised = load.ramp_time > 0 ? std::min(1.0, time / load.ramp_time) : 1.0;
  const Vec3 force = raised * load.force;
  return load.turns ? Vec3(orientation * force) : force;
}

void add_corner_loads(std::vector<Vec3>& force, std::span<const CornerLoad> loads,
                      const MechanicsState& state, std::span<const Corners> corners, double time) {
  Loads sum;
  sum.force.swap(force);
  add_corner_loads(sum, loads, state, corners, time);
  force.swap(sum.force);
}

void add_corner_loads(Loads& sum, std::span<const CornerLoad> loads, const MechanicsState& state,
                      std::span<const Corners> corners, double time) {
  sum.force.resize(state.vertices.size(), Vec3::Zero());
  sum.turning.resize(state.vertices.size(), Vec3::Zero());
  for (const CornerLoad& load : loads) {
    const std::size_t t = tetrahedron_of(load.corner).index();
    const VertexId v = node_of(load, state.elements, corners);
    const Component& component = state.components[state.elements.component[t].index()];
    const Vec3 f = force_at(load, time, component.orientation);
    if (load.turns) sum.turning[v.index()] += f;
    sum.force[v.index()] += f;
  }
}

}  // namespace sunder
