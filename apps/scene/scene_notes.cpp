// SPDX-License-Identifier: MIT
// Notes on scenes.
#include "apps/scene/scene_notes.hpp"

namespace sunder {

std::vector<Finding> scene_notes(const SceneText& text, const SceneFile& file) {
  constexpr const char* window = "/impact/window";
  const nlohmann::json::json_pointer pointer(window);
  const bool asked = text.root.contains(pointer) && text.root[pointer] == true;
  if (!asked || file.scene.integrator.integrator == Integrator::floating_frame) return {};
  const auto line = text.line.find(window);
  return {{.code = "no_impact_windows",
           .severity = Severity::note,
           .text = "impact.window is true, but windows are for the method floating_frame alone: "
                   "the step, or that of sub_stepped, decides what breaks on impact",
           .remedy = "take floating_frame, or leave impact.window out",
           .file = text.file,
           .line = line == text.line.end() ? 0 : line->second}};
}

}  // namespace sunder
