// SPDX-License-Identifier: MIT
// The bar as a scene, its run, and the counts.
#include "tests/experiments/cases/crack_growth.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "fracture/simulation/simulation_state.hpp"
#include "topology/suite/fixtures/shapes.hpp"

namespace sunder::accuracy {
namespace {

/// Moves vertices that are neither on the surface nor on the cut.
void shake(TetMesh& mesh, const NotchedBar& bar) {
  const double b = bar.height, cell = b / bar.cells, eps = 1e-3 * cell;
  std::mt19937 random(1);
  const auto shift = [&] { return bar.shake * cell * (double(random()) / 2147483648.0 - 1); };
  for (Point& p : mesh.points) {
    if (p[0] < eps || p[0] > 2 * b - eps) continue;
    if (p[1] < 0.25 * b + eps && std::abs(p[0] - b) < eps) continue;
    const Point by = {shift(), shift(), shift()};
    const auto inside = [&](int axis, double end) {
      return p[std::size_t(axis)] > eps && p[std::size_t(axis)] < end - eps;
    };
    p = {p[0] + by[0], p[1] + inside(1, b) * by[1], p[2] + inside(2, bar.thickness * cell) * by[2]};
  }
}

Scene scene_of(const NotchedBar& bar) {
  const double b = bar.height, cell = b / bar.cells;
  BodySettings body;
  body.mesh =
      bar.mesh ? *bar.mesh : suite::kuhn_box({2 * bar.cells, bar.cells, bar.thickness}, cell);
  body.material = bar.material;
  const double speed = bar.stress_rate / bar.material.young_modulus * 2 * b;
  const double eps = 1e-3 * cell;
  body.held = {{.minimum = {-1, -1, -1}, .maximum = {eps, 9, 9}},
               {.minimum = {2 * b - eps, -1, -1}, .maximum = {9, 9, 9}, .velocity = {speed, 0, 0}}};
  if (bar.grip > 0) {
    const double grip = bar.grip * b;
    body.unbreakable = {{RestBox{{-1, -1, -1}, {grip, 9, 9}}},
                        {RestBox{{2 * b - grip, -1, -1}, {9, 9, 9}}}};
  }
  if (!bar.mesh) shake(body.mesh, bar);
  if (bar.cut)
    body.cuts = {{.faces = CutPlane{.point = {b, 0, 0}, .normal = {1, 0, 0}},
                  .box = RestBox{{-1, -1, -1}, {9, 0.25 * b + eps, 9}},
                  .ball = {}}};
  Scene scene;
  scene.fracture.crack = CrackMode::paper;
  scene.bodies = {body};
  scene.gravity.acceleration.setZero();
  scene.integrator.time_step = bar.time_step;
  scene.integrator.damping.stiffness_factor = bar.damping;
  scene.fracture = bar.fracture;
  return scene;
}

/// How far from the cut's plane cracks reach, over b.
double farthest_crack(const Cells& cells, const NotchedBar& bar) {
  double farthest = 0;
  for (std::size_t f = 0; f < 4 * cells.map.tetrahedra(); ++f) {
    const HalfFaceId face{f};
    if (!is_crack_face(cells, face)) continue;
    for (const VertexId v : corners_of_face(cells.map.corners(tetrahedron_of(face)), face)) {
      farthest = std::max(farthest, std::abs(cells.map.point(v)[0] - bar.height) / bar.height);
    }
  }
  return farthest;
}

void add_cracks(GrowthAnswer& answer, const Simulation& sim, const NotchedBar& bar,
                const CrackArea& cut) {
  const CrackArea all = crack_area(sim.state->cells);
  const double section = bar.height * bar.height / bar.cells * bar.thickness;
  const double left = section * (bar.cut ? 0.75 : 1);
  answer.area = (all.raw - cut.raw) / left;
  answer.projected = (all.projected - cut.projected) / left;
  answer.farthest = farthest_crack(sim.state->cells, bar);
  double whole = 0, largest = 0;
  for (const Component& c : sim.state->mechanics.components) {
    whole += c.mass;
    if (!c.tetrahedra.empty()) largest = std::max(largest, c.mass);
  }
  answer.smallest = 1 - largest / whole;
}

}  // namespace

CrackArea crack_area(const Cells& cells) {
  CrackArea sum;
  for (std::size_t f = 0; f < 4 * cells.map.tetrahedra(); ++f) {
    if (!is_crack_face(cells, HalfFaceId{f})) continue;
    if (cells.pieces && !cells.pieces->map.neighbour(HalfFaceId{f}).is_none()) continue;
    const Vec3 area = 0.5 * rest_area_vector(cells.map, HalfFaceId{f});
    sum.raw += area.norm();
    sum.projected += projected_area(area, Vec3::UnitX());
  }
  return sum;
}

GrowthAnswer pulled_apart(const NotchedBar& bar, int after) {
  auto built = build_simulation(scene_of(bar));
  if (!built) throw std::runtime_error(built.findings.front().text);
  Simulation sim = std::move(*built);
  GrowthAnswer answer;
  const CrackArea cut = crack_area(sim.state->cells);
  double first = 0, energy = 0, area = 0;
  for (int left = after; left > 0;) {
    const StepReport report = advance(sim);
    if (report.status.outcome != StepOutcome::fine) throw std::runtime_error("the run failed");
    answer.pieces = report.components;
    for (const CrackEnergy& crack : report.cracks) {
      energy += crack.energy;
      area += crack.projected;
    }
    if (!report.fracture.fans.empty()) {
      if (answer.fans == 0) {
        first = report.time;
        answer.load = report.time * bar.stress_rate;
      }
      ++answer.steps;
      answer.fans += report.fracture.fans.size();
      answer.worst_ms = std::max(answer.worst_ms, report.stage_ms[std::size_t(Stage::fracture)]);
    }
    if (answer.separated == 0 && answer.pieces > 1) {
      answer.separated = report.time - first + 1e-300;
      add_cracks(answer, sim, bar, cut);
      answer.parted_area = answer.area;
      answer.parted_projected = answer.projected;
    }
    left -= answer.pieces > 1;
    if (first > 0 && report.time > bar.in_vain * first) break;
    if (report.time * bar.stress_rate > 10 * bar.material.tensile_strength) break;
  }
  answer.energy = area > 0 ? energy / area : 0;
  add_cracks(answer, sim, bar, cut);
  return answer;
}

}  // namespace sunder::accuracy
