// SPDX-License-Identifier: MIT
// Which corners of two half-faces met, by the file's points.
#include "fracture/breaking/partners.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "mechanics/element/strain_displacement.hpp"

namespace sunder {
namespace {

double inradius(const VolumeMap& map, TetId t) {
  std::array<Vec3, 4> at;
  for (std::size_t corner = 0; corner < 4; ++corner) {
    const Point& p = map.point(map.corners()[t.index()][corner]);
    at[corner] = {p[0], p[1], p[2]};
  }
  double area = 0;
  for (const auto& [a, b, c] : dart_order::face_corners) {
    area += 0.5 * (at[b] - at[a]).cross(at[c] - at[a]).norm();
  }
  return 3 * std::abs(tetrahedron_volume(at)) / area;
}

}  // namespace

Partner partner_of(const VolumeMap& map, HalfFaceId face, HalfFaceId opposite) {
  const TetId a = tetrahedron_of(face), b = tetrahedron_of(opposite);
  Partner partner{.face = face,
                  .opposite = opposite,
                  .reach = 0.5 * std::min(inradius(map, a), inradius(map, b))};
  const auto point = [&](TetId t, std::size_t corner) {
    return map.point_of_vertex(map.corners()[t.index()][corner]);
  };
  for (std::size_t k = 0; k < 3; ++k) {
    const int corner = dart_order::face_corners[static_cast<std::size_t>(place_of(face))][k];
    partner.corner[k] = static_cast<std::uint8_t>(corner);
    for (std::uint8_t other = 0; other < 4; ++other) {
      if (point(b, other) == point(a, partner.corner[k])) partner.opposite_corner[k] = other;
    }
  }
  return partner;
}

void add_partners(std::vector<Partner>& partners, const VolumeMap& map,
                  std::span<const FanEvent> fans) {
  for (const FanEvent& fan : fans) {
    for (const FaceSplit& split : fan.faces) {
      if (split.did) partners.push_back(partner_of(map, split.face, split.opposite));
    }
  }
}

std::vector<Partner> partners_of_cuts(const VolumeMap& map,
                                      std::span<const std::array<HalfFaceId, 4>> sewn) {
  std::vector<Partner> partners;
  for (std::size_t t = 0; t < sewn.size(); ++t) {
    for (int p = 0; p < 4; ++p) {
      const HalfFaceId face = half_face(TetId{t}, p);
      const HalfFaceId opposite = sewn[t][static_cast<std::size_t>(p)];
      if (opposite.is_none() || opposite < face || !map.neighbour(face).is_none()) continue;
      partners.push_back(partner_of(map, face, opposite));
    }
  }
  return partners;
}

}  // namespace sunder
