// SPDX-License-Identifier: MIT
// Faces against the faces they were one with.
#include "mechanics/rubble/rubble_partners.hpp"

#include <algorithm>

namespace sunder {
namespace {

struct PartnerSides {
  std::array<Vec3, 3> a, b;  ///< m, corners; k meets k
  Vec3 normal{0, 0, 1};      ///< from B to A
};

/// Twice the area out of the solid.
Vec3 area_of(const std::array<Vec3, 3>& at, const Vec3& inside) {
  const Vec3 area = (at[1] - at[0]).cross(at[2] - at[0]);
  return area.dot(at[0] - inside) < 0 ? Vec3(-area) : area;
}

PartnerSides sides_of(const FindScratch& scratch, const RubblePartner& p) {
  const Polytope &a = scratch.solids[p.shape_a], &b = scratch.solids[p.shape_b];
  PartnerSides sides;
  for (std::size_t k = 0; k < 3; ++k) {
    sides.a[k] = a.vertex[p.corner_a[k]];
    sides.b[k] = b.vertex[p.corner_b[k]];
  }
  sides.normal = (area_of(sides.b, b.centre) - area_of(sides.a, a.centre)).normalized();
  return sides;
}

bool do_face(const PartnerSides& sides, double reach) {
  double least = reach, most_slip = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 apart = sides.a[k] - sides.b[k];
    const double gap = sides.normal.dot(apart);
    least = std::min(least, gap);
    most_slip = std::max(most_slip, (apart - gap * sides.normal).norm());
  }
  return least < reach && most_slip < reach;
}

bool share_a_point(const RubblePartner& p, const RubblePartner& q) {
  return std::ranges::any_of(p.point, [&](std::uint32_t point) {
    return std::ranges::find(q.point, point) != q.point.end();
  });
}

}  // namespace

void find_facing(FindScratch& scratch, const FindInput& input) {
  scratch.facing.clear();
  for (std::uint32_t k = 0; k < input.partners.size(); ++k) {
    const RubblePartner& p = input.partners[k];
    if (!do_face(sides_of(scratch, p), p.reach)) continue;
    scratch.facing.push_back({p.shape_a, k});
    scratch.facing.push_back({p.shape_b, k});
  }
  std::sort(scratch.facing.begin(), scratch.facing.end());
}

bool touch_as_partners(const FindScratch& scratch, const FindInput& input, const RowPair& pair) {
  const auto of = [&](std::uint32_t shape) {
    return std::ranges::equal_range(scratch.facing, shape, {}, &RowPair::first);
  };
  const auto firsts = of(pair.first);
  if (firsts.empty()) return false;
  const std::uint32_t body_a = scratch.body[pair.first], body_b = scratch.body[pair.second];
  const auto between = [&](const RubblePartner& p) {
    return std::minmax(scratch.body[p.shape_a], scratch.body[p.shape_b]) ==
           std::minmax(body_a, body_b);
  };
  for (const RowPair& first : firsts) {
    const RubblePartner& p = input.partners[first.second];
    if (!between(p)) continue;
    for (const RowPair& second : of(pair.second)) {
      const RubblePartner& q = input.partners[second.second];
      if (between(q) && share_a_point(p, q)) return true;
    }
  }
  return false;
}

void add_partner_patches(std::vector<RubblePatch>& patches, const FindScratch& scratch,
                         const FindInput& input) {
  for (std::size_t row = 0; row < scratch.facing.size(); ++row) {
    const auto [shape, k] = scratch.facing[row];
    const RubblePartner& p = input.partners[k];
    if (shape != p.shape_a) continue;
    const PartnerSides sides = sides_of(scratch, p);
    Manifold m;
    m.normal = sides.normal;
    const double most = approach_of(scratch, input, {p.shape_a, p.shape_b}).along(-m.normal);
    for (std::size_t i = 0; i < 3; ++i) {
      const double gap = m.normal.dot(sides.a[i] - sides.b[i]);
      if (gap <= most) m.point[static_cast<std::size_t>(m.count++)] = {sides.a[i], sides.b[i], gap};
    }
    if (m.count > 0) patches.push_back(patch_of(input, {p.shape_a, p.shape_b}, m));
  }
}

}  // namespace sunder
