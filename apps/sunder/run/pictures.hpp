// SPDX-License-Identifier: MIT
// Pictures of a run, drawn into files; where the program is built without the renderer, a refusal.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "apps/scene/output_settings.hpp"
#include "apps/sunder/telling.hpp"
#include "fracture/simulation/simulation.hpp"

namespace sunder {

/// The reason why this machine draws no pictures, with a remedy; nothing if it draws them. Creates
/// a graphics context. Errors in it: those of `HeadlessContext::create`, `no_renderer`.
std::optional<Finding> cannot_draw();

/// Whether pictures can be drawn on this machine. If not, a note gives the reason.
inline bool may_draw(const Telling& telling) {
  std::optional<Finding> reason = cannot_draw();
  if (!reason) return true;
  reason->severity = Severity::note;
  reason->text = "no pictures: " + reason->text;
  tell_beside({*reason}, telling);
  return false;
}

/// Draws pictures of one run, all seen by the same camera.
class Pictures {
 public:
  /// The camera of the settings, or one that sees the bodies as they start, static obstacles, and
  /// the ground below; up is against gravity (z without any).
  /// Errors: those of the renderer; `no_renderer` where the program was built without it.
  static Result<Pictures> open(const Simulation& start, const OutputSettings& output);
  Pictures(Pictures&&) noexcept;
  Pictures& operator=(Pictures&&) noexcept;
  ~Pictures();

  /// Writes a PNG of the shape asked for: skin and crack faces (of `both` the deformed mesh as
  /// wires over the filled reference), obstacles, ground; cracks on their planes where that is
  /// asked for. O(|V| + |T|), and the cost of `smooth_crack_moves`. Errors: those of the renderer.
  std::vector<Finding> draw(const std::filesystem::path& path, const Simulation& now);

 private:
  struct Parts;
  explicit Pictures(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace sunder
