// SPDX-License-Identifier: MIT
// Boundary half-faces to triangles with corner normals.
#include "apps/render/drawn_surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "topology/base/assert.hpp"

namespace sunder::render {
namespace {

using Rows = std::array<std::uint32_t, 3>;

/// Corners of skin faces gathered by vertex: row v has `corners[first[v]] ... corners[first[v+1]]`.
struct Stars {
  std::vector<std::size_t> first;
  /// 3 * triangle + place.
  std::vector<std::uint32_t> corners;
};

bool is_crack(const Surface& s, std::size_t triangle) {
  return !s.face_class.empty() && s.face_class[triangle] == FaceClass::crack;
}

Stars skin_stars(const Surface& s) {
  Stars stars;
  stars.first.assign(s.positions.size() + 1, 0);
  const auto each_skin_corner = [&](auto visit) {
    for (std::size_t t = 0; t < s.triangles.size(); ++t) {
      if (is_crack(s, t)) continue;
      for (std::size_t i = 0; i < 3; ++i) visit(s.triangles[t][i], 3 * t + i);
    }
  };
  each_skin_corner([&](std::size_t v, std::size_t) { ++stars.first[v + 1]; });
  for (std::size_t v = 1; v < stars.first.size(); ++v) stars.first[v] += stars.first[v - 1];
  stars.corners.resize(stars.first.back());
  std::vector<std::size_t> next = stars.first;
  each_skin_corner([&](std::size_t v, std::size_t corner) {
    stars.corners[next[v]++] = static_cast<std::uint32_t>(corner);
  });
  return stars;
}

/// A triangle's unit normal and the angles at its corners; zero where it has no area.
struct FaceFrame {
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  std::array<float, 3> angle = {};
};

FaceFrame face_frame(const Surface& s, const Rows& rows) {
  std::array<Eigen::Vector3d, 3> p;
  for (std::size_t i = 0; i < 3; ++i) p[i] = s.positions[rows[i]].cast<double>();
  const Eigen::Vector3d twice_area = (p[1] - p[0]).cross(p[2] - p[0]);
  FaceFrame frame;
  if (!(twice_area.norm() > 0)) return frame;
  frame.normal = twice_area.stableNormalized().cast<float>();
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d a = p[(i + 1) % 3] - p[i], b = p[(i + 2) % 3] - p[i];
    frame.angle[i] = static_cast<float>(std::atan2(a.cross(b).norm(), a.dot(b)));
  }
  return frame;
}

void smooth_normals(Surface& s, double crease_angle) {
  std::vector<FaceFrame> frames;
  frames.reserve(s.triangles.size());
  for (const Rows& rows : s.triangles) frames.push_back(face_frame(s, rows));
  const Stars stars = skin_stars(s);
  const auto least_cosine = static_cast<float>(std::cos(crease_angle));
  s.corner_normals.resize(s.triangles.size());
  for (std::size_t t = 0; t < s.triangles.size(); ++t) {
    s.corner_normals[t].fill(frames[t].normal);
    if (is_crack(s, t)) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t v = s.triangles[t][i];
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      for (std::size_t k = stars.first[v]; k < stars.first[v + 1]; ++k) {
        const std::size_t other = stars.corners[k] / 3, place = stars.corners[k] % 3;
        const bool smooth = frames[t].normal.dot(frames[other].normal) >= least_cosine;
        if (!smooth || s.piece[other] != s.piece[t]) continue;
        sum += frames[other].angle[place] * frames[other].normal;
      }
      if (sum.norm() > 0) s.corner_normals[t][i] = sum.normalized();
    }
  }
}

void add_triangles(Surface& s, const BoundaryFaces& faces) {
  constexpr std::uint32_t unused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> row(faces.positions.size(), unused);
  for (const HalfFaceId face : faces.half_faces) {
    const std::size_t tet = tetrahedron_of(face).index();
    SUNDER_ASSERT(tet < faces.corners.size(), "half-face of a tetrahedron that does not exist");
    Rows rows{};
    const auto corners = outward_corners(faces.corners[tet], face);
    for (std::size_t i = 0; i < 3; ++i) {
      SUNDER_ASSERT(corners[i].index() < row.size(), "vertex row without a position");
      rows[i] = corners[i].value;
      row[rows[i]] = 0;
    }
    s.triangles.push_back(rows);
    s.piece.push_back(faces.component.empty() ? 0 : faces.component[tet].value);
  }
  for (std::size_t v = 0; v < row.size(); ++v) {
    if (row[v] == unused) continue;
    row[v] = static_cast<std::uint32_t>(s.positions.size());
    s.positions.push_back(faces.positions[v].cast<float>());
  }
  for (Rows& rows : s.triangles) {
    for (std::uint32_t& v : rows) v = row[v];
  }
}

}  // namespace

std::array<VertexId, 3> outward_corners(const std::array<VertexId, 4>& corners, HalfFaceId face) {
  // Opposite to each corner of a positively oriented tetrahedron, seen from outside.
  constexpr std::array<std::array<std::size_t, 3>, 4> places{
      {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
  const auto& p = places[static_cast<std::size_t>(place_of(face))];
  return {corners[p[0]], corners[p[1]], corners[p[2]]};
}

Surface drawn_surface(const BoundaryFaces& faces) {
  SUNDER_ASSERT(faces.face_class.empty() || faces.face_class.size() == faces.half_faces.size(),
                "one class for each half-face, or none");
  SUNDER_ASSERT(faces.component.empty() || faces.component.size() == faces.corners.size(),
                "one component for each tetrahedron, or none");
  Surface surface;
  surface.triangles.reserve(faces.half_faces.size());
  surface.piece.reserve(faces.half_faces.size());
  surface.face_class.assign(faces.face_class.begin(), faces.face_class.end());
  add_triangles(surface, faces);
  smooth_normals(surface, faces.crease_angle);
  return surface;
}

}  // namespace sunder::render
