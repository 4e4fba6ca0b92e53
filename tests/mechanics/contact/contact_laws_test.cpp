// SPDX-License-Identifier: MIT
// Laws of any contact: other units, other axes and mirrors change nothing that happens.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "tests/experiments/contact/random_throws.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// The changes of a law to a scene. Times stay.
struct Change {
  double length = 1;             ///< factor of lengths, and so of speeds
  double density = 1;            ///< factor
  Mat3 turn = Mat3::Identity();  ///< orthogonal; determinant -1: mirrored

  bool is_mirror() const { return turn.determinant() < 0; }
  double mass() const { return density * length * length * length; }
  /// Of places, speeds and accelerations.
  Vec3 of(const Vec3& x) const { return length * (turn * x); }
  /// Of impulses, N s.
  Vec3 of_impulse(const Vec3& j) const { return mass() * of(j); }
};

/// A body in other units and axes. Mirrored tetrahedra get two corners swapped.
Body changed(Body body, const Change& change) {
  for (Vec3& x : body.rest) x = change.of(x);
  if (!change.is_mirror()) return body;
  for (Corners& t : body.corners) std::swap(t[2], t[3]);
  return body;
}

/// The same throw in other units and axes.
RandomThrow changed(RandomThrow thrown, const Change& change) {
  thrown.first = changed(thrown.first, change);
  thrown.second = changed(thrown.second, change);
  thrown.figures.speed *= change.length;
  thrown.ball *= change.length;
  thrown.ball_mass *= change.mass();
  thrown.small *= change.length;
  thrown.start = change.of(thrown.start);
  thrown.ahead = change.turn * thrown.ahead;
  for (Vec3& axis : thrown.axis) axis = (change.is_mirror() ? -1 : 1) * (change.turn * axis);
  return thrown;
}

/// Springs that are soft enough for the lightest vertex.
void use_penalty(ContactScene& scene) {
  const double least = *std::ranges::min_element(scene.state.vertices.mass);
  const double step = scene.integrator.time_step;
  scene.contact.method = ContactMethod::penalty;
  scene.contact.penalty_stiffness = 0.1 * least / (step * step);
  scene.contact.penalty_damping = 0.1 * least / step;
}

/// The second solid of a throw at a box of the size of the first, which stands and does not break.
ContactScene scene_at_box(const RandomThrow& thrown, const Material& material,
                          const Change& change) {
  Body body = thrown.second;
  for (Vec3& x : body.rest) x += thrown.start;
  ContactScene scene{body, state_of(together({body}), material)};
  const Mat3 turn = (change.is_mirror() ? -1 : 1) * change.turn;
  scene.obstacles = {
      {Box{Vec3::Zero(), Eigen::Quaterniond(turn), Vec3::Constant(0.3 * change.length)}}};
  const ThrowFigures& figures = thrown.figures;
  scene.integrator.time_step = figures.time_step;
  scene.contact.allowed_penetration = 1e-4 * thrown.small;
  scene.contact.push_out_speed = 0.1 * thrown.small;
  scene.state.components[0].rigid = !figures.is_elastic;
  place(scene.state, ComponentId{0},
        {.velocity = -figures.speed * thrown.ahead,
         .spin = thrown.turn[1] / figures.time_step * thrown.axis[1]});
  return scene;
}

/// The scene of a seed, changed. Some seeds have a box in place of the first solid, some soft
/// contacts, some springs on overlaps.
ContactScene scene_of(std::uint64_t seed, const RandomThrow& thrown, const Change& change) {
  const double length = change.length;
  const Material material =
      material_of(1e10 * change.density * length * length, 2400 * change.density);
  const bool on_cube = thrown.figures.kinds.ends_with("on cube");
  const bool is_box = on_cube && thrown.ball == 0 && seed % 2 == 0;
  const RandomThrow other = changed(thrown, change);
  ContactScene scene =
      is_box ? scene_at_box(other, material, change) : test::scene_of(other, material);
  scene.loads.gravity = change.of({1, -2, -9.5});
  if (seed % 5 == 0) scene.contact.compliance = 1e-9 / change.mass();
  if (seed % 7 == 0) use_penalty(scene);
  return scene;
}

