// SPDX-License-Identifier: MIT
// Laws of rigid bodies that touch.
#include "mechanics/rubble/rubble.hpp"

#include <catch2/catch.hpp>

#include <cstring>
#include <random>
#include <vector>

#include "tests/experiments/rubble/rubble_scenes.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

RubbleSettings earth() {
  RubbleSettings settings;
  settings.gravity = {0, 0, -9.81};
  settings.still_speed = 1e-3;
  return settings;
}

RubbleReport run(RubbleScene& scene, const RubbleSettings& settings, int ticks) {
  RubbleScratch scratch;
  RubbleReport report;
  for (int k = 0; k < ticks; ++k) {
    report = advance_rubble(scene.bodies, scene.shapes, scene.memory, settings, scratch);
  }
  return report;
}

/// Two clouds of chips that fly at each other, no ground.
RubbleScene clouds(unsigned seed) {
  RubbleScene scene = broken_block({3, 3, 3}, 0.01, {0, 0, 0}, 0, seed);
  RubbleScene other = broken_block({3, 3, 3}, 0.01, {0.045, 0.008, 0.01}, 0, seed + 1);
  scene.bodies.erase(scene.bodies.begin());
  scene.shapes.erase(scene.shapes.begin());
  for (RubbleBody& body : scene.bodies) body.momentum = body.mass * Vec3(1.5, 0, 0);
  const auto first = static_cast<std::uint32_t>(scene.bodies.size()) + 1;
  for (RubbleShape& shape : scene.shapes) --shape.body;
  for (std::size_t k = 1; k < other.shapes.size(); ++k) {
    other.shapes[k].body += first - 2;
    other.shapes[k].key += 1000;
    other.bodies[k].momentum = other.bodies[k].mass * Vec3(-1.5, 0, 0);
    scene.shapes.push_back(other.shapes[k]);
    scene.bodies.push_back(other.bodies[k]);
  }
  return scene;
}

}  // namespace

TEST_CASE("what collides in free space keeps momentum, turning and the ledger", "[rubble]") {
  RubbleSettings settings;
  settings.sleep_after = 0;
  for (const unsigned seed : {1u, 2u, 3u}) {
    RubbleScene scene = clouds(seed);
    const Sums before = sums_of(scene, Vec3::Zero());
    RubbleScratch scratch;
    double passed = 0, last = before.kinetic;
    for (const RubbleBody& body : scene.bodies) passed += body.momentum.norm();
    for (int k = 0; k < 60; ++k) {
      const RubbleReport report =
          advance_rubble(scene.bodies, scene.shapes, scene.memory, settings, scratch);
      const Sums now = sums_of(scene, Vec3::Zero());
      CHECK(now.kinetic - last == Approx(report.contact_work).margin(1e-9 * before.kinetic));
      CHECK(report.contact.head<3>().norm() < 1e-12 * passed);
      // Pushed apart at birth and in the crush it may gain, by less than a hundredth in all.
      CHECK(now.kinetic < last + 1e-3 * before.kinetic);
      last = now.kinetic;
    }
    const Sums after = sums_of(scene, Vec3::Zero());
    CHECK((after.momentum - before.momentum).norm() < 1e-12 * passed);
    CHECK((after.angular - before.angular).norm() < 1e-12 * passed * 0.1);
    CHECK(after.kinetic < 0.5 * before.kinetic);
  }
}

TEST_CASE("a free body flies on its parabola and spins for good", "[rubble]") {
  RubbleScene scene = ground();
  add_box(scene, {0, 0, 50}, Eigen::Quaterniond::Identity(), {0.01, 0.02, 0.03}, 1000);
  RubbleBody& body = scene.bodies[1];
  body.momentum = body.mass * Vec3(1, 2, 3);
  body.angular_momentum = body.inertia * Vec3(30, 1, 20);
  const Vec3 spin = body.angular_momentum;
  const double mass = body.mass;
  const double rotation = kinetic_energy(body) - 0.5 * body.momentum.squaredNorm() / mass;
  run(scene, earth(), 240);
  const Vec3 truth = Vec3(1, 2, 3) + Vec3(0, 0, 50 - 0.5 * 9.81);
  CHECK((scene.bodies[1].centre - truth).norm() < 1e-10);
  CHECK(scene.bodies[1].angular_momentum == spin);
  const double left =
      kinetic_energy(scene.bodies[1]) - 0.5 * scene.bodies[1].momentum.squaredNorm() / mass;
  CHECK(left == Approx(rotation).epsilon(1e-9));
}

