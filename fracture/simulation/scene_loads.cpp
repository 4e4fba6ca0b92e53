// SPDX-License-Identifier: MIT
// Looks up faces and vertices in the load boxes of a scene.
#include "fracture/simulation/scene_loads.hpp"

#include <fmt/format.h>

namespace sunder {
namespace {

bool contains(const LoadBox& box, const Vec3& p) {
  return (p.array() >= box.minimum.array()).all() && (p.array() <= box.maximum.array()).all();
}

/// Pressure on every boundary face whose three vertices lie in the box; how many there are.
std::size_t add_pressure(Simulation& sim, const BodyRows& rows, const LoadBox& box) {
  const MechanicsState& m = sim.state->mechanics;
  std::size_t count = 0;
  for (std::size_t t = rows.first_tetrahedron; t < rows.end_tetrahedron; ++t) {
    const Corners& corners = sim.state->cells.map.corners(TetId{t});
    for (int place = 0; place < 4; ++place) {
      if (!sim.state->cells.map.neighbour(half_face(TetId{t}, place)).is_none()) continue;
      bool inside = true;
      for (int k = 1; k < 4; ++k) {
        const VertexId v = corners[static_cast<std::size_t>((place + k) % 4)];
        inside = inside && contains(box, m.vertices.rest_position[v.index()]);
      }
      if (!inside) continue;
      ++count;
      for (CornerLoad load : face_pressure(m.elements, TetId{t}, place, box.pressure)) {
        load.ramp_time = box.ramp_time;
        sim.state->loads.push_back(load);
      }
    }
  }
  return count;
}

/// The force in equal parts on every vertex in the box; how many there are.
std::size_t add_force(Simulation& sim, const BodyRows& rows, const LoadBox& box) {
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
  const std::size_t first = sim.state->loads.size();
  for (const auto& corners : star) {
    if (corners.empty()) continue;
    add_vertex_force(sim.state->loads, m, corners, box.force / static_cast<double>(count));
  }
  for (std::size_t i = first; i < sim.state->loads.size(); ++i) sim.state->loads[i].ramp_time = box.ramp_time;
  return count;
}

Finding nothing_loaded(const std::string& place, const char* what) {
  return {.code = "nothing_loaded",
          .text = fmt::format("{}: no {} of the mesh lies in its box", place, what),
          .remedy =
              "give the box in the mesh's own coordinates, m, before it is turned and moved; "
              "a pressure needs boundary faces with all three vertices inside"};
}

}  // namespace

Vec3 gravity_at(const GravitySettings& gravity, double time) {
  if (gravity.ramp_time <= 0) return gravity.acceleration;
  return gravity.acceleration * std::min(1.0, time / gravity.ramp_time);
}

std::vector<Finding> make_scene_loads(Simulation& sim) {
  std::vector<Finding> findings;
  for (std::size_t b = 0; b < sim.bodies.size(); ++b) {
    const std::vector<LoadBox>& boxes = sim.scene.bodies[b].loads;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const std::string place = fmt::format("bodies[{}].loads[{}]", b, i);
      const bool pushes = boxes[i].pressure != 0, pulls = !boxes[i].force.isZero(0);
      if (!pushes && !pulls) {
        findings.push_back({.code = "no_load",
                            .text = place + " has neither a pressure nor a force",
                            .remedy = "give \"pressure\" in Pa or \"force\" in N"});
      }
      if (pushes && add_pressure(sim, sim.bodies[b], boxes[i]) == 0) {
        findings.push_back(nothing_loaded(place, "boundary face"));
      }
      if (pulls && add_force(sim, sim.bodies[b], boxes[i]) == 0) {
        findings.push_back(nothing_loaded(place, "vertex"));
      }
    }
  }
  return findings;
}

}  // namespace sunder
