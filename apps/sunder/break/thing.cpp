// SPDX-License-Identifier: MIT
#include "apps/sunder/break/thing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "apps/scene/reading/length_unit.hpp"
#include "apps/sunder/break/quantity.hpp"
#include "topology/base/counted.hpp"
#include "topology/io/mesh_file.hpp"
#include "topology/mesh/boundary_surface.hpp"
#include "topology/mesh/check.hpp"
#include "topology/mesh/kinds/split_cells.hpp"
#include "topology/mesh/repair.hpp"
#include "topology/mesh/surface/crossing.hpp"
#include "topology/mesh/surface/surface_check.hpp"

namespace sunder {
namespace {

/// Above it nobody drops a thing that is so many metres long.
constexpr double longest_in_metres = 3;

Finding refused(const char* code, std::string text, std::string remedy) {
  return {.code = code, .text = std::move(text), .remedy = std::move(remedy)};
}

/// Leaves triangles with an area and their points, which are one where they lie at one place.
FileMesh plain_surface(FileMesh&& mesh) {
  split_cells(mesh);
  FileMesh surface;
  surface.points = std::move(mesh.points);
  surface.triangles.corners = std::move(mesh.triangles.corners);
  merge_points(surface, 0);
  std::erase_if(surface.triangles.corners,
                [&](const auto& corners) { return !has_area(surface.points, corners); });
  drop_unused_points(surface);
  return surface;
}

/// Why a surface encloses no solid; none where it does.
std::optional<Finding> fault_of(const SurfaceCheck& check) {
  const auto count_of = [&](std::string_view code) {
    const auto found = std::ranges::find(check.findings, code, &Finding::code);
    return found == check.findings.end() ? std::size_t{0} : found->count;
  };
  if (check.triangles == 0) {
    return refused("no_faces", "the file has neither tetrahedra nor faces with an area",
                   "give a closed surface (STL, OBJ, PLY, OFF) or a mesh of tetrahedra");
  }
  if (check.boundary_edges > 0) {
    return refused("open_surface",
                   fmt::format("the surface is open: {} of one face only",
                               counted(check.boundary_edges, "edge", "edges")),
                   "close its holes, in Blender by Mesh > Clean Up > Fill Holes; give a sheet a "
                   "thickness, in Blender by the modifier Solidify");
  }
  if (const std::size_t edges = count_of("nonmanifold_edge"); edges > 0) {
    return refused("nonmanifold_surface",
                   fmt::format("three faces or more meet at {}", counted(edges, "edge", "edges")),
                   "remove inner walls and doubled faces, in Blender by the modifier Remesh");
  }
  if (check.crosses_itself == true) {
    return refused("self_intersection",
                   fmt::format("the surface crosses itself: {} of faces go through each other",
                               counted(count_of("self_intersection"), "pair", "pairs")),
                   "join the parts into one surface, in Blender by the modifier Boolean or Remesh, "
                   "in OpenSCAD by union()");
  }
  if (!check.volume) return std::nullopt;  // some faces look inward: the mesher does not mind
  if (std::abs(*check.volume) > 0) return std::nullopt;
  return refused("no_volume", "the surface encloses no volume", "give the object a thickness");
}

/// Volume without sign: of faces in disorder from the box, as a bound.
double volume_of(const SurfaceCheck& check) {
  if (check.volume) return std::abs(*check.volume);
  return 0;
}

Result<Thing> as_solid(FileMesh&& mesh, std::vector<Finding> findings) {
  Result<Thing> result;
  Thing thing{.solid = tet_mesh_of(std::move(mesh))};
  for (Finding& f : check_mesh(thing.solid)) findings.push_back(std::move(f));
  if (!has_error(findings)) result.value = std::move(thing);
  result.findings = std::move(findings);
  return result;
}

}  // namespace

Result<Thing> read_thing(const std::filesystem::path& path) {
  Result<FileMesh> mesh = read_file_mesh(path);
  Result<Thing> result;
  if (!mesh) {
    result.findings = std::move(mesh.findings);
    return result;
  }
  if (has_volume_cells(*mesh)) {
    mesh = only_simplices(std::move(mesh), path.string());
    if (mesh)
      result = as_solid(std::move(*mesh), std::move(mesh.findings));
    else
      result.findings = std::move(mesh.findings);
  } else {
    Thing thing{.surface = plain_surface(std::move(*mesh))};
    const SurfaceCheck check = check_surface(thing.surface);
    if (std::optional<Finding> fault = fault_of(check)) {
      result.findings.push_back(std::move(*fault));
    } else {
      thing.volume = volume_of(check);
      result.value = std::move(thing);
    }
  }
  for (Finding& f : result.findings) {
    if (f.file.empty()) f.file = path.string();
  }
  return result;
}

double longest_side(const Thing& thing) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  Point low = {infinite, infinite, infinite}, high = {-infinite, -infinite, -infinite};
  const auto extend = [&](const Point& p) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  };
  for (const auto& t : thing.solid.tetrahedra) {
    for (const std::uint32_t corner : t) extend(thing.solid.points[corner]);
  }
  for (const Point& p : thing.surface.points) extend(p);
  return std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
}

ThingScale scale_of(const Thing& thing, std::optional<double> size, const std::string& units,
                    const std::string& file) {
  const double side = longest_side(thing);
  if (size) return {*size / side, {}};
  if (const auto unit = length_unit_called(units)) return {metres_of(*unit), {}};
  const double metres = side > longest_in_metres ? 1e-3 : 1;
  return {metres,
          Finding{.code = "guessed_unit",
                  .severity = Severity::note,
                  .text = fmt::format("the longest side is {:.4g} in the file's unit, which "
                                      "is taken as {}: {}",
                                      side, metres == 1 ? "metres" : "millimetres",
                                      length_words(side * metres)),
                  .remedy = "give --units or --size if that is not so",
                  .file = file}};
}

}  // namespace sunder
