// SPDX-License-Identifier: MIT
#include "apps/scene/reading/material_names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mechanics/state/settings/named_materials.hpp"

namespace sunder::reading {

void write_names_out(SceneText& text) {
  if (!text.root.is_object() || !text.root.contains("bodies")) return;
  json& bodies = text.root["bodies"];
  if (!bodies.is_array()) return;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (!bodies[b].is_object() || !bodies[b].contains("material")) continue;
    json& material = bodies[b]["material"];
    if (!material.is_string()) continue;
    const std::string at = fmt::format("/bodies/{}/material", b);
    if (const auto line = text.line.find(at); line != text.line.end()) {
      text.line[at + "/name"] = line->second;
    }
    material = json{{"name", material}};
  }
}

void start_from_name(const Context& c, const std::string& name, const json& given,
                     const std::string& pointer, Material& material) {
  const NamedMaterial* named = find_material(name);
  if (named == nullptr) {
    const std::string nearest = nearest_word(name, material_names());
    c.add("unknown_name", pointer + "/name",
          fmt::format("is {}; known are {}", shown(name), fmt::join(material_names(), ", ")),
          nearest.empty() ? "give one of them, which `sunder materials` lists with their numbers"
                          : fmt::format("did you mean {}?", nearest));
    return;
  }
  material = named->material;
  if (given.contains("fracture_energy") && !given.contains("toughness")) material.toughness.reset();
}

}  // namespace sunder::reading
