// SPDX-License-Identifier: MIT
// Flight until things meet, resting contact, the shatter after a blow, and debris.
#include "fracture/scene/expected_time.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "fracture/scene/body_measures.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "topology/base/elementary.hpp"

namespace sunder {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

// Measured by tests/experiments/expected_time/expected_time.py.
/// s per tetrahedron of a step in resting contact, where bodies lie on bodies and where they do
/// not.
constexpr double of_heap = 30e-6, of_rest = 1e-7;
/// s per tetrahedron for all cracks after breaking blows, of a body of 5 000; it grows with this
/// power of the number. Cracks are about a sixth of the tetrahedra, each with its contacts and
/// sub-steps, however long the run goes on.
constexpr double of_shatter = 1.7e-3, growth = 0.2;
/// The share of it where no impact window divides a step.
constexpr double without_windows = 0.02;
/// s per tetrahedron of a step of debris.
constexpr double of_debris = 3e-6;
/// Elements of second order make forces dear, contact hardly: times that a shatter takes with them.
constexpr double of_second_order = 3;
/// Blows that break most bodies have this stress rho c v over the strength.
constexpr double breaks_most = 1.3;
/// Wave travels through a body after a blow while it cracks, and until a held one is quiet. The
/// pieces of free bodies go on meeting each other.
constexpr double ringing = 50;

/// s in which a body of so many tetrahedra cracks throughout.
double shatter(double size) {
  return of_shatter * size * exponential(growth * logarithm(size / 5000));
}

/// A body as its bounding box, which neither turns nor rebounds.
struct MovingBody {
  Vec3 way = Vec3::Zero(), velocity = Vec3::Zero();
  /// kg; infinite where it is held.
  double mass = never;
  /// s: its first contact, its first contact with another body, the first blow that may break it.
  double touched = never, piled = never, broken = never;
  double cracked = 0;  ///< s: when it no longer rings from the last such blow
  double quiet = 0;    ///< s: when its pieces no longer meet
  /// Whether something at rest holds it up, and m that something driven has pressed into it.
  bool is_held_up = false;
  double squeezed = 0;
};

struct MovingObstacle {
  Obstacle obstacle;
  double mass = never;
};

/// The velocities of two that meet are made the same along the normal. Returns their closing speed.
double stop(Vec3& first, double first_mass, Vec3& second, double second_mass, const Vec3& normal) {
  const double closing = -normal.dot(first - second);
  if (!(closing > 0)) return 0;
  if (first_mass == never && second_mass == never) return closing;
  const double share = first_mass == never    ? 0
                       : second_mass == never ? 1
                                              : second_mass / (first_mass + second_mass);
  first += share * closing * normal;
  second -= (1 - share) * closing * normal;
  return closing;
}

/// The scene as boxes among obstacles, in 400 steps: enough to find the meetings of bodies, their
/// times and speeds. Above 500 bodies each meets obstacles only.
class BoxWorld {
 public:
  BoxWorld(const Scene& scene, const std::vector<BodyMeasures>& measures)
      : scene_(scene), measures_(measures) {
    for (std::size_t b = 0; b < measures.size(); ++b) {
      const BodySettings& settings = scene.bodies[b];
      MovingBody body;
      if (settings.held.empty()) {
        body.velocity = settings.velocity;
        body.mass = settings.material.density * measures[b].volume;
      }
      bodies_.push_back(body);
    }
    for (const Obstacle& o : scene.obstacles) obstacles_.push_back({o, o.mass.value_or(never)});
    constexpr int steps = 400;
    const double step = scene.duration / steps;
    for (int k = 0; k < steps; ++k) {
      meet_all(k * step, step);
      move_all(step);
    }
  }

  const std::vector<MovingBody>& bodies() const { return bodies_; }

 private:
  void move_all(double step) {
    const Vec3 gravity = scene_.gravity.acceleration;
    for (MovingBody& body : bodies_) {
      if (body.mass != never) body.velocity += step * gravity;
      body.way += step * body.velocity;
    }
    for (MovingObstacle& o : obstacles_) {
      if (o.mass != never) o.obstacle.velocity += step * gravity;
      translate(o.obstacle.shape, step * o.obstacle.velocity);
    }
  }

  void meet_all(double time, double step) {
    for (std::size_t a = 0; a < bodies_.size(); ++a) {
      for (MovingObstacle& obstacle : obstacles_) meet(a, obstacle, time, step);
    }
    constexpr std::size_t most = 500;
    for (std::size_t a = 0; a < bodies_.size() && bodies_.size() <= most; ++a) {
      for (std::size_t b = 0; b < a; ++b) meet(a, b, time, step);
    }
  }

