// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL's Mesh_3, in the one source that sees it: 83 s and 3 GB to compile.
#include "apps/sunder-mesh/solid_mesh.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polyhedral_mesh_domain_with_features_3.h>
#include <CGAL/exude_mesh_3.h>
#include <CGAL/make_mesh_3.h>
#include <CGAL/perturb_mesh_3.h>

#include <fmt/format.h>

#include <string>
#include <unordered_map>

#include "apps/sunder-mesh/mesh_quality.hpp"

namespace sunder {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Domain = CGAL::Polyhedral_mesh_domain_with_features_3<Kernel>;
using Polyhedron = CGAL::Mesh_polyhedron_3<Kernel>::type;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation, Domain::Corner_index,
                                                        Domain::Curve_index>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;

Polyhedron polyhedron_of(const Surface& surface) {
  std::vector<Kernel::Point_3> points;
  points.reserve(surface.points.size());
  for (const Point& p : surface.points) points.emplace_back(p[0], p[1], p[2]);
  Polyhedron polyhedron;
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, surface.triangles,
                                                              polyhedron);
  return polyhedron;
}

TetMesh tetrahedra_of(const Complex& complex) {
  TetMesh mesh;
  std::unordered_map<const void*, std::uint32_t> row_of;
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end();
       ++cell) {
    std::array<std::uint32_t, 4> corners{};
    for (int k = 0; k < 4; ++k) {
      const auto vertex = cell->vertex(k);
      const auto [place, is_new] =
          row_of.try_emplace(&*vertex, static_cast<std::uint32_t>(mesh.points.size()));
      if (is_new) {
        const auto& p = vertex->point();
        mesh.points.push_back({p.x(), p.y(), p.z()});
      }
      corners[k] = place->second;
    }
    mesh.tetrahedra.push_back(corners);
  }
  return mesh;
}

}  // namespace

Result<TetMesh> mesh_solid(const Surface& surface, const MeshSizes& sizes,
                           const MeshQualityBounds& bounds) {
  namespace with = CGAL::parameters;
  CGAL::get_default_random() = CGAL::Random(0);
  CGAL::Random random(0);
  Domain domain(polyhedron_of(surface), &random);
  if (bounds.feature_angle > 0) domain.detect_features(bounds.feature_angle);
  const Criteria criteria(with::edge_size = sizes.edge, with::facet_angle = bounds.facet_angle,
                          with::facet_size = sizes.facet, with::facet_distance = sizes.distance,
                          with::cell_radius_edge_ratio = bounds.radius_edge_ratio,
                          with::cell_size = sizes.cell);

  CGAL::Mesh_error_code error = CGAL::CGAL_MESH_3_NO_ERROR;
  with::internal::Mesh_3_options guard;
  guard.maximal_number_of_vertices = bounds.max_vertices;
  guard.pointer_to_error_code = &error;
  auto complex = CGAL::make_mesh_3<Complex>(domain, criteria, with::no_perturb(), with::no_exude(),
                                            with::manifold(), guard);
  if (error != CGAL::CGAL_MESH_3_NO_ERROR) {
    Finding f;
    f.code = "mesh_too_large";
    f.text = fmt::format("the refinement reached {} vertices and was stopped", bounds.max_vertices);
    f.remedy = "give larger sizes or a smaller --facet-angle, or raise --max-vertices";
    return f;
  }
  if (complex.number_of_cells_in_complex() == 0) {
    Finding f;
    f.code = "no_tetrahedron";
    f.text = "no tetrahedron of the given sizes fits into the surface";
    f.remedy = "give smaller sizes (--facet-size, --cell-size, --facet-distance)";
    return f;
  }
  if (bounds.perturb) CGAL::perturb_mesh_3(complex, domain);
  if (bounds.exude) CGAL::exude_mesh_3(complex);
  TetMesh mesh = tetrahedra_of(complex);
  sort_rows(mesh);
  return mesh;
}

}  // namespace sunder
