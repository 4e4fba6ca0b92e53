// SPDX-License-Identifier: MIT
// A tick: patches, sub-steps, memory.
#include "mechanics/rubble/rubble.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <utility>

#include "mechanics/integrators/rigid_motion.hpp"
#include "mechanics/rubble/rubble_tick.hpp"

namespace sunder {

RubbleScratch::RubbleScratch() : buffers(std::make_unique<Buffers>()) {}
RubbleScratch::~RubbleScratch() = default;
RubbleScratch::RubbleScratch(RubbleScratch&&) noexcept = default;
RubbleScratch& RubbleScratch::operator=(RubbleScratch&&) noexcept = default;

namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

void turn(MovingBody& m, const RubbleBody& body) {
  m.turned = body.orientation.toRotationMatrix();
  if (!is_awake(body)) return;
  m.inverse_inertia = m.turned * body.inertia.inverse() * m.turned.transpose();
  m.spin = m.inverse_inertia * body.angular_momentum;
}

/// Patches of bodies that may touch within `time`.
void find(Tick& tick, double time) {
  const FindInput input{tick.bodies,   tick.scratch.moving, tick.shapes,
                        tick.partners, tick.settings,       time};
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
    for (int k = 0; k < p.count; ++k) {
      tick.report.deepest =
          std::max(tick.report.deepest, -p.point[static_cast<std::size_t>(k)].separation);
    }
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

/// Momenta of bodies pushed by contact, and the work on them: each impulse times the mean velocity.
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
    Impulse given = impulse_at(m.centre, impulse);
    given.tail<3>() += turning;
    tick.report.contact += given;
    if (!body.in_ledger) {
      tick.report.given[k] += given;
      continue;
    }
    tick.report.contact_work += 0.5 * (impulse.dot(m.velocity + tick.scratch.velocity[k]) +
                                       turning.dot(m.spin + tick.scratch.spin[k]));
  }
}

/// Impulse of a patch on its body `a`, whose mass centre is at `centre`.
Impulse impulse_on_a(const RubblePatch& p, const Vec3& centre) {
  Impulse given =
      impulse_at(centre + p.arm_a, p.slip_impulse[0] * p.along + p.slip_impulse[1] * p.across);
  given.tail<3>() += p.twist_impulse * p.normal;
  for (int k = 0; k < p.count; ++k) {
    const RubblePatch::Point& point = p.point[static_cast<std::size_t>(k)];
    given += impulse_at(centre + point.arm_a, point.impulse * p.normal);
  }
  return given;
}

/// Adds `sign` times the present impulses of patches on driven bodies, at their present places.
/// Around a sweep with signs -1 and 1 this adds the change of the impulses.
void note_driven(Tick& tick, double sign) {
  for (const RubblePatch& p : tick.scratch.patches) {
    const bool drives_a = tick.bodies[p.a].mass == 0, drives_b = tick.bodies[p.b].mass == 0;
    if (!drives_a && !drives_b) continue;
    const Impulse on_a = impulse_on_a(p, tick.scratch.moving[p.a].centre);
    if (drives_a) tick.report.given[p.a] += sign * on_a;
    if (drives_b) tick.report.given[p.b] -= sign * on_a;
  }
}

/// Weight for one sub-step.
void fall(Tick& tick) {
  const Vec3 change = tick.sub_step() * tick.settings.gravity;
  for (std::size_t k = 0; k < tick.bodies.size(); ++k) {
    RubbleBody& body = tick.bodies[k];
    if (!is_awake(body)) continue;
    MovingBody& m = tick.scratch.moving[k];
    if (body.in_ledger) {
      tick.report.numerical -= body.mass * change.dot(m.velocity + 0.5 * change);
    }
    m.velocity += change;
    body.momentum += body.mass * change;
    tick.report.gravity += impulse_at(m.centre, body.mass * change);
  }
}

/// Places after a sub-step. A body without contact flies on its parabola.
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
    if (body.in_ledger) {
      tick.report.gravity_work += work;
      tick.report.numerical += work;
    }
    m.centre = body.centre += way;
    // A parabola: its weight acts half-way.
    tick.report.gravity.tail<3>() += way.cross(body.momentum);
    if (m.spin.isZero(0)) continue;
    body.orientation = turn_through_step(
        body.orientation,
        {body.inertia, Vec3::Zero(), body.angular_momentum, body.angular_momentum, h});
    turn(m, body);
  }
}

bool keeps_still(const Tick& tick, std::uint64_t key) {
  const auto at = std::ranges::lower_bound(tick.shapes, key, {}, &RubbleShape::key);
  return at != tick.shapes.end() && at->key == key && !tick.scratch.find.moves[at->body];
}

