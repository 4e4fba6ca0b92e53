// SPDX-License-Identifier: MIT
// A body among obstacles with everything a step with contact needs, for tests.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <vector>

#include "mechanics/contact/contact.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "mechanics/contact/step_division.hpp"
#include "mechanics/element/energy.hpp"
#include "tests/support/bodies.hpp"

namespace sunder::test {

/// The half-face beyond each face: two faces with the same corners are one.
inline std::vector<std::array<HalfFaceId, 4>> neighbours_of(std::span<const Corners> corners) {
  std::vector<std::array<HalfFaceId, 4>> neighbours(corners.size());
  std::map<std::array<VertexId, 3>, HalfFaceId> open;
  for (std::size_t t = 0; t < corners.size(); ++t) {
    for (int place = 0; place < 4; ++place) {
      std::array<VertexId, 3> face;
      for (std::size_t i = 0, k = 0; i < 4; ++i) {
        if (static_cast<int>(i) != place) face[k++] = corners[t][i];
      }
      std::ranges::sort(face);
      const HalfFaceId mine = half_face(TetId{t}, place);
      const auto [other, is_new] = open.emplace(face, mine);
      if (is_new) continue;
      const HalfFaceId theirs = other->second;
      neighbours[t][static_cast<std::size_t>(place)] = theirs;
      neighbours[tetrahedron_of(theirs).index()][static_cast<std::size_t>(place_of(theirs))] = mine;
      open.erase(other);
    }
  }
  return neighbours;
}

/// State, obstacles and scratch that live together.
struct ContactScene {
  Body body;
  MechanicsState state;
  std::vector<Obstacle> obstacles = {};
  IntegratorSettings integrator = {};
  ContactSettings contact = {};
  Loads loads = {};
  ContactMemory memory = {};
  MechanicsScratch mechanics = {};
  ContactScratch scratch = {};

  ContactStepResult step(const StepPart& part = {}) { return take(part, integrator.time_step); }

  /// One step, in parts if pieces would pass each other in it, as the plan of a simulation divides
  /// it (fracture/simulation/plan.cpp). Gives the last part, with the deepest
  /// overlap and the most contacts of all parts. `observe()` is called after each part.
  template <class Observe>
  ContactStepResult step_in_parts(Observe observe) {
    StepDivision division;
    ContactStepResult last;
    std::uint32_t contacts = 0;
    double deepest = 0;
    while (division.taken < division.parts) {
      StepPart part;
      part.divides = division.may_divide();
      last = take(part, integrator.time_step / division.parts);
      if (last.passing_way > 0) {
        divide(division, last.passing_way);
        continue;
      }
      take_part(division);
      observe();
      contacts = std::max(contacts, last.report.contacts);
      deepest = std::max(deepest, last.report.deepest);
    }
    last.report.contacts = contacts;
    last.report.deepest = deepest;
    return last;
  }

  ContactStepResult step_in_parts() {
    return step_in_parts([] {});
  }

  ContactStepResult take(const StepPart& part, double length) {
    const auto neighbours = neighbours_of(body.corners);
    IntegratorSettings settings = integrator;
    settings.time_step = length;
    return advance_with_contact({state, obstacles, memory},
                                {.corners = body.corners,
                                 .loads = loads,
                                 .settings = settings,
                                 .part = part,
                                 .neighbours = neighbours},
                                contact, {mechanics, scratch});
  }

  /// Kinetic, strain and gravitational energy of bodies and balls, J.
  double energy() const {
    double sum = kinetic_energy(state.vertices) + strain_energy(state) +
                 gravity_energy(state.vertices, loads.gravity);
    for (const Obstacle& ball : obstacles) {
      if (!ball.mass) continue;
      sum += 0.5 * *ball.mass * ball.velocity.squaredNorm() +
             0.5 * moment_of_inertia(ball) * ball.spin.squaredNorm() -
             *ball.mass * loads.gravity.dot(std::get<Sphere>(ball.shape).center);
    }
    return sum;
  }

  Vec3 total_momentum() const {
    Vec3 sum = momentum(state.vertices);
    for (const Obstacle& ball : obstacles) {
      if (ball.mass) sum += *ball.mass * ball.velocity;
    }
    return sum;
  }

  Vec3 total_angular_momentum() const {
    Vec3 sum = angular_momentum(state.vertices);
    for (const Obstacle& ball : obstacles) {
      if (!ball.mass) continue;
      sum += *ball.mass * std::get<Sphere>(ball.shape).center.cross(ball.velocity) +
             moment_of_inertia(ball) * ball.spin;
    }
    return sum;
  }
};

/// Bodies side by side as one mesh, each a component of its own.
struct SeveralBodies {
  Body body;
  std::vector<ComponentId> component;  ///< |T|
};

inline SeveralBodies together(const std::vector<Body>& parts) {
  SeveralBodies all;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const std::size_t first = all.body.rest.size();
    all.body.rest.insert(all.body.rest.end(), parts[k].rest.begin(), parts[k].rest.end());
    for (Corners t : parts[k].corners) {
      for (VertexId& v : t) v = VertexId{v.index() + first};
      all.body.corners.push_back(t);
      all.component.emplace_back(k);
    }
  }
  return all;
}

inline MechanicsState state_of(const SeveralBodies& all, const Material& material) {
  BodyDescription description{all.body.rest, all.body.corners, {}, all.component, {&material, 1}};
  return *make_state(description);
}

inline Material material_of(double young_modulus, double density = 2400,
                            double poisson_ratio = 0.2) {
  Material m;
  m.young_modulus = young_modulus;
  m.poisson_ratio = poisson_ratio;
  m.density = density;
  return m;
}

}  // namespace sunder::test
