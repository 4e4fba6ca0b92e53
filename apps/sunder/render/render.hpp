// SPDX-License-Identifier: MIT
// `sunder render`: pictures and films of a finished run from any camera.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <vector>

#include "apps/scene/output_settings.hpp"
#include "apps/sunder/exit_code.hpp"
#include "apps/sunder/render/film.hpp"
#include "apps/sunder/telling.hpp"

namespace sunder {

/// The arguments of `sunder render`; SI units.
struct RenderArguments : Telling {
  /// Folder of a run, and the file to write: .png, or a film.
  std::filesystem::path result, out;
  /// s; not a number: the last frame.
  double time = std::numeric_limits<double>::quiet_NaN();
  double explode = 0, magnify = 1;
  double field_of_view = 35;  ///< degrees
  std::vector<double> eye, target;
  std::vector<std::uint32_t> size = {1280, 720};
  ShownShape show = ShownShape::reference;
  bool all = false;
  FilmSpeed speed;
};

/// The result of drawing.
struct Rendered {
  ExitCode code = ExitCode::fine;
  std::optional<FilmPlan> film;  ///< of a film
  /// Folder of a film's pictures, where no encoder made a film of them.
  std::filesystem::path pictures;
};

/// Draws the pictures, or the film, of a finished run, and tells each picture, and the faults.
/// Without an encoder a film's pictures stay in a folder of its name, and the code is not_written.
Rendered render_result(const RenderArguments& arguments);

/// Adds `render RESULT PICTURE`. `exit_code` is set when the command runs.
void add_render_command(CLI::App& program, ExitCode& exit_code);

}  // namespace sunder
