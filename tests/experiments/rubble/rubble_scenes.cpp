// SPDX-License-Identifier: MIT
#include "tests/experiments/rubble/rubble_scenes.hpp"

#include <algorithm>
#include <random>

namespace sunder::test {
namespace {

RubbleShape& add_shape(RubbleScene& scene, RubbleShape::Kind kind, RubbleBody body, double radius) {
  body.radius = radius;
  RubbleShape& shape = scene.shapes.emplace_back();
  shape.kind = kind;
  shape.body = static_cast<std::uint32_t>(scene.bodies.size());
  shape.key = scene.shapes.size();
  scene.bodies.push_back(body);
  return shape;
}

}  // namespace

RubbleScene ground(double friction) {
  RubbleScene scene;
  RubbleBody body;
  body.friction = friction;
  add_shape(scene, RubbleShape::Kind::half_space, body, 0);
  return scene;
}

void add_tetrahedron(RubbleScene& scene, const std::array<Vec3, 4>& corners, double density,
                     bool lumped) {
  RubbleBody body;
  body.centre = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
  const double volume =
      (corners[1] - corners[0]).cross(corners[2] - corners[0]).dot(corners[3] - corners[0]) / 6;
  body.mass = density * volume;
  double radius = 0;
  for (const Vec3& c : corners) {
    const Vec3 arm = c - body.centre;
    // A solid's second moments are a fifth of those of its mass lumped into the corners.
    const double share = (lumped ? 0.25 : 0.05) * body.mass;
    body.inertia += share * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
    radius = std::max(radius, arm.norm());
  }
  const Vec3 centre = body.centre;
  RubbleShape& shape = add_shape(scene, RubbleShape::Kind::tetrahedron, body, radius);
  for (std::size_t k = 0; k < 4; ++k) shape.corner[k] = corners[k] - centre;
}

void add_box(RubbleScene& scene, const Vec3& centre, const Eigen::Quaterniond& turn,
             const Vec3& half, double density) {
  RubbleBody body;
  body.centre = centre;
  body.orientation = turn;
  body.mass = 8 * density * half.prod();
  const Vec3 s = half.cwiseProduct(half) / 3;
  body.inertia = body.mass * Vec3(s[1] + s[2], s[0] + s[2], s[0] + s[1]).asDiagonal();
  add_shape(scene, RubbleShape::Kind::box, body, half.norm()).half_extent = half;
}

void add_ball(RubbleScene& scene, const Vec3& centre, double radius, double density) {
  RubbleBody body;
  body.centre = centre;
  body.mass = density * 4.0 / 3 * 3.14159265358979324 * radius * radius * radius;
  body.inertia = 0.4 * body.mass * radius * radius * Mat3::Identity();
  add_shape(scene, RubbleShape::Kind::ball, body, radius).radius = radius;
}

RubbleScene broken_block(std::array<int, 3> cubes, double cell, const Vec3& low, double speed,
                         unsigned seed) {
  RubbleScene scene = ground();
  const Vec3 size = cell * Vec3(cubes[0], cubes[1], cubes[2]);
  Mat3 turn = Mat3::Identity();
  if (seed != 0) {
    std::mt19937 random(seed);
    std::normal_distribution<double> any;
    turn = Eigen::Quaterniond(any(random), any(random), any(random), any(random))
               .normalized()
               .toRotationMatrix();
  }
  const double lowest = (turn.row(2).cwiseAbs() * (0.5 * size))(0);
  const auto place = [&](int x, int y, int z) -> Vec3 {
    const Vec3 p = turn * (cell * Vec3(x, y, z) - 0.5 * size);
    return p + Vec3(low[0] + 0.5 * size[0], low[1] + 0.5 * size[1], low[2] + lowest);
  };
  constexpr int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}};
  for (int x = 0; x < cubes[0]; ++x) {
    for (int y = 0; y < cubes[1]; ++y) {
      for (int z = 0; z < cubes[2]; ++z) {
        for (const auto& order : orders) {
          int at[3] = {x, y, z};
          std::array<Vec3, 4> corners;
          corners[0] = place(x, y, z);
          for (std::size_t k = 0; k < 3; ++k) {
            ++at[order[k]];
            corners[k + 1] = place(at[0], at[1], at[2]);
          }
          const Vec3 first = corners[1] - corners[0], second = corners[2] - corners[0];
          if (first.cross(second).dot(corners[3] - corners[0]) < 0) {
            std::swap(corners[2], corners[3]);
          }
          add_tetrahedron(scene, corners, 2400);
        }
      }
    }
  }
  for (RubbleBody& body : scene.bodies) body.momentum = body.mass * Vec3(0, 0, -speed);
  return scene;
}

std::vector<SeenPart> parts_of(const RubbleScene& scene) {
  std::vector<SeenPart> parts;
  for (const RubbleShape& shape : scene.shapes) {
    if (shape.kind == RubbleShape::Kind::half_space || shape.kind == RubbleShape::Kind::ball)
      continue;
    const RubbleBody& b = scene.bodies[shape.body];
    parts.push_back({polytope_of(shape, b.centre, b.orientation.toRotationMatrix()), shape.body});
  }
  return parts;
}

double below_ground(std::span<const SeenPart> parts) {
  double below = 0;
  for (const SeenPart& part : parts) {
    for (std::size_t v = 0; v < part.solid.kind->vertices; ++v) {
      below = std::max(below, -part.solid.vertex[v].z());
    }
  }
  return below;
}

Sums sums_of(const RubbleScene& scene, const Vec3& gravity) {
  Sums sums;
  for (const RubbleBody& body : scene.bodies) {
    sums.momentum += body.momentum;
    sums.angular += body.angular_momentum + body.centre.cross(body.momentum);
    sums.kinetic += kinetic_energy(body);
    sums.potential -= body.mass * gravity.dot(body.centre);
  }
  return sums;
}

}  // namespace sunder::test
