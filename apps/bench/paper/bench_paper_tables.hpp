// SPDX-License-Identifier: MIT
// The paper's own numbers, its scenes, and the modes of our runs that are compared with them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace sunder {

/// A scene of tables 1 to 4.
struct PaperScene {
  std::string_view name;   ///< of meshes/scenes/paper/NAME.json
  std::string_view title;  ///< as the paper writes it
  /// Steps that are run, all and with --quick; the scene's own end may come before.
  std::uint64_t steps = 0, quick_steps = 0;
};
std::span<const PaperScene> paper_scenes();

/// A way to run a scene, which has one line in table 2.
struct PaperMode {
  std::string_view name;
  std::string_view text;
  /// Of the scene, for all three columns; and further ones of the corotational column.
  std::vector<std::string_view> changes, corotational;
};
/// The first is the paper's mode, the last our defaults.
std::span<const PaperMode> paper_modes();

/// `PaperFigure::mode` of the paper's own numbers.
inline constexpr std::string_view theirs = "paper";

struct PaperQuantity {
  std::string_view name, unit;
  int table = 0;  ///< 1 to 4 as in the paper; 5: further figures, of the claims of section 5
  std::string_view text;
};
/// In the order of the CSV.
std::span<const PaperQuantity> paper_quantities();

/// The paper's number for a scene; nothing where it has none.
std::optional<double> paper_value(std::string_view scene, std::string_view quantity);

}  // namespace sunder