/// A step as it ends.
struct Moment {
  std::vector<Vec3> position, velocity;  ///< of vertices, then of balls
  std::vector<Eigen::Quaterniond> orientation;
  std::vector<ContactPoint> contacts;
  double time_step = 0;    ///< s
  bool is_solved = false;  ///< to the tolerance, in every pass and at the end
};

/// Takes one step, of half the length as long as pieces would pass each other in it.
Moment moment_after_step(ContactScene& scene) {
  constexpr double shortest = 1e-9;
  ContactStepResult result;
  for (;; scene.integrator.time_step /= 2) {
    result = scene.step({.divides = scene.integrator.time_step > shortest});
    if (result.passing_way == 0) break;
  }
  Moment now{scene.state.vertices.position,
             scene.state.vertices.velocity,
             {},
             result.contacts,
             scene.integrator.time_step};
  for (const Component& c : scene.state.components) now.orientation.push_back(c.orientation);
  for (const Obstacle& ball : scene.obstacles) {
    now.position.push_back(pose_of(ball.shape).centre);
    now.velocity.push_back(ball.velocity);
  }
  const ContactReport& report = result.report;
  now.is_solved = report.converged && report.residual <= report.tolerated;
  return now;
}

/// Whether rows of coordinates are the same bytes once those of the second are divided.
bool is_same(const std::vector<Vec3>& a, std::vector<Vec3> b, double over) {
  for (Vec3& x : b) x /= over;
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0;
}

/// Whether two contacts are the same bytes but for their units.
bool is_same(const ContactPoint& a, const ContactPoint& b, const Change& change) {
  const auto key = [](const ContactPoint& c) {
    return std::tuple(c.vertex, c.tetrahedron_a, c.ball, c.corner, c.tetrahedron, c.obstacle,
                      c.face, c.place, c.place_a, c.weights_a, c.weights, c.friction);
  };
  const double length = change.length;
  return key(a) == key(b) && is_same({a.normal}, {b.normal}, 1) &&
         is_same({a.impulse}, {b.impulse}, change.mass() * length) &&
         a.gap_start == b.gap_start / length && a.offset == b.offset / length;
}

/// Whether two moments are the same bytes but for their units, contacts in the same order.
bool is_same(const Moment& a, const Moment& b, const Change& change) {
  const auto same_contact = [&](const ContactPoint& one, const ContactPoint& other) {
    return is_same(one, other, change);
  };
  const auto same_turn = [](const Eigen::Quaterniond& p, const Eigen::Quaterniond& q) {
    return p.coeffs() == q.coeffs();
  };
  return is_same(a.position, b.position, change.length) &&
         is_same(a.velocity, b.velocity, change.length) &&
         std::ranges::equal(a.orientation, b.orientation, same_turn) &&
         std::ranges::equal(a.contacts, b.contacts, same_contact) && a.time_step == b.time_step;
}

/// A vertex, an edge, a face, a tetrahedron or an obstacle, by its vertices in ascending order.
using Feature = std::vector<std::uint32_t>;

Feature feature_of(VertexId vertex, TetId tetrahedron, std::uint8_t place, std::uint32_t obstacle,
                   const std::vector<Corners>& corners) {
  constexpr std::uint32_t obstacles = 1000000;
  if (obstacle != ContactPoint::none) return {obstacles + obstacle};
  if (!vertex.is_none()) return {vertex.value};
  const Corners& t = corners[tetrahedron.index()];
  if (place >= ContactPoint::edge_place && place < ContactPoint::edge_place + edge_ends.size()) {
    const auto [i, j] = edge_ends[static_cast<std::size_t>(place - ContactPoint::edge_place)];
    const auto [low, high] =
        std::minmax(t[static_cast<std::size_t>(i)].value, t[static_cast<std::size_t>(j)].value);
    return {low, high};
  }
  Feature feature;
  for (std::size_t i = 0; i < 4; ++i) {
    if (i != place) feature.push_back(t[i].value);
  }
  std::ranges::sort(feature);
  return feature;
}

