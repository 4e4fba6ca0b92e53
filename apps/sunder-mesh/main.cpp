// SPDX-License-Identifier: GPL-3.0-or-later
// sunder-mesh: a closed surface, a box or a ring in, tetrahedra out.
#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "apps/sunder-mesh/command_line.hpp"
#include "apps/sunder-mesh/count_search.hpp"
#include "apps/sunder-mesh/mesh_quality.hpp"
#include "apps/sunder-mesh/report.hpp"
#include "topology/base/counted.hpp"
#include "topology/io/files/printing.hpp"
#include "topology/io/mesh_file.hpp"

namespace {

using namespace sunder;

constexpr int exit_bad_input = 3;
constexpr int exit_not_written = 4;

void say(const std::vector<Finding>& findings) {
  for (const Finding& f : findings) print(stderr, "{}", finding_line(f));
}

Result<Surface> surface_of(const MeshJob& job) {
  Result<Surface> surface = job.box    ? Result<Surface>(box_surface(*job.box))
                            : job.ring ? Result<Surface>(ring_surface(*job.ring))
                                       : read_surface(job.surface);
  if (!surface) return surface;
  turn_up(surface->points, job.up);
  if (job.height) scale_to_height(surface->points, *job.height);
  return surface;
}

MeshSizes sizes_of(const MeshJob& job, const Surface& surface) {
  MeshSizes s;
  s.facet = job.facet_size.value_or(bounding_diagonal(surface.points) / 20);
  s.edge = job.edge_size.value_or(s.facet);
  s.cell = job.cell_size.value_or(s.facet);
  s.distance = job.facet_distance.value_or(s.facet / 10);
  return s;
}

Result<TetMesh> mesh_of(const MeshJob& job, const Surface& surface) {
  const MeshSizes sizes = sizes_of(job, surface);
  MeshQualityBounds bounds = job.bounds;
  bounds.feature_angle = job.feature_angle.value_or(job.box || job.ring ? 60 : 0);
  const auto mesh_at = [&](double scale) {
    return mesh_solid(
        surface,
        {sizes.edge * scale, sizes.facet * scale, sizes.cell * scale, sizes.distance * scale},
        bounds);
  };
  if (!job.tetrahedra) return mesh_at(1);
  return mesh_with_count(mesh_at, {*job.tetrahedra, job.tries}, [&](const CountTry& t) {
    print(stderr, "try {:2}: facet size {:.6g} m: {}, {}\n", t.number, sizes.facet * t.scale,
          counted_tetrahedra(t.tetrahedra), counted(t.vertices, "vertex", "vertices"));
  });
}

int run(const MeshJob& job) {
  const Result<Surface> surface = surface_of(job);
  say(surface.findings);
  if (!surface) return exit_bad_input;
  print(stderr, "surface: {} points, {} triangles\n", surface->points.size(),
        surface->triangles.size());
  Result<TetMesh> mesh = mesh_of(job, *surface);
  say(mesh.findings);
  if (!mesh) return exit_bad_input;
  if (job.largest_component) {
    print(stderr, "left out: {}\n", counted_tetrahedra(keep_largest_component(*mesh)));
  }
  if (job.stand_on_ground) stand_on_ground(mesh->points);
  mesh->region.assign(mesh->tetrahedra.size(), 1);
  mesh->region_name[1] = job.region;
  const std::vector<Finding> findings = write_mesh(job.output, *mesh);
  say(findings);
  if (has_error(findings)) return exit_not_written;
  const MeshQuality quality = quality_of(*mesh);
  print("{}", job.json ? report_json(*mesh, quality) : report_text(*mesh, quality));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const sunder::CommandLine command = sunder::read_command_line(argc, argv);
  if (!command.job) return command.exit_code;
  try {
    return run(*command.job);
  } catch (const std::exception& error) {
    // CGAL's checks throw; on a surface that passed ours that means a geometry it cannot mesh.
    print(stderr, "error: the surface cannot be meshed: {} [mesher_failed]\n", error.what());
    return exit_bad_input;
  }
}
