// SPDX-License-Identifier: MIT
#include "topology/mesh/surface/repair/surface_repair.hpp"

#include <fmt/format.h>

#include <string>

#include "topology/base/counted.hpp"
#include "topology/mesh/repair.hpp"
#include "topology/mesh/surface/repair/facing.hpp"
#include "topology/mesh/surface/repair/holes.hpp"

namespace sunder {
namespace {

void close_holes(FileMesh& surface, double widest, SurfaceRepair& done) {
  std::vector<Triangle>& triangles = surface.triangles.corners;
  done.wide_holes = 0;
  done.widest_left = 0;
  for (const Rim& rim : rims_of(triangles)) {
    const double width = width_of(surface.points, rim);
    const std::vector<Triangle> cover =
        width <= widest ? cover_of(surface.points, triangles, rim) : std::vector<Triangle>();
    if (cover.empty()) {
      ++done.wide_holes;
      if (width >= done.widest_left) {
        done.widest_left = width;
        done.place_left = middle_of(surface.points, rim);
      }
      continue;
    }
    triangles.insert(triangles.end(), cover.begin(), cover.end());
    ++done.holes;
    done.cover += cover.size();
    done.widest_hole = std::max(done.widest_hole, width);
  }
}

}  // namespace

SurfaceRepair repair_surface(FileMesh& surface, double widest) {
  SurfaceRepair done;
  std::vector<Triangle>& triangles = surface.triangles.corners;
  done.walls = drop_walls(triangles);
  if (count_edges(triangles).open > 0) {
    done.stitching = stitch(surface.points, triangles);
    const Walls again = drop_walls(triangles);  // faces that a seam kept apart
    done.walls.doubled += again.doubled;
    done.walls.inner += again.inner;
  }
  done.turned = face_outward(surface.points, triangles);
  if (count_edges(triangles).open > 0) {
    close_holes(surface, widest, done);
    // A shell that a cover closed has an outside.
    if (done.holes > 0) done.turned += face_outward(surface.points, triangles);
  }
  drop_unused_points(surface);
  return done;
}

std::vector<std::string> repair_words(const SurfaceRepair& r) {
  std::vector<std::string> words;
  const auto add = [&](std::size_t count, std::string text) {
    if (count > 0) words.push_back(std::move(text));
  };
  add(r.stitching.points, fmt::format("{} joined with others at most {:.2g} away",
                                      counted(r.stitching.points, "point"), r.stitching.distance));
  add(r.stitching.sides,
      fmt::format("{} divided at points on them", counted(r.stitching.sides, "side")));
  add(r.walls.doubled, fmt::format("{} removed", counted(r.walls.doubled, "doubled face")));
  add(r.walls.inner, fmt::format("{} of inner walls removed", counted(r.walls.inner, "face")));
  add(r.turned, fmt::format("{} turned", counted(r.turned, "face")));
  add(r.holes,
      fmt::format("{} closed, the widest {:.3g}", counted(r.holes, "hole"), r.widest_hole));
  return words;
}

}  // namespace sunder
