// SPDX-License-Identifier: MIT
// Columns and rows of the history of a run.
#include "apps/output/history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "fracture/strength/held_boxes.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "mechanics/element/energy.hpp"
#include "mechanics/state/living.hpp"

namespace sunder {
namespace {

constexpr std::array<const char*, 3> axis_names = {"x", "y", "z"};

/// m, world: the point of an obstacle at the start about which its moments are.
Vec3 start_of(const Obstacle& obstacle) {
  if (const auto* plane = std::get_if<Plane>(&obstacle.shape)) return plane->offset * plane->normal;
  return pose_of(obstacle.shape).centre;
}

/// m: how far an obstacle has gone; a plane along its normal.
Vec3 way_of(const Obstacle& start, const Obstacle& now) { return start_of(now) - start_of(start); }

/// m, world: the middle of the box round the points that a held box holds, where the body starts.
Vec3 start_of(const BodySettings& body, std::size_t box) {
  Eigen::AlignedBox3d round;
  for (const Point& p : body.mesh.points) {
    const Vec3 point(p.data());
    const Holders holders = holders_of(body.held, point);
    if (std::ranges::find(holders, box) != holders.end()) round.extend(point);
  }
  const HeldBox& held = body.held[box];
  const Vec3 middle = round.isEmpty() ? Vec3(0.5 * (held.minimum + held.maximum)) : round.center();
  return body.rotation * middle + body.translation;
}

using Rows = std::vector<Impulse> HistorySums::*;

double per_time(double sum, double time) { return time > 0 ? sum / time : 0; }

/// Three columns of force and three of moment about `centre` from impulses about the origin.
void add_forces(std::vector<HistoryColumn>& columns, const std::string& name, const std::string& of,
                Rows rows, std::size_t row, const Vec3& centre) {
  for (int axis = 0; axis < 3; ++axis) {
    const char* letter = axis_names[static_cast<std::size_t>(axis)];
    columns.push_back(
        {fmt::format("{}_force_{}", name, letter), "N",
         fmt::format("Mean force {} since the row before, along {}.", of, letter),
         [=](const HistoryMoment& m) { return per_time((m.sums.*rows)[row][axis], m.interval); }});
  }
  for (int axis = 0; axis < 3; ++axis) {
    const char* letter = axis_names[static_cast<std::size_t>(axis)];
    columns.push_back(
        {fmt::format("{}_moment_{}", name, letter), "N m",
         fmt::format("Mean moment of that force about ({:.6g}, {:.6g}, {:.6g}) m, along {}.",
                     centre[0], centre[1], centre[2], letter),
         [=](const HistoryMoment& m) {
           const Impulse& given = (m.sums.*rows)[row];
           const Vec3 moment = given.tail<3>() - centre.cross(given.head<3>());
           return per_time(moment[axis], m.interval);
         }});
  }
}

void add_energies(std::vector<HistoryColumn>& columns) {
  columns.push_back({"kinetic_energy", "J", "Kinetic energy of all bodies.",
                     [](const HistoryMoment& m) { return m.energy[0]; }});
  columns.push_back({"elastic_energy", "J", "Strain energy of all bodies.",
                     [](const HistoryMoment& m) { return m.energy[1]; }});
  columns.push_back({"potential_energy", "J",
                     "Potential energy of all bodies in the full gravity, from the origin.",
                     [](const HistoryMoment& m) { return m.energy[2]; }});
  columns.push_back({"crack_energy_released", "J",
                     "Energy that cracks without ties have given up since the start, as in "
                     "cracks.csv.",
                     [](const HistoryMoment& m) { return m.sums.released; }});
  columns.push_back({"crack_energy_taken", "J",
                     "Energy that ties of cohesive cracks have taken since the start.",
                     [](const HistoryMoment& m) { return m.sums.taken; }});
}

void add_counts(std::vector<HistoryColumn>& columns) {
  columns.push_back({"pieces", "", "Number of pieces.",
                     [](const HistoryMoment& m) { return static_cast<double>(m.pieces); }});
  columns.push_back({"largest_piece", "kg", "Mass of the heaviest piece.",
                     [](const HistoryMoment& m) { return m.largest_mass; }});
  columns.push_back({"asleep", "kg",
                     "Mass of the pieces that sleep. Forces on obstacles and held regions lack "
                     "what these would give.",
                     [](const HistoryMoment& m) { return m.asleep_mass; }});
  columns.push_back({"fans", "", "Number of fans since the start.", [](const HistoryMoment& m) {
                       return static_cast<double>(m.simulation.state->fans);
                     }});
  columns.push_back({"contact_gap_error", "m",
                     "Largest violation that contact left in a gap since the row before.",
                     [](const HistoryMoment& m) { return m.sums.gap_error; }});
  columns.push_back({"deepest_overlap", "m",
                     "Deepest overlap that contact reported since the row before.",
                     [](const HistoryMoment& m) { return m.sums.overlap; }});
}

void add_loads(std::vector<HistoryColumn>& columns, const Scene& scene) {
  std::size_t row = 0;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    for (std::size_t i = 0; i < scene.bodies[b].loads.size(); ++i, ++row) {
      columns.push_back({fmt::format("body_{}_load_{}_work", b, i), "J",
                         fmt::format("Work of bodies.{}.loads.{} since the start.", b, i),
                         [row](const HistoryMoment& m) { return m.sums.load_work[row]; }});
    }
  }
}

void add_obstacles(std::vector<HistoryColumn>& columns, const Scene& scene) {
  for (std::size_t k = 0; k < scene.obstacles.size(); ++k) {
    const std::string name = fmt::format("obstacle_{}", k);
    add_forces(columns, name, fmt::format("of bodies and other obstacles on obstacles.{}", k),
               &HistorySums::obstacle, k, start_of(scene.obstacles[k]));
    for (int axis = 0; axis < 3 && !scene.obstacles[k].mass; ++axis) {
      columns.push_back(
          {fmt::format("{}_displacement_{}", name, axis_names[static_cast<std::size_t>(axis)]), "m",
           fmt::format(
               "Displacement of obstacles.{} since the start; of a plane, along its normal.", k),
           [k, axis](const HistoryMoment& m) {
             return way_of(m.simulation.scene.obstacles[k], m.simulation.state->obstacles[k])[axis];
           }});
    }
  }
}

void add_held(std::vector<HistoryColumn>& columns, const Scene& scene) {
  std::size_t row = 0;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    for (std::size_t i = 0; i < scene.bodies[b].held.size(); ++i, ++row) {
      add_forces(columns, fmt::format("body_{}_held_{}", b, i),
                 fmt::format("of the support on bodies.{}.held.{}", b, i), &HistorySums::held, row,
                 start_of(scene.bodies[b], i));
    }
  }
}

