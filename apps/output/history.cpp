// SPDX-License-Identifier: MIT
// Columns and rows of the history of a run.
#include "apps/output/history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>

#include "apps/output/output_columns.hpp"
#include "fracture/simulation/ledger/force_report.hpp"
#include "fracture/strength/held_boxes.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "mechanics/element/energy.hpp"
#include "mechanics/state/living.hpp"
#include "topology/base/assert.hpp"

namespace sunder {
namespace {

/// The state from which the values of one row are taken.
struct HistoryMoment {
  const Simulation& simulation;
  const History& history;
  double kinetic = 0, strain = 0, potential = 0;  ///< J
  std::size_t pieces = 0;
  double largest_mass = 0, asleep_mass = 0;  ///< kg
  double interval = 0;                       ///< s since the last row
};

/// A column stands once per run, or once per row of one of the scene's lists.
enum class HistoryOf { run, load, obstacle, driven, held };

/// A row of a list of the scene.
struct HistoryPlace {
  std::size_t body = 0;   ///< B of a column's name
  std::size_t place = 0;  ///< L, K or H of a column's name
  std::size_t row = 0;    ///< of `ForceReport`
};

struct HistoryColumn {
  HistoryOf of;
  OutputColumn text;
  double (*value)(const HistoryMoment& moment, std::size_t row);
};

/// m, world: the centre of an obstacle; of a plane, its point nearest to the origin.
Vec3 centre_of(const Obstacle& obstacle) {
  if (const auto* plane = std::get_if<Plane>(&obstacle.shape)) return plane->offset * plane->normal;
  return pose_of(obstacle.shape).centre;
}

/// m, world: the middle of the box round the points that a held box holds, where the body starts.
Vec3 centre_of(const BodySettings& body, std::size_t box) {
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

using ImpulseRows = std::vector<Impulse> HistorySums::*;
using CentreRows = std::vector<Vec3> History::*;

double per_time(double sum, double time) { return time > 0 ? sum / time : 0; }

template <ImpulseRows rows, int axis>
double force(const HistoryMoment& m, std::size_t row) {
  return per_time((m.history.sums.*rows)[row][axis], m.interval);
}

template <ImpulseRows rows, CentreRows centres, int axis>
double moment(const HistoryMoment& m, std::size_t row) {
  const Impulse& given = (m.history.sums.*rows)[row];
  const Vec3 turning = given.tail<3>() - (m.history.*centres)[row].cross(given.head<3>());
  return per_time(turning[axis], m.interval);
}

template <int axis>
double displacement(const HistoryMoment& m, std::size_t row) {
  return centre_of(m.simulation.state->obstacles[row])[axis] -
         centre_of(m.simulation.scene.obstacles[row])[axis];
}

constexpr const char* with_loads = "the body has `loads`";
constexpr const char* with_obstacles = "the scene has `obstacles`";
constexpr const char* with_driven = "the obstacle has no `mass`";
constexpr const char* with_held = "the body has `held`";

constexpr HistoryColumn history_list[] = {
    {HistoryOf::run,
     {"time", "s", "Simulated time."},
     [](const HistoryMoment& m, std::size_t) { return m.simulation.state->mechanics.time; }},
    {HistoryOf::run,
     {"kinetic_energy", "J", "Kinetic energy of all bodies."},
     [](const HistoryMoment& m, std::size_t) { return m.kinetic; }},
    {HistoryOf::run,
     {"elastic_energy", "J", "Strain energy of all bodies."},
     [](const HistoryMoment& m, std::size_t) { return m.strain; }},
    {HistoryOf::run,
     {"potential_energy", "J",
      "Potential energy of all bodies in the full gravity, zero at the origin."},
     [](const HistoryMoment& m, std::size_t) { return m.potential; }},
    {HistoryOf::run,
     {"crack_energy_released", "J",
      "Energy that the bodies lost as cracks without ties opened, since the first line."},
     [](const HistoryMoment& m, std::size_t) { return m.history.sums.released; }},
    {HistoryOf::run,
     {"crack_energy_taken", "J",
      "Energy that ties of cohesive cracks dissipated since the first line."},
     [](const HistoryMoment& m, std::size_t) { return m.history.sums.taken; }},
    {HistoryOf::run,
     {"pieces", "", "Number of pieces."},
     [](const HistoryMoment& m, std::size_t) { return static_cast<double>(m.pieces); }},
    {HistoryOf::run,
     {"largest_piece", "kg", "Mass of the heaviest piece."},
     [](const HistoryMoment& m, std::size_t) { return m.largest_mass; }},
    {HistoryOf::run,
     {"asleep", "kg", "Mass of the pieces that sleep, whose contact forces are in no column."},
     [](const HistoryMoment& m, std::size_t) { return m.asleep_mass; }},
    {HistoryOf::run,
     {"fans", "", "Number of fans since the start."},
     [](const HistoryMoment& m, std::size_t) {
       return static_cast<double>(m.simulation.state->fans);
     }},
    {HistoryOf::run,
     {"contact_gap_error", "m", "Largest gap error that contact left since the last line."},
     [](const HistoryMoment& m, std::size_t) { return m.history.sums.gap_error; }},
    {HistoryOf::run,
     {"deepest_overlap", "m", "Deepest overlap at the end of a step since the last line."},
     [](const HistoryMoment& m, std::size_t) { return m.history.sums.overlap; }},
    {HistoryOf::load,
     {"body_B_load_L_work", "J", "Work of the load since the first line.", with_loads},
     [](const HistoryMoment& m, std::size_t row) { return m.history.sums.load_work[row]; }},
    {HistoryOf::obstacle,
     {"obstacle_K_force_x", "N",
      "Mean force of bodies and other obstacles on the obstacle since the last line, x.",
      with_obstacles},
     force<&HistorySums::obstacle, 0>},
    {HistoryOf::obstacle,
     {"obstacle_K_force_y", "N", "The same, y.", with_obstacles},
     force<&HistorySums::obstacle, 1>},
    {HistoryOf::obstacle,
     {"obstacle_K_force_z", "N", "The same, z.", with_obstacles},
     force<&HistorySums::obstacle, 2>},
    {HistoryOf::obstacle,
     {"obstacle_K_moment_x", "N m",
      "Mean moment of that force about the centre of the obstacle at the start; of a plane, about "
      "its point nearest to the origin, x.",
      with_obstacles},
     moment<&HistorySums::obstacle, &History::obstacle_centre, 0>},
    {HistoryOf::obstacle,
     {"obstacle_K_moment_y", "N m", "The same, y.", with_obstacles},
     moment<&HistorySums::obstacle, &History::obstacle_centre, 1>},
    {HistoryOf::obstacle,
     {"obstacle_K_moment_z", "N m", "The same, z.", with_obstacles},
     moment<&HistorySums::obstacle, &History::obstacle_centre, 2>},
    {HistoryOf::driven,
     {"obstacle_K_displacement_x", "m",
      "Displacement of the obstacle since the start; of a plane, along its normal, x.",
      with_driven},
     displacement<0>},
    {HistoryOf::driven,
     {"obstacle_K_displacement_y", "m", "The same, y.", with_driven},
     displacement<1>},
    {HistoryOf::driven,
     {"obstacle_K_displacement_z", "m", "The same, z.", with_driven},
     displacement<2>},
    {HistoryOf::held,
     {"body_B_held_H_force_x", "N",
      "Mean force of the support on the held region since the last line, x.", with_held},
     force<&HistorySums::held, 0>},
    {HistoryOf::held,
     {"body_B_held_H_force_y", "N", "The same, y.", with_held},
     force<&HistorySums::held, 1>},
    {HistoryOf::held,
     {"body_B_held_H_force_z", "N", "The same, z.", with_held},
     force<&HistorySums::held, 2>},
    {HistoryOf::held,
     {"body_B_held_H_moment_x", "N m",
      "Mean moment of that force about the middle of the region at the start, x.", with_held},
     moment<&HistorySums::held, &History::held_centre, 0>},
    {HistoryOf::held,
     {"body_B_held_H_moment_y", "N m", "The same, y.", with_held},
     moment<&HistorySums::held, &History::held_centre, 1>},
    {HistoryOf::held,
     {"body_B_held_H_moment_z", "N m", "The same, z.", with_held},
     moment<&HistorySums::held, &History::held_centre, 2>},
};

/// The texts of `history_list`, for the list of all output.
constexpr auto history_texts = [] {
  std::array<OutputColumn, std::size(history_list)> texts;
  for (std::size_t k = 0; k < texts.size(); ++k) texts[k] = history_list[k].text;
  return texts;
}();

/// Calls `visit(column, place)` for each column of a scene, in the order of the file.
template <class Visit>
void for_each_column(const Scene& scene, Visit visit) {
  const auto take = [&](std::initializer_list<HistoryOf> kinds, const HistoryPlace& place) {
    for (const HistoryColumn& column : history_list) {
      if (std::ranges::find(kinds, column.of) != kinds.end()) visit(column, place);
    }
  };
  using enum HistoryOf;
  take({run}, {});
  std::size_t row = 0;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    for (std::size_t i = 0; i < scene.bodies[b].loads.size(); ++i) take({load}, {b, i, row++});
  }
  for (std::size_t k = 0; k < scene.obstacles.size(); ++k) {
    if (scene.obstacles[k].mass) {
      take({obstacle}, {0, k, k});
    } else {
      take({obstacle, driven}, {0, k, k});
    }
  }
  row = 0;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    for (std::size_t i = 0; i < scene.bodies[b].held.size(); ++i) take({held}, {b, i, row++});
  }
}

/// A column's name with numbers in place of its capital letters.
std::string name_of(const HistoryColumn& column, const HistoryPlace& at) {
  std::string name;
  for (const char letter : column.text.name) {
    if (letter == 'B') {
      name += std::to_string(at.body);
    } else if (letter == 'L' || letter == 'K' || letter == 'H') {
      name += std::to_string(at.place);
    } else {
      name += letter;
    }
  }
  return name;
}

HistoryMoment moment_of(const History& history, const Simulation& now) {
  const MechanicsState& m = now.state->mechanics;
  HistoryMoment moment{.simulation = now, .history = history};
  moment.kinetic = kinetic_energy(m.vertices);
  moment.strain = strain_energy(m);
  moment.potential = gravity_energy(m.vertices, now.scene.gravity.acceleration);
  for_each_living(m, {}, [&](const Component& c) {
    ++moment.pieces;
    moment.largest_mass = std::max(moment.largest_mass, c.mass);
    if (c.rung == Rung::asleep) moment.asleep_mass += c.mass;
  });
  moment.interval = m.time - history.sums.since;
  return moment;
}

void add(std::vector<Impulse>& sums, const std::vector<Impulse>& more) {
  SUNDER_ASSERT(more.size() == sums.size(), "the simulation reports forces");
  for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += more[k];
}

}  // namespace

