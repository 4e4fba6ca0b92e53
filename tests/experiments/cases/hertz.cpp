// SPDX-License-Identifier: MIT
// Builds the round block, lets it strike and measures.
#include "tests/experiments/cases/hertz.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "fracture/simulation/simulation_state.hpp"
#include "topology/suite/fixtures/shapes.hpp"

namespace sunder::accuracy {
namespace {

using std::numbers::pi;
constexpr double half_width = 0.5, block_height = 1, round = 1;

/// k of sinh(k u) / sinh(k), the place of the u-th part of an edge of length 1 in `n` cells, the
/// first of which is `first` wide.
double grading(double first, int n) {
  double low = 1e-6, high = 20;
  for (int i = 0; i < 60; ++i) {
    const double k = 0.5 * (low + high);
    (std::sinh(k / n) / std::sinh(k) > first ? low : high) = k;
  }
  return low;
}

double graded(double u, double k) { return std::sinh(k * u) / std::sinh(k); }

TetMesh round_block(const HertzImpact& impact) {
  const int n = impact.cells, nz = std::max(2, 2 * n / 3 + 1);
  TetMesh mesh = suite::kuhn_box({2 * n, 2 * n, nz}, 1);
  const double k = grading(impact.smallest / half_width, n);
  const double kz = grading(impact.smallest / block_height, nz);
  for (Point& p : mesh.points) {
    const double x = half_width * graded(p[0] / n - 1, k);
    const double y = half_width * graded(p[1] / n - 1, k);
    const double z = block_height * graded(p[2] / nz, kz);
    p = {x, y, z + (1 - z / block_height) * (x * x + y * y) / (2 * round)};
  }
  return mesh;
}

Scene scene_of(const HertzImpact& impact) {
  Scene scene;
  scene.fracture.crack = CrackMode::paper;
  BodySettings block;
  block.name = "block";
  block.mesh = round_block(impact);
  block.material.poisson_ratio = impact.poisson_ratio;
  block.velocity = {0, 0, -impact.speed};
  scene.integrator.time_step = 1e-4;
  block.translation = {0, 0, 0.4 * scene.integrator.time_step * impact.speed};
  scene.bodies.push_back(std::move(block));
  scene.obstacles = {{.shape = Plane{{0, 0, 1}, 0}, .friction = 0}};
  scene.gravity.acceleration.setZero();
  scene.contact.friction = 0;
  scene.contact.max_contacts_per_pair = 1024;
  scene.impact.negligible = 1e-6;
  scene.fracture.mode = FractureMode::off;
  return scene;
}

/// Hertz's figures of the impact.
struct Hertz {
  double modulus, depth, force, radius, time;
};

Hertz hertz_of(const HertzImpact& impact, double mass) {
  const Material concrete;
  const double nu = impact.poisson_ratio, v = impact.speed;
  const double modulus = concrete.young_modulus / (1 - nu * nu);
  const double depth = std::pow(15 * mass * v * v / (16 * modulus * std::sqrt(round)), 0.4);
  return {modulus, depth, 4.0 / 3 * modulus * std::sqrt(round) * std::pow(depth, 1.5),
          std::sqrt(round * depth),
          2.87 * std::pow(mass * mass / (round * modulus * modulus * v), 0.2)};
}

/// The contact as it was when it pressed hardest.
struct Peak {
  double force = 0;     ///< N
  double moment = 0;    ///< sum of force times r^2, N m^2
  double pressure = 0;  ///< Pa, on the vertex in the middle
};

/// Impulses of a part of a step on the wall.
void watch(Peak& peak, const Simulation& sim, const PartReport& part, double cell) {
  const double force = part.contact.impulse_of(0).z() / part.length;
  if (force <= peak.force) return;
  peak = {force, 0, 0};
  for (const ContactMemory::Remembered& last : sim.state->contact.last_contacts) {
    const ContactPoint& contact = last.contact;
    const Vec3& at = sim.state->mechanics.vertices.position[contact.vertex.index()];
    const double push = contact.impulse.z() / part.length, r = std::hypot(at.x(), at.y());
    peak.moment += push * r * r;
    if (r < cell / 2) peak.pressure = push / (cell * cell);
  }
}

}  // namespace

HertzOutcome run_hertz(const HertzImpact& impact) {
  Result<Simulation> sim = build_simulation(scene_of(impact));
  if (!sim) throw std::runtime_error(sim.findings.front().text);
  const Component& block = sim->state->mechanics.components[0];
  const Hertz hertz = hertz_of(impact, block.mass);
  Peak peak;
  double first = -1, last = -1;
  const StepObserver observe = [&](const Simulation& now, const PartReport& part) {
    watch(peak, now, part, impact.smallest);
    if (part.contact.impulse_of(0).z() < 1e-3 * hertz.force * part.length) return;
    last = now.state->mechanics.time;
    if (first < 0) first = last - part.length;
  };
  const double h = sim->scene.integrator.time_step;
  for (double time = 0; time < 3 * hertz.time && (last < 0 || time < last + 4 * h); time += h) {
    const StepReport report = advance(*sim, observe);
    if (report.status.outcome != StepOutcome::fine) {
      throw std::runtime_error(to_finding(report.status).text);
    }
  }
  HertzOutcome seen;
  seen.vertices = sim->state->mechanics.vertices.size();
  seen.radius_cells = hertz.radius / impact.smallest;
  seen.contact_time = (last - first) / hertz.time;
  seen.force = peak.force / hertz.force;
  const double a = std::sqrt(2.5 * peak.moment / peak.force);
  seen.radius = a / hertz.radius;
  seen.law = peak.force / (4.0 / 3 * hertz.modulus * a * a * a / round);
  seen.pressure = peak.pressure / (1.5 * peak.force / (pi * a * a));
  seen.rebound = block.momentum.z() / block.mass / impact.speed;
  return seen;
}

}  // namespace sunder::accuracy
