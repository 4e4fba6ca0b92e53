// SPDX-License-Identifier: MIT
#include "apps/sunder/export/obstacle_tracks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <variant>

#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "mechanics/contact/shapes/solid_surface.hpp"

namespace sunder {
namespace {

/// Surfaces about the mass centre, in the obstacle's own axes.
struct AddSurface {
  PieceTrack& track;

  void operator()(const Plane&) const {}

  void operator()(const Sphere& ball) const {
    constexpr std::uint32_t around = 24, rings = 12;
    const auto row = [](std::uint32_t ring, std::uint32_t k) {
      return ring == 0 ? 0 : ring == rings ? 1 : 2 + (ring - 1) * around + k % around;
    };
    track.vertex = {ball.radius * Vec3::UnitZ(), -ball.radius * Vec3::UnitZ()};
    for (std::uint32_t ring = 1; ring < rings; ++ring) {
      const double down = std::numbers::pi * ring / rings;
      for (std::uint32_t k = 0; k < around; ++k) {
        const double turn = 2 * std::numbers::pi * k / around;
        track.vertex.push_back(ball.radius * Vec3(std::sin(down) * std::cos(turn),
                                                  std::sin(down) * std::sin(turn), std::cos(down)));
      }
    }
    for (std::uint32_t ring = 0; ring < rings; ++ring) {
      for (std::uint32_t k = 0; k < around; ++k) {
        if (ring > 0) track.outer.push_back({row(ring, k), row(ring + 1, k), row(ring, k + 1)});
        if (ring + 1 < rings) {
          track.outer.push_back({row(ring, k + 1), row(ring + 1, k), row(ring + 1, k + 1)});
        }
      }
    }
  }

  void operator()(const Box& box) const {
    for (int k = 0; k < 8; ++k) {
      track.vertex.push_back(
          Vec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1).cwiseProduct(box.half_extent));
    }
    track.outer = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                   {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  }

  void operator()(const Solid& solid) const {
    for (const Vec3& x : solid.surface->points) track.vertex.push_back(x - solid.surface->centre);
    track.outer = solid.surface->triangles;
  }
};

}  // namespace

std::vector<PieceTrack> obstacle_tracks(const std::vector<ResultFrame>& frames) {
  std::vector<PieceTrack> tracks;
  for (std::size_t k = 0; k < frames.front().obstacles.size(); ++k) {
    PieceTrack track;
    track.name = fmt::format("obstacle_{}", k);
    track.is_obstacle = true;
    std::visit(AddSurface{track}, frames.front().obstacles[k].shape);
    if (track.outer.empty()) continue;
    for (const ResultFrame& frame : frames) {
      Pose pose = pose_of(frame.obstacles[k].shape);
      if (!track.orientation.empty() && track.orientation.back().dot(pose.orientation) < 0) {
        pose.orientation.coeffs() *= -1;
      }
      track.centre.push_back(pose.centre);
      track.orientation.push_back(pose.orientation);
    }
    tracks.push_back(std::move(track));
  }
  return tracks;
}

}  // namespace sunder
