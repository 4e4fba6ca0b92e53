// SPDX-License-Identifier: MIT
// Smoothing of drawn motion (section 3.3): frame rates, half turns, splits.
#include "mechanics/state/display_state.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

using namespace sunder;

namespace {

Pose state_at(const Vec3& translation, double angle, const Vec3& axis) {
  return {translation, Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis.normalized()))};
}

double angle_between(const Pose& a, const Pose& b) {
  return a.orientation.angularDistance(b.orientation);
}

}  // namespace

TEST_CASE("what is drawn does not depend on the frame rate", "[mechanics][display_state]") {
  const Pose start = state_at({0, 0, 0}, 0.2, {1, 0, 0});
  const Pose target = state_at({1, -2, 3}, 2.5, {1, 2, -1});
  const int frames = GENERATE(2, 7, 60, 1000);
  const Pose once = approach(start, target, 0.3, 0.1);
  Pose many = start;
  for (int k = 0; k < frames; ++k) many = approach(many, target, 0.3 / frames, 0.1);
  // Rounding grows with the number of frames.
  CHECK((many.centre - once.centre).norm() < 1e-15 * 8 * frames);
  CHECK(angle_between(many, once) < 1e-7);  // angularDistance is good to sqrt(eps)
  CHECK((many.orientation.toRotationMatrix() - once.orientation.toRotationMatrix()).norm() <
        1e-15 * 16 * frames);
}

TEST_CASE("alpha is one minus exp of minus dt over T, for both parts",
          "[mechanics][display_state]") {
  const Pose start = state_at({0, 0, 0}, 0, {0, 0, 1});
  const Pose target = state_at({1, 0, 0}, 1.0, {0, 0, 1});
  const Pose now = approach(start, target, 0.05, 0.1);
  const double alpha = 1 - std::exp(-0.5);
  CHECK(now.centre.x() == Approx(alpha).epsilon(1e-14));
  CHECK(angle_between(now, start) == Approx(alpha).epsilon(1e-12));
  CHECK(approach(start, target, 0, 0.1).centre == start.centre);
  CHECK(approach(start, target, 0.01, 0).centre == target.centre);
}

TEST_CASE("a rotation of a quaternion with negative w is taken the short way",
          "[mechanics][display_state]") {
  const Pose start = state_at({0, 0, 0}, 0, {0, 0, 1});
  Pose target = state_at({0, 0, 0}, 0.4, {0, 0, 1});
  target.orientation.coeffs() *= -1;
  const Pose now = approach(start, target, 0.1, 0.1);
  CHECK(angle_between(now, start) < 0.4);
  CHECK(angle_between(now, target) < 0.4);
}

TEST_CASE("a half turn is gone through, not stuck at", "[mechanics][display_state]") {
  const double pi = std::acos(-1.0);
  const Pose target = state_at({0, 0, 0}, pi, {1, 1, 0});
  Pose now = state_at({0, 0, 0}, 0, {1, 0, 0});
  double angle = angle_between(now, target);
  for (int k = 0; k < 40; ++k) {
    now = approach(now, target, 0.05, 0.1);
    CHECK(now.orientation.coeffs().allFinite());
    const double next = angle_between(now, target);
    CHECK(next <= angle + 1e-7);
    angle = next;
  }
  CHECK(angle < 1e-6);
}

TEST_CASE("a new piece is drawn exactly where it was", "[mechanics][display_state]") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-1, 1);
  const auto vector = [&] { return Vec3(place(random), place(random), place(random)); };
  for (int k = 0; k < 50; ++k) {
    const Pose old = state_at(vector(), 3 * place(random), vector());
    const Vec3 old_center = vector(), new_center = vector(), rest = vector();
    const Pose piece = split_off(old, old_center, new_center);
    const Vec3 before = old.orientation * (rest - old_center) + old.centre;
    const Vec3 after = piece.orientation * (rest - new_center) + piece.centre;
    CHECK((after - before).norm() < 1e-15 * 32);
  }
}

TEST_CASE("a body in flight is drawn where it is, and only a split's jump is smoothed",
          "[mechanics][display_state]") {
  const double dt = 1e-2, T = 0.1;
  Pose target = state_at({0, 0, 0}, 0, {0, 1, 0});
  Pose shown = state_at({0.1, 0, 0}, 0.05, {0, 1, 0});
  const double jump = 0.1;
  for (int k = 1; k <= 50; ++k) {
    const Pose next = state_at({5 * dt * k, 0, 1}, 0.3 * k, {0, 0, 1});
    shown = approach(carry(shown, target, next), next, dt, T);
    target = next;
    CHECK((shown.centre - target.centre).norm() ==
          Approx(jump * std::exp(-k * dt / T)).epsilon(1e-9));
    CHECK(angle_between(shown, target) == Approx(0.05 * std::exp(-k * dt / T)).margin(1e-7));
  }
}
