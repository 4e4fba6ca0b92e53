// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL's Polygon_mesh_processing and Alpha_wrap_3, in the one source that sees them.
#include "apps/sunder-mesh/repair/heal.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_mesh_to_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_self_intersections.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <CGAL/alpha_wrap_3.h>

#include <algorithm>
#include <exception>
#include <utility>
#include <vector>

namespace sunder {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace processing = CGAL::Polygon_mesh_processing;

Finding failed(const char* code, std::string text) {
  return {.code = code, .text = std::move(text), .remedy = "repair it in a mesh editor"};
}

std::vector<Kernel::Point_3> points_of(const Surface& surface) {
  std::vector<Kernel::Point_3> points;
  for (const Point& p : surface.points) points.emplace_back(p[0], p[1], p[2]);
  return points;
}

Surface surface_of(const Mesh& mesh) {
  std::vector<Kernel::Point_3> points;
  std::vector<std::vector<std::size_t>> faces;
  processing::polygon_mesh_to_polygon_soup(mesh, points, faces);
  Surface surface;
  for (const auto& p : points) surface.points.push_back({p.x(), p.y(), p.z()});
  for (const auto& f : faces) {
    surface.triangles.push_back({static_cast<std::uint32_t>(f[0]), static_cast<std::uint32_t>(f[1]),
                                 static_cast<std::uint32_t>(f[2])});
  }
  return surface;
}

/// The shells of a surface, each closed; a reason where one is not.
Result<std::vector<Mesh>> shells_of(const Surface& surface) {
  std::vector<Kernel::Point_3> points = points_of(surface);
  std::vector<std::vector<std::size_t>> faces;
  for (const auto& t : surface.triangles) faces.push_back({t[0], t[1], t[2]});
  // Edges and points of several shells become one of each.
  processing::orient_polygon_soup(points, faces);
  Mesh mesh;
  processing::polygon_soup_to_polygon_mesh(points, faces, mesh);
  std::vector<Mesh> shells;
  processing::split_connected_components(mesh, shells);
  for (const Mesh& shell : shells) {
    if (!CGAL::is_closed(shell)) return failed("not_united", "a part of the surface is open");
  }
  return shells;
}

/// Cuts the crossings of a shell away; gives whether it had any.
Result<bool> uncross(Mesh& shell) {
  if (!processing::does_self_intersect(shell)) return false;
  const bool done = processing::experimental::remove_self_intersections(shell);
  shell.collect_garbage();
  if (!done || !CGAL::is_closed(shell) || processing::does_self_intersect(shell)) {
    return failed("not_united", "crossings of a shell with itself cannot be cut away");
  }
  return true;
}

/// Joins the shells to the first, the largest first; those that look inward are cut out.
Result<Healed> joined(std::vector<Mesh> shells, Healed healed) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t k = 0; k < shells.size(); ++k) {
    order.emplace_back(-std::abs(CGAL::to_double(processing::volume(shells[k]))), k);
  }
  std::ranges::sort(order);
  const auto looks_inward = [&](std::size_t k) { return processing::volume(shells[k]) < 0; };
  Mesh whole;
  for (const bool cavities : {false, true}) {
    for (const auto& [volume, k] : order) {
      if (looks_inward(k) != cavities) continue;
      Mesh shell = shells[k];
      if (cavities) processing::reverse_face_orientations(shell);
      if (whole.is_empty()) {
        whole = std::move(shell);
        continue;
      }
      const bool done = cavities ? processing::corefine_and_compute_difference(whole, shell, whole)
                                 : processing::corefine_and_compute_union(whole, shell, whole);
      if (!done) return failed("not_united", "two shells touch in a way that has no union");
    }
  }
  whole.collect_garbage();
  if (whole.is_empty()) return failed("not_united", "all shells look inward");
  if (!CGAL::is_closed(whole) || processing::does_self_intersect(whole)) {
    return failed("not_united", "the union still crosses itself");
  }
  healed.surface = surface_of(whole);
  return healed;
}

/// The surface with about so many triangles, or more of them where it would cross itself.
Mesh simplified(const Mesh& mesh, std::size_t triangles) {
  namespace simplification = CGAL::Surface_mesh_simplification;
  for (std::size_t wanted = triangles; 5 * wanted < 4 * mesh.number_of_faces();
       wanted += wanted / 2) {
    Mesh coarse = mesh;
    simplification::edge_collapse(coarse,
                                  simplification::Count_stop_predicate<Mesh>(3 * wanted / 2));
    coarse.collect_garbage();
    if (CGAL::is_closed(coarse) && !processing::does_self_intersect(coarse)) return coarse;
  }
  return mesh;
}

}  // namespace

Result<Healed> unite(const Surface& surface) {
  try {
    Result<std::vector<Mesh>> shells = shells_of(surface);
    if (!shells) return shells.findings.front();
    Healed healed{.surface = {}, .method = "union", .shells = shells->size()};
    for (Mesh& shell : *shells) {
      const Result<bool> crossed = uncross(shell);
      if (!crossed) return crossed.findings.front();
      healed.crossings += *crossed;
    }
    return joined(std::move(*shells), std::move(healed));
  } catch (const std::exception& reason) {
    return failed("not_united", reason.what());
  }
}

Result<Healed> wrap(const Surface& surface, const WrapSettings& settings) {
  try {
    Mesh mesh;
    CGAL::alpha_wrap_3(points_of(surface), surface.triangles, settings.alpha, settings.offset,
                       mesh);
    if (mesh.is_empty()) return failed("not_wrapped", "nothing is left of the surface");
    return Healed{.surface = surface_of(simplified(mesh, settings.triangles)), .method = "wrap"};
  } catch (const std::exception& reason) {
    return failed("not_wrapped", reason.what());
  }
}

}  // namespace sunder
