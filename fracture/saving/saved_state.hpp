// SPDX-License-Identifier: MIT
// A simulation as a file, to continue later with the same bytes as without a pause.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "fracture/simulation/simulation.hpp"

namespace sunder {

/// Version of the saved files; it rises with every change of their content.
inline constexpr std::uint32_t saved_state_format = 21;

/// Saves a whole simulation between two steps: its scene and everything that evolves. That includes
/// the factors of its matrices, because their rounding depends on the step in which they were made.
/// Scratch, threads and observers are not saved. Little endian: "SunderSt", format (4 bytes), then
/// sections of a name (4 bytes), a length (8) and that many bytes, and last a checksum (FNV-1a, 8
/// bytes) over all earlier bytes. O(state); 1 to 5 kB per tetrahedron, mostly factors
/// (docs/lab/saved_state.md).
std::string saved_state(const Simulation& simulation);

/// Restores a simulation from bytes of `saved_state`, which include the scene. Errors:
/// not_a_saved_state, other_version (with both numbers), damaged (wrong checksum, missing or
/// inconsistent parts). The checksum detects damage, but not every number is checked: load no files
/// from untrusted sources.
Result<Simulation> restore(std::string_view bytes);

/// Writes `saved_state` to a file. After an error an older file stays as it was. Errors:
/// cannot_write.
std::vector<Finding> save(const Simulation& simulation, const std::filesystem::path& path);

/// Restores a simulation from a file. The findings name the file. Errors: those of `restore`,
/// cannot_open.
Result<Simulation> load(const std::filesystem::path& path);

}  // namespace sunder
