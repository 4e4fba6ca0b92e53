// SPDX-License-Identifier: MIT
// Falling asleep and waking.
#include <algorithm>
#include <utility>

#include "mechanics/rubble/rubble_tick.hpp"
#include "topology/base/union_find.hpp"

namespace sunder {
namespace {

/// m/s, the fastest approach of a patch that touches within `time`; negative: none does.
double approach(const Tick& tick, const RubblePatch& patch, double time) {
  const MovingBody& a = tick.scratch.moving[patch.a];
  const MovingBody& b = tick.scratch.moving[patch.b];
  const double fall = time * tick.settings.gravity.norm();
  double fastest = -1;
  for (std::size_t k = 0; k < static_cast<std::size_t>(patch.count); ++k) {
    const Vec3 arm_a = a.turned * patch.point[k].local_a, arm_b = b.turned * patch.point[k].local_b;
    const double speed =
        -patch.normal.dot(a.velocity + a.spin.cross(arm_a) - b.velocity - b.spin.cross(arm_b));
    const double gap = patch.normal.dot(a.centre + arm_a - b.centre - arm_b);
    if (gap - time * (speed + fall) < tick.settings.slop) fastest = std::max({fastest, speed, 0.0});
  }
  return fastest;
}

void wake(Tick& tick, std::uint32_t row) {
  tick.bodies[row].asleep = false;
  // It wakes others once it moves.
  tick.bodies[row].still = tick.settings.length;
  tick.scratch.moving[row] = moving_of(tick.bodies[row]);
}

/// Wakes all bodies connected with `from` by overlapping boxes: a blow goes through all of them.
void wake_all_round(Tick& tick, std::vector<std::uint32_t> from) {
  FindScratch& find = tick.scratch.find;
  std::vector<RowPair> pairs;
  const std::vector<char> all(tick.bodies.size(), 1);
  find_box_pairs(pairs, find.grid, {find.boxes, find.body, all});
  UnionFind joined(tick.bodies.size());
  for (const auto& [i, j] : pairs) {
    const std::uint32_t a = find.body[i], b = find.body[j];
    if (tick.bodies[a].asleep && tick.bodies[b].asleep) joined.join(a, b);
  }
  for (std::uint32_t& row : from) row = joined.root(row);
  std::sort(from.begin(), from.end());
  for (std::uint32_t k = 0; k < tick.bodies.size(); ++k) {
    if (!tick.bodies[k].asleep) continue;
    if (std::binary_search(from.begin(), from.end(), joined.root(k))) wake(tick, k);
  }
}

double surface_speed(const MovingBody& m, const RubbleBody& body) {
  return m.velocity.norm() + m.spin.norm() * body.radius;
}

void fall_asleep(Tick& tick, RubbleBody& body) {
  if (body.in_ledger) tick.report.sleep_energy += kinetic_energy(body);
  tick.report.sleep += impulse_at(body.centre, body.momentum);
  tick.report.sleep.tail<3>() += body.angular_momentum;
  body.momentum.setZero();
  body.angular_momentum.setZero();
  body.asleep = true;
}

}  // namespace

bool wake_touched(Tick& tick, double time) {
  const auto disturbs = [&](const RubbleBody& body) {
    return body.mass > 0 ? !body.asleep && body.still == 0 : !body.velocity.isZero(0);
  };
  std::vector<std::uint32_t> struck, touched;
  for (const RubblePatch& patch : tick.scratch.patches) {
    for (const auto& [sleeper, other] : {std::pair{patch.a, patch.b}, {patch.b, patch.a}}) {
      if (!tick.bodies[sleeper].asleep || !disturbs(tick.bodies[other])) continue;
      const double speed = approach(tick, patch, time);
      if (speed < 0) continue;
      const bool is_blow = tick.bodies[other].mass == 0 || speed > 10 * tick.settings.still_speed;
      (is_blow ? struck : touched).push_back(sleeper);
    }
  }
  if (!struck.empty()) wake_all_round(tick, struck);
  for (const std::uint32_t row : touched) {
    if (tick.bodies[row].asleep) wake(tick, row);
  }
  return !struck.empty() || !touched.empty();
}

void put_to_sleep(Tick& tick) {
  if (!(tick.settings.sleep_after > 0)) return;
  std::vector<char> restless(tick.bodies.size(), 0);
  for (std::size_t k = 0; k < tick.bodies.size(); ++k) {
    RubbleBody& body = tick.bodies[k];
    if (!is_awake(body)) {
      restless[k] = body.mass == 0 && !body.velocity.isZero(0);
      continue;
    }
    const bool still = surface_speed(tick.scratch.moving[k], body) <= tick.settings.still_speed;
    body.still = still ? body.still + tick.settings.length : 0;
    restless[k] = body.still < tick.settings.sleep_after;
  }
  std::vector<char> stays = restless;
  for (const RubblePatch& p : tick.scratch.patches) {
    if (!pushes(p)) continue;
    stays[p.a] = stays[p.a] || restless[p.b];
    stays[p.b] = stays[p.b] || restless[p.a];
  }
  for (std::size_t k = 0; k < tick.bodies.size(); ++k) {
    const bool sleeps = is_awake(tick.bodies[k]) && tick.scratch.pressed[k] && !stays[k];
    if (sleeps) fall_asleep(tick, tick.bodies[k]);
  }
}

}  // namespace sunder
