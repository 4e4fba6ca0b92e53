// SPDX-License-Identifier: MIT
// Impacts in explicit steps: the laws that hold in them.
#include "mechanics/contact/waves/explicit_wave.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "tests/mechanics/contact/contact_scene.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

StepPart wave_of(double length) {
  StepPart part;
  part.deformation = Deformation::wave;
  part.contacts_for = length;
  return part;
}

/// Two blocks, a rigid tetrahedron and a free ball that meet.
ContactScene meeting(std::mt19937& random, double speed) {
  Body right = shaken(kuhn_block({2, 2, 2}, Vec3(0.2, 0.2, 0.2)), 0.01, random);
  for (Vec3& x : right.rest) x += Vec3(0.2 + 0.021, 0.03, 0.01);
  Body chip = single_tetrahedron(0.1);
  for (Vec3& x : chip.rest) x += Vec3(-0.02, 0.112, -0.03);
  const SeveralBodies all =
      together({shaken(kuhn_block({2, 2, 2}, Vec3(0.2, 0.2, 0.2)), 0.01, random), right, chip});
  ContactScene scene{all.body, state_of(all, material_of(1e9))};
  place(scene.state, ComponentId{0}, {.velocity = {speed, 0.2 * speed, 0}, .spin = {1, 2, 3}});
  place(scene.state, ComponentId{1}, {.velocity = {-speed, 0, 0.1 * speed}});
  place(scene.state, ComponentId{2}, {.velocity = {0, -speed, 0}, .spin = {0, 5, 1}});
  scene.obstacles = {{.shape = Sphere{Vec3(0.2, -0.17, 0), 0.05},
                      .velocity = {0.1, speed, 0},
                      .spin = {3, 0, 1},
                      .friction = 0.4,
                      .mass = 1.5}};
  scene.contact.friction = 0.5;
  return scene;
}

/// Takes a part of so many sub-steps that asks `ends` between them.
ContactStepResult take_sub_steps(ContactScene& scene, double sub_step, std::uint32_t count,
                                 const std::function<bool()>& ends) {
  const auto neighbours = neighbours_of(scene.body.corners);
  IntegratorSettings settings = scene.integrator;
  settings.time_step = count * sub_step;
  StepPart part = wave_of(settings.time_step);
  part.sub_steps = count;
  return advance_with_contact({scene.state, scene.obstacles, scene.memory},
                              {.corners = scene.body.corners,
                               .loads = scene.loads,
                               .settings = settings,
                               .part = part,
                               .neighbours = neighbours,
                               .measures_strain = true,
                               .ends = &ends},
                              scene.contact, {scene.mechanics, scene.scratch});
}

bool goes_on() { return false; }

}  // namespace

TEST_CASE("explicit steps keep momentum and angular momentum, whatever meets",
          "[mechanics][waves]") {
  std::mt19937 random(31);
  for (int trial = 0; trial < 3; ++trial) {
    ContactScene scene = meeting(random, 2);
    const Vec3 p = scene.total_momentum(), l = scene.total_angular_momentum();
    const double length = 2e-5;
    std::size_t contacts = 0;
    for (int k = 0; k < 700; ++k) contacts += scene.take(wave_of(length), length).contacts.size();
    CHECK(contacts > 100);
    double size = 0;
    for (std::size_t v = 0; v < scene.state.vertices.size(); ++v) {
      size += scene.state.vertices.mass[v] * scene.state.vertices.velocity[v].norm();
    }
    CHECK((scene.total_momentum() - p).norm() < 1e-12 * size);
    CHECK((scene.total_angular_momentum() - l).norm() < 1e-9 * size);
  }
}

TEST_CASE("energy does not rise in explicit steps, and the works measured add up",
          "[mechanics][waves]") {
  std::mt19937 random(32);
  ContactScene scene = meeting(random, 2);
  const double length = 2e-5, start = scene.energy();
  double highest = start, kinetic = kinetic_energy(scene.state.vertices), by_forces = 0;
  for (int k = 0; k < 700; ++k) {
    const ContactStepResult result = take_sub_steps(scene, length, 1, goes_on);
    REQUIRE(result.status.outcome == StepOutcome::fine);
    REQUIRE(result.trace);
    by_forces += result.trace->work.inner + result.trace->contact.contact;
    highest = std::max(highest, scene.energy());
  }
  CHECK(highest < start * (1 + 1e-3));
  CHECK(scene.energy() < start);
  CHECK(kinetic_energy(scene.state.vertices) - kinetic == Approx(by_forces).margin(1e-6 * kinetic));
}

