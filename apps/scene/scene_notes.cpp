// SPDX-License-Identifier: MIT
// Notes on scenes.
#include "apps/scene/scene_notes.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "mechanics/state/settings/material.hpp"

namespace sunder {
namespace {

/// Line of a value in the scene's text; 0: it has none.
std::size_t line_of(const SceneText& text, const std::string& pointer) {
  const auto line = text.line.find(pointer);
  return line == text.line.end() ? 0 : line->second;
}

std::optional<Finding> note_on_windows(const SceneText& text, const SceneFile& file) {
  constexpr const char* window = "/impact/window";
  const nlohmann::json::json_pointer pointer(window);
  const bool asked = text.root.contains(pointer) && text.root[pointer] == true;
  if (!asked || file.scene.integrator.integrator == Integrator::floating_frame) return std::nullopt;
  return Finding{.code = "no_impact_windows",
                 .severity = Severity::note,
                 .text =
                     "impact.window is true, but windows are for the method floating_frame "
                     "alone: the step, or that of sub_stepped, decides what breaks on impact",
                 .remedy = "take floating_frame, or leave impact.window out",
                 .file = text.file,
                 .line = line_of(text, window)};
}

/// Bodies that can break and name neither a toughness nor a fracture energy: one note for all.
std::optional<Finding> note_on_tips(const SceneText& text, const Scene& scene) {
  if (scene.fracture.mode == FractureMode::off) return std::nullopt;
  if (scene.fracture.crack != CrackMode::object) return std::nullopt;
  std::size_t bodies = 0, first = 0;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const Material& material = scene.bodies[b].material;
    const bool breaks = std::isfinite(material.tensile_strength) && !scene.bodies[b].rigid;
    if (!breaks || std::isfinite(toughness_of(material))) continue;
    if (bodies++ == 0) first = b;
  }
  if (bodies == 0) return std::nullopt;
  return Finding{
      .code = "no_toughness",
      .severity = Severity::note,
      .text = fmt::format("bodies.{}.material{}: neither toughness nor fracture_energy is "
                          "given, so crack tips break at the tensile strength and a "
                          "body breaks into fewer pieces",
                          first, bodies > 1 ? fmt::format(" and {} more", bodies - 1) : ""),
      .remedy =
          "give \"toughness\" in Pa sqrt(m): about 1.5e5 for plaster, 1e6 for "
          "concrete, 0.75e6 for glass",
      .file = text.file,
      .line = line_of(text, fmt::format("/bodies/{}/material", first))};
}

}  // namespace

std::vector<Finding> scene_notes(const SceneText& text, const SceneFile& file) {
  std::vector<Finding> notes;
  if (std::optional<Finding> note = note_on_windows(text, file)) notes.push_back(std::move(*note));
  if (std::optional<Finding> note = note_on_tips(text, file.scene)) {
    notes.push_back(std::move(*note));
  }
  return notes;
}

}  // namespace sunder
