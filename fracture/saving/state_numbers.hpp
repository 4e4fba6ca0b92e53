// SPDX-License-Identifier: MIT
// Every number of a running simulation, column by column, and those that are none.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "fracture/simulation/simulation.hpp"

namespace sunder {

/// Which numbers are examined: the columns of the evolving state, about 400 bytes per tetrahedron,
/// or all numbers of a saved state. The latter have matrices, factors, map and scene too.
enum class NumbersOf { columns, everything };

/// The floating-point numbers of a member, over all rows, named by the members it lies in.
struct NumberColumn {
  std::string name;  ///< such as "mechanics.vertices.position"
  std::size_t numbers = 0;
  std::size_t not_numbers = 0;  ///< of them, NaN
  std::size_t row = 0;          ///< the first that has a NaN
  /// Where the first and the last of them stand in `saved_state`; with `everything` only.
  std::size_t first_byte = 0, last_byte = 0;
};

/// All columns that have a number. The list is that of saved states: every saved number is
/// examined.
std::vector<NumberColumn> number_columns(const Simulation& simulation, NumbersOf which);

/// The columns that have a NaN: one finding, not_a_number, that names the step and of each column
/// the first vertex, tetrahedron, component or row; none where there is no NaN. O(numbers).
std::vector<Finding> check_numbers(const Simulation& simulation, NumbersOf which);

}  // namespace sunder
