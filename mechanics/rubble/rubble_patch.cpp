// SPDX-License-Identifier: MIT
// Rows of patches: normal rows by point, friction and twist by patch.
#include "mechanics/rubble/rubble_patch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sunder {
namespace {

void push(MovingBody& a, MovingBody& b, const RubblePatch::Point& p, const Vec3& normal,
          double impulse) {
  a.velocity += a.inverse_mass * impulse * normal;
  a.spin += impulse * p.turn_a;
  b.velocity -= b.inverse_mass * impulse * normal;
  b.spin -= impulse * p.turn_b;
}

void drag(MovingBody& a, MovingBody& b, const RubblePatch& patch, const Vec3& impulse,
          double twist) {
  a.velocity += a.inverse_mass * impulse;
  a.spin += a.inverse_inertia * (patch.arm_a.cross(impulse) + twist * patch.normal);
  b.velocity -= b.inverse_mass * impulse;
  b.spin -= b.inverse_inertia * (patch.arm_b.cross(impulse) + twist * patch.normal);
}

/// Change of the relative velocity along `way` by a unit impulse along it, 1/kg.
double answer(const MovingBody& a, const MovingBody& b, const Vec3& arm_a, const Vec3& arm_b,
              const Vec3& way) {
  const Vec3 ra = arm_a.cross(way), rb = arm_b.cross(way);
  return a.inverse_mass + b.inverse_mass + ra.dot(a.inverse_inertia * ra) +
         rb.dot(b.inverse_inertia * rb);
}

double over(double x) { return x > 0 ? 1 / x : 0; }

void prepare(RubblePatch& patch, const MovingBody& a, const MovingBody& b) {
  Vec3 middle = Vec3::Zero();
  const Vec3& n = patch.normal;
  for (int k = 0; k < patch.count; ++k) {
    RubblePatch::Point& p = patch.point[static_cast<std::size_t>(k)];
    const Vec3 at_a = a.centre + a.turned * p.local_a, at_b = b.centre + b.turned * p.local_b;
    p.separation = n.dot(at_a - at_b);
    // Both are pushed at one place: angular momentum is kept.
    const Vec3 at = 0.5 * (at_a + at_b);
    middle += at;
    p.arm_a = at - a.centre;
    p.arm_b = at - b.centre;
    const Vec3 ra = p.arm_a.cross(n), rb = p.arm_b.cross(n);
    p.turn_a = a.inverse_inertia * ra;
    p.turn_b = b.inverse_inertia * rb;
    p.response = over(a.inverse_mass + b.inverse_mass + ra.dot(p.turn_a) + rb.dot(p.turn_b));
  }
  middle /= patch.count;
  patch.arm_a = middle - a.centre;
  patch.arm_b = middle - b.centre;
  patch.friction_response = over(std::max(answer(a, b, patch.arm_a, patch.arm_b, patch.along),
                                          answer(a, b, patch.arm_a, patch.arm_b, patch.across)));
  patch.twist_response = over(n.dot((a.inverse_inertia + b.inverse_inertia) * n));
  patch.reach = 0;
  for (int k = 0; k < patch.count; ++k) {
    patch.reach += (patch.point[static_cast<std::size_t>(k)].arm_a - patch.arm_a).norm();
  }
  patch.reach /= patch.count;
}

void sweep(RubblePatch& patch, MovingBody& a, MovingBody& b, const SweepRule& rule) {
  double pressed = 0;
  for (int k = 0; k < patch.count; ++k) {
    pressed += patch.point[static_cast<std::size_t>(k)].impulse;
  }
  if (patch.friction > 0) {
    const Vec3 slip =
        a.velocity + a.spin.cross(patch.arm_a) - b.velocity - b.spin.cross(patch.arm_b);
    const double most = patch.friction * pressed;
    std::array<double, 2> wanted = {
        patch.slip_impulse[0] - patch.friction_response * slip.dot(patch.along),
        patch.slip_impulse[1] - patch.friction_response * slip.dot(patch.across)};
    const double size = std::sqrt(wanted[0] * wanted[0] + wanted[1] * wanted[1]);
    if (size > most) {
      wanted[0] *= most / size;
      wanted[1] *= most / size;
    }
    const double turning = patch.normal.dot(a.spin - b.spin);
    const double twist = std::clamp(patch.twist_impulse - patch.twist_response * turning,
                                    -most * patch.reach, most * patch.reach);
    const Vec3 change = (wanted[0] - patch.slip_impulse[0]) * patch.along +
                        (wanted[1] - patch.slip_impulse[1]) * patch.across;
    drag(a, b, patch, change, twist - patch.twist_impulse);
    patch.slip_impulse = wanted;
    patch.twist_impulse = twist;
  }
  for (int k = 0; k < patch.count; ++k) {
    RubblePatch::Point& p = patch.point[static_cast<std::size_t>(k)];
    const double speed =
        patch.normal.dot(a.velocity + a.spin.cross(p.arm_a) - b.velocity - b.spin.cross(p.arm_b));
    // Apart: it may come as near as the gap. Overlapped: it goes away by a share.
    double wanted = -p.separation * rule.over_step, share = 1, leak = 0;
    if (p.separation <= 0) {
      wanted = std::min(rule.rate * std::max(0.0, -p.separation - rule.slop), rule.push);
      share = rule.share;
      leak = rule.leak;
    }
    const double change = p.response * share * (wanted - speed) - leak * p.impulse;
    const double impulse = std::max(0.0, p.impulse + change);
    push(a, b, p, patch.normal, impulse - p.impulse);
    p.impulse = impulse;
  }
}

}  // namespace

