// SPDX-License-Identifier: MIT
// Meshes of bodies and surfaces of obstacles in metres, from what a scene file gives for them.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "apps/scene/reading/body_source.hpp"
#include "apps/scene/reading/scene_values.hpp"

namespace sunder::reading {

/// The keys of a body from which its mesh is made.
struct BodySource {
  std::optional<ShapeSettings> shape;
  FileScale file;
};

/// Makes `mesh`, which holds that of the body's file if it has one: the mesh of the shape, or the
/// file's in metres. `body`: the object, at `pointer`. Errors: missing_key and two_meshes where it
/// has not exactly one of mesh and shape, scale_without_file, those of `shape_mesh`.
void take_source(const Context& c, const BodySource& source, const json& body,
                 const std::string& pointer, TetMesh& mesh);

/// Gives the surface of a file in metres. Errors: those of `make_solid_surface`.
void take_scale(const Context& c, const FileScale& file, const std::string& pointer,
                std::shared_ptr<const SolidSurface>& surface);

}  // namespace sunder::reading
