// SPDX-License-Identifier: MIT
// Gaps, feet and times of vertices and faces.
#include "mechanics/contact/detection/face_touch.hpp"

#include <algorithm>

#include "mechanics/contact/shapes/nearest_point.hpp"

namespace sunder {
namespace {

/// Shares of the corners in the foot of `point` in their plane; not numbers where they are in line.
std::array<double, 3> foot_of(const std::array<Vec3, 3>& x, const Vec3& point) {
  const Vec3 a = x[1] - x[0], b = x[2] - x[0], p = point - x[0], area = a.cross(b);
  const double square = area.squaredNorm();
  const double v = p.cross(b).dot(area) / square, w = a.cross(p).dot(area) / square;
  return {1 - v - w, v, w};
}
/// m, of a vertex from the plane of a face.
double gap_at(const StepPaths& paths, VertexId v, HalfFaceId face, double part) {
  const std::array<Vec3, 3> x = places_at(paths, corners_of(paths, face), part);
  return normal_of(x).dot(paths.at(v, part) - x[0]);
}

/// As the step begins; the values at its end are not set.
FaceTouch touch_at_start(const StepPaths& paths, VertexId v, HalfFaceId face) {
  return {.vertex = v,
          .component = paths.state.elements.component[tetrahedron_of(face).index()],
          .face = face,
          .gap_start = gap_at(paths, v, face, 0)};
}

void set_foot(FaceTouch& touch, const StepPaths& paths) {
  const std::array<Vec3, 3> x = places_at(paths, corners_of(paths, touch.face), touch.part);
  touch.normal = normal_of(x);
  touch.size = (x[1] - x[0]).norm();
  touch.foot = foot_of(x, paths.at(touch.vertex, touch.part));
  touch.over_face = std::ranges::all_of(touch.foot, [](double w) { return w >= -on_face; });
}

}  // namespace

bool is_near(const StepPaths& paths, const FaceTouch& touch) {
  const std::array<VertexId, 3> corners = corners_of(paths, touch.face);
  Vec3 way = paths.at(touch.vertex, 1) - paths.at(touch.vertex, 0);
  for (std::size_t k = 0; k < 3; ++k) {
    way -= touch.foot[k] * (paths.at(corners[k], 1) - paths.at(corners[k], 0));
  }
  return touch.gap_end < way.norm();
}

std::optional<FaceTouch> swept_touch(const StepPaths& paths, VertexId v, HalfFaceId face) {
  FaceTouch touch = touch_at_start(paths, v, face);
  touch.gap_end = gap_at(paths, v, face, 1);
  touch.is_swept = true;
  if (touch.gap_start > 0) {
    touch.part = touch.gap_end < 0 ? touch.gap_start / (touch.gap_start - touch.gap_end)
                                   : (touch.gap_end < touch.gap_start ? 1.0 : 0.0);
  }
  set_foot(touch, paths);
  const bool counts =
      touch.over_face && touch.gap_start >= -on_face * touch.size && is_near(paths, touch);
  return counts ? std::optional(touch) : std::nullopt;
}

std::optional<FaceTouch> resting_touch(const StepPaths& paths, VertexId v, HalfFaceId face,
                                       double band, bool is_inside) {
  FaceTouch touch = touch_at_start(paths, v, face);
  if (touch.gap_start > band || (!is_inside && touch.gap_start < -band)) return std::nullopt;
  touch.gap_end = gap_at(paths, v, face, 1);
  set_foot(touch, paths);
  if (touch.over_face) return touch;
  const std::array<VertexId, 3> corners = corners_of(paths, face);
  const std::array<Vec3, 3> x = places_at(paths, corners, 0);
  touch.foot = nearest_on_triangle(x, paths.at_start(v));
  const auto apart_at = [&](double part) -> Vec3 {
    const std::array<Vec3, 3> there = places_at(paths, corners, part);
    return paths.at(v, part) - touch.foot[0] * there[0] - touch.foot[1] * there[1] -
           touch.foot[2] * there[2];
  };
  const Vec3 apart = apart_at(0);
  const double beside = (apart - touch.gap_start * touch.normal).norm();
  touch.over_face = beside <= band;
  if (touch.over_face) return touch;
  if (!is_inside || touch.gap_start > 0) return std::nullopt;
  touch.gap_start = -apart.norm();
  touch.normal = -apart.normalized();
  touch.gap_end = touch.normal.dot(apart_at(1));
  touch.over_face = true;
  return touch;
}

}  // namespace sunder
