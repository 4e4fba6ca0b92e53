// SPDX-License-Identifier: MIT
// Rows of patches: normal rows by point, friction and twist by patch.
#include "mechanics/rubble/rubble_patch.hpp"

#include <algorithm>
#include <cmath>

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

/// What a unit impulse along `way` does to the relative velocity along it, 1/kg.
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

void sweep(RubblePatch& patch, MovingBody& a, MovingBody& b, const SweepRule& rows) {
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
    const double speed = patch.normal.dot(a.velocity + a.spin.cross(p.arm_a) - b.velocity -
                                          b.spin.cross(p.arm_b));
    // Apart: it may come as near as the gap. Overlapped: it goes away by a share.
    double wanted = -p.separation * rows.over_step;
    if (p.separation <= 0) {
      wanted = std::min(rows.rate * std::max(0.0, -p.separation - rows.slop), rows.push);
    }
    const double impulse = std::max(0.0, p.impulse + p.response * (wanted - speed));
    push(a, b, p, patch.normal, impulse - p.impulse);
    p.impulse = impulse;
  }
}

}  // namespace

void prepare_patches(std::span<RubblePatch> patches, std::span<const MovingBody> bodies) {
  for (RubblePatch& patch : patches) prepare(patch, bodies[patch.a], bodies[patch.b]);
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

void sweep_patches(std::span<RubblePatch> patches, std::span<MovingBody> bodies,
                   const SweepRule& rows) {
  for (RubblePatch& patch : patches) sweep(patch, bodies[patch.a], bodies[patch.b], rows);
}

}  // namespace sunder
