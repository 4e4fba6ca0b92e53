// SPDX-License-Identifier: MIT
// Held boxes to prescribed motions.
#include "fracture/strength/held_boxes.hpp"

#include <map>

#include "mechanics/state/supports.hpp"

namespace sunder {
namespace {

bool contains(const HeldBox& box, const Vec3& p) {
  return (p.array() >= box.minimum.array()).all() && (p.array() <= box.maximum.array()).all();
}

/// The effect of one box alone.
Holders alone(std::span<const HeldBox> boxes, std::size_t box) {
  const AxisSet axes = axes_of(boxes[box]);
  Holders holders;
  for (std::size_t axis = 0; axis < 3; ++axis) holders[axis] = axes[axis] ? box : no_holder;
  return holders;
}

/// Along each axis the velocity of the box that holds it.
PrescribedMotion motion_of(const Holders& holders, std::span<const HeldBox> boxes,
                           const Eigen::Quaterniond& rotation) {
  PrescribedMotion motion;
  bool is_one = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    motion.axes[axis] = holders[axis] != no_holder;
    is_one = is_one && holders[axis] == holders[0];
  }
  bool is_raised = false;
  const auto add = [&](std::size_t box, const Vec3& velocity) {
    motion.velocity += velocity;
    motion.raised.push_back({velocity, boxes[box].ramp_time});
    is_raised = is_raised || boxes[box].ramp_time > 0;
  };
  if (is_one) add(holders[0], boxes[holders[0]].velocity);
  for (int axis = 0; axis < 3 && !is_one; ++axis) {
    const std::size_t box = holders[static_cast<std::size_t>(axis)];
    if (box == no_holder) continue;
    const Vec3 along = rotation * Vec3::Unit(axis);
    add(box, along.dot(boxes[box].velocity) * along);
  }
  if (is_raised) {
    motion.velocity = mean_velocity(motion, 0, 0);
  } else {
    motion.raised.clear();
  }
  return motion;
}

}  // namespace

AxisSet axes_of(const HeldBox& box) {
  if (box.axes.empty()) return {true, true, true};
  AxisSet axes{};
  for (const Axis axis : box.axes) axes[static_cast<std::size_t>(axis)] = true;
  return axes;
}

bool is_partial(const HeldBox& box) { return axes_of(box) != AxisSet{true, true, true}; }

Holders holders_of(std::span<const HeldBox> boxes, const Vec3& rest) {
  Holders holders = {no_holder, no_holder, no_holder};
  for (std::size_t box = 0; box < boxes.size(); ++box) {
    if (!contains(boxes[box], rest)) continue;
    const AxisSet axes = axes_of(boxes[box]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (axes[axis]) holders[axis] = box;
    }
  }
  return holders;
}

void hold_vertices(MechanicsState& mechanics, std::span<const VertexId> vertices,
                   std::span<const HeldBox> boxes, const Eigen::Quaterniond& rotation) {
  std::map<Holders, MotionId> motions;
  const auto motion_for = [&](const Holders& holders) {
    const auto [place, is_new] = motions.try_emplace(holders, MotionId{mechanics.motions.size()});
    if (is_new) mechanics.motions.push_back(motion_of(holders, boxes, rotation));
    return place->second;
  };
  for (std::size_t box = 0; box < boxes.size(); ++box) motion_for(alone(boxes, box));
  for (const VertexId v : vertices) {
    const Holders holders = holders_of(boxes, mechanics.vertices.rest_position[v.index()]);
    if (holders == Holders{no_holder, no_holder, no_holder}) continue;
    mechanics.vertices.support[v.index()] = motion_for(holders);
  }
}

}  // namespace sunder
