// SPDX-License-Identifier: MIT
#include "apps/scene/reading/take_source.hpp"

#include <algorithm>

#include "apps/scene/reading/shape_mesh.hpp"
#include "mechanics/contact/shapes/solid_surface.hpp"

namespace sunder::reading {
namespace {

void make_shape(const Context& c, const ShapeSettings& shape, const std::string& pointer,
                TetMesh& mesh) {
  Result<TetMesh> made = shape_mesh(shape, dotted(pointer));
  for (Finding& f : made.findings) c.add(std::move(f), pointer);
  if (made) mesh = std::move(*made);
}

/// Whether a finding about the shape says already that it cannot be made.
bool is_faulty(const Context& c, const std::string& pointer) {
  const std::string place = dotted(pointer);
  return std::any_of(c.findings.begin(), c.findings.end(), [&](const Finding& f) {
    return f.severity == Severity::error && f.text.starts_with(place);
  });
}

}  // namespace

void take_source(const Context& c, const BodySource& source, const json& body,
                 const std::string& pointer, TetMesh& mesh) {
  const bool has_file = body.contains("mesh"), has_shape = body.contains("shape");
  if (!has_file && !has_shape) {
    return c.add("missing_key", pointer, "has no key mesh and no key shape",
                 "add \"mesh\": a mesh file with tetrahedra; or \"shape\": a simple solid, such as "
                 "{\"box\": {\"size\": [0.2, 0.1, 0.05]}}");
  }
  if (has_file && has_shape) {
    return c.add("two_meshes", pointer, "has a mesh and a shape", "leave one of them out");
  }
  if (has_shape) {
    if (body.contains("units") || body.contains("scale")) {
      c.add("scale_without_file", pointer, "has units or a scale, which are for mesh files",
            "leave them out: lengths of a shape are metres");
    }
    const std::string at = pointer + "/shape";
    if (source.shape && !is_faulty(c, at)) make_shape(c, *source.shape, at, mesh);
    return;
  }
  const double metres = metres_of(source.file);
  if (metres == 1) return;
  for (Point& p : mesh.points) {
    for (double& x : p) x *= metres;
  }
}

void take_scale(const Context& c, const FileScale& file, const std::string& pointer,
                std::shared_ptr<const SolidSurface>& surface) {
  const double metres = metres_of(file);
  if (metres == 1 || !surface) return;
  TriangleSurface scaled{surface->points, surface->triangles};
  for (Vec3& p : scaled.points) p *= metres;
  Result<SolidSurface> made = make_solid_surface(std::move(scaled), surface->file);
  for (Finding& f : made.findings) {
    if (f.severity == Severity::error) c.add(std::move(f), pointer);
  }
  surface = made ? std::make_shared<const SolidSurface>(std::move(*made)) : nullptr;
}

}  // namespace sunder::reading
