// SPDX-License-Identifier: MIT
// Bodies of second order: rows for the nodes in the middles of edges, behind those of vertices.
#include <algorithm>

#include "fracture/simulation/scene_loads.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "fracture/simulation/statics/statics.hpp"
#include "fracture/strength/held_boxes.hpp"
#include "mechanics/rebuild.hpp"
#include "mechanics/state/living.hpp"
#include "topology/cells/edges.hpp"

namespace sunder {
namespace {

/// Row of a node in the middle between `a` and `b`, as a rigid body has it there.
VertexId append_middle(VertexColumns& vertices, VertexId a, VertexId b) {
  const auto middle = [&](std::vector<Vec3>& column) {
    column.push_back(0.5 * (column[a.index()] + column[b.index()]));
  };
  const VertexId row{vertices.size()};
  middle(vertices.rest_position);
  middle(vertices.position);
  middle(vertices.velocity);
  vertices.mass.push_back(0);
  vertices.component.push_back(vertices.component[a.index()]);
  vertices.displacement.push_back(Vec3::Zero());
  vertices.displacement_rate.push_back(Vec3::Zero());
  vertices.displacement_acceleration.push_back(Vec3::Zero());
  vertices.support.push_back(MotionId::none());
  return row;
}

/// Appends the nodes of one body's edges and holds those that its boxes hold.
void append_nodes(Simulation& sim, std::size_t body, const EdgeRows& edges) {
  MechanicsState& m = sim.state->mechanics;
  const BodyRows& rows = sim.bodies[body];
  std::vector<VertexId> appended;
  std::vector<VertexId> node(edges.first.size(), VertexId::none());
  for (std::size_t t = rows.first_tetrahedron; t < rows.end_tetrahedron; ++t) {
    const Corners corners = sim.state->cells.map.corners(TetId{t});
    for (std::size_t e = 0; e < 6; ++e) {
      VertexId& row = node[edges.of_cell[t][e]];
      if (row.is_none()) {
        const auto [i, j] = edge_ends[e];
        row = append_middle(m.vertices, corners[static_cast<std::size_t>(i)],
                            corners[static_cast<std::size_t>(j)]);
        appended.push_back(row);
      }
      m.elements.edge_nodes[t][e] = row;
    }
  }
  const BodySettings& settings = sim.scene.bodies[body];
  hold_vertices(m, appended, settings.held, settings.rotation);
}

}  // namespace

Result<Simulation> build_statics(Scene scene) {
  Result<Simulation> result = build_bodies(std::move(scene));
  const auto is_raised = [](const BodySettings& body) { return body.order == 2; };
  if (!result || std::ranges::none_of(result->scene.bodies, is_raised)) return result;
  Simulation& sim = *result;
  if (sim.scene.fracture.node_stress == NodeStress::fit) {
    result.findings.push_back(
        {.code = "fit_of_second_order",
         .text = "fracture.node_stress: is fit, which is for tetrahedra of first order",
         .remedy = "leave it out: of second order the stresses at the nodes are averaged"});
    result.value.reset();
    return result;
  }
  MechanicsState& m = sim.state->mechanics;
  const EdgeRows edges = edge_rows(sim.state->cells.map);
  m.elements.edge_nodes.assign(m.elements.size(), EdgeNodes{});
  for (std::size_t b = 0; b < sim.bodies.size(); ++b) {
    if (is_raised(sim.scene.bodies[b])) append_nodes(sim, b, edges);
  }
  sim.state->loads.clear();
  make_scene_loads(sim);
  rebuild(m, sim.state->cells.map.corners(), living_components(m), sim.scratch->mechanics);
  return result;
}

}  // namespace sunder
