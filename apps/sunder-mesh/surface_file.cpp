// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces from OFF, OBJ and STL files through CGAL, checked to be closed and manifold.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>

#include "apps/sunder-mesh/surface.hpp"
#include "topology/base/counted.hpp"

namespace sunder {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
namespace processing = CGAL::Polygon_mesh_processing;

struct PolygonSoup {
  std::vector<Kernel::Point_3> points;
  std::vector<std::vector<std::size_t>> polygons;
};

Finding refusal(const std::filesystem::path& path, std::string code, std::string text,
                std::string remedy) {
  Finding f;
  f.code = std::move(code);
  f.text = std::move(text);
  f.remedy = std::move(remedy);
  f.file = path.string();
  return f;
}

/// Reads the polygons as they stand; a reason when there are none to use.
std::optional<Finding> read_soup(const std::filesystem::path& path, PolygonSoup& soup) {
  const std::string ending = path.extension().string();
  if (!std::ifstream(path)) {
    return refusal(path, "cannot_open", "the file cannot be opened", "check the path");
  }
  const bool is_known = ending == ".off" || ending == ".obj" || ending == ".stl";
  if (!is_known) {
    return refusal(path, "unknown_format", fmt::format("the name ends in \"{}\"", ending),
                   "give a surface whose name ends in .off, .obj or .stl");
  }
  if (!CGAL::IO::read_polygon_soup(path.string(), soup.points, soup.polygons)) {
    return refusal(path, "not_a_surface", fmt::format("it does not read as {}", ending.substr(1)),
                   "check that the file is whole and that its name has the right ending");
  }
  for (const Kernel::Point_3& p : soup.points) {
    if (!std::isfinite(p.x()) || !std::isfinite(p.y()) || !std::isfinite(p.z())) {
      return refusal(path, "nan_coordinate", "a coordinate is not a finite number",
                     "write the surface again with finite coordinates");
    }
  }
  for (const auto& polygon : soup.polygons) {
    for (std::size_t row : polygon) {
      if (row >= soup.points.size()) {
        return refusal(path, "index_out_of_range",
                       fmt::format("a polygon names point {} of {}", row, soup.points.size()),
                       "check that the file is whole");
      }
    }
  }
  return std::nullopt;
}

Surface triangulated(const PolygonSoup& soup) {
  Surface s;
  for (const Kernel::Point_3& p : soup.points) s.points.push_back({p.x(), p.y(), p.z()});
  for (const auto& polygon : soup.polygons) {
    for (std::size_t k = 2; k < polygon.size(); ++k) {
      s.triangles.push_back({static_cast<std::uint32_t>(polygon[0]),
                             static_cast<std::uint32_t>(polygon[k - 1]),
                             static_cast<std::uint32_t>(polygon[k])});
    }
  }
  return s;
}

/// Number of edges that do not have exactly two triangles.
std::size_t count_open_edges(const Surface& s) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const auto& t : s.triangles) {
    for (int k = 0; k < 3; ++k) ++uses[std::minmax(t[k], t[(k + 1) % 3])];
  }
  std::size_t open = 0;
  for (const auto& [edge, count] : uses) open += count != 2;
  return open;
}

bool cuts_itself(const Surface& s) {
  CGAL::Surface_mesh<Kernel::Point_3> mesh;
  std::vector<Kernel::Point_3> points;
  for (const Point& p : s.points) points.emplace_back(p[0], p[1], p[2]);
  processing::polygon_soup_to_polygon_mesh(points, s.triangles, mesh);
  return processing::does_self_intersect(mesh);
}

}  // namespace

Result<Surface> read_surface(const std::filesystem::path& path) {
  PolygonSoup soup;
  if (auto reason = read_soup(path, soup)) return *reason;
  processing::repair_polygon_soup(soup.points, soup.polygons);
  if (soup.polygons.empty()) {
    return refusal(path, "empty_surface", "it holds no polygon of any area", "check the file");
  }
  if (!processing::orient_polygon_soup(soup.points, soup.polygons)) {
    return refusal(path, "non_manifold_surface",
                   "some edge has more than two polygons, or the polygons cannot be made to agree",
                   "repair the surface so that every edge has two polygons");
  }
  Surface surface = triangulated(soup);
  if (const std::size_t open = count_open_edges(surface)) {
    return refusal(path, "open_surface",
                   fmt::format("{} only one triangle: the surface has holes",
                               counted(open, "edge has", "edges have")),
                   "fill the holes; only a closed surface bounds a solid");
  }
  Result<Surface> result;
  if (cuts_itself(surface)) {
    Finding f = refusal(path, "self_intersecting_surface", "some triangles cut each other",
                        "what lies inside is decided by counting crossings; look at the mesh");
    f.severity = Severity::warning;
    result.findings.push_back(std::move(f));
  }
  result.value = std::move(surface);
  return result;
}

}  // namespace sunder
