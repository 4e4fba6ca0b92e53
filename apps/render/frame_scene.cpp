// SPDX-License-Identifier: MIT
// Bounds and checks of a scene.
#include "apps/render/frame_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace sunder::render {
namespace {

bool is_inside(const Surface& s, const std::array<std::uint32_t, 3>& t) {
  return std::ranges::all_of(t, [&](std::uint32_t v) { return v < s.positions.size(); });
}

/// A finding about every row of `rows`; nothing when there is none.
void report(std::vector<Finding>& findings, Finding finding,
            const std::vector<std::int64_t>& rows) {
  if (rows.empty()) return;
  finding.count = rows.size();
  finding.ids.assign(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(
                                                      std::min(rows.size(), Finding::max_ids)));
  findings.push_back(std::move(finding));
}

void check_lengths(const Surface& s, std::size_t row, std::vector<Finding>& findings) {
  const auto compare = [&](std::size_t length, const char* name) {
    if (length == 0 || length == s.triangles.size()) return;
    findings.push_back({.code = "length_mismatch",
                        .text = fmt::format("surface {}: {} has {} entries for {} triangles", row,
                                            name, length, s.triangles.size()),
                        .remedy = "give one entry for each triangle, or none at all"});
  };
  compare(s.corner_normals.size(), "corner_normals");
  compare(s.face_class.size(), "face_class");
  compare(s.piece.size(), "piece");
}

void check_triangles(const Surface& s, std::size_t row, std::vector<Finding>& findings) {
  std::vector<std::int64_t> outside, infinite;
  for (std::size_t t = 0; t < s.triangles.size(); ++t) {
    const auto& corners = s.triangles[t];
    if (!is_inside(s, corners)) {
      outside.push_back(static_cast<std::int64_t>(t));
    } else if (!is_drawable(s, corners)) {
      infinite.push_back(static_cast<std::int64_t>(t));
    }
  }
  report(findings,
         {.code = "index_out_of_range",
          .text = fmt::format("surface {}: triangles name points that are not among its {}", row,
                              s.positions.size()),
          .remedy = "rows of points count from 0 and end before the number of points"},
         outside);
  report(findings,
         {.code = "not_finite",
          .severity = Severity::warning,
          .text = fmt::format("surface {}: triangles with a corner that is not finite", row),
          .remedy = "they are left out of the picture; look for where the simulation diverged"},
         infinite);
}

template <class Shape, class Predicate>
void check_shapes(const std::vector<Shape>& shapes, const char* what, Predicate good,
                  std::vector<Finding>& findings) {
  std::vector<std::int64_t> bad;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (!good(shapes[i])) bad.push_back(static_cast<std::int64_t>(i));
  }
  report(findings,
         {.code = "degenerate_shape",
          .text = fmt::format("{} not finite or without extent", what),
          .remedy = "give finite numbers, sizes above 0 and normals that are not 0"},
         bad);
}

}  // namespace

bool is_drawable(const Surface& s, const std::array<std::uint32_t, 3>& t) {
  return is_inside(s, t) &&
         std::ranges::all_of(t, [&](std::uint32_t v) { return s.positions[v].allFinite(); });
}

Bounds scene_bounds(const FrameScene& scene) {
  Bounds bounds;
  for (const Surface& s : scene.surfaces) {
    for (const auto& t : s.triangles) {
      if (!is_drawable(s, t)) continue;
      for (const std::uint32_t v : t) bounds.extend(s.positions[v]);
    }
  }
  for (const Sphere& s : scene.spheres) {
    const Eigen::Vector3f r = Eigen::Vector3f::Constant(s.radius);
    bounds.extend(Bounds(s.center - r, s.center + r));
  }
  for (const Box& b : scene.boxes) {
    const Eigen::Vector3f r = b.rotation.toRotationMatrix().cwiseAbs() * b.half_extent;
    bounds.extend(Bounds(b.center - r, b.center + r));
  }
  return bounds;
}

std::vector<Finding> check(const FrameScene& scene) {
  std::vector<Finding> findings;
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
    check_lengths(scene.surfaces[i], i, findings);
    check_triangles(scene.surfaces[i], i, findings);
  }
  const auto good_plane = [](const Plane& p) {
    return p.point.allFinite() && p.normal.allFinite() && p.normal.norm() > 0;
  };
  const auto good_sphere = [](const Sphere& s) {
    return s.center.allFinite() && std::isfinite(s.radius) && s.radius > 0;
  };
  const auto good_box = [](const Box& b) {
    return b.center.allFinite() && b.half_extent.allFinite() && b.half_extent.minCoeff() > 0 &&
           b.rotation.coeffs().allFinite() && b.rotation.norm() > 0;
  };
  check_shapes(scene.planes, "planes", good_plane, findings);
  check_shapes(scene.spheres, "spheres", good_sphere, findings);
  check_shapes(scene.boxes, "boxes", good_box, findings);
  if (!scene.light.to_key.allFinite() || scene.light.to_key.norm() == 0 ||
      !scene.light.up.allFinite() || scene.light.up.norm() == 0) {
    findings.push_back({.code = "degenerate_shape",
                        .text = "the light's to_key or up is not a direction",
                        .remedy = "give finite vectors that are not 0"});
  }
  if (!scene.extent.isEmpty() &&
      !(scene.extent.min().allFinite() && scene.extent.max().allFinite())) {
    findings.push_back({.code = "degenerate_shape",
                        .text = "the extent of the scene is not finite",
                        .remedy = "give a finite box, or an empty one"});
  }
  return findings;
}

}  // namespace sunder::render
