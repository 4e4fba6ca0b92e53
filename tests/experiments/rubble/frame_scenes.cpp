// SPDX-License-Identifier: MIT
#include "tests/experiments/rubble/frame_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <variant>

#include "fracture/simulation/simulation_state.hpp"
#include "topology/suite/fixtures/shapes.hpp"

namespace sunder::test {
namespace {

/// A box of six tetrahedra about its middle, that cannot break.
BodySettings box_body(const Vec3& sides) {
  BodySettings body;
  body.mesh = suite::kuhn_box({1, 1, 1});
  for (Point& p : body.mesh.points) {
    for (int k = 0; k < 3; ++k) p[std::size_t(k)] = (p[std::size_t(k)] - 0.5) * sides[k];
  }
  body.material.density = 2400;
  body.material.tensile_strength = std::numeric_limits<double>::infinity();
  return body;
}

/// Shared by the scenes: a floor, rubble on, steps of 1/240 s.
Scene rubble_on_floor() {
  Scene scene;
  scene.fracture.crack = CrackMode::paper;
  scene.obstacles = {{.shape = Plane{}, .friction = 0.5}};
  scene.integrator.time_step = 1.0 / 240;
  scene.ladder.rubble = RubbleMode::certified;
  scene.duration = 10;
  return scene;
}

}  // namespace

Scene boxes_scene(unsigned seed, double scale) {
  Scene scene = rubble_on_floor();
  scene.name = "boxes";
  // As `accuracy` chooses it for cells of that size.
  scene.contact.allowed_penetration *= std::clamp(scale, 0.1, 10.0);
  std::mt19937_64 random(seed);
  const auto any = [&] { return suite::unit(random); };
  for (int k = 0; k < 200; ++k) {
    BodySettings body = box_body(0.02 * scale * Vec3(1 + any(), 1 + any(), 1 + any()));
    const Eigen::Vector4d q(any() - 0.5, any() - 0.5, any() - 0.5, any() - 0.5);
    body.rotation = Eigen::Quaterniond(q).normalized();
    body.translation =
        scale * Vec3(0.075 * (k % 3 - 1), 0.075 * (k / 3 % 3 - 1), 0.05 + 0.075 * (k / 9));
    body.velocity = {0, 0, -std::sqrt(scale)};
    scene.bodies.push_back(std::move(body));
  }
  return scene;
}

Scene wall_scene() {
  Scene scene = rubble_on_floor();
  scene.name = "wall";
  constexpr double length = 0.1, depth = 0.05, height = 0.04, joint = 1e-4;
  for (int course = 0; course < 25; ++course) {
    for (int k = 0; k < 40; ++k) {
      BodySettings body = box_body({length - joint, depth, height});
      const double shift = course % 2 == 0 ? 0 : 0.5;
      body.translation = {(k + shift - 20) * length, 0, (course + 0.5) * height};
      scene.bodies.push_back(std::move(body));
    }
  }
  scene.obstacles.push_back(
      {.shape = Sphere{{0, -0.2, 0.6}, 0.06}, .velocity = {0, 6, 0}, .mass = 2.0});
  return scene;
}

std::vector<SeenPart> seen_parts(const Simulation& sim) {
  const SimulationState& s = *sim.state;
  std::vector<SeenPart> parts;
  for (const Component& c : s.mechanics.components) {
    for (const TetId t : c.tetrahedra) {
      std::array<Vec3, 4> corners;
      const Corners rows = s.cells.map.corners(t);
      for (std::size_t k = 0; k < 4; ++k) {
        corners[k] = s.mechanics.vertices.position[rows[k].index()];
      }
      parts.push_back({make_tetrahedron(corners), static_cast<std::uint32_t>(c.id.index())});
    }
  }
  return parts;
}

PieceCount count_pieces(const Simulation& sim) {
  PieceCount count;
  for (const Component& c : sim.state->mechanics.components) {
    if (c.tetrahedra.empty()) continue;
    ++count.pieces;
    count.asleep += c.rung == Rung::asleep;
    count.mass += c.mass;
  }
  return count;
}

BelowPlanes below_planes(const Simulation& sim, double allowed) {
  BelowPlanes below{.depth = -std::numeric_limits<double>::infinity()};
  for (const Component& c : sim.state->mechanics.components) {
    double depth = -std::numeric_limits<double>::infinity();
    for (const Obstacle& obstacle : sim.state->obstacles) {
      const auto* plane = std::get_if<Plane>(&obstacle.shape);
      if (plane == nullptr) continue;
      for (const VertexId v : c.vertices) {
        const Vec3& x = sim.state->mechanics.vertices.position[v.index()];
        depth = std::max(depth, plane->offset - plane->normal.dot(x));
      }
    }
    below.pieces += depth > allowed;
    if (depth <= below.depth) continue;
    below.depth = depth;
    below.piece = static_cast<std::uint32_t>(c.id.index());
  }
  return below;
}

bool all_finite(const Simulation& sim) {
  const VertexColumns& v = sim.state->mechanics.vertices;
  const auto finite = [](const Vec3& x) { return x.allFinite(); };
  return std::ranges::all_of(v.position, finite) && std::ranges::all_of(v.velocity, finite);
}

}  // namespace sunder::test
