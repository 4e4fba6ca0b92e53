// SPDX-License-Identifier: MIT
// The plates' scenes, and tips, branches and angles of their cracks.
#include "tests/experiments/cases/plates.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fracture/simulation/simulation_state.hpp"

namespace sunder::accuracy {
namespace {

constexpr double wide = 1e3;  // m: beyond every plate

/// The slab of a case: one cell thick, notched, all of `material`.
PlateCase slab(PlateShape shape, const PlateLine& notch, const Material& material,
               const PlateChoice& choice) {
  if (choice.cell > 0) shape.cell = choice.cell;
  shape.cells = choice.cells;
  shape.seed = choice.seed;
  shape.thickness = shape.cell;
  shape.lines = {notch};
  PlateCase plate;
  plate.shape = shape;
  plate.notch = notch;
  BodySettings body;
  body.name = "plate";
  body.mesh = plate_mesh(shape);
  body.material = material;
  if (choice.strength > 0) body.material.tensile_strength = choice.strength;
  const double eps = 1e-6 * shape.cell;
  body.cuts = {{.faces = CutPlane{.point = {0, notch.height, 0}, .normal = {0, 1, 0}},
                .box = RestBox{{notch.from - eps, -wide, -wide}, {notch.to + eps, wide, wide}},
                .ball = {}}};
  if (choice.plane_strain) {
    body.held = {
        {.minimum = {-wide, -wide, -wide}, .maximum = {wide, wide, wide}, .axes = {Axis::z}}};
  }
  plate.scene.bodies = {body};
  plate.scene.gravity.acceleration.setZero();
  plate.scene.integrator.time_step = choice.step > 0 ? choice.step : 1e-6;
  plate.scene.fracture.crack = CrackMode::cohesive;
  plate.scene.ladder = {.rigid = false, .quasi_static = false, .sleep = false};
  return plate;
}

double notch_tip(const PlateCase& plate) { return plate.notch.to; }

double distance_of(const CrackTrace& trace, const PlateCase& plate) {
  return std::hypot(trace.x - notch_tip(plate), trace.y - plate.notch.height);
}

double notch_at(const PlateChoice& choice, double height, double cell) {
  const double size = choice.cell > 0 ? choice.cell : cell;
  return choice.cells == PlateCells::delaunay ? height : size * std::lround(height / size);
}

}  // namespace

PlateCase branching_plate(const PlateChoice& choice) {
  PlateShape shape{.length = 0.1, .height = 0.04, .cell = 0.0025};
  const Material material{.young_modulus = 32e9,
                          .poisson_ratio = 0.2,
                          .density = 2450,
                          .tensile_strength = 3.08e6,
                          .fracture_energy = 3};
  PlateCase plate = slab(shape, {0, 0.05, 0.02}, material, choice);
  const double eps = 1e-6 * shape.cell;
  plate.scene.bodies[0].loads = {
      {.minimum = {-wide, -wide, -wide}, .maximum = {wide, eps, wide}, .pressure = -1e6},
      {.minimum = {-wide, shape.height - eps, -wide},
       .maximum = {wide, wide, wide},
       .pressure = -1e6}};
  plate.duration = 80e-6;
  return plate;
}

PlateCase kalthoff_plate(const PlateChoice& choice) {
  PlateShape shape{.length = 0.1, .height = 0.1, .cell = 0.0025};
  const Material material{.young_modulus = 190e9,
                          .poisson_ratio = 0.3,
                          .density = 8000,
                          .tensile_strength = 844e6,
                          .fracture_energy = 22130};
  const double height = notch_at(choice, 0.025, shape.cell);
  PlateCase plate = slab(shape, {0, 0.05, height}, material, choice);
  std::vector<HeldBox>& held = plate.scene.bodies[0].held;
  const double eps = 1e-6 * plate.shape.cell;
  held.push_back(
      {.minimum = {-wide, -wide, -wide}, .maximum = {wide, eps, wide}, .axes = {Axis::y}});
  const double speed = choice.rate > 0 ? choice.rate : 16.5;
  held.push_back({.minimum = {-wide, -wide, -wide},
                  .maximum = {eps, height - eps, wide},
                  .velocity = {speed, 0, 0},
                  .axes = {Axis::x},
                  .ramp_time = choice.ramp < 0 ? 1e-6 : choice.ramp});
  plate.duration = 90e-6;
  return plate;
}

PlateCase compact_tension(const PlateChoice& choice) {
  PlateShape shape{.length = 0.2, .height = 0.2, .cell = 0.01};
  const Material material{.young_modulus = 36e9,
                          .poisson_ratio = 0.18,
                          .density = 2400,
                          .tensile_strength = 3.8e6,
                          .fracture_energy = 65};
  PlateChoice own = choice;
  own.plane_strain = false;
  PlateCase plate = slab(shape, {0, 0.08, 0.1}, material, own);
  // At the mouth of the notch, as by the specimen's steel frame: pulled up above it, held below.
  const double eps = 1e-6 * plate.shape.cell, mouth = 0.02;
  const double deep = choice.frame < 0 ? 0.02 : choice.frame;
  const double rate = choice.rate > 0 ? choice.rate : 0.035;
  BodySettings& body = plate.scene.bodies[0];
  body.held.push_back({.minimum = {-wide, 0.1 + eps, -wide},
                       .maximum = {deep + eps, 0.1 + mouth + eps, wide},
                       .velocity = {0, rate, 0},
                       .axes = {Axis::y},
                       .ramp_time = choice.ramp < 0 ? 1e-4 : choice.ramp});
  body.held.push_back({.minimum = {-wide, 0.1 - mouth - eps, -wide},
                       .maximum = {deep + eps, 0.1 - eps, wide},
                       .axes = {Axis::x, Axis::y}});
  // The arms would break next to the frame, which stiffens them.
  body.unbreakable = {{RestBox{{-wide, -wide, -wide}, {0.07, wide, wide}}}};
  plate.duration = 150e-6 + 3e-4 / rate;
  if (choice.step == 0) plate.scene.integrator.time_step = rate < 0.5 ? 2e-5 : 2e-6;
  return plate;
}

std::vector<CrackTrace> main_crack(const std::vector<CrackTrace>& traces, const PlateCase& plate) {
  const double near = 2.5 * plate.shape.cell;
  std::vector<CrackTrace> rest, crack;
  for (const CrackTrace& t : traces) {
    if (!t.released) continue;
    (distance_of(t, plate) < near ? crack : rest).push_back(t);
  }
  for (std::size_t k = 0; k < crack.size(); ++k) {
    const CrackTrace from = crack[k];
    const auto out = std::partition(rest.begin(), rest.end(), [&](const CrackTrace& t) {
      return std::hypot(t.x - from.x, t.y - from.y) >= near;
    });
    crack.insert(crack.end(), out, rest.end());
    rest.erase(out, rest.end());
  }
  return crack;
}

std::vector<CrackTrace> crack_traces(const Simulation& sim, const PlateCase& plate) {
  const Cells& cells = sim.state->cells;
  const double eps = 1e-6 * plate.shape.cell;
  std::vector<CrackTrace> traces;
  for (std::size_t f = 0; f < 4 * cells.map.tetrahedra(); ++f) {
    const HalfFaceId face{f};
    if (!is_crack_face(cells, face)) continue;
    CrackTrace trace;
    const auto corners = corners_of_face(cells.map.corners(tetrahedron_of(face)), face);
    bool on_notch = true;
    for (std::size_t k = 0; k < 3; ++k) {
      trace.corners[k] = cells.map.point(corners[k]);
      trace.x += trace.corners[k][0] / 3;
      trace.y += trace.corners[k][1] / 3;
      on_notch = on_notch && trace.corners[k][0] < plate.notch.to + eps &&
                 std::abs(trace.corners[k][1] - plate.notch.height) < eps;
    }
    trace.released = cells.pieces->map.neighbour(face).is_none();
    if (!on_notch) traces.push_back(trace);
  }
  return traces;
}

TipPlace tip_of(const std::vector<CrackTrace>& traces, const PlateCase& plate, double time) {
  TipPlace tip;
  tip.time = time;
  const double cell = plate.shape.cell;
  std::vector<std::vector<double>> rings;  // angles about the notch's tip
  for (const CrackTrace& trace : traces) tip.tied = std::max(tip.tied, distance_of(trace, plate));
  for (const CrackTrace& trace : main_crack(traces, plate)) {
    const double distance = distance_of(trace, plate);
    if (distance > tip.reach) {
      tip.reach = distance;
      tip.x = trace.x;
      tip.y = trace.y;
    }
    const auto ring = std::size_t(distance / (2 * cell));
    rings.resize(std::max(rings.size(), ring + 1));
    rings[ring].push_back(std::atan2(trace.y - plate.notch.height, trace.x - notch_tip(plate)));
  }
  for (std::size_t r = 1; r < rings.size(); ++r) {
    std::vector<double>& angle = rings[r];
    std::ranges::sort(angle);
    const double radius = 2 * cell * (double(r) + 0.5);
    std::size_t groups = angle.empty() ? 0 : 1;
    for (std::size_t k = 1; k < angle.size(); ++k) {
      groups += (angle[k] - angle[k - 1]) * radius > 2.5 * cell;
    }
    tip.branches = std::max(tip.branches, groups);
    if (groups > 1 && tip.fork == 0) tip.fork = radius;
  }
  if (rings.size() == 1) tip.branches = 1;
  return tip;
}

std::vector<double> tip_speeds(const std::vector<TipPlace>& history) {
  std::vector<double> speeds;
  for (const TipPlace& at : history) {
    double n = 0, t = 0, x = 0, tt = 0, tx = 0;
    for (const TipPlace& p : history) {
      if (std::abs(p.time - at.time) > 2.5000001e-6) continue;
      const double s = p.time - at.time;
      n += 1;
      t += s;
      x += p.reach;
      tt += s * s;
      tx += s * p.reach;
    }
    const double spread = n * tt - t * t;
    speeds.push_back(spread > 0 ? (n * tx - t * x) / spread : 0);
  }
  return speeds;
}

double crack_angle(const std::vector<CrackTrace>& traces, const PlateCase& plate, double from,
                   double to) {
  double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  for (const CrackTrace& trace : main_crack(traces, plate)) {
    const double distance = distance_of(trace, plate);
    if (distance < from || distance > to) continue;
    const double dx = trace.x - notch_tip(plate), dy = trace.y - plate.notch.height;
    x += dx;
    y += dy;
    xx += dx * dx;
    xy += dx * dy;
    yy += dy * dy;
  }
  const double axis = 0.5 * std::atan2(2 * xy, xx - yy);
  const double way = std::cos(axis) * x + std::sin(axis) * y;
  return std::remainder(axis + (way < 0 ? std::numbers::pi : 0), 2 * std::numbers::pi) * 180 /
         std::numbers::pi;
}

}  // namespace sunder::accuracy
