// SPDX-License-Identifier: MIT
// Solids, aims, spins and steps by a seed; the judge sees places alone.
#include "tests/experiments/contact/random_pairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <span>

#include "tests/experiments/contact/contact_judge.hpp"
#include "tests/mechanics/contact/contact_scene.hpp"

namespace sunder::test {
namespace {

enum class Kind { chip, cube, bar, plate, ball };
constexpr std::array<const char*, 5> names = {"chip", "cube", "bar", "plate", "ball"};

/// About the origin, with a radius of about a half.
Body solid_of(Kind kind, std::mt19937& random) {
  switch (kind) {
    case Kind::cube:
      return kuhn_block({1, 1, 1}, {0.6, 0.6, 0.6});
    case Kind::bar:
      return kuhn_block({5, 1, 1}, {1, 0.2, 0.2});
    case Kind::plate:
      return kuhn_block({3, 3, 1}, {0.7, 0.7, 0.06});
    default:
      break;
  }
  for (;;) {
    Body chip = single_tetrahedron(1);
    Vec3 mean = Vec3::Zero();
    for (Vec3& x : chip.rest) {
      x = 0.5 * random_vector(random);
      mean += x / 4;
    }
    for (Vec3& x : chip.rest) x -= mean;
    const Vec3 u = chip.rest[1] - chip.rest[0], v = chip.rest[2] - chip.rest[0];
    const double volume = u.cross(v).dot(chip.rest[3] - chip.rest[0]) / 6;
    if (volume < 0) std::swap(chip.rest[0], chip.rest[1]);
    if (std::abs(volume) > 5e-3) return chip;
  }
}

double radius_of_body(const Body& body) {
  double squared = 0;
  for (const Vec3& x : body.rest) squared = std::max(squared, x.squaredNorm());
  return std::sqrt(squared);
}

/// m: between the first solid and the second when that is shifted, or a ball of that radius there.
double distance_of(const Body& first, const Body& second, double radius, const Vec3& shift) {
  double least = std::numeric_limits<double>::infinity();
  for (const Corners& t : first.corners) {
    TetCorners a{};
    for (std::size_t i = 0; i < 4; ++i) a[i] = first.rest[t[i].index()];
    if (radius > 0) least = std::min(least, -overlap(a, Shape{Sphere{shift, radius}}));
    for (const Corners& u : second.corners) {
      TetCorners b{};
      for (std::size_t i = 0; i < 4; ++i) b[i] = second.rest[u[i].index()] + shift;
      least = std::min(least, -overlap(a, b));
    }
  }
  return least;
}

/// The places of a scene at one moment.
struct Moment {
  std::vector<Vec3> at;
  std::vector<Pose> frames;
  std::vector<Obstacle> obstacles;
};

Moment moment_of(const ContactScene& scene) {
  Moment now{scene.state.vertices.position, {}, scene.obstacles};
  for (const Component& c : scene.state.components) now.frames.push_back({c.centre, c.orientation});
  return now;
}

/// One part of a step, or a part of that.
struct Motion {
  Moment from, to;
};

/// Appends tetrahedra for the judge.
void add_tetrahedra(ContactFrame& frame, std::span<const Corners> tetrahedra) {
  for (const Corners& t : tetrahedra) {
    frame.tetrahedra.push_back({t[0].value, t[1].value, t[2].value, t[3].value});
  }
}

/// Places after a share of a motion. Frames turn evenly, and vertices move evenly in their frames.
ContactFrame frame_at(const Motion& motion, const ContactScene& scene, double part) {
  ContactFrame frame;
  frame.points.resize(motion.from.at.size());
  for (std::size_t v = 0; v < frame.points.size(); ++v) {
    const std::size_t k = scene.state.vertices.component[v].index();
    const Pose &a = motion.from.frames[k], &b = motion.to.frames[k];
    const Vec3 x = a.orientation.conjugate() * (motion.from.at[v] - a.centre);
    const Vec3 y = b.orientation.conjugate() * (motion.to.at[v] - b.centre);
    frame.points[v] = (1 - part) * a.centre + part * b.centre +
                      a.orientation.slerp(part, b.orientation) * ((1 - part) * x + part * y);
  }
  add_tetrahedra(frame, scene.body.corners);
  for (const ComponentId id : scene.state.elements.component) frame.piece.push_back(id.value);
  frame.obstacles = motion.from.obstacles;
  for (std::size_t k = 0; k < frame.obstacles.size(); ++k) {
    Vec3& centre = std::get<Sphere>(frame.obstacles[k].shape).center;
    centre = (1 - part) * centre + part * std::get<Sphere>(motion.to.obstacles[k].shape).center;
  }
  return frame;
}

double turn_of(const Motion& motion) {
  double most = 0;
  for (std::size_t k = 0; k < motion.from.frames.size(); ++k) {
    most = std::max(
        most, motion.from.frames[k].orientation.angularDistance(motion.to.frames[k].orientation));
  }
  return most;
}

double deepest_of(const FrameOverlaps& overlaps) {
  return std::max(overlaps.pieces.depth, overlaps.obstacles.depth);
}

/// Adds the judgement of one part of a step.
void judge_step(RandomPair& pair, const Motion& motion, const ContactScene& scene, double edge) {
  constexpr double tolerance = 0.02, most_turn = 0.05;
  const int moments = 1 + static_cast<int>(turn_of(motion) / most_turn);
  ContactFrame last = frame_at(motion, scene, 0);
  for (int k = 1; k <= moments; ++k) {
    ContactFrame now = frame_at(motion, scene, double(k) / moments);
    for (const Crossing& c : judge_crossings(last, now, tolerance * edge)) {
      pair.passed = pair.passed || c.passed;
    }
    last = std::move(now);
  }
  pair.last = deepest_of(judge_overlaps(last, edge)) / edge;
  pair.deepest = std::max(pair.deepest, pair.last);
}

/// The draw of a seed. Both solids are about the origin, and the second is thrown at the first.
struct Throw {
  RandomPair pair;
  Body first, second;            ///< the second is empty if it is a ball
  double ball = 0;               ///< m, radius; 0: no ball
  double small = 1;              ///< size of the second over that of the first
  Vec3 start, ahead;             ///< m, of the second; unit, against its velocity
  double reach = 0, gap = 0;     ///< m: radii of both together, and how far apart they start
  std::array<double, 2> turn{};  ///< rad per step
  std::array<Vec3, 2> axis{};
};

/// Aimed at a tetrahedron of the first: a small one may come to any part of it. Both start just
/// apart.
void aim(Throw& thrown, std::mt19937& random, double gap) {
  thrown.ahead = random_vector(random).normalized();
  Vec3 target = Vec3::Zero();
  const Corners& t = thrown.first.corners[random() % thrown.first.corners.size()];
  for (const VertexId v : t) target += thrown.first.rest[v.index()] / 4;
  double distance = 3 * thrown.reach;
  // Nearer by the distance that is left, again and again.
  for (int k = 0; k < 100; ++k) {
    const double left =
        distance_of(thrown.first, thrown.second, thrown.ball, target + distance * thrown.ahead);
    if (left <= 1.01 * gap) break;
    distance -= left - gap;
  }
  thrown.gap = gap;
  thrown.start = target + distance * thrown.ahead;
}

Throw draw(std::uint64_t seed) {
  std::mt19937 random(static_cast<std::mt19937::result_type>(seed * 2654435761u + 17));
  const auto any = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  Throw thrown;
  RandomPair& pair = thrown.pair;
  const auto first = static_cast<Kind>(random() % 4), second = static_cast<Kind>(random() % 5);
  pair.kinds = std::string(names[static_cast<std::size_t>(second)]) + " on " +
               names[static_cast<std::size_t>(first)];
  pair.ratio = random() % 2 == 0 ? 1 : std::pow(10.0, any(0, 3));
  pair.is_elastic = random() % 4 == 0;
  pair.speed = std::pow(10.0, pair.is_elastic ? any(-2, 1) : any(-2, 3));
  pair.time_step = std::pow(10.0, any(-5, -1.5));
  thrown.small = 1 / pair.ratio;
  thrown.first = solid_of(first, random);
  if (second == Kind::ball) {
    thrown.ball = 0.5 * thrown.small;
  } else {
    thrown.second = solid_of(second, random);
    for (Vec3& x : thrown.second.rest) x *= thrown.small;
  }
  thrown.reach =
      radius_of_body(thrown.first) + std::max(thrown.ball, radius_of_body(thrown.second));
  const double way = pair.speed * pair.time_step;
  aim(thrown, random, any(0.02, 1.5) * std::max(way, 0.02 * thrown.small));
  for (std::size_t k = 0; k < 2; ++k) {
    double turn = random() % 3 == 0 ? 0 : std::pow(10.0, any(-3, 0));
    // Faster ones are torn by their own spin.
    if (pair.is_elastic) turn = std::min(turn, 20 * pair.time_step / (k == 1 ? thrown.small : 1));
    thrown.turn[k] = thrown.ball > 0 && k == 1 ? 0 : turn;
    thrown.axis[k] = random_vector(random).normalized();
    pair.turn = std::max(pair.turn, thrown.turn[k]);
  }
  return thrown;
}

ContactScene scene_of(const Throw& thrown) {
  const RandomPair& pair = thrown.pair;
  std::vector<Body> parts = {thrown.first};
  if (thrown.ball == 0) {
    parts.push_back(thrown.second);
    for (Vec3& x : parts.back().rest) x += thrown.start;
  }
  const SeveralBodies all = together(parts);
  ContactScene scene{all.body, state_of(all, material_of(1e10))};
  if (thrown.ball > 0) {
    Obstacle ball{Sphere{thrown.start, thrown.ball}, -pair.speed * thrown.ahead};
    ball.mass = 2400 * 4.0 / 3 * pi * std::pow(thrown.ball, 3);
    scene.obstacles = {ball};
  }
  scene.integrator.time_step = pair.time_step;
  scene.contact.allowed_penetration = 1e-4 * thrown.small;
  scene.contact.push_out_speed = 0.1 * thrown.small;
  for (std::size_t k = 0; k < scene.state.components.size(); ++k) {
    scene.state.components[k].rigid = !pair.is_elastic;
    place(scene.state, ComponentId{k},
          {.velocity = k == 1 ? Vec3(-pair.speed * thrown.ahead) : Vec3(Vec3::Zero()),
           .spin = thrown.turn[k] / pair.time_step * thrown.axis[k]});
  }
  return scene;
}

/// m: the mean edge of the smaller solid, or the radius of a ball.
double edge_of(const Throw& thrown) {
  if (thrown.ball > 0) return thrown.ball;
  ContactFrame smaller;
  smaller.points = thrown.second.rest;
  add_tetrahedra(smaller, thrown.second.corners);
  return mean_edge(smaller);
}

}  // namespace

RandomPair run_random_pair(std::uint64_t seed) {
  const Throw thrown = draw(seed);
  ContactScene scene = scene_of(thrown);
  RandomPair pair = thrown.pair;
  const double edge = edge_of(thrown), way = pair.speed * pair.time_step;
  constexpr int most_steps = 100, after = 4;
  int left = std::min(most_steps, 2 + static_cast<int>((thrown.gap + 3 * thrown.reach) / way));
  Motion motion{moment_of(scene), {}};
  for (; left > 0; --left) {
    const ContactStepResult result = scene.step_in_parts([&] {
      motion.to = moment_of(scene);
      judge_step(pair, motion, scene, edge);
      motion.from = std::move(motion.to);
    });
    if (result.report.contacts > 0 && !pair.met) {
      pair.met = true;
      left = std::min(left, after + 1);
    }
  }
  return pair;
}

}  // namespace sunder::test
