// SPDX-License-Identifier: MIT
// The files of the demo, part of the program: it needs no other.
#pragma once

#include <string_view>

namespace sunder {

extern const std::string_view demo_scene;  ///< JSON; names demo_mesh_name
extern const std::string_view demo_mesh;   ///< Gmsh MSH
inline constexpr std::string_view demo_mesh_name = "ball.msh";

}  // namespace sunder
