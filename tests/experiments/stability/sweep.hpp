// SPDX-License-Identifier: MIT
// The full sweep: maps of outcomes over step and stiffness, spin, Poisson's ratio, shape and mass.
#pragma once

#include <functional>

#include "tests/stability/cell.hpp"

namespace sunder::stability {

/// A map: outcome over the time step and one other quantity.
struct Map {
  std::string name;  ///< in the CSV
  std::vector<double> values, time_steps;
  std::function<Cell(const Method&, double value, double time_step)> run;
};

/// E 1e5 to 1e12 Pa; spin to 500 rad/s; nu to 0.5; slivers to 0.1 degrees; masses 1 : 1e6; each
/// over steps of 1 us to 1/30 s.
std::vector<Map> maps();

/// The methods of the maps: without those that differ only in isolated tetrahedra, which no map
/// has.
std::vector<Method> mapped_methods();

}  // namespace sunder::stability
