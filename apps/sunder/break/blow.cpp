// SPDX-License-Identifier: MIT
#include "apps/sunder/break/blow.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "topology/base/elementary.hpp"

namespace sunder {
namespace {

using nlohmann::ordered_json;
using Bounds = Eigen::AlignedBox3d;
using Eigen::Vector3d;

constexpr double standard_gravity = 9.81;
constexpr double steel = 7850;  // kg/m^3

/// A share of the object's size that lies between things that are about to touch.
constexpr double gap_share = 2e-3;

/// The number with six digits, so that scenes can be read.
double plain(double x) { return std::strtod(fmt::format("{:.6g}", x).c_str(), nullptr); }

ordered_json numbers(const Vector3d& v) { return {plain(v[0]), plain(v[1]), plain(v[2])}; }

Vector3d at(const TetMesh& mesh, std::uint32_t row) { return Vector3d(mesh.points[row].data()); }

template <class Turn>
Bounds box_of(const TetMesh& mesh, const Turn& turn) {
  Bounds box;
  for (const auto& t : mesh.tetrahedra) {
    for (const std::uint32_t corner : t) box.extend(turn(at(mesh, corner)));
  }
  return box;
}

/// About x, by degrees.
struct Tilt {
  double s, c;
  explicit Tilt(double degrees) : s(sine(degrees * M_PI / 180)), c(cosine(degrees * M_PI / 180)) {}
  Vector3d operator()(const Vector3d& x) const {
    return {x[0], c * x[1] - s * x[2], s * x[1] + c * x[2]};
  }
};

/// A scene that is being made.
struct Stage {
  ordered_json body, obstacles = ordered_json::array();
  Bounds box;       ///< of the object at rest
  double friction;  ///< of the material
  double duration = 0.015;