SweepRule pushing_rule(double sub_step, double slop, double push) {
  // A quarter turn of the spring a sub-step, five times overdamped: stiffer ones make towers
  // tremble, softer ones let them buckle (docs/lab/rubble_measured.md).
  constexpr double turn = 0.5 * std::numbers::pi, damping = 5;
  constexpr double a1 = 2 * damping + turn, a2 = turn * a1;
  return {1 / sub_step, turn / a1 / sub_step, a2 / (1 + a2), 1 / (1 + a2), slop, push};
}

SweepRule relaxing_rule(double sub_step) { return {.over_step = 1 / sub_step}; }

void prepare_patches(std::span<RubblePatch> patches, std::span<const MovingBody> bodies) {
  for (RubblePatch& patch : patches) prepare(patch, bodies[patch.a], bodies[patch.b]);
}

void note_blows(std::span<RubbleBlow> blows, std::span<const RubblePatch> patches,
                std::span<const MovingBody> bodies, double time) {
  for (const RubblePatch& patch : patches) {
    const MovingBody &a = bodies[patch.a], &b = bodies[patch.b];
    for (int k = 0; k < patch.count; ++k) {
      const RubblePatch::Point& p = patch.point[static_cast<std::size_t>(k)];
      const Vec3 apart = a.velocity + a.spin.cross(p.arm_a) - b.velocity - b.spin.cross(p.arm_b);
      const double approach = -patch.normal.dot(apart);
      if (!(approach > 0) || p.separation > time * approach) continue;
      for (const std::uint32_t body : {patch.a, patch.b}) {
        blows[body].speed = std::max(blows[body].speed, approach);
        blows[body].energy += 0.5 * p.response * approach * approach;
      }
    }
  }
}

void warm_start(std::span<const RubblePatch> patches, std::span<MovingBody> bodies) {
  for (const RubblePatch& patch : patches) {
    MovingBody& a = bodies[patch.a];
    MovingBody& b = bodies[patch.b];
    for (int k = 0; k < patch.count; ++k) {
      const RubblePatch::Point& p = patch.point[static_cast<std::size_t>(k)];
      push(a, b, p, patch.normal, p.impulse);
    }
    drag(a, b, patch, patch.slip_impulse[0] * patch.along + patch.slip_impulse[1] * patch.across,
         patch.twist_impulse);
  }
}

void sweep_patches(std::span<RubblePatch> patches, std::span<const std::uint32_t> order,
                   std::span<MovingBody> bodies, const SweepRule& rule) {
  const auto take = [&](std::uint32_t row) {
    sweep(patches[row], bodies[patches[row].a], bodies[patches[row].b], rule);
  };
  for (const std::uint32_t row : order) take(row);
  for (std::size_t k = order.size(); k-- > 0;) take(order[k]);
}

}  // namespace sunder