  void meet(std::size_t a, MovingObstacle& o, double time, double step) {
    MovingBody& body = bodies_[a];
    const BodyMeasures& m = measures_[a];
    const double reach = near(m, step * (body.velocity - o.obstacle.velocity).norm());
    if (is_far(a, o.obstacle.shape, reach)) return;
    SurfaceDistance nearest{.gap = never};
    for (const OuterFace& face : m.outside) {
      const Vec3 point = m.points[face.points[0]] + body.way;
      const SurfaceDistance here = surface_distance(o.obstacle.shape, point);
      if (here.gap < nearest.gap) nearest = here;
    }
    if (nearest.gap > reach) return;
    body.touched = std::min(body.touched, time);
    const double closing =
        stop(body.velocity, body.mass, o.obstacle.velocity, o.mass, nearest.normal);
    strike(a, closing, time);
    const bool is_driven = o.mass == never && !o.obstacle.velocity.isZero();
    if (o.mass == never && !is_driven) body.is_held_up = true;
    if (is_driven && (body.is_held_up || body.mass == never)) {
      squeeze(a, closing * step, time);
    }
  }

  /// Something driven comes `way` m further into a body that cannot yield.
  void squeeze(std::size_t b, double way, double time) {
    MovingBody& body = bodies_[b];
    const BodySettings& settings = scene_.bodies[b];
    if (settings.rigid || scene_.fracture.mode == FractureMode::off) return;
    body.squeezed += way;
    const double strain = measures_[b].strength / settings.material.young_modulus;
    if (body.squeezed < strain * measures_[b].extent) return;
    body.broken = std::min(body.broken, time);
    body.cracked = body.quiet = never;
  }

  void meet(std::size_t a, std::size_t b, double time, double step) {
    MovingBody &first = bodies_[a], &second = bodies_[b];
    const Eigen::AlignedBox3d box = box_of(a), other = box_of(b);
    const double reach = std::min(near(measures_[a], 0), near(measures_[b], 0)) +
                         step * (first.velocity - second.velocity).norm();
    if (box.exteriorDistance(other) > reach) return;
    // Along the axis on which they overlap least.
    const Vec3 overlap = box.max().cwiseMin(other.max()) - box.min().cwiseMax(other.min());
    int axis = 0;
    overlap.minCoeff(&axis);
    Vec3 normal = Vec3::Zero();
    normal[axis] = box.center()[axis] < other.center()[axis] ? -1 : 1;
    const double closing = stop(first.velocity, first.mass, second.velocity, second.mass, normal);
    for (const std::size_t body : {a, b}) {
      bodies_[body].touched = std::min(bodies_[body].touched, time);
      bodies_[body].piled = std::min(bodies_[body].piled, time);
      strike(body, closing, time);
    }
  }

  void strike(std::size_t b, double speed, double time) {
    const BodySettings& settings = scene_.bodies[b];
    if (settings.rigid || scene_.fracture.mode == FractureMode::off) return;
    const double stress = settings.material.density * measures_[b].wave_speed * speed;
    if (!(stress > breaks_most * measures_[b].strength)) return;
    MovingBody& body = bodies_[b];
    body.broken = std::min(body.broken, time);
    const double rings = ringing * measures_[b].extent / measures_[b].wave_speed;
    body.cracked = std::max(body.cracked, time + rings);
    body.quiet = body.mass != never ? never : std::max(body.quiet, time + rings);
  }

  Eigen::AlignedBox3d box_of(std::size_t b) const {
    Eigen::AlignedBox3d box = measures_[b].box;
    return box.translate(bodies_[b].way);
  }

  /// m: a gap that counts as none, `way` (m) being that of a step.
  static double near(const BodyMeasures& m, double way) { return 0.01 * m.cell + way; }

  bool is_far(std::size_t b, const Shape& shape, double reach) const {
    if (!has_volume(shape)) return !std::holds_alternative<Plane>(shape);
    return box_of(b).exteriorDistance(pose_of(shape).centre) > radius_of(shape) + reach;
  }

