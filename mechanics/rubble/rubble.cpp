// SPDX-License-Identifier: MIT
// A tick: patches, sub-steps, memory, islands, sleep.
#include "mechanics/rubble/rubble.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "mechanics/integrators/rigid_motion.hpp"
#include "mechanics/rubble/rubble_find.hpp"
#include "mechanics/rubble/rubble_patch.hpp"
#include "topology/base/union_find.hpp"

namespace sunder {

struct RubbleScratch::Buffers {
  FindScratch find;
  std::vector<MovingBody> moving;
  std::vector<RubblePatch> patches;
  std::vector<char> pressed;  ///< row = body: in a patch
  std::vector<Vec3> velocity, spin;  ///< before contact, row = body
};

RubbleScratch::RubbleScratch() : buffers(std::make_unique<Buffers>()) {}
RubbleScratch::~RubbleScratch() = default;
RubbleScratch::RubbleScratch(RubbleScratch&&) noexcept = default;
RubbleScratch& RubbleScratch::operator=(RubbleScratch&&) noexcept = default;

namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

bool is_awake(const RubbleBody& body) { return body.mass > 0 && !body.asleep; }

void turn(MovingBody& m, const RubbleBody& body) {
  m.turned = body.orientation.toRotationMatrix();
  if (!is_awake(body)) return;
  m.inverse_inertia = m.turned * body.inertia.inverse() * m.turned.transpose();
  m.spin = m.inverse_inertia * body.angular_momentum;
}

MovingBody moving_of(const RubbleBody& body) {
  MovingBody m;
  m.centre = body.centre;
  m.velocity = body.velocity;
  if (is_awake(body)) {
    m.inverse_mass = 1 / body.mass;
    m.velocity = body.momentum / body.mass;
  } else if (body.mass > 0) {
    m.velocity.setZero();
  }
  turn(m, body);
  return m;
}

/// One tick at work.
struct Tick {
  std::span<RubbleBody> bodies;
  std::span<const RubbleShape> shapes;
  RubbleMemory& memory;
  const RubbleSettings& settings;
  RubbleScratch::Buffers& scratch;
  RubbleReport report;