TEST_CASE("contacts found for several parts serve them as contacts found in each",
          "[mechanics][waves]") {
  const auto run = [](int served) {
    std::mt19937 random(33);
    ContactScene scene = meeting(random, 2);
    const double length = 1e-5;
    for (int k = 0; k < 1200; ++k) {
      StepPart part = wave_of(length);
      part.contacts_for = k % served == 0 ? served * length : 0;
      scene.take(part, length);
    }
    return scene;
  };
  const ContactScene each = run(1), kept = run(4);
  for (std::size_t c = 0; c < 3; ++c) {
    const Component &a = each.state.components[c], &b = kept.state.components[c];
    CHECK((a.momentum - b.momentum).norm() < 0.05 * a.mass * 2);
    CHECK((a.centre - b.centre).norm() < 1e-4);
  }
}

TEST_CASE("a block falls on a plane and leaves it as fast with parts of any length",
          "[mechanics][waves]") {
  const auto rebound = [](double length) {
    Body block = kuhn_block({3, 3, 3}, Vec3(0.3, 0.3, 0.3));
    for (Vec3& x : block.rest) x.z() += 0.15 + 1e-3;
    ContactScene scene{block, state_of(together({block}), material_of(1e9))};
    place(scene.state, ComponentId{0}, {.velocity = {0, 0, -1}});
    scene.obstacles = {{.shape = Plane{}}};
    for (int k = 0; k < static_cast<int>(4e-3 / length); ++k) {
      scene.take(wave_of(length), length);
    }
    return scene.state.components[0].momentum.z() / scene.state.components[0].mass;
  };
  const double whole = rebound(2e-5);
  CHECK(whole > 0.5);
  CHECK(whole <= 1);
  CHECK(whole == Approx(rebound(2e-6)).margin(0.03));
}

TEST_CASE("a part of many sub-steps goes as they go one by one", "[mechanics][waves]") {
  const double sub_step = 1e-5;
  const auto run = [&](std::uint32_t together) {
    std::mt19937 random(34);
    ContactScene scene = meeting(random, 2);
    for (std::uint32_t k = 0; k < 1200; k += together) {
      take_sub_steps(scene, sub_step, together, goes_on);
    }
    return scene;
  };
  const ContactScene each = run(1), together = run(8);
  CHECK(together.state.time == Approx(each.state.time));
  for (std::size_t c = 0; c < 3; ++c) {
    const Component &a = each.state.components[c], &b = together.state.components[c];
    CHECK((a.momentum - b.momentum).norm() < 0.05 * a.mass * 2);
    CHECK((a.centre - b.centre).norm() < 2e-4);
    CHECK(a.orientation.angularDistance(b.orientation) < 5e-3);
  }
}

TEST_CASE("a part ends at the sub-step that is asked for, with the stresses that were shown",
          "[mechanics][waves]") {
  std::mt19937 random(35);
  ContactScene scene = meeting(random, 2);
  const double sub_step = 1e-5;
  for (int k = 0; k < 60; ++k) take_sub_steps(scene, sub_step, 16, goes_on);
  const auto strain = [&] { return strain_energy(scene.state); };
  const Vec3 p = scene.total_momentum(), l = scene.total_angular_momentum();
  const double start = scene.state.time, before = strain();
  std::vector<double> asked_at;
  std::vector<Mat3> shown;
  const std::function<bool()> third = [&] {
    asked_at.push_back(scene.state.time);
    shown = scene.state.elements.stress;
    return asked_at.size() == 3;
  };
  const ContactStepResult result = take_sub_steps(scene, sub_step, 16, third);
  CHECK(result.sub_steps == 3);
  CHECK(scene.state.time == Approx(start + 3 * sub_step));
  REQUIRE(asked_at.size() == 3);
  CHECK(asked_at[0] == Approx(start + sub_step));
  CHECK(asked_at[2] == Approx(scene.state.time));
  CHECK((scene.total_momentum() - p).norm() < 1e-12);
  CHECK((scene.total_angular_momentum() - l).norm() < 1e-10);
  double largest = 0, off = 0, change = 0;
  for (std::size_t t = 0; t < shown.size(); ++t) {
    const Component& c = scene.state.components[scene.state.elements.component[t].index()];
    if (c.rigid) continue;
    largest = std::max(largest, shown[t].norm());
    off = std::max(off, (shown[t] - scene.state.elements.stress[t]).norm());
  }
  CHECK(largest > 0);
  CHECK(off < 1e-6 * largest);
  for (const Component& c : scene.state.components) {
    change += c.strain_change.after - c.strain_change.before;
  }
  CHECK(change == Approx(strain() - before).margin(1e-12 * before));
}
