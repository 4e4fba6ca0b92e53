// SPDX-License-Identifier: MIT
// Columns of a simulation as bytes for hosts, and one vertex in full.
#include <Eigen/Dense>
#include <algorithm>
#include <cstdint>
#include <variant>

#include "apps/host/column.hpp"
#include "apps/host/engine.hpp"
#include "apps/output/smooth_cracks.hpp"
#include "fracture/algorithms/find_fractures.hpp"
#include "fracture/algorithms/fracture_plane.hpp"
#include "fracture/algorithms/split_fan.hpp"
#include "fracture/algorithms/threshold_test.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/contact/shapes/solid_surface.hpp"

namespace sunder {
namespace {

void add_faces(Column& column, const Cells& cells, sunder_column kind) {
  for (std::size_t t = 0; t < cells.map.tetrahedra(); ++t) {
    for (int place = 0; place < 4; ++place) {
      const HalfFaceId face = half_face(TetId{t}, place);
      if (!cells.map.neighbour(face).is_none()) continue;
      if (kind == SUNDER_FACE_IS_CRACK) {
        column.add(std::uint32_t{is_crack_face(cells, face)});
      } else if (kind == SUNDER_HALF_FACE) {
        column.add(face.value);
      } else {
        for (const VertexId v : corners_of_face(cells.map.corners(TetId{t}), face)) {
          column.add(v.value);
        }
      }
    }
  }
}

void add_stress(Column& column, const Simulation& simulation, bool as_ratio) {
  const SimulationState& s = *simulation.state;
  const std::vector<Mat3> stress =
      node_stress_of(s.cells, s.mechanics, simulation.scene.fracture.node_stress);
  for (std::size_t v = 0; v < stress.size(); ++v) {
    const double largest = largest_principal_stress(stress[v]);
    column.add_floats(as_ratio ? largest / s.cells.strength[v] : largest);
  }
}

void add_obstacle(Column& column, const Obstacle& obstacle) {
  const double mass = obstacle.mass.value_or(0);
  const Vec3& v = obstacle.velocity;
  if (const auto* plane = std::get_if<Plane>(&obstacle.shape)) {
    const Vec3& n = plane->normal;
    column.add_doubles({0, n[0], n[1], n[2], plane->offset, 0, 0, 0, 0, 0, 0, 1});
  } else if (const auto* ball = std::get_if<Sphere>(&obstacle.shape)) {
    const Vec3& c = ball->center;
    column.add_doubles({1, c[0], c[1], c[2], ball->radius, 0, 0, 0, 0, 0, 0, 1});
  } else if (const auto* box = std::get_if<Box>(&obstacle.shape)) {
    const Vec3 &c = box->center, &h = box->half_extent;
    const Eigen::Quaterniond& q = box->orientation;
    column.add_doubles({2, c[0], c[1], c[2], 0, h[0], h[1], h[2], q.x(), q.y(), q.z(), q.w()});
  } else if (const auto* solid = std::get_if<Solid>(&obstacle.shape)) {
    const Vec3& x = solid->translation;
    const Eigen::Quaterniond& q = solid->orientation;
    column.add_doubles({3, x[0], x[1], x[2], 0, 0, 0, 0, q.x(), q.y(), q.z(), q.w()});
  }
  column.add_doubles({v[0], v[1], v[2], mass});
}

void add_solids(Column& column, const std::vector<Obstacle>& obstacles) {
  for (std::size_t row = 0; row < obstacles.size(); ++row) {
    const auto* solid = std::get_if<Solid>(&obstacles[row].shape);
    if (solid == nullptr) continue;
    for (const auto& triangle : solid->surface->triangles) {
      column.add_floats(row);
      for (const std::uint32_t point : triangle) column.add_floats(solid->surface->points[point]);
    }
  }
}

void add_material(Column& column, const Material& m) {
  column.add_doubles({m.young_modulus, m.poisson_ratio, m.density, m.tensile_strength,
                      m.toughness.value_or(0), m.fracture_energy.value_or(0)});
}

/// Rest positions with points on cracks near the planes of those.
void add_smooth(Column& column, const SimulationState& s) {
  const std::vector<Vec3> moves = smooth_crack_moves(s.cells);
  const VertexColumns& v = s.mechanics.vertices;
  for (std::size_t i = 0; i < v.size(); ++i) {
    column.add_floats(Vec3(v.rest_position[i] + moves[s.cells.map.point_of_vertex(VertexId{i})]));
  }
}

/// A column with a row a vertex.
void fill_vertices(Column& column, const Simulation& simulation, sunder_column kind) {
  const VertexColumns& v = simulation.state->mechanics.vertices;
  if (kind == SUNDER_STRESS || kind == SUNDER_LOAD_RATIO) {
    return add_stress(column, simulation, kind == SUNDER_LOAD_RATIO);
  }
  if (kind == SUNDER_SMOOTH) return add_smooth(column, *simulation.state);
  for (std::size_t i = 0; i < v.size(); ++i) {
    if (kind == SUNDER_POSITION) column.add_floats(v.position[i]);
    if (kind == SUNDER_REST) column.add_floats(v.rest_position[i]);
    if (kind == SUNDER_PIECE) column.add(v.component[i].value);
    if (kind == SUNDER_SPEED) column.add_floats(v.velocity[i].norm());
  }
}

/// A column with a row a piece.
void fill_pieces(Column& column, const Simulation& simulation, sunder_column kind) {
  const SimulationState& s = *simulation.state;
  for (const Component& c : s.mechanics.components) {
    const std::size_t id = c.id.index();
    if (kind == SUNDER_DRAWN_POSE) column.add_pose(s.display[id].centre, s.display[id].orientation);
    if (kind == SUNDER_POSE) column.add_pose(c.centre, c.orientation);
    if (kind == SUNDER_REST_CENTRE) {
      column.add_floats(c.rest_centre);
      column.add_floats(c.mass);
    }
    if (kind == SUNDER_BIRTH) {
      column.add(static_cast<std::uint32_t>(id < s.birth_step.size() ? s.birth_step[id] : 0));
    }
    if (kind == SUNDER_PARENT) column.add(s.cells.labels.parent[id].value);
    if (kind == SUNDER_TETRAHEDRA) {
      column.add(static_cast<std::uint32_t>(c.tetrahedra.size()));
    }
    if (kind == SUNDER_VELOCITY) {
      const Vec3 moving = c.mass > 0 ? Vec3(c.momentum / c.mass) : Vec3(Vec3::Zero());
      column.add_floats(c.supported ? c.frame_velocity : moving);
    }
    if (kind == SUNDER_BODY) {
      column.add(static_cast<std::uint32_t>(
          c.tetrahedra.empty() ? 0 : body_of(simulation, c.tetrahedra.front())));
    }
  }
}

}  // namespace

void fill_column(std::vector<unsigned char>& bytes, const Simulation& simulation,
                 sunder_column kind) {
  Column column(bytes);
  switch (kind) {
    case SUNDER_POSITION:
    case SUNDER_REST:
    case SUNDER_PIECE:
    case SUNDER_STRESS:
    case SUNDER_LOAD_RATIO:
    case SUNDER_SPEED:
    case SUNDER_SMOOTH:
      return fill_vertices(column, simulation, kind);
    case SUNDER_FACE:
    case SUNDER_FACE_IS_CRACK:
    case SUNDER_HALF_FACE:
      return add_faces(column, simulation.state->cells, kind);
    case SUNDER_DRAWN_POSE:
    case SUNDER_POSE:
    case SUNDER_REST_CENTRE:
    case SUNDER_BIRTH:
    case SUNDER_BODY:
    case SUNDER_PARENT:
    case SUNDER_TETRAHEDRA:
    case SUNDER_VELOCITY:
      return fill_pieces(column, simulation, kind);
    case SUNDER_OBSTACLE:
      for (const Obstacle& obstacle : simulation.state->obstacles) add_obstacle(column, obstacle);
      return;
    case SUNDER_SOLID:
      return add_solids(column, simulation.state->obstacles);
    case SUNDER_MATERIAL:
      for (const BodySettings& body : simulation.scene.bodies) add_material(column, body.material);
      return;
    case SUNDER_CONTACT:
    case SUNDER_CRACK_FRONT:
      return fill_marks(column, simulation, kind);
    case SUNDER_FAN:
    case SUNDER_FAN_FACE:  // not of the state: fill_fans
    case SUNDER_COLUMNS:
      return;
  }
}

void inspect_vertex(sunder_vertex& result, const Simulation& simulation, VertexId vertex) {
  const SimulationState& s = *simulation.state;
  const std::size_t row = vertex.index();
  const Mat3 sigma =
      node_stress_of(s.cells, s.mechanics, simulation.scene.fracture.node_stress)[row];
  const Component& piece = s.mechanics.components[s.mechanics.vertices.component[row].index()];
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(sigma);
  const int order[] = {0, 0, 1, 1, 2, 2, 0, 1, 1, 2, 0, 2};
  for (int i = 0; i < 6; ++i) result.stress[i] = sigma(order[2 * i], order[2 * i + 1]);
  const Mat3 R = piece.orientation.toRotationMatrix();
  for (int i = 0; i < 3; ++i) {
    result.principal[i] = solver.eigenvalues()[2 - i];
    const Vec3 direction = R * solver.eigenvectors().col(2 - i);
    for (int k = 0; k < 3; ++k) result.direction[3 * i + k] = direction[k];
    result.position[i] = s.mechanics.vertices.position[row][i];
  }
  const VertexStar around = vertex_star(s.cells.map, vertex);
  const Vec3 normal = solver.eigenvectors().col(2);
  const std::vector<char> signs =
      plane_signs(s.cells.map, around, {normal[0], normal[1], normal[2]});
  result.piece = piece.id.value;
  result.tetrahedra = static_cast<std::uint32_t>(around.corners.size());
  result.fan = static_cast<std::uint32_t>(breakable_fan(s.cells, around, signs).size());
  result.threshold = s.cells.strength[row];
  result.gershgorin = gershgorin_bound(sigma);
  result.speed = s.mechanics.vertices.velocity[row].norm();
}

}  // namespace sunder