  double sub_step() const { return settings.length / settings.sub_steps; }
};

/// m/s, the fastest approach of a patch that touches within `time`; negative: none does.
double approach(const Tick& tick, const RubblePatch& patch, double time) {
  const MovingBody& a = tick.scratch.moving[patch.a];
  const MovingBody& b = tick.scratch.moving[patch.b];
  const double fall = time * tick.settings.gravity.norm();
  double fastest = -1;
  for (std::size_t k = 0; k < static_cast<std::size_t>(patch.count); ++k) {
    const Vec3 arm_a = a.turned * patch.point[k].local_a, arm_b = b.turned * patch.point[k].local_b;
    const double speed = -patch.normal.dot(a.velocity + a.spin.cross(arm_a) - b.velocity -
                                           b.spin.cross(arm_b));
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

/// Wakes whatever hangs together with `from` by boxes that overlap: a blow goes through all of it.
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

/// Wakes what is touched by what is not still; by a blow, all that hangs together. Whether any was.
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

/// Patches of what may touch within `time`.
void find(Tick& tick, double time) {
  const FindInput input{tick.bodies, tick.scratch.moving, tick.shapes, tick.settings, time};
  do {
    const auto start = Clock::now();
    find_pairs(tick.scratch.find, input);
    tick.report.broad_ms += ms_since(start);
    tick.report.pairs = static_cast<std::uint32_t>(tick.scratch.find.pairs.size());
    const auto narrow = Clock::now();
    find_patches(tick.scratch.patches, tick.scratch.find, input, tick.memory);
    tick.report.narrow_ms += ms_since(narrow);
  } while (wake_touched(tick, time));
  tick.scratch.pressed.assign(tick.bodies.size(), 0);
  for (const RubblePatch& p : tick.scratch.patches) {
    tick.scratch.pressed[p.a] = tick.scratch.pressed[p.b] = 1;
  }
}

void note_velocities(Tick& tick) {
  tick.scratch.velocity.resize(tick.bodies.size());
  tick.scratch.spin.resize(tick.bodies.size());
  for (std::size_t k = 0; k < tick.bodies.size(); ++k) {
    tick.scratch.velocity[k] = tick.scratch.moving[k].velocity;
    tick.scratch.spin[k] = tick.scratch.moving[k].spin;
  }
}

/// Momenta of what contact has pushed, and the work of that: each impulse times the mean velocity.
void take_impulses(Tick& tick) {
  for (std::size_t k = 0; k < tick.bodies.size(); ++k) {
    RubbleBody& body = tick.bodies[k];
    if (!is_awake(body) || !tick.scratch.pressed[k]) continue;
    const MovingBody& m = tick.scratch.moving[k];
    const Vec3 impulse = body.mass * (m.velocity - tick.scratch.velocity[k]);
    const Mat3 inertia = m.turned * body.inertia * m.turned.transpose();
    const Vec3 turning = inertia * (m.spin - tick.scratch.spin[k]);
    body.momentum += impulse;
    body.angular_momentum += turning;
    tick.report.contact_work += 0.5 * (impulse.dot(m.velocity + tick.scratch.velocity[k]) +
                                       turning.dot(m.spin + tick.scratch.spin[k]));
  }
}

/// Weight for one sub-step.
void fall(Tick& tick) {
  const Vec3 change = tick.sub_step() * tick.settings.gravity;
  for (std::size_t k = 0; k < tick.bodies.size(); ++k) {
    RubbleBody& body = tick.bodies[k];
    if (!is_awake(body)) continue;
    MovingBody& m = tick.scratch.moving[k];
    tick.report.numerical -= body.mass * change.dot(m.velocity + 0.5 * change);
    m.velocity += change;
    body.momentum += body.mass * change;
  }
}

/// Places after a sub-step. What touches nothing flies on its parabola.
void move(Tick& tick) {
  const double h = tick.sub_step();
  const Vec3 lag = 0.5 * h * h * tick.settings.gravity;
  for (std::size_t k = 0; k < tick.bodies.size(); ++k) {
    RubbleBody& body = tick.bodies[k];
    MovingBody& m = tick.scratch.moving[k];
    if (!is_awake(body)) {
      if (body.mass == 0) m.centre = body.centre += h * body.velocity;
      continue;
    }
    Vec3 way = h * m.velocity;
    if (!tick.scratch.pressed[k]) way -= lag;
    const double work = body.mass * tick.settings.gravity.dot(way);
    tick.report.gravity_work += work;
    tick.report.numerical += work;
    m.centre = body.centre += way;
    if (m.spin.isZero(0)) continue;
    body.orientation =
        turn_through_step(body.orientation, {body.inertia, Vec3::Zero(), body.angular_momentum,
                                             body.angular_momentum, h});
    turn(m, body);
  }
}

bool keeps_still(const Tick& tick, std::uint64_t key) {
  const auto at = std::ranges::lower_bound(tick.shapes, key, {}, &RubbleShape::key);
  return at != tick.shapes.end() && at->key == key && !tick.scratch.find.moves[at->body];
}

RubbleMemory::Pair memory_of(const Tick& tick, const RubblePatch& patch) {
  RubbleMemory::Pair pair;
  pair.a = tick.shapes[patch.shape_a].key;
  pair.b = tick.shapes[patch.shape_b].key;
  pair.count = patch.count;
  for (std::size_t k = 0; k < static_cast<std::size_t>(patch.count); ++k) {
    pair.feature[k] = patch.point[k].feature;
    pair.impulse[k] = patch.point[k].impulse;
  }
  pair.friction = patch.slip_impulse[0] * patch.along + patch.slip_impulse[1] * patch.across;
  pair.twist = patch.twist_impulse;
  pair.sub_step = tick.sub_step();
  return pair;
}

/// Patches as they are, and those of the last tick between what keeps still: what wakes goes on
/// with them.
void remember(Tick& tick) {
  std::vector<RubbleMemory::Pair>& pairs = tick.memory.pairs;
  std::erase_if(pairs, [&](const RubbleMemory::Pair& p) {
    return !keeps_still(tick, p.a) || !keeps_still(tick, p.b);
  });
  const auto kept = static_cast<std::ptrdiff_t>(pairs.size());
  // Sorted, since shapes are sorted by key and patches by row.
  for (const RubblePatch& patch : tick.scratch.patches) pairs.push_back(memory_of(tick, patch));
  std::inplace_merge(pairs.begin(), pairs.begin() + kept, pairs.end(),
                     [](const RubbleMemory::Pair& p, const RubbleMemory::Pair& q) {
                       return std::pair(p.a, p.b) < std::pair(q.a, q.b);
                     });
}

double surface_speed(const MovingBody& m, const RubbleBody& body) {
  return m.velocity.norm() + m.spin.norm() * body.radius;
}

void fall_asleep(Tick& tick, RubbleBody& body) {
  tick.report.sleep_energy += kinetic_energy(body);
  tick.report.sleep_momentum += body.momentum;
  tick.report.sleep_angular += body.angular_momentum + body.centre.cross(body.momentum);
  body.momentum.setZero();
  body.angular_momentum.setZero();
  body.asleep = true;
}

/// What lies still, and touches only what does, sleeps: one that spins keeps its neighbours awake
/// and no others.
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
    const bool pushes = std::any_of(p.point.begin(), p.point.begin() + p.count,
                                    [](const RubblePatch::Point& point) { return point.impulse > 0; });
    if (!pushes) continue;
    stays[p.a] = stays[p.a] || restless[p.b];
    stays[p.b] = stays[p.b] || restless[p.a];
  }
  for (std::size_t k = 0; k < tick.bodies.size(); ++k) {
    const bool sleeps = is_awake(tick.bodies[k]) && tick.scratch.pressed[k] && !stays[k];
    if (sleeps) fall_asleep(tick, tick.bodies[k]);
  }
}

/// How often patches are found anew: while things fly far in a tick.
int rounds_of(const Tick& tick) {
  double way = 0, size = 0;
  std::size_t count = 0;
  for (std::size_t k = 0; k < tick.bodies.size(); ++k) {
    const RubbleBody& body = tick.bodies[k];
    if (!is_awake(body)) continue;
    way = std::max(way, tick.settings.length * tick.scratch.moving[k].velocity.norm());
    size += body.radius;
    ++count;
  }
  if (count == 0) return 1;
  const double far = way * static_cast<double>(count) / size;
  int rounds = 1;
  while (rounds < far && 2 * rounds <= tick.settings.sub_steps) rounds *= 2;
  return rounds;
}

void take_round(Tick& tick, int sub_steps) {
  find(tick, sub_steps * tick.sub_step());
  const auto start = Clock::now();
  auto& [find, moving, patches, pressed, velocity, spin] = tick.scratch;
  double size = 0;
  for (const RubbleBody& body : tick.bodies) size = std::max(size, is_awake(body) ? body.radius : 0);
  // A fifth of an overlap a sub-step: more rings, less lasts (docs/rubble.md).
  const double over_step = 1 / tick.sub_step();
  const SweepRule pushing{over_step, 0.2 * over_step, tick.settings.slop, 3 * size};
  const SweepRule relaxing{over_step};
  prepare_patches(patches, moving);
  for (int k = 0; k < sub_steps; ++k) {
    fall(tick);
    note_velocities(tick);
    warm_start(patches, moving);
    sweep_patches(patches, moving, pushing);
    take_impulses(tick);
    move(tick);
    prepare_patches(patches, moving);
    note_velocities(tick);
    sweep_patches(patches, moving, relaxing);
    take_impulses(tick);
  }
  remember(tick);
  tick.report.solve_ms += ms_since(start);
}

void note_touches(std::vector<RubbleTouch>& touches, const Tick& tick) {
  for (const RubblePatch& p : tick.scratch.patches) {
    Vec3 impulse = p.slip_impulse[0] * p.along + p.slip_impulse[1] * p.across;
    for (int k = 0; k < p.count; ++k) {
      impulse += p.point[static_cast<std::size_t>(k)].impulse * p.normal;
    }
    if (!impulse.isZero(0)) touches.push_back({p.a, p.b, impulse});
  }
}

}  // namespace

