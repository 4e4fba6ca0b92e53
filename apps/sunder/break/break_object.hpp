// SPDX-License-Identifier: MIT
// From the file of an object to its fragments: the work of `sunder break`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/sunder/break/blow.hpp"
#include "apps/sunder/break/mend.hpp"
#include "apps/sunder/exit_code.hpp"
#include "apps/sunder/telling.hpp"

namespace sunder {

/// The arguments of `sunder break`. Lengths, speeds and times are text with a unit (quantity.hpp).
struct BreakArguments : Telling {
  std::filesystem::path thing;
  /// Empty: out/ and the name of the thing.
  std::filesystem::path folder;
  std::string material = "ceramic", units, size, cell, mesher, drop, hurl, ball, speed, budget;
  UpAxis up = UpAxis::z;
  Mending mending = Mending::small;
  double tetrahedra = 5000;
  /// Names of options about filling that were given, for things that are filled already.
  std::vector<std::string> filling;
  double tilt = 20;  ///< degrees
  BreakTimes times;
  bool press = false, bend = false, scene_only = false, force = false, no_film = false;
};

/// Reads the object, repairs and fills it, writes the scene, runs it, tells the outcome, and draws
/// a film of it. Findings go to stderr, the outcome to stdout.
ExitCode break_object(BreakArguments arguments);

}  // namespace sunder