void add_memory(std::vector<RubbleMemory::Point>& points, const Tick& tick,
                const RubblePatch& patch) {
  double pressed = 0;
  for (int k = 0; k < patch.count; ++k) {
    pressed += patch.point[static_cast<std::size_t>(k)].impulse;
  }
  if (!(pressed > 0)) return;
  const double over_step = 1 / tick.sub_step();
  const Vec3 friction =
      over_step * (patch.slip_impulse[0] * patch.along + patch.slip_impulse[1] * patch.across);
  for (int k = 0; k < patch.count; ++k) {
    const RubblePatch::Point& p = patch.point[static_cast<std::size_t>(k)];
    const double share = p.impulse / pressed;
    points.push_back({tick.shapes[p.shape_a].key, tick.shapes[p.shape_b].key, p.local_a,
                      over_step * p.impulse, share * friction,
                      over_step * share * patch.twist_impulse});
  }
}

/// Keeps the present points, and those of the last tick between bodies that keep still: woken
/// bodies go on with them.
void remember(Tick& tick) {
  std::vector<RubbleMemory::Point>& points = tick.memory.points;
  std::erase_if(points, [&](const RubbleMemory::Point& p) {
    return !keeps_still(tick, p.a) || !keeps_still(tick, p.b);
  });
  for (const RubblePatch& patch : tick.scratch.patches) add_memory(points, tick, patch);
  std::ranges::stable_sort(points, {},
                           [](const RubbleMemory::Point& p) { return std::pair(p.a, p.b); });
}

/// How often patches are found in a tick: more often while most bodies fly farther in a tick than
/// they are large.
int rounds_of(const Tick& tick) {
  double way = 0, size = 0;
  std::size_t count = 0;
  for (std::size_t k = 0; k < tick.bodies.size(); ++k) {
    const RubbleBody& body = tick.bodies[k];
    if (!is_awake(body)) continue;
    way += tick.settings.length * tick.scratch.moving[k].velocity.norm();
    size += body.radius;
    ++count;
  }
  if (count == 0) return 1;
  const double far = way / size;
  int rounds = 1;
  while (rounds < far && 2 * rounds <= tick.settings.sub_steps) rounds *= 2;
  return rounds;
}

/// From the lowest patch up; without gravity in their present order.
void sort_by_height(Tick& tick) {
  std::vector<double> height;
  for (const RubblePatch& p : tick.scratch.patches) {
    height.push_back(-tick.settings.gravity.dot(tick.scratch.moving[p.a].centre + p.arm_a));
  }
  tick.scratch.order.resize(height.size());
  std::iota(tick.scratch.order.begin(), tick.scratch.order.end(), 0u);
  std::ranges::stable_sort(tick.scratch.order, {}, [&](std::uint32_t k) { return height[k]; });
}

/// The largest number of bodies upon each other, counted up from driven or sleeping bodies, by the
/// points that pushed in the last tick.
std::uint32_t layers_of(const Tick& tick) {
  constexpr std::uint32_t unknown = ~0u;
  std::vector<std::uint32_t> layer(tick.bodies.size(), unknown), reached, next;
  std::vector<std::vector<std::uint32_t>> on(tick.bodies.size());
  for (const RubblePatch& p : tick.scratch.patches) {
    if (!pushes(p)) continue;
    on[p.a].push_back(p.b);
    on[p.b].push_back(p.a);
  }
  for (std::uint32_t k = 0; k < tick.bodies.size(); ++k) {
    if (is_awake(tick.bodies[k])) continue;
    layer[k] = 0;
    reached.push_back(k);
  }
  std::uint32_t most = 0;
  while (!reached.empty()) {
    next.clear();
    for (const std::uint32_t k : reached) {
      for (const std::uint32_t other : on[k]) {
        if (layer[other] != unknown) continue;
        layer[other] = most + 1;
        next.push_back(other);
      }
    }
    if (!next.empty()) ++most;
    std::swap(reached, next);
  }
  return most;
}

/// Weight goes through a tower one body per sweep: a high tower needs more sub-steps.
void choose_sub_steps(Tick& tick) {
  const std::uint32_t layers = layers_of(tick);
  tick.report.layers = std::max(tick.report.layers, layers);
  int factor = 1;
  while (factor < 32 && layers > static_cast<std::uint32_t>(10 * factor)) factor *= 2;
  tick.sub_steps = std::max(tick.sub_steps, tick.settings.sub_steps * factor);
}

void forces_to_impulses(Tick& tick) {
  const double h = tick.sub_step();
  for (RubblePatch& p : tick.scratch.patches) {
    for (RubblePatch::Point& point : p.point) point.impulse *= h;
    for (double& slip : p.slip_impulse) slip *= h;
    p.twist_impulse *= h;
  }
}

