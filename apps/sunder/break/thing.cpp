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
#include "topology/mesh/box_tree.hpp"
#include "topology/mesh/check.hpp"
#include "topology/mesh/kinds/split_cells.hpp"
#include "topology/mesh/repair.hpp"
#include "topology/mesh/surface/crossing.hpp"
#include "topology/mesh/surface/surface_check.hpp"

namespace sunder {
namespace {

/// Above it nobody drops a thing that is so many metres long.
constexpr double longest_in_metres = 3;

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

Result<Thing> as_solid(FileMesh&& mesh, std::vector<Finding> findings) {
  Result<Thing> result;
  Thing thing{.solid = tet_mesh_of(std::move(mesh))};
  for (Finding& f : check_mesh(thing.solid)) findings.push_back(std::move(f));
  if (!has_error(findings)) result.value = std::move(thing);
  result.findings = std::move(findings);
  return result;
}

}  // namespace

Result<Thing> read_thing(const std::filesystem::path& path, Mending mending) {
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
    Result<Mended> mended = mend(plain_surface(std::move(*mesh)), mending);
    if (mended) result.value = Thing{{}, std::move(mended->surface), mended->volume};
    result.findings = std::move(mended.findings);
  }
  for (Finding& f : result.findings) {
    if (f.file.empty()) f.file = path.string();
  }
  return result;
}

double longest_side(const Thing& thing) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  BoundingBox box{{infinite, infinite, infinite}, {-infinite, -infinite, -infinite}};
  for (const auto& t : thing.solid.tetrahedra) {
    for (const std::uint32_t corner : t) extend(box, thing.solid.points[corner]);
  }
  for (const Point& p : thing.surface.points) extend(box, p);
  return longest_side(box);
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