TEST_CASE("an incline is slid on if and only if it is steeper than friction", "[rubble]") {
  for (const double friction : {0.3, 0.6}) {
    for (const double part : {0.99, 1.01}) {
      for (const bool chip : {false, true}) {
        RubbleScene scene = ground(friction);
        if (chip) {
          add_tetrahedron(
              scene, {Vec3(0, 0, 0), Vec3(0.02, 0, 0), Vec3(0, 0.02, 0), Vec3(0.006, 0.006, 0.008)},
              2400);
        } else {
          add_box(scene, {0, 0, 0.01}, Eigen::Quaterniond::Identity(), {0.02, 0.02, 0.01}, 2400);
        }
        scene.bodies[1].friction = friction;
        RubbleSettings settings = earth();
        settings.sleep_after = 0;
        const double angle = std::atan(part * friction);
        settings.gravity = 9.81 * Vec3(std::sin(angle), 0, -std::cos(angle));
        const Vec3 from = scene.bodies[1].centre;
        run(scene, settings, 480);
        const double way = (scene.bodies[1].centre - from)[0];
        const double pull = 9.81 * (std::sin(angle) - friction * std::cos(angle));
        INFO("friction " << friction << " part " << part << " chip " << chip << " way " << way);
        if (part < 1) {
          CHECK(std::abs(way) < 1e-4);
        } else {
          CHECK(way == Approx(0.5 * pull * 4).epsilon(0.1));
        }
      }
    }
  }
}

TEST_CASE("stacks of boxes stand", "[rubble]") {
  for (const int count : {5, 20, 50}) {
    RubbleScene scene = ground();
    for (int k = 0; k < count; ++k) {
      add_box(scene, {0, 0, 0.01 + 0.02 * k}, Eigen::Quaterniond::Identity(), {0.01, 0.01, 0.01},
              2400);
    }
    RubbleSettings settings = earth();
    settings.sleep_after = 0;
    run(scene, settings, 1200);
    const RubbleBody& top = scene.bodies.back();
    INFO(count);
    CHECK(top.centre.head<2>().norm() < 1e-3);
    CHECK(top.centre[2] == Approx(0.02 * count - 0.01).epsilon(0.01));
    CHECK(kinetic_energy(top) < 1e-8);
    CHECK(see_overlaps(parts_of(scene)).deepest < 0.02 * 0.02);
  }
}

TEST_CASE("a heap comes to rest and sleeps, struck, it wakes, its overlaps are small", "[rubble]") {
  RubbleScene scene = broken_block({3, 3, 4}, 0.01, {0, 0, 0.02}, 2, 4);
  const RubbleSettings settings = earth();
  const RubbleReport report = run(scene, settings, 960);
  CHECK(report.awake == 0);
  CHECK(report.asleep == 216);
  const std::vector<SeenPart> parts = parts_of(scene);
  const SeenOverlaps seen = see_overlaps(parts);
  CHECK(seen.deepest < 0.02 * 0.0125);
  CHECK(seen.mean < 0.002 * 0.0125);
  CHECK(below_ground(parts) < 1e-4);
  // A sleeper takes no time and no place.
  const Vec3 at = scene.bodies[7].centre;
  run(scene, settings, 10);
  CHECK(scene.bodies[7].centre == at);
  add_ball(scene, {0.015, 0.015, 0.3}, 0.02, 7800);
  scene.bodies.back().momentum = scene.bodies.back().mass * Vec3(0, 0, -3);
  std::uint32_t awake = 0;
  RubbleScratch scratch;
  const Sums before = sums_of(scene, settings.gravity);
  Impulse given = Impulse::Zero();
  for (int k = 0; k < 60; ++k) {
    const RubbleReport tick =
        advance_rubble(scene.bodies, scene.shapes, scene.memory, settings, scratch);
    awake = std::max(awake, tick.awake);
    given += tick.gravity + tick.contact - tick.sleep;
  }
  CHECK(awake > 100);
  const Sums after = sums_of(scene, settings.gravity);
  CHECK((after.momentum - before.momentum - given.head<3>()).norm() < 1e-12);
  CHECK((after.angular - before.angular - given.tail<3>()).norm() < 1e-12);
}

