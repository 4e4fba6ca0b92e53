// SPDX-License-Identifier: MIT
// Looks up faces and vertices in the load boxes of a scene.
#include "fracture/simulation/scene_loads.hpp"

#include <fmt/format.h>

namespace sunder {
namespace {

bool contains(const LoadBox& box, const Vec3& p) {
  return (p.array() >= box.minimum.array()).all() && (p.array() <= box.maximum.array()).all();
}

/// Pressure on every boundary face with all three vertices in the box; gives their number.
std::size_t add_pressure(Simulation& sim, const BodyRows& rows, const LoadBox& box) {
  const MechanicsState& m = sim.state->mechanics;
  const VolumeMap& map = sim.state->cells.map;
  std::size_t count = 0;
  for (std::size_t t = rows.first_tetrahedron; t < rows.end_tetrahedron; ++t) {
    for (int place = 0; place < 4; ++place) {
      const HalfFaceId face = half_face(TetId{t}, place);
      if (!map.neighbour(face).is_none()) continue;
      bool inside = true;
      for (const VertexId v : corners_of_face(map.corners(TetId{t}), face)) {
        inside = inside && contains(box, m.vertices.rest_position[v.index()]);
      }
      if (!inside) continue;
      ++count;
      for (const CornerLoad& load : face_pressure(m.elements, TetId{t}, place, box.pressure)) {
        sim.state->loads.push_back(load);
      }
    }
  }
  return count;
}

/// The force in equal parts on every vertex in the box.
void add_force(Simulation& sim, const BodyRows& rows, const LoadBox& box) {
  const MechanicsState& m = sim.state->mechanics;
  std::vector<std::vector<CornerId>> star(m.vertices.size());
  for (std::size_t t = rows.first_tetrahedron; t < rows.end_tetrahedron; ++t) {
    for (int place = 0; place < 4; ++place) {
      const VertexId v = sim.state->cells.map.corners(TetId{t})[static_cast<std::size_t>(place)];
      if (contains(box, m.vertices.rest_position[v.index()])) {
        star[v.index()].push_back(corner(TetId{t}, place));
      }
    }
  }
  std::size_t count = 0;
  for (const auto& corners : star) count += !corners.empty();
  for (const auto& corners : star) {
    if (corners.empty()) continue;
    add_vertex_force(sim.state->loads, m, corners, box.force / static_cast<double>(count));
  }
}

}  // namespace

std::vector<Finding> make_scene_loads(Simulation& sim) {
  std::vector<Finding> findings;
  std::uint32_t row = 0;
  for (std::size_t b = 0; b < sim.bodies.size(); ++b) {
    const std::vector<LoadBox>& boxes = sim.scene.bodies[b].loads;
    for (std::size_t i = 0; i < boxes.size(); ++i, ++row) {
      const std::size_t first = sim.state->loads.size();
      if (!boxes[i].force.isZero(0)) add_force(sim, sim.bodies[b], boxes[i]);
      if (boxes[i].pressure != 0 && add_pressure(sim, sim.bodies[b], boxes[i]) == 0) {
        findings.push_back(
            {.code = "nothing_loaded",
             .text =
                 fmt::format("bodies.{}.loads.{}: no boundary face lies in its box whole", b, i),
             .remedy = "give the box in the mesh's own coordinates, m, large enough for all three "
                       "vertices of a face"});
      }
      for (std::size_t k = first; k < sim.state->loads.size(); ++k) {
        sim.state->loads[k].ramp_time = boxes[i].ramp_time;
        sim.state->loads[k].load = row;
      }
    }
  }
  return findings;
}

}  // namespace sunder