/// The impulses (N s) that the first of two features got from the second, the lower one first.
using Impulses = std::map<std::pair<Feature, Feature>, Vec3>;

Impulses impulses_of(const Moment& now, const std::vector<Corners>& corners) {
  Impulses sum;
  for (const ContactPoint& c : now.contacts) {
    const Feature a = feature_of(c.vertex, c.tetrahedron_a, c.place_a, c.ball, corners);
    const Feature b = feature_of({}, c.tetrahedron, c.place, c.obstacle, corners);
    const auto at = sum.emplace(std::minmax(a, b), Vec3::Zero()).first;
    at->second += a < b ? c.impulse : Vec3(-c.impulse);
  }
  return sum;
}

/// How far the impulses of two moments are from each other, over the largest. `sum`: of all of
/// them instead of each. Infinite where a pair of features with an impulse is in one alone.
double deviation_of(const Impulses& a, const Impulses& b, const Change& change, bool sum) {
  constexpr double nothing = 1e-6;
  Impulses apart;
  double largest = 0;
  for (const auto& [pair, j] : a) {
    apart[pair] = change.of_impulse(j);
    largest = std::max(largest, apart[pair].norm());
  }
  for (const auto& [pair, j] : b) apart.try_emplace(pair, Vec3::Zero()).first->second -= j;
  double worst = 0;
  Vec3 total = Vec3::Zero();
  for (const auto& [pair, j] : apart) {
    if (!sum) worst = std::max(worst, j.norm());
    total += j;
    const bool both = a.contains(pair) && b.contains(pair);
    if (!both && j.norm() > nothing * largest) return std::numeric_limits<double>::infinity();
  }
  return std::max(worst, total.norm()) / largest;
}

/// A scene and the same scene changed.
struct Twins {
  Change change;
  ContactScene one, other;
  double small = 0;    ///< m, of the first
  int most_steps = 0;  ///< until the solids have met or missed each other

  Twins(std::uint64_t seed, const RandomThrow& thrown, const Change& how)
      : change(how),
        one(scene_of(seed, thrown, {})),
        other(scene_of(seed, thrown, how)),
        small(thrown.small) {
    const double way = thrown.figures.speed * thrown.figures.time_step;
    most_steps = std::min(100, 2 + static_cast<int>((thrown.gap + 3 * thrown.reach) / way));
  }

  /// Both after the step in which the first contact of either has an impulse; nothing: they miss.
  std::optional<std::array<Moment, 2>> meet() {
    for (int k = 0; k < most_steps; ++k) {
      std::array<Moment, 2> now = {moment_after_step(one), moment_after_step(other)};
      if (!now[0].contacts.empty() || !now[1].contacts.empty()) return now;
    }
    return std::nullopt;
  }

  /// The largest deviation: of places over the size of the smaller solid, and of impulses.
  double compare(const Moment& a, const Moment& b) const {
    if (a.time_step != b.time_step) return std::numeric_limits<double>::infinity();
    double worst = 0;
    for (std::size_t v = 0; v < a.position.size(); ++v) {
      const double apart = (change.of(a.position[v]) - b.position[v]).norm() / change.length;
      worst = std::max(worst, apart / small);
    }
    // Several contacts may press against each other by any impulse: their sum is known.
    const bool sum = a.contacts.size() > 1 && one.contact.method == ContactMethod::impulses;
    return std::max(worst, deviation_of(impulses_of(a, one.body.corners),
                                        impulses_of(b, other.body.corners), change, sum));
  }