double kinetic_energy(const RubbleBody& body) {
  if (body.mass == 0) return 0;
  const Vec3 l = body.orientation.conjugate() * body.angular_momentum;
  return 0.5 * (body.momentum.squaredNorm() / body.mass + l.dot(body.inertia.inverse() * l));
}

Polytope polytope_of(const RubbleShape& shape, const Vec3& centre, const Mat3& turned) {
  if (shape.kind == RubbleShape::Kind::box) return make_box(centre, turned, shape.half_extent);
  std::array<Vec3, 4> corners;
  for (std::size_t k = 0; k < 4; ++k) corners[k] = centre + turned * shape.corner[k];
  return make_tetrahedron(corners, shape.outer_faces);
}

RubbleReport advance_rubble(std::span<RubbleBody> bodies, std::span<const RubbleShape> shapes,
                            RubbleMemory& memory, const RubbleSettings& settings,
                            RubbleScratch& scratch, std::vector<RubbleTouch>* touches) {
  Tick tick{bodies, shapes, memory, settings, *scratch.buffers, {}};
  if (touches) touches->clear();
  const bool rests = std::ranges::all_of(bodies, [](const RubbleBody& body) {
    return body.mass > 0 ? body.asleep : body.velocity.isZero(0);
  });
  if (rests) {
    for (const RubbleBody& body : bodies) tick.report.asleep += body.mass > 0;
    return tick.report;
  }
  tick.scratch.moving.clear();
  for (const RubbleBody& body : bodies) tick.scratch.moving.push_back(moving_of(body));
  const int rounds = rounds_of(tick);
  for (int k = 0; k < rounds; ++k) take_round(tick, settings.sub_steps / rounds);
  for (const RubblePatch& p : tick.scratch.patches) {
    ++tick.report.manifolds;
    tick.report.points += static_cast<std::uint32_t>(p.count);
    for (int k = 0; k < p.count; ++k) {
      tick.report.deepest =
          std::max(tick.report.deepest, -p.point[static_cast<std::size_t>(k)].separation);
    }
  }
  if (touches) note_touches(*touches, tick);
  put_to_sleep(tick);
  for (const RubbleBody& body : bodies) {
    if (body.mass > 0) ++(body.asleep ? tick.report.asleep : tick.report.awake);
  }
  return tick.report;
}

}  // namespace sunder
