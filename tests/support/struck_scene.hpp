// SPDX-License-Identifier: MIT
// A scene in JSON that breaks at once.
#pragma once

#include <nlohmann/json.hpp>

namespace sunder::test {

/// The monolith struck by one ball with its centre `away` m off its middle at first: at 0.32 it
/// breaks in impact windows in its first step, at 0.4 within 0.02 s.
inline nlohmann::json struck_scene(double away = 0.32, double duration = 0.005) {
  return {{"name", "struck"},
          {"bodies",
           {{{"mesh", SUNDER_MESHES "/monolith.msh"},
             {"order", 1},
             {"material", {{"young_modulus", 30e9}, {"tensile_strength", 2e6}}}}}},
          {"obstacles",
           {{{"plane", {{"normal", {0, 0, 1}}}}},
            {{"sphere", {{"center", {0, -away, 1.3}}, {"radius", 0.2}}},
             {"velocity", {0, 20, 0}},
             {"mass", 120}}}},
          {"time_step", 2.5e-4},
          {"duration", duration}};
}

}  // namespace sunder::test
