// SPDX-License-Identifier: MIT
// Rows of a simulation for researchers, and faces split in it.
#include "fracture/simulation/rows.hpp"

#include <fmt/format.h>

#include "fracture/algorithms/find_fractures.hpp"
#include "fracture/algorithms/split_fan.hpp"
#include "fracture/simulation/rebuild_pieces.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "topology/base/sort_unique.hpp"

namespace sunder {
const VolumeMap& map_of(const Simulation& simulation) { return simulation.state->cells.map; }

SimulationRows rows_of(const Simulation& simulation) {
  const MechanicsState& m = simulation.state->mechanics;
  return {.rest_position = m.vertices.rest_position,
          .position = m.vertices.position,
          .velocity = m.vertices.velocity,
          .mass = m.vertices.mass,
          .strength = simulation.state->cells.strength,
          .component = m.vertices.component,
          .cell_stress = m.elements.stress,
          .cell_mass = m.elements.mass,
          .cell_component = m.elements.component};
}

std::vector<Mat3> vertex_stress(const Simulation& simulation) {
  const SimulationState& s = *simulation.state;
  return node_stress_of(s.cells, s.mechanics, simulation.scene.fracture.node_stress);
}

Result<FanEvent> split_faces(Simulation& simulation, std::span<const HalfFaceId> faces) {
  SimulationState& s = *simulation.state;
  SimulationScratch& scratch = *simulation.scratch;
  FanEvent event;
  if (s.cells.pieces) {
    return Finding{
        .code = "ties_between_faces",
        .text = "faces cannot be parted at once with the crack mode cohesive, which ties them",
        .remedy = "take fracture.crack object or paper"};
  }
  for (const HalfFaceId face : faces) {
    if (face.index() < 4 * s.cells.map.tetrahedra()) continue;
    return Finding{.code = "no_such_face",
                   .ids = {face.value},
                   .text = fmt::format("there is no half-face {}", face.value),
                   .remedy = fmt::format("give rows below {}", 4 * s.cells.map.tetrahedra())};
  }
  std::vector<VertexId> rows;
  for (const HalfFaceId face : faces) {
    const FaceSplit split = part_face({s.cells, s.mechanics}, face, event.nodes);
    if (!split.did) continue;
    rows.insert(rows.end(), split.vertices.begin(), split.vertices.end());
    for (int i = 0; i < split.vertex_count; ++i) {
      rows.push_back(split.split_vertices[static_cast<std::size_t>(i)].new_row);
    }
    event.faces.push_back(split);
  }
  if (event.faces.empty()) return event;
  event.components =
      update_components(s.cells.map, event.faces, simulation.scene.fracture.detection,
                        s.cells.labels, scratch.fracture.components);
  sort_unique(rows);
  for (const VertexId v : rows) {
    s.cells.strength[v.index()] = vertex_strength(s.cells, s.mechanics, v, star(s.cells.map, v));
  }
  const FaceSplit& first = event.faces.front();
  event.vertex = first.vertices[0];
  event.point = s.cells.map.point_of_vertex(event.vertex);
  event.rest_position = s.mechanics.vertices.rest_position[event.vertex.index()];
  event.normal = rest_area_vector(s.cells.map, first.face).normalized();
  rebuild_pieces(s, std::span(&event, 1), scratch.mechanics);
  s.birth_step.resize(s.cells.labels.size.size(), s.step);
  return event;
}

}  // namespace sunder
