// SPDX-License-Identifier: MIT
// Boundary faces of the last frame by piece, and the least-squares rigid motion of each frame.
#include "apps/sunder/export/piece_tracks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace sunder {
namespace {

using Triple = std::array<std::uint32_t, 3>;

/// A piece while its vertices are collected: rows of the last frame, and a corner (4 t + place) of
/// each, by which other frames know it.
struct Draft {
  std::map<std::uint32_t, std::uint32_t> row;
  std::vector<std::size_t> corner;
  PieceTrack track;
};

void add_face(Draft& draft, const ResultFrame& last, std::size_t half_face, bool is_crack) {
  const auto& t = last.tetrahedra[half_face / 4];
  Triple triangle = face_of(t, static_cast<int>(half_face % 4));
  for (std::uint32_t& v : triangle) {
    const auto [place, is_new] =
        draft.row.try_emplace(v, static_cast<std::uint32_t>(draft.corner.size()));
    if (is_new) {
      draft.corner.push_back(4 * (half_face / 4) +
                             static_cast<std::size_t>(std::ranges::find(t, v) - t.begin()));
    }
    v = place->second;
  }
  (is_crack ? draft.track.crack : draft.track.outer).push_back(triangle);
}

const Vec3& reference_of(const ResultFrame& frame, std::size_t corner) {
  return frame.reference[frame.tetrahedra[corner / 4][corner % 4]];
}

/// The motion of a piece in one frame.
void add_key(Draft& draft, const ResultFrame& frame) {
  const auto count = static_cast<Eigen::Index>(draft.corner.size());
  Eigen::Matrix3Xd from(3, count), to(3, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    from.col(i) = draft.track.vertex[static_cast<std::size_t>(i)];
    to.col(i) = reference_of(frame, draft.corner[static_cast<std::size_t>(i)]);
  }
  const Eigen::Matrix4d motion = Eigen::umeyama(from, to, false);
  Eigen::Quaterniond q(Eigen::Matrix3d(motion.topLeftCorner<3, 3>()));
  q.normalize();
  PieceTrack& track = draft.track;
  if (!track.orientation.empty() && track.orientation.back().dot(q) < 0) q.coeffs() *= -1;
  track.orientation.push_back(q);
  track.centre.push_back(motion.topRightCorner<3, 1>());
  const Eigen::Matrix3Xd placed = (q.toRotationMatrix() * from).colwise() + track.centre.back();
  track.departure = std::max(track.departure, (placed - to).colwise().norm().maxCoeff());
}

}  // namespace

std::vector<PieceTrack> piece_tracks(const std::vector<ResultFrame>& frames) {
  const ResultFrame &first = frames.front(), &last = frames.back();
  const std::vector<char> before = boundary_of(first), after = boundary_of(last);
  std::map<std::int64_t, Draft> drafts;
  for (std::size_t f = 0; f < after.size(); ++f) {
    if (after[f]) add_face(drafts[last.component[f / 4]], last, f, !before[f]);
  }
  std::vector<PieceTrack> tracks;
  for (auto& [component, draft] : drafts) {
    draft.track.name = fmt::format("piece_{}", component);
    draft.track.component = component;
    Vec3 middle = Vec3::Zero();
    for (const std::size_t corner : draft.corner) middle += reference_of(first, corner);
    middle /= static_cast<double>(draft.corner.size());
    for (const std::size_t corner : draft.corner) {
      draft.track.vertex.push_back(reference_of(first, corner) - middle);
    }
    for (const ResultFrame& frame : frames) add_key(draft, frame);
    tracks.push_back(std::move(draft.track));
  }
  return tracks;
}

}  // namespace sunder