  double gap() const { return gap_share * box.sizes().maxCoeff(); }
  void add_plane(const Vector3d& normal, double offset) {
    obstacles.push_back({{"plane", {{"normal", numbers(normal)}, {"offset", plain(offset)}}},
                         {"friction", friction}});
  }
};

void drop(Stage& stage, const TetMesh& mesh, const Blow& blow) {
  const Bounds turned = box_of(mesh, Tilt(blow.tilt));
  if (blow.tilt != 0) stage.body["rotation"] = {{"axis", {1, 0, 0}}, {"angle", blow.tilt}};
  stage.body["translation"] = numbers({0, 0, stage.gap() - turned.min()[2]});
  stage.body["velocity"] = numbers({0, 0, -std::sqrt(2 * standard_gravity * blow.height)});
  stage.add_plane({0, 0, 1}, 0);
}

/// Against a wall, half its height above the ground.
void hurl(Stage& stage, const Blow& blow) {
  stage.body["translation"] = numbers({0, 0, stage.box.sizes()[2] / 2});
  stage.body["velocity"] = numbers({blow.speed, 0, 0});
  stage.add_plane({0, 0, 1}, 0);
  stage.add_plane({-1, 0, 0}, -(stage.box.max()[0] + stage.gap()));
}

void strike(Stage& stage, const Blow& blow) {
  const double radius = blow.ball.diameter / 2;
  Eigen::Index axis = 0;
  stage.box.sizes().minCoeff(&axis);
  // From above, or from the side with the lesser numbers.
  const bool from_above = axis == 2;
  Vector3d center = stage.box.center(), velocity = Vector3d::Zero();
  const double way = radius + stage.gap();
  center[axis] = from_above ? stage.box.max()[axis] + way : stage.box.min()[axis] - way;
  center[2] = std::max(center[2], radius);
  velocity[axis] = from_above ? -blow.ball.speed : blow.ball.speed;
  stage.add_plane({0, 0, 1}, 0);
  stage.obstacles.push_back({{"sphere", {{"center", numbers(center)}, {"radius", plain(radius)}}},
                             {"velocity", numbers(velocity)},
                             {"mass", plain(steel * 4 * M_PI / 3 * radius * radius * radius)},
                             {"friction", stage.friction}});
  stage.duration = std::max(stage.duration, 4 * stage.box.sizes()[axis] / blow.ball.speed);
}

void press(Stage& stage, const Blow& blow) {
  const Vector3d size = stage.box.sizes();
  const double thickness = 0.1 * size[2];
  stage.add_plane({0, 0, 1}, 0);
  const Vector3d center = {0, 0, size[2] + thickness + stage.gap() / 10};
  const Vector3d half = {0.75 * size[0], 0.75 * size[1], thickness};
  stage.obstacles.push_back({{"box", {{"center", numbers(center)}, {"half_extent", numbers(half)}}},
                             {"velocity", numbers({0, 0, -blow.speed})},
                             {"friction", stage.friction}});
  stage.duration = 0.04 * size[2] / blow.speed;
}

/// A box around the part of the object between two shares of its length along one axis, and of its
/// thickness along another. It is widened until it holds three points at least.
Bounds part_of(const TetMesh& mesh, const Bounds& all, Eigen::Index along, Eigen::Index across,
               std::array<double, 2> length, std::array<double, 2> thickness) {
  const double margin = 1e-6 * all.sizes().maxCoeff();
  for (double wider = 0;; wider += 0.02) {
    Bounds part(all.min().array() - margin, all.max().array() + margin);
    const Vector3d low = all.min(), size = all.sizes();
    part.min()[along] = low[along] + (length[0] - wider) * size[along] - margin;
    part.max()[along] = low[along] + (length[1] + wider) * size[along] + margin;
    part.min()[across] = low[across] + (thickness[0] - wider) * size[across] - margin;
    part.max()[across] = low[across] + (thickness[1] + wider) * size[across] + margin;
    const auto inside = std::ranges::count_if(
        mesh.points, [&](const Point& p) { return part.contains(Vector3d(p.data())); });
    if (inside >= 3 || wider > 1) return part;
  }
}

void bend(Stage& stage, const TetMesh& mesh, const Blow& blow) {
  constexpr std::array<const char*, 3> names = {"x", "y", "z"};
  const Vector3d size = stage.box.sizes();
  Eigen::Index along = 0, across = 0;
  size.maxCoeff(&along);
  size.minCoeff(&across);
  if (across == along) across = (along + 1) % 3;
  Vector3d down = Vector3d::Zero();
  down[across] = -blow.speed;
  const auto hold = [&](const Bounds& part, const ordered_json& axes, const Vector3d& velocity) {
    ordered_json held = {{"minimum", numbers(part.min())}, {"maximum", numbers(part.max())}};
    if (!axes.empty()) held["axes"] = axes;
    if (!velocity.isZero(0)) held["velocity"] = numbers(velocity);
    stage.body["held"].push_back(std::move(held));
  };
  const ordered_json across_only = {names[static_cast<std::size_t>(across)]};
  const std::array<double, 2> below = {0, 0.3}, above = {0.7, 1};
  hold(part_of(mesh, stage.box, along, across, {0, 0.05}, below), across_only, Vector3d::Zero());
  hold(part_of(mesh, stage.box, along, across, {0.95, 1}, below), across_only, Vector3d::Zero());
  hold(part_of(mesh, stage.box, along, across, {0.475, 0.525}, above), across_only, down);
  stage.body["translation"] = numbers({0, 0, size[2]});
  stage.add_plane({0, 0, 1}, 0);
  stage.duration = 0.01 * size[along] / blow.speed;
}

/// 1 to 200 us: short compared with the time in which things that break come apart.
double usual_step(double duration) { return plain(std::clamp(duration / 75, 1e-6, 2e-4)); }

}  // namespace

void set_down(TetMesh& mesh, double metres, UpAxis up) {
  const auto turned = [&](const Vector3d& x) -> Vector3d {
    switch (up) {
      case UpAxis::x:
        return {-x[2], x[1], x[0]};
      case UpAxis::minus_x:
        return {x[2], x[1], -x[0]};
      case UpAxis::y:
        return {x[0], -x[2], x[1]};
      case UpAxis::minus_y:
        return {x[0], x[2], -x[1]};
      case UpAxis::minus_z:
        return {x[0], -x[1], -x[2]};
      case UpAxis::z:
        break;
    }
    return x;
  };
  const Bounds box = box_of(mesh, turned);
  const Vector3d foot = {box.center()[0], box.center()[1], box.min()[2]};
  for (Point& p : mesh.points) {
    const Vector3d x = (turned(Vector3d(p.data())) - foot) * metres;
    p = {x[0], x[1], x[2]};
  }
}

ordered_json break_scene(const BrokenThing& thing, const Blow& blow, const BreakTimes& times,
                         bool with_pictures) {
  Stage stage;
  stage.friction = thing.material.friction;
  stage.box = box_of(thing.mesh, [](const Vector3d& x) { return x; });
  stage.body = {{"name", thing.name}, {"mesh", thing.file}, {"material", thing.material.name}};
  switch (blow.kind) {
    case BlowKind::drop:
      drop(stage, thing.mesh, blow);
      break;
    case BlowKind::hurl:
      hurl(stage, blow);
      break;
    case BlowKind::strike:
      strike(stage, blow);
      break;
    case BlowKind::press:
      press(stage, blow);
      break;
    case BlowKind::bend:
      bend(stage, thing.mesh, blow);
      break;
  }
  const double duration = times.duration ? *times.duration : plain(stage.duration);
  ordered_json scene = {
      {"name", thing.name},
      {"description", fmt::format("{} of {} is {}. Made by `sunder break`.", thing.name,
                                  thing.material.name, blow_words(blow))},
      {"accuracy", "preview"},
      {"bodies", {stage.body}},
      {"obstacles", stage.obstacles},
      {"contact", {{"friction", thing.material.friction}}},
      {"time_step", times.step ? *times.step : usual_step(duration)},
      {"duration", duration},
      {"output", {{"frames", film_frames}, {"crack_surface", "smooth"}}}};
  if (with_pictures) scene["output"]["pictures"]["count"] = 6;
  return scene;
}

std::string blow_words(const Blow& blow) {
  switch (blow.kind) {
    case BlowKind::drop:
      return fmt::format("dropped from {}", length_words(blow.height));
    case BlowKind::hurl:
      return fmt::format("thrown at a wall with {:.3g} m/s", blow.speed);
    case BlowKind::strike:
      return fmt::format("struck by a steel ball of {} with {:.3g} m/s",
                         length_words(blow.ball.diameter), blow.ball.speed);
    case BlowKind::press:
      return fmt::format("pressed at {:.3g} m/s", blow.speed);
    case BlowKind::bend:
      return fmt::format("bent at {:.3g} m/s", blow.speed);
  }
  return {};
}

}  // namespace sunder