TEST_CASE("fast balls do not pass a thin plate", "[rubble]") {
  for (const double speed : {1.0, 10.0, 30.0, 100.0, 300.0}) {
    RubbleScene scene;
    RubbleBody plate;
    plate.centre = {0, 0, 0};
    plate.radius = 1.5;
    scene.bodies.push_back(plate);
    RubbleShape& shape = scene.shapes.emplace_back();
    shape.kind = RubbleShape::Kind::box;
    shape.half_extent = {1, 1, 0.0005};
    for (int k = 0; k < 9; ++k) {
      add_ball(scene, {0.3 * (k % 3 - 1), 0.3 * (k / 3 - 1), 0.1 + 0.37 * k}, 0.01, 7800);
      RubbleBody& ball = scene.bodies.back();
      ball.momentum = ball.mass * Vec3(0.02 * k, 0, -speed);
    }
    RubbleSettings settings;
    settings.sleep_after = 0;
    run(scene, settings, static_cast<int>(4 / speed * 240) + 4);
    for (std::size_t k = 1; k < scene.bodies.size(); ++k) {
      INFO(speed << " " << k);
      CHECK(scene.bodies[k].centre[2] > 0.009);
    }
  }
}

TEST_CASE("the same bytes on any number of threads", "[rubble]") {
  RubbleScene one = broken_block({4, 4, 4}, 0.01, {0, 0, 0.01}, 2, 9), three = one;
  RubbleSettings settings = earth();
  run(one, settings, 40);
  settings.threads = 3;
  run(three, settings, 40);
  for (std::size_t k = 0; k < one.bodies.size(); ++k) {
    CHECK(one.bodies[k].centre == three.bodies[k].centre);
    CHECK(one.bodies[k].angular_momentum == three.bodies[k].angular_momentum);
  }
  CHECK(one.memory.points.size() == three.memory.points.size());
}

TEST_CASE("a quarter of the tick gives the same heap", "[rubble]") {
  double height[2] = {0, 0}, spread[2] = {0, 0};
  for (const unsigned seed : {1u, 2u, 3u, 4u}) {
    for (const int finer : {0, 1}) {
      RubbleScene scene = broken_block({3, 3, 4}, 0.01, {0, 0, 0.02}, 1, seed);
      RubbleSettings settings = earth();
      if (finer) settings.length /= 4;
      run(scene, settings, finer ? 1920 : 480);
      for (std::size_t k = 1; k < scene.bodies.size(); ++k) {
        height[finer] += scene.bodies[k].centre[2];
        spread[finer] += (scene.bodies[k].centre.head<2>() - Eigen::Vector2d(0.015, 0.015)).norm();
      }
    }
  }
  CHECK(height[1] == Approx(height[0]).epsilon(0.1));
  CHECK(spread[1] == Approx(spread[0]).epsilon(0.1));
}

namespace {

/// Faces that two chips of a block share, as partners.
std::vector<RubblePartner> partners_of(const RubbleScene& scene, double reach) {
  const auto place = [&](std::size_t shape, std::size_t k) -> Vec3 {
    const RubbleBody& body = scene.bodies[scene.shapes[shape].body];
    return body.centre + body.orientation * scene.shapes[shape].corner[k];
  };
  std::vector<Vec3> points;
  const auto point_of = [&](const Vec3& at) {
    for (std::uint32_t k = 0; k < points.size(); ++k) {
      if ((points[k] - at).norm() < 1e-9) return k;
    }
    points.push_back(at);
    return static_cast<std::uint32_t>(points.size() - 1);
  };
  std::vector<RubblePartner> partners;
  for (std::uint32_t a = 1; a < scene.shapes.size(); ++a) {
    for (std::uint32_t b = a + 1; b < scene.shapes.size(); ++b) {
      RubblePartner p{a, b, {}, {}, {}, reach};
      std::size_t shared = 0;
      for (std::uint8_t i = 0; i < 4; ++i) {
        for (std::uint8_t j = 0; j < 4; ++j) {
          if ((place(a, i) - place(b, j)).norm() > 1e-9 || shared == 3) continue;
          p.corner_a[shared] = i;
          p.corner_b[shared] = j;
          p.point[shared++] = point_of(place(a, i));
        }
      }
      if (shared == 3) partners.push_back(p);
    }
  }
  return partners;
}

/// Makes one body of all chips on each side of the plane x = 0.
RubbleScene in_halves(const RubbleScene& chips) {
  RubbleScene scene = ground();
  scene.bodies.resize(3);
  for (std::size_t k = 1; k < chips.bodies.size(); ++k) {
    const RubbleBody& chip = chips.bodies[k];
    RubbleBody& half = scene.bodies[chip.centre[0] < 0 ? 1 : 2];
    half.mass += chip.mass;
    half.centre += chip.mass * chip.centre;
    half.momentum += chip.momentum;
  }
  for (std::size_t h : {1u, 2u}) scene.bodies[h].centre /= scene.bodies[h].mass;
  for (std::size_t k = 1; k < chips.bodies.size(); ++k) {
    const RubbleBody& chip = chips.bodies[k];
    const std::uint32_t row = chip.centre[0] < 0 ? 1 : 2;
    RubbleBody& half = scene.bodies[row];
    const Vec3 arm = chip.centre - half.centre;
    half.inertia +=
        chip.inertia + chip.mass * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
    RubbleShape shape = chips.shapes[k];
    shape.body = row;
    for (Vec3& corner : shape.corner) {
      corner += arm;
      half.radius = std::max(half.radius, corner.norm());
    }
    scene.shapes.push_back(shape);
  }
  return scene;
}

}  // namespace