std::span<const OutputColumn> history_columns() { return history_texts; }

History begin_history(const Simulation& start) {
  const Scene& scene = start.scene;
  ForceReport none = no_forces(scene);
  History history;
  history.sums.since = start.state->mechanics.time;
  history.sums.obstacle = std::move(none.obstacle);
  history.sums.held = std::move(none.held);
  history.sums.load_work = std::move(none.load_work);
  for (const Obstacle& obstacle : scene.obstacles) {
    history.obstacle_centre.push_back(centre_of(obstacle));
  }
  for (const BodySettings& body : scene.bodies) {
    for (std::size_t i = 0; i < body.held.size(); ++i) {
      history.held_centre.push_back(centre_of(body, i));
    }
  }
  add_row(history, start);
  return history;
}

void add_step(History& history, const StepReport& report) {
  HistorySums& sums = history.sums;
  add(sums.obstacle, report.forces.obstacle);
  add(sums.held, report.forces.held);
  for (std::size_t k = 0; k < sums.load_work.size(); ++k) {
    sums.load_work[k] += report.forces.load_work[k];
  }
  sums.gap_error = std::max(sums.gap_error, report.contact.residual);
  sums.overlap = std::max({sums.overlap, report.contact.deepest, report.rubble.deepest});
  for (const CrackEnergy& crack : report.cracks) sums.released += crack.energy;
  sums.taken += report.ties.dissipated;
}

void add_row(History& history, const Simulation& now) {
  const HistoryMoment moment = moment_of(history, now);
  for_each_column(now.scene, [&](const HistoryColumn& column, const HistoryPlace& at) {
    history.values.push_back(column.value(moment, at.row));
  });
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
  for_each_column(scene, [&](const HistoryColumn& column, const HistoryPlace& at) {
    if (width++ > 0) text += ',';
    text += name_of(column, at);
  });
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
