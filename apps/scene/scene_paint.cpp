// SPDX-License-Identifier: MIT
// Point fields of mesh files as strengths.
#include "apps/scene/scene_paint.hpp"

#include <fmt/format.h>

namespace sunder {

std::vector<Finding> paint_strengths(Scene& scene, const SceneText& text, const SceneFiles& files) {
  std::vector<Finding> findings;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    BodySettings& body = scene.bodies[b];
    if (body.strength.field.empty() || body.mesh.points.empty()) continue;
    const std::string at = fmt::format("/bodies/{}/strength/field", b);
    if (!text.root["bodies"][b].contains("mesh")) {
      const auto line = text.line.find(at);
      findings.push_back({.code = "no_such_field",
                          .text = dotted(at) + " names a field, and a shape has none",
                          .remedy = "give a mesh file with the field, or leave it out",
                          .file = text.file,
                          .line = line == text.line.end() ? 0 : line->second});
      continue;
    }
    const std::string mesh = text.root["bodies"][b]["mesh"].get<std::string>();
    Result<std::vector<double>> field = files.point_field(mesh, body.strength.field);
    for (Finding& f : field.findings) {
      f.text = fmt::format("{} ({}): {}", dotted(at), mesh, f.text);
      if (const auto line = text.line.find(at); line != text.line.end()) {
        f.file = text.file;
        f.line = line->second;
      }
      findings.push_back(std::move(f));
    }
    if (field) body.strength.painted = std::move(*field);
  }
  return findings;
}

}  // namespace sunder