  /// Whether the bodies determine their impulses. Three contacts in a line, as along the edge
  /// of a plate, share pressure and friction in many ways. A solve without an end is no answer.
  bool is_determined(const Moment& a, const Moment& b) const {
    if (one.contact.method == ContactMethod::penalty) return true;
    return a.is_solved && b.is_solved && std::min(a.contacts.size(), b.contacts.size()) <= 2;
  }
};

/// The outcomes of a law on many seeds.
struct Tally {
  int met = 0, compared = 0;
  double worst = 0;
  std::string failed;  ///< seeds
};

/// The first contact of random pairs of solids, as they are and changed.
template <class ChangeOf>
Tally try_law(ChangeOf change_of) {
  constexpr double enough = 1e-6;
  constexpr std::uint64_t seeds = 300;
  Tally tally;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const RandomThrow thrown = draw_throw(seed, Lies::askew);
    Twins twins(seed, thrown, change_of(seed));
    // Impulses are to be as exact as the law is.
    twins.one.contact.tolerance = twins.other.contact.tolerance = 1e-9;
    const auto both = twins.meet();
    if (!both) continue;
    ++tally.met;
    const auto& [a, b] = *both;
    if (!twins.is_determined(a, b)) continue;
    ++tally.compared;
    const double deviation = twins.compare(a, b);
    if (deviation > enough) {
      tally.failed += " " + std::to_string(seed);
    } else {
      tally.worst = std::max(tally.worst, deviation);
    }
  }
  return tally;
}

/// Of 300 pairs about 250 meet, and 195 of those are compared.
void check_law(const Tally& tally) {
  INFO(tally.met << " met, " << tally.compared << " compared, worst " << tally.worst
                 << ", failed:" << tally.failed);
  CHECK(tally.compared >= 170);
  CHECK(tally.failed.empty());
}

/// A quarter of a turn about the axis x, y or z.
Mat3 quarter_turn(std::uint64_t axis) {
  Mat3 turn = Mat3::Zero();
  const auto i = static_cast<Eigen::Index>(axis % 3), j = (i + 1) % 3, k = (i + 2) % 3;
  turn(i, i) = 1;
  turn(k, j) = 1;
  turn(j, k) = -1;
  return turn;
}

}  // namespace

TEST_CASE("contact laws: units that are powers of two change no byte", "[mechanics][contact]") {
  // Of 300 pairs about 250 meet.
  int met = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const Change change = seed % 2 == 0 ? Change{1024, 1} : Change{1.0 / 1024, 64};
    Twins twins(seed, draw_throw(seed, Lies::askew), change);
    int after = 2;
    bool same = true;
    for (int k = 0; same && after > 0 && k < twins.most_steps; ++k) {
      const Moment a = moment_after_step(twins.one), b = moment_after_step(twins.other);
      same = is_same(a, b, change);
      if (a.contacts.empty()) continue;
      met += after == 2;
      --after;
    }
    INFO("seed " << seed);
    CHECK(same);
  }
  CHECK(met >= 230);
}

TEST_CASE("contact laws: other units, a thousand times as long", "[mechanics][contact]") {
  check_law(try_law([](std::uint64_t) { return Change{1000}; }));
}

TEST_CASE("contact laws: a quarter of a turn about an axis", "[mechanics][contact]") {
  check_law(try_law([](std::uint64_t seed) { return Change{.turn = quarter_turn(seed)}; }));
}

TEST_CASE("contact laws: any turn", "[mechanics][contact]") {
  std::mt19937 random(7);
  check_law(try_law(
      [&](std::uint64_t) { return Change{.turn = random_rotation(random).toRotationMatrix()}; }));
}

TEST_CASE("contact laws: a mirror across an axis", "[mechanics][contact]") {
  check_law(try_law([](std::uint64_t seed) {
    Change change;
    const auto axis = static_cast<Eigen::Index>(seed % 3);
    change.turn(axis, axis) = -1;
    return change;
  }));
}