TEST_CASE("faces that were one meet each other and nothing else near them", "[rubble]") {
  RubbleScene with = in_halves(broken_block({2, 2, 2}, 0.01, {-0.01, 0, 0}, 0.1, 0));
  RubbleScene without = with;
  std::vector<RubblePartner> partners = partners_of(with, 0.5e-3);
  const auto of_one = [&](const RubblePartner& p) {
    return with.shapes[p.shape_a].body == with.shapes[p.shape_b].body;
  };
  std::erase_if(partners, of_one);
  CHECK(partners.size() == 8);
  // One turns against the other.
  with.bodies[1].angular_momentum[1] = without.bodies[1].angular_momentum[1] =
      2 * with.bodies[1].inertia(1, 1);
  RubbleScratch scratch, plain;
  RubbleSettings settings = earth();
  std::uint32_t patches = 0, plain_patches = 0;
  for (int k = 0; k < 720; ++k) {
    const RubbleReport report =
        advance_rubble(with.bodies, with.shapes, with.memory, settings, scratch, nullptr, partners);
    const RubbleReport other =
        advance_rubble(without.bodies, without.shapes, without.memory, settings, plain);
    if (k == 0) {
      patches = report.manifolds;
      plain_patches = other.manifolds;
    }
    CHECK(report.deepest < 3e-4);
  }
  CHECK(patches <= plain_patches);
  // They lie where they would lie without.
  for (std::size_t row : {1u, 2u}) {
    CHECK((with.bodies[row].centre - without.bodies[row].centre).norm() < 2e-3);
    CHECK(with.bodies[row].asleep);
  }
  CHECK(see_overlaps(parts_of(with)).deepest < 1e-4);
}

TEST_CASE("a blow has the speed of the approach and the energy that stops it", "[rubble]") {
  for (const double speed : {0.5, 3.0, 20.0}) {
    RubbleScene scene;
    RubbleBody ground, ball;
    ball.mass = 2;
    ball.radius = 0.1;
    ball.inertia = 0.4 * ball.mass * 0.01 * Mat3::Identity();
    ball.centre = {0, 0, 0.1 + 1e-3};
    ball.momentum = ball.mass * Vec3(0.3, 0, -speed);
    scene.bodies = {ground, ball};
    RubbleShape floor, round;
    floor.kind = RubbleShape::Kind::half_space;
    round.kind = RubbleShape::Kind::ball;
    round.body = 1;
    round.key = 1;
    round.radius = 0.1;
    scene.shapes = {floor, round};
    RubbleSettings settings;  // no gravity
    settings.sleep_after = 0;
    const RubbleReport first = run(scene, settings, 1);
    CHECK(first.blow[1].speed == Approx(speed));
    CHECK(first.blow[0].speed == Approx(speed));
    // A point that comes to rest over the four sub-steps counts in both sweeps of each.
    const double energy = 0.5 * ball.mass * speed * speed;
    CHECK(first.blow[1].energy >= (1 - 1e-9) * energy);
    CHECK(first.blow[1].energy < 8 * energy);
    // The ball stands on the floor, or leaves it.
    const RubbleReport second = run(scene, settings, 1);
    CHECK(second.blow[1].speed < 0.01 * speed);
  }
}
