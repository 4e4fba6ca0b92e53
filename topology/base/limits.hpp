// SPDX-License-Identifier: MIT
// The most that input may ask of the process: one list. docs/howto/troubleshooting.md has it as a
// table.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace sunder {

/// Each can be lowered and none raised, by `lower_limits` or the environment variable
/// SUNDER_LIMITS.
struct Limits {
  /// Bytes of a file of meshes, faces or names, as it lies on the disk or comes by a pipe.
  std::uint64_t file_bytes = std::uint64_t{1} << 40;
  /// Bytes to which a file packed by gzip, or one packed array of a VTU, unfolds.
  std::uint64_t unpacked_bytes = std::uint64_t{1} << 34;
  /// Levels of nesting in a scene, of objects and arrays.
  std::uint64_t scene_levels = 64;
  /// Levels of nesting in XML (VTU, VTP).
  std::uint64_t xml_levels = 64;
  /// Steps of a run.
  std::uint64_t steps = 1'000'000'000;
  /// Frames, or pictures, of a run.
  std::uint64_t frames = 1'000'000;
};

/// Those of `--confined`, for files that somebody else made.
inline constexpr Limits confined_limits = {.file_bytes = std::uint64_t{1} << 32,
                                           .unpacked_bytes = std::uint64_t{1} << 28};

/// Those of this process: the defaults, lowered by SUNDER_LIMITS when they are first asked for.
const Limits& limits();

/// Lowers each limit of this process to that of `wanted` where it is less. Not while other threads
/// read: a program calls it as it starts.
void lower_limits(const Limits& wanted);

/// Lowers limits by a list "unpacked_bytes=1e8 steps=1000": names of the members above, `=`, a
/// number; spaces or commas between. Returns the mistake in the list, empty where there is none; a
/// list with a mistake lowers nothing.
std::string lower_limits(Limits& lowered, std::string_view list);

/// The mistake in SUNDER_LIMITS; empty where there is none.
std::string limits_fault();

}  // namespace sunder
