// SPDX-License-Identifier: MIT
// The scenes of meshes/scenes, for tests that get their place (SUNDER_SCENES).
#pragma once

#include <catch2/catch.hpp>
#include <string>
#include <utility>

#include "apps/scene/scene_json.hpp"
#include "fracture/simulation/simulation.hpp"

namespace sunder::test {

/// The scene `name`.json, built.
inline Simulation shipped(const std::string& name) {
  auto file = read_scene(std::string(SUNDER_SCENES "/") + name + ".json");
  REQUIRE(file);
  auto simulation = build_simulation(file->scene);
  REQUIRE(simulation);
  return std::move(*simulation);
}

}  // namespace sunder::test
