// SPDX-License-Identifier: MIT
#include "fracture/simulation/changes/actions.hpp"

#include <cmath>

#include "fracture/simulation/rows.hpp"
#include "fracture/simulation/simulation_state.hpp"

namespace sunder {
namespace {

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
  const std::vector<HalfFaceId> faces = faces_between(s, point, normal.normalized());
  if (faces.empty()) {
    return Finding{.code = "nothing_cut",
                   .text = "the plane passes between no two tetrahedra",
                   .remedy = "give one that passes through a piece"};
  }
  Result<FanEvent> event = split_faces(simulation, faces);
  if (!event) return event;
  const TetId tetrahedron = tetrahedron_of(event->faces.front().face);
  const ComponentId piece = s.cells.labels.of_tetrahedron[tetrahedron.index()];
  event->normal =
      s.mechanics.components[piece.index()].orientation.conjugate() * normal.normalized();
  return event;
}

std::optional<Finding> pull(Simulation& simulation, VertexId vertex, const Vec3& end) {
  const VolumeMap& map = simulation.state->cells.map;
  if (vertex.index() >= map.vertices() || map.is_node(vertex) || !end.allFinite()) {
    return bad_action("there is no such vertex, or its place is none",
                      "give the row of a vertex and a finite point");
  }
  simulation.spring = Spring{vertex, end};
  return std::nullopt;
}

void release(Simulation& simulation) { simulation.spring.reset(); }

}  // namespace sunder