/// The next of so many equal rounds.
void take_round(Tick& tick, int rounds) {
  find(tick, tick.settings.length / rounds);
  // Bodies that fly far in a tick bear nothing yet.
  if (rounds == 1) choose_sub_steps(tick);
  forces_to_impulses(tick);
  const int sub_steps = tick.sub_steps / rounds;
  tick.report.sub_steps += static_cast<std::uint32_t>(sub_steps);
  const auto start = Clock::now();
  auto& [find, moving, patches, order, pressed, velocity, spin] = tick.scratch;
  double size = 0;
  for (const RubbleBody& body : tick.bodies)
    size = std::max(size, is_awake(body) ? body.radius : 0);
  // The speed of a fall by its own size; a sweep without pushing takes that speed back.
  const double push = std::max(3 * size, std::sqrt(tick.settings.gravity.norm() * size));
  const SweepRule pushing = pushing_rule(tick.sub_step(), tick.settings.slop, push);
  const SweepRule relaxing = relaxing_rule(tick.sub_step());
  prepare_patches(patches, moving);
  sort_by_height(tick);
  for (int k = 0; k < sub_steps; ++k) {
    fall(tick);
    note_velocities(tick);
    note_blows(tick.report.blow, patches, moving, tick.sub_step());
    warm_start(patches, moving);
    sweep_patches(patches, order, moving, pushing);
    take_impulses(tick);
    note_driven(tick, 1);
    move(tick);
    prepare_patches(patches, moving);
    note_velocities(tick);
    // Relaxing slows points that come near, too.
    note_blows(tick.report.blow, patches, moving, tick.sub_step());
    note_driven(tick, -1);
    sweep_patches(patches, order, moving, relaxing);
    take_impulses(tick);
    note_driven(tick, 1);
  }
  remember(tick);
  tick.report.solve_ms += ms_since(start);
}

void note_touches(std::vector<RubbleTouch>& touches, const Tick& tick) {
  for (const RubblePatch& p : tick.scratch.patches) {
    const Vec3 impulse = impulse_on_a(p, tick.scratch.moving[p.a].centre).head<3>();
    if (!impulse.isZero(0)) touches.push_back({p.a, p.b, impulse});
  }
}

}  // namespace

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

double kinetic_energy(const RubbleBody& body) {
  if (body.mass == 0) return 0;
  const Vec3 l = body.orientation.conjugate() * body.angular_momentum;
  return 0.5 * (body.momentum.squaredNorm() / body.mass + l.dot(body.inertia.inverse() * l));
}

Polytope polytope_of(const RubbleShape& shape, const Vec3& centre, const Mat3& turned) {
  if (shape.kind == RubbleShape::Kind::box) return make_box(centre, turned, shape.half_extent);
  if (shape.kind == RubbleShape::Kind::solid) return make_polytope(*shape.solid, centre, turned);
  std::array<Vec3, 4> corners;
  for (std::size_t k = 0; k < 4; ++k) corners[k] = centre + turned * shape.corner[k];
  return make_tetrahedron(corners, shape.outer_faces);
}

RubbleReport advance_rubble(std::span<RubbleBody> bodies, std::span<const RubbleShape> shapes,
                            RubbleMemory& memory, const RubbleSettings& settings,
                            RubbleScratch& scratch, std::vector<RubbleTouch>* touches,
                            std::span<const RubblePartner> partners) {
  Tick tick{bodies, shapes, partners, memory, settings, *scratch.buffers, {}, settings.sub_steps};
  if (touches) touches->clear();
  const bool rests = std::ranges::all_of(bodies, [](const RubbleBody& body) {
    return body.mass > 0 ? body.asleep : body.velocity.isZero(0);
  });
  if (rests) {
    for (const RubbleBody& body : bodies) tick.report.asleep += body.mass > 0;
    return tick.report;
  }
  tick.report.given.assign(bodies.size(), Impulse::Zero());
  tick.report.blow.assign(bodies.size(), {});
  tick.scratch.moving.clear();
  for (const RubbleBody& body : bodies) tick.scratch.moving.push_back(moving_of(body));
  const int rounds = rounds_of(tick);
  for (int k = 0; k < rounds; ++k) take_round(tick, rounds);
  for (const RubblePatch& p : tick.scratch.patches) {
    ++tick.report.manifolds;
    tick.report.points += static_cast<std::uint32_t>(p.count);
  }
  if (touches) note_touches(*touches, tick);
  put_to_sleep(tick);
  for (const RubbleBody& body : bodies) {
    if (body.mass > 0) ++(body.asleep ? tick.report.asleep : tick.report.awake);
  }
  return tick.report;
}

}  // namespace sunder
