// SPDX-License-Identifier: GPL-3.0-or-later
// The options of sunder-mesh, their units, defaults and limits.
#include "apps/sunder-mesh/command_line.hpp"

#include <CLI/CLI.hpp>

#include <iostream>
#include <limits>
#include <map>
#include <vector>

namespace sunder {
namespace {

const char* const footer = R"(Examples:
  sunder-mesh bunny.off -o bunny.msh --up y --height 0.15 --ground --tetrahedra 6142
  sunder-mesh --box 1,0.4,2 -o slab.msh --facet-size 0.15
  sunder-mesh --ring 0.5,0.3,0.2 -o ring.msh --tetrahedra 5000
Exit codes: 0 fine; 2 usage; 3 surface unreadable or not to be meshed; 4 output not written.)";

struct Shapes {
  std::vector<double> box, ring;
};

void add_shape_options(CLI::App& app, MeshJob& job, Shapes& shapes) {
  auto* shape = app.add_option_group("shape", "What to fill with tetrahedra (one of)");
  shape->add_option("surface", job.surface,
                    "Closed surface: OFF, OBJ or STL, recognised by its ending");
  shape->add_option("--box", shapes.box, "Box X,Y,Z, m, standing on z = 0")
      ->delimiter(',')
      ->expected(3)
      ->check(CLI::PositiveNumber);
  shape->add_option("--ring", shapes.ring, "Tube OUTER,INNER,HEIGHT (two radii), m, about z")
      ->delimiter(',')
      ->expected(3)
      ->check(CLI::PositiveNumber);
  shape->require_option(1);

  const std::map<std::string, UpAxis> axes{{"x", UpAxis::x}, {"-x", UpAxis::minus_x},
                                           {"y", UpAxis::y}, {"-y", UpAxis::minus_y},
                                           {"z", UpAxis::z}, {"-z", UpAxis::minus_z}};
  app.add_option("--up", job.up, "Axis of the surface that becomes +z (default z)")
      ->transform(CLI::Transformer(axes));
  app.add_option("--height", job.height, "Scale to this extent along z, m (default: as it is)")
      ->check(CLI::PositiveNumber);
  app.add_flag("--ground", job.stand_on_ground,
               "Move the mesh to stand on z = 0, its bounding box centred on the z axis");
}

void add_size_options(CLI::App& app, MeshJob& job) {
  app.add_option("--facet-size", job.facet_size,
                 "Largest radius about a boundary triangle, m (default: diagonal / 20)")
      ->check(CLI::PositiveNumber);
  app.add_option("--cell-size", job.cell_size,
                 "Largest circumradius of a tetrahedron, m (default: facet size)")
      ->check(CLI::PositiveNumber);
  app.add_option("--edge-size", job.edge_size,
                 "Longest edge along sharp edges, m (default: facet size)")
      ->check(CLI::PositiveNumber);
  app.add_option("--facet-distance", job.facet_distance,
                 "Largest distance between mesh and surface, m (default: facet size / 10)")
      ->check(CLI::PositiveNumber);
  app.add_option("--tetrahedra", job.tetrahedra,
                 "Multiply all sizes so that the count is as near to this as possible")
      ->check(CLI::Range(std::size_t{1}, std::size_t{100'000'000}));
  app.add_option("--tries", job.tries, "Meshes made for --tetrahedra at most (default 24)")
      ->check(CLI::Range(1, 1000));
}

void add_quality_options(CLI::App& app, MeshJob& job) {
  app.add_option("--facet-angle", job.bounds.facet_angle,
                 "Least angle of a boundary triangle, degrees (default 25; 30 at most)")
      ->check(CLI::Range(0.0, 30.0));
  app.add_option("--edge-ratio", job.bounds.radius_edge_ratio,
                 "Largest circumradius over shortest edge of a tetrahedron (default 2)")
      ->check(CLI::Range(1.0, 1e6));
  app.add_option("--feature-angle", job.feature_angle,
                 "Keep edges with normals further apart than this, degrees; 0: none "
                 "(default 60 for --box and --ring, 0 for files)")
      ->check(CLI::Range(0.0, 180.0));
  app.add_flag("--perturb,!--no-perturb", job.bounds.perturb,
               "Move vertices against slivers (default on)");
  app.add_flag("--exude,!--no-exude", job.bounds.exude,
               "Change weights against slivers (default on)");
  app.add_flag("--largest", job.largest_component, "Keep the largest component only");
  app.add_option("--max-vertices", job.bounds.max_vertices,
                 "Stop with an error at this many vertices (default 5000000)")
      ->check(CLI::Range(std::size_t{100}, std::size_t{1'000'000'000}));
}

void add_output_options(CLI::App& app, MeshJob& job) {
  app.add_option("-o,--output", job.output, "The mesh to write: .msh (MSH 4.1 ASCII) or .vtu")
      ->required();
  app.add_option("--region", job.region, "Name of the region all tetrahedra are in (default body)")
      ->check([](const std::string& name) {
        const bool is_plain = !name.empty() && name.find_first_of("\"\n") == std::string::npos;
        return is_plain ? std::string{} : "a region's name is not empty and has no quote in it";
      });
  app.add_flag("--json", job.json, "Print the figures as JSON");
}

/// A fault that the parser cannot see: values that do not go together. Empty when they do.
std::string contradiction(const MeshJob& job) {
  if (job.ring && !(job.ring->outer_radius > job.ring->inner_radius)) {
    return "--ring: OUTER must be larger than INNER";
  }
  return {};
}

}  // namespace

CommandLine read_command_line(int argc, char** argv) {
  CLI::App app{
      "Fills a closed surface with tetrahedra (CGAL Mesh_3; this program is under the GPL)",
      "sunder-mesh"};
  app.footer(footer);
  MeshJob job;
  Shapes shapes;
  add_shape_options(app, job, shapes);
  add_size_options(app, job);
  add_quality_options(app, job);
  add_output_options(app, job);
  try {
    app.parse(argc, argv);
    if (!shapes.box.empty()) job.box = {shapes.box[0], shapes.box[1], shapes.box[2]};
    if (!shapes.ring.empty()) job.ring = {shapes.ring[0], shapes.ring[1], shapes.ring[2]};
    if (const std::string what = contradiction(job); !what.empty()) {
      throw CLI::ValidationError(what);
    }
  } catch (const CLI::Success& help) {
    return {std::nullopt, app.exit(help)};
  } catch (const CLI::ParseError& error) {
    app.exit(error, std::cout, std::cerr);
    return {std::nullopt, 2};
  }
  return {std::move(job), 0};
}

}  // namespace sunder
