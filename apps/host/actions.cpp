// SPDX-License-Identifier: MIT
// What a host does to a scene between two steps.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/host/engine.hpp"
#include "fracture/algorithms/split_fan.hpp"
#include "fracture/simulation/rebuild_pieces.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "topology/base/sort_unique.hpp"
#include "topology/kernel/split_face.hpp"

namespace sunder {
namespace {

constexpr double spring_frequency = 5;  // Hz

Finding bad_action(const char* text, const char* remedy) {
  return {.code = "bad_action", .text = text, .remedy = remedy};
}

/// Interior faces between tetrahedra on different sides, each once, seen from its lower one.
std::vector<HalfFaceId> faces_between(const SimulationState& s, const Vec3& point,
                                      const Vec3& normal) {
  std::vector<char> above(s.cells.map.tetrahedra());
  for (std::size_t t = 0; t < above.size(); ++t) {
    Vec3 sum = Vec3::Zero();
    for (const VertexId v : s.cells.map.corners(TetId{t})) {
      sum += s.mechanics.vertices.position[v.index()];
    }
    above[t] = normal.dot(sum / 4 - point) > 0;
  }
  std::vector<HalfFaceId> faces;
  for (std::size_t t = 0; t < above.size(); ++t) {
    for (int place = 0; place < 4; ++place) {
      const HalfFaceId across = s.cells.map.neighbour(half_face(TetId{t}, place));
      if (across.is_none() || tetrahedron_of(across).index() < t) continue;
      if (above[t] != above[tetrahedron_of(across).index()]) {
        faces.push_back(half_face(TetId{t}, place));
      }
    }
  }
  return faces;
}

/// Splits the faces with all rows that follow, as `split_fan` does for those of a fan.
FanEvent part_faces(SimulationState& s, const std::vector<HalfFaceId>& faces, Detection detection,
                    ComponentScratch& scratch) {
  FanEvent event;
  std::vector<VertexId> rows;
  for (const HalfFaceId face : faces) {
    const FaceSplit split = split_face(s.cells.map, face);
    rows.insert(rows.end(), split.vertices.begin(), split.vertices.end());
    for (int i = 0; i < split.vertex_count; ++i) {
      const VertexCopy& copy = split.split_vertices[static_cast<std::size_t>(i)];
      append_copy(s.mechanics.vertices, copy.old_row);
      append_copy(s.cells, copy.old_row);
      rows.push_back(copy.new_row);
    }
    event.faces.push_back(split);
  }
  event.components =
      update_components(s.cells.map, event.faces, detection, s.cells.labels, scratch);
  sort_unique(rows);
  for (const VertexId v : rows) {
    s.cells.strength[v.index()] =
        vertex_strength(s.cells, s.mechanics, v, star(s.cells.map, v));
  }
  return event;
}

}  // namespace

std::optional<Finding> shoot(Simulation& simulation, const Sphere& ball, const Vec3& velocity,
                             double mass) {
  if (!ball.center.allFinite() || !velocity.allFinite() || !(ball.radius > 0) || !(mass > 0) ||
      !std::isfinite(ball.radius) || !std::isfinite(mass)) {
    return bad_action("a ball needs a finite place and velocity, a radius and a mass above 0",
                      "give them, in m, m/s and kg");
  }
  const Obstacle obstacle{.shape = ball, .velocity = velocity, .mass = mass};
  simulation.scene.obstacles.push_back(obstacle);
  simulation.state->obstacles.push_back(obstacle);
  std::vector<char>& apart = simulation.state->ladder.rubble.ball_apart;
  if (!apart.empty()) apart.push_back(0);
  return std::nullopt;
}

Result<FanEvent> cut(Simulation& simulation, const Vec3& point, const Vec3& normal) {
  SimulationState& s = *simulation.state;
  if (!point.allFinite() || !normal.allFinite() || normal.isZero(0)) {
    return bad_action("a cut needs a point and a normal that is not zero", "give both");
  }
  if (s.cells.pieces) {
    return bad_action("cuts part faces at once, which the crack mode cohesive does not know",
                      "take fracture.crack object or paper");
  }
  const std::vector<HalfFaceId> faces = faces_between(s, point, normal.normalized());
  if (faces.empty()) {
    return Finding{.code = "nothing_cut",
                   .text = "the plane passes between no two tetrahedra",
                   .remedy = "give one that passes through a piece"};
  }
  SimulationScratch& scratch = *simulation.scratch;
  FanEvent event = part_faces(s, faces, simulation.scene.fracture.detection,
                              scratch.fracture.components);
  const FaceSplit& first = event.faces.front();
  event.vertex = first.vertices[0];
  event.point = s.cells.map.point_of_vertex(event.vertex);
  event.rest_position = s.mechanics.vertices.rest_position[event.vertex.index()];
  const ComponentId piece = s.cells.labels.of_tetrahedron[tetrahedron_of(first.face).index()];
  event.normal =
      s.mechanics.components[piece.index()].orientation.conjugate() * normal.normalized();
  rebuild_pieces(s, std::span(&event, 1), scratch.mechanics);
  s.birth_step.resize(s.cells.labels.size.size(), s.step);
  return event;
}

void load_spring(Simulation& simulation, const std::optional<Spring>& spring,
                 std::size_t scene_loads) {
  SimulationState& s = *simulation.state;
  s.loads.resize(scene_loads);
  if (!spring) return;
  const std::size_t row = spring->vertex.index();
  const VertexColumns& v = s.mechanics.vertices;
  const Component& piece = s.mechanics.components[v.component[row].index()];
  const double omega = 2 * std::numbers::pi * spring_frequency;
  // However far the pointer is: a chip pulled from far off would be spun faster than a step follows.
  const double lifts = 3 * simulation.scene.gravity.acceleration.norm() / (omega * omega);
  const double longest = std::max(2 * piece.rest_radius, lifts);
  Vec3 stretch = spring->end - v.position[row];
  stretch *= std::min(1.0, longest / stretch.norm());
  if (!stretch.allFinite()) stretch.setZero();
  const Vec3 force = piece.mass * omega * (omega * stretch - 2 * v.velocity[row]);
  add_vertex_force(s.loads, s.mechanics, vertex_star(s.cells.map, spring->vertex).corners, force);
}

}  // namespace sunder