HistoryMoment moment_of(const History& history, const Simulation& now) {
  const MechanicsState& m = now.state->mechanics;
  HistoryMoment moment{.simulation = now, .sums = history.sums};
  moment.energy = {kinetic_energy(m.vertices), strain_energy(m),
                   gravity_energy(m.vertices, now.scene.gravity.acceleration)};
  for_each_living(m, {}, [&](const Component& c) {
    ++moment.pieces;
    moment.largest_mass = std::max(moment.largest_mass, c.mass);
    if (c.rung == Rung::asleep) moment.asleep_mass += c.mass;
  });
  moment.interval = m.time - history.sums.since;
  return moment;
}

}  // namespace

std::vector<HistoryColumn> history_columns(const Scene& scene) {
  std::vector<HistoryColumn> columns;
  columns.push_back({"time", "s", "Simulated time.",
                     [](const HistoryMoment& m) { return m.simulation.state->mechanics.time; }});
  add_energies(columns);
  add_counts(columns);
  add_loads(columns, scene);
  add_obstacles(columns, scene);
  add_held(columns, scene);
  return columns;
}

History begin_history(const Simulation& start) {
  const Scene& scene = start.scene;
  History history;
  std::size_t held = 0, loads = 0;
  for (const BodySettings& body : scene.bodies) {
    held += body.held.size();
    loads += body.loads.size();
  }
  history.sums.since = start.state->mechanics.time;
  history.sums.obstacle.assign(scene.obstacles.size(), Impulse::Zero());
  history.sums.held.assign(held, Impulse::Zero());
  history.sums.load_work.assign(loads, 0);
  add_row(history, start);
  return history;
}

void add_step(History& history, const StepReport& report) {
  HistorySums& sums = history.sums;
  const ForceReport& forces = report.forces;
  for (std::size_t k = 0; k < sums.obstacle.size(); ++k) sums.obstacle[k] += forces.obstacle[k];
  for (std::size_t k = 0; k < sums.held.size(); ++k) sums.held[k] += forces.held[k];
  for (std::size_t k = 0; k < sums.load_work.size(); ++k) {
    sums.load_work[k] += forces.load_work[k];
  }
  sums.gap_error = std::max(sums.gap_error, report.contact.residual);
  sums.overlap = std::max({sums.overlap, report.contact.deepest, report.rubble.deepest});
  for (const CrackEnergy& crack : report.cracks) sums.released += crack.energy;
  sums.taken += report.ties.dissipated;
}

void add_row(History& history, const Simulation& now) {
  const HistoryMoment moment = moment_of(history, now);
  for (const HistoryColumn& column : history_columns(now.scene)) {
    history.values.push_back(column.value(moment));
  }
  HistorySums& sums = history.sums;
  sums.since = now.state->mechanics.time;
  std::ranges::fill(sums.obstacle, Impulse::Zero());
  std::ranges::fill(sums.held, Impulse::Zero());
  sums.gap_error = sums.overlap = 0;
  history.last_row = now.state->step;
}

std::string history_csv(const History& history, const Scene& scene) {
  std::string text;
  std::size_t width = 0;
  for (const HistoryColumn& column : history_columns(scene)) {
    text += fmt::format("{}{}", width++ > 0 ? "," : "", column.name);
  }
  text += "\r\n";
  for (std::size_t k = 0; k < history.values.size(); ++k) {
    text += fmt::format("{}{}", history.values[k], (k + 1) % width == 0 ? "\r\n" : ",");
  }
  return text;
}

std::uint64_t usual_history_stride(std::uint64_t steps) {
  constexpr std::uint64_t most_intervals = 1999;
  return std::max<std::uint64_t>(1, (steps + most_intervals - 1) / most_intervals);
}

}  // namespace sunder