  const Scene& scene_;
  const std::vector<BodyMeasures>& measures_;
  std::vector<MovingBody> bodies_;
  std::vector<MovingObstacle> obstacles_;
};

/// s: when supports that move towards or along each other have strained the body to its strength.
/// Those that move apart leave nothing that touches.
double pressed_time(const BodySettings& body, const BodyMeasures& m) {
  const auto middle = [&](const HeldBox& held) -> Vec3 {
    return (held.minimum.cwiseMax(m.box.min()) + held.maximum.cwiseMin(m.box.max())) / 2;
  };
  double fastest = 0;
  for (const HeldBox& a : body.held) {
    for (const HeldBox& b : body.held) {
      const Vec3 speed = a.velocity - b.velocity, way = middle(a) - middle(b);
      if (speed.dot(way) <= 0.1 * speed.norm() * way.norm()) {
        fastest = std::max(fastest, speed.norm());
      }
    }
  }
  const double strain = m.strength / body.material.young_modulus;
  return strain * m.extent / fastest;
}

/// Of second order 12 to 30 times as much (docs/lab/bending.md).
double cost_of_order(const BodySettings& body) { return body.order == 2 ? 15 : 1; }

/// ms of a step of the body in flight.
double flight_ms(const Scene& scene, const BodySettings& body) {
  // Measured: 6 to 8 times (docs/lab/second_order.md, the slender strip).
  const double model = scene.integrator.model == ElasticModel::corotational ? 7 : 1;
  // Large bodies' factors fill in.
  const auto tetrahedra = static_cast<double>(body.mesh.tetrahedra.size());
  return model * cost_of_order(body) * 1e-4 * tetrahedra * (1 + tetrahedra / 8000);
}

class Forecast {
 public:
  explicit Forecast(const Scene& scene) : scene_(scene) {
    for (const BodySettings& body : scene.bodies) measures_.push_back(measure(body));
    bodies_ = BoxWorld(scene, measures_).bodies();
    if (scene.fracture.mode == FractureMode::off) return;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const double pressed = pressed_time(scene.bodies[b], measures_[b]);
      bodies_[b].broken = std::min(bodies_[b].broken, pressed);
      if (pressed < never) bodies_[b].cracked = bodies_[b].quiet = never;
      bodies_[b].touched = std::min(bodies_[b].touched, pressed);
    }
  }

  ExpectedTime phases() const {
    std::vector<double> changes = {0};
    for (const MovingBody& body : bodies_) {
      for (const double t :
           {body.touched, body.touched + time_to_sleep(), body.broken, body.cracked, body.quiet}) {
        if (t < scene_.duration) changes.push_back(t);
      }
    }
    std::ranges::sort(changes);
    changes.erase(std::ranges::unique(changes).begin(), changes.end());
    ExpectedTime expected;
    expected.phases.clear();
    for (const double t : changes) expected.phases.push_back({t, rate(t)});
    return expected;
  }

 private:
  /// s from the first contact until resting bodies are asleep; `never` where loads keep them awake.
  double time_to_sleep() const {
    const bool loaded = scene_.gravity.ramp_time > 0 ||
                        std::ranges::any_of(scene_.bodies, [](const BodySettings& body) {
                          return !body.held.empty() || !body.loads.empty();
                        });
    return scene_.ladder.sleep && !loaded ? 1.5 * scene_.ladder.sleep_after : never;
  }

  /// s of computing per simulated second at the time t.
  double rate(double t) const {
    const double steps = 1 / scene_.integrator.time_step;
    double seconds = 1e-3 * flight_ms(scene_) * steps;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      if (!scene_.bodies[b].rigid && t >= bodies_[b].touched) seconds += rate_of(b, t, steps);
    }
    return seconds;
  }

  /// The part of a body that has touched another or an obstacle.
  double rate_of(std::size_t b, double t, double steps) const {
    const MovingBody& body = bodies_[b];
    const BodySettings& settings = scene_.bodies[b];
    const auto size = static_cast<double>(settings.mesh.tetrahedra.size());
    if (t >= body.broken && t < body.quiet) {
      const double share = has_windows() ? 1 : without_windows;
      double seconds = share * of_debris * size * steps;
      const double end = std::min(body.cracked, scene_.duration);
      if (t < end) {
        const double order = settings.order == 2 ? of_second_order : 1;
        seconds += share * order * shatter(size) / (end - body.broken);
      }
      return seconds;
    }
    if (t >= body.touched + time_to_sleep()) return 0;
    return (t < body.piled ? of_rest : of_heap) * size * cost_of_order(settings) * steps;
  }

  /// Whether blows are computed in sub-steps.
  bool has_windows() const {
    return scene_.impact.window && scene_.integrator.integrator == Integrator::floating_frame &&
           scene_.contact.method == ContactMethod::impulses;
  }

  const Scene& scene_;
  std::vector<BodyMeasures> measures_;
  std::vector<MovingBody> bodies_;
};

}  // namespace

double ExpectedTime::between(double from, double to) const {
  double seconds = 0;
  for (std::size_t k = 0; k < phases.size(); ++k) {
    const double end = k + 1 < phases.size() ? phases[k + 1].begin : never;
    seconds += phases[k].rate * std::max(0.0, std::min(to, end) - std::max(from, phases[k].begin));
  }
  return seconds;
}

double flight_ms(const Scene& scene) {
  double ms = 0;
  for (const BodySettings& body : scene.bodies) ms += flight_ms(scene, body);
  return ms;
}

ExpectedTime expected_time(const Scene& scene) { return Forecast(scene).phases(); }

}  // namespace sunder
