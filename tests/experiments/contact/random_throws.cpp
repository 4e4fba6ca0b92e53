// SPDX-License-Identifier: MIT
// Solids, aims, spins and steps by a seed.
#include "tests/experiments/contact/random_throws.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tests/experiments/contact/overlap.hpp"

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

void turn(Body& body, const Eigen::Quaterniond& by) {
  for (Vec3& x : body.rest) x = by * x;
}

/// Aimed at a tetrahedron of the first: a small one may come to any part of it. Both start just
/// apart.
void aim(RandomThrow& thrown, std::mt19937& random, double gap) {
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

}  // namespace

RandomThrow draw_throw(std::uint64_t seed, Lies lies) {
  std::mt19937 random(static_cast<std::mt19937::result_type>(seed * 2654435761u + 17));
  const auto any = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  RandomThrow thrown;
  ThrowFigures& pair = thrown.figures;
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
    thrown.ball_mass = 2400 * 4.0 / 3 * pi * std::pow(thrown.ball, 3);
  } else {
    thrown.second = solid_of(second, random);
    if (lies == Lies::askew) turn(thrown.second, random_rotation(random));
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

ContactScene scene_of(const RandomThrow& thrown, const Material& material) {
  const ThrowFigures& pair = thrown.figures;
  std::vector<Body> parts = {thrown.first};
  if (thrown.ball == 0) {
    parts.push_back(thrown.second);
    for (Vec3& x : parts.back().rest) x += thrown.start;
  }
  const SeveralBodies all = together(parts);
  ContactScene scene{all.body, state_of(all, material)};
  if (thrown.ball > 0) {
    Obstacle ball{Sphere{thrown.start, thrown.ball}, -pair.speed * thrown.ahead};
    ball.mass = thrown.ball_mass;
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

}  // namespace sunder::test
