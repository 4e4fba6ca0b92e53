// SPDX-License-Identifier: MIT
// Internal: the programs' sources in GLSL 3.30.
#pragma once

#include <string>

namespace sunder::render {

/// A vertex and a fragment stage.
struct ShaderSource {
  std::string vertex;
  std::string fragment;
};

/// Depth of the triangles seen from the key light.
ShaderSource shadow_source();
/// Normal and depth of the nearest surface: of triangles, and of planes.
ShaderSource mesh_normals_source();
ShaderSource plane_normals_source();
/// How much of the sky and of the key light each pixel sees.
ShaderSource visibility_source();
/// Smooths the visibility along one direction, within one surface.
ShaderSource smoothing_source();
/// The picture itself: background, planes, triangles, edges.
ShaderSource background_source();
ShaderSource plane_source();
ShaderSource mesh_source();
ShaderSource edge_source();

}  // namespace sunder::render
