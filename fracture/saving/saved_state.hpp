// SPDX-License-Identifier: MIT
// A simulation as a file, to go on with later: to the same bytes as without a pause.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "fracture/simulation/simulation.hpp"

namespace sunder {

/// Of the files that this library writes and reads; raised whenever what is saved changes.
inline constexpr std::uint32_t saved_state_format = 17;

/// Everything that a simulation is, between two steps: its scene, whole, and all that evolves, down
/// to the factors of its matrices, whose rounding depends on when they were made. Scratch, threads
/// and observers are not part of it.
/// Little endian: "SunderSt", format (4 bytes), then sections of a name (4 bytes), a length (8) and
/// so many bytes, and last a checksum (FNV-1a, 8 bytes) over all before it.
/// O(state); 1 to 5 kB a tetrahedron, mostly factors (docs/lab/saved_state.md).
std::string saved_state(const Simulation& simulation);

/// The simulation of such bytes. It needs no scene: the file has it. Errors: not_a_saved_state,
/// other_version (with both numbers), damaged (the checksum is another, something is missing or
/// does not fit together). Bytes of another maker than `saved_state` are caught by the checksum,
/// not by a look at every number: do not load files from those who may want to harm you.
Result<Simulation> restore(std::string_view bytes);

/// `saved_state` as a file, whole or not at all: an error leaves an older file as it was. Errors:
/// cannot_write.
std::vector<Finding> save(const Simulation& simulation, const std::filesystem::path& path);

/// `restore` of a file, which the findings name. Errors: cannot_open beside those.
Result<Simulation> load(const std::filesystem::path& path);

}  // namespace sunder
