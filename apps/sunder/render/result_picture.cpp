// SPDX-License-Identifier: MIT
#include "apps/sunder/render/result_picture.hpp"

#include <algorithm>
#include <map>

namespace sunder {
namespace {

/// Moves the pieces apart.
void explode_pieces(PictureBodies& bodies, double factor, const Vec3& up) {
  struct Sum {
    Vec3 place = Vec3::Zero();
    double count = 0;
    Vec3 way = Vec3::Zero();
  };
  std::map<ComponentId, Sum> pieces;
  std::vector<ComponentId> piece_of(bodies.reference.size());
  for (std::size_t t = 0; t < bodies.corners.size(); ++t) {
    for (const VertexId v : bodies.corners[t]) piece_of[v.index()] = bodies.component[t];
  }
  Vec3 middle = Vec3::Zero();
  for (std::size_t v = 0; v < piece_of.size(); ++v) {
    Sum& sum = pieces[piece_of[v]];
    sum.place += bodies.reference[v];
    ++sum.count;
    middle += bodies.reference[v];
  }
  middle /= static_cast<double>(std::max<std::size_t>(piece_of.size(), 1));
  double lowest = 0;
  for (auto& [id, sum] : pieces) {
    sum.way = factor * (sum.place / sum.count - middle);
    lowest = std::min(lowest, sum.way.dot(up));
  }
  for (std::size_t v = 0; v < piece_of.size(); ++v) {
    const Vec3 way = pieces[piece_of[v]].way - lowest * up;
    bodies.reference[v] += way;
    bodies.deformed[v] += way;
  }
}

}  // namespace

FramePicture frame_picture(const ResultFrame& frame, const std::vector<char>& first_boundary,
                           double explode, const Vec3& up) {
  FramePicture picture;
  for (const auto& t : frame.tetrahedra) {
    picture.corners.push_back({VertexId{t[0]}, VertexId{t[1]}, VertexId{t[2]}, VertexId{t[3]}});
  }
  for (const std::int64_t c : frame.component) {
    picture.component.emplace_back(static_cast<std::size_t>(c));
  }
  PictureBodies& bodies = picture.bodies;
  bodies.reference = frame.reference;
  bodies.deformed = frame.position;
  for (std::size_t v = 0; v < frame.crack_move.size(); ++v) {
    bodies.reference[v] += frame.crack_move[v];
    bodies.deformed[v] += frame.crack_move[v];
  }
  bodies.corners = picture.corners;
  bodies.component = picture.component;
  const std::vector<char> boundary = boundary_of(frame);
  for (std::size_t f = 0; f < boundary.size(); ++f) {
    if (!boundary[f]) continue;
    const bool is_skin = f < first_boundary.size() && first_boundary[f];
    bodies.half_faces.emplace_back(f);
    bodies.face_class.push_back(is_skin ? render::FaceClass::skin : render::FaceClass::crack);
  }
  if (explode > 0) explode_pieces(bodies, explode, up);
  return picture;
}

render::Bounds bounds_of_large(const ResultFrame& frame, const render::Bounds& start) {
  std::map<std::int64_t, std::size_t> size;
  for (const std::int64_t c : frame.component) ++size[c];
  render::Bounds bounds;
  for (std::size_t t = 0; t < frame.tetrahedra.size(); ++t) {
    if (100 * size[frame.component[t]] < frame.tetrahedra.size()) continue;
    for (const std::uint32_t corner : frame.tetrahedra[t]) {
      bounds.extend(frame.reference[corner].cast<float>());
    }
  }
  if (bounds.isEmpty() || start.isEmpty()) return bounds;
  const Eigen::Vector3f margin = Eigen::Vector3f::Constant(start.diagonal().norm());
  return bounds.intersection(render::Bounds(start.min() - margin, start.max() + margin));
}

}  // namespace sunder
