// SPDX-License-Identifier: MIT
// Bodies cut in two by hand, with the faces that were one as partners, for tests.
#pragma once

#include <algorithm>
#include <vector>

#include "mechanics/contact/shapes/partner.hpp"
#include "tests/mechanics/contact/contact_scene.hpp"
#include "topology/kernel/kernel.hpp"

namespace sunder::test {

inline constexpr double degree = 3.14159265358979323846 / 180;

/// The faces between tetrahedra on different sides, as partners; corners meet by equal rows.
inline std::vector<Partner> partners_between(std::span<const Corners> corners,
                                             const std::vector<bool>& upper, double reach) {
  std::vector<Partner> partners;
  for (std::size_t a = 0; a < corners.size(); ++a) {
    for (std::size_t b = 0; b < corners.size(); ++b) {
      if (!upper[a] || upper[b]) continue;
      for (int p = 0; p < 4; ++p) {
        Partner partner{.reach = reach};
        int met = 0, left = 6;
        for (std::size_t k = 0; k < 3; ++k) {
          const int corner = dart_order::face_corners[static_cast<std::size_t>(p)][k];
          partner.corner[k] = static_cast<std::uint8_t>(corner);
          const auto at = std::ranges::find(corners[b], corners[a][partner.corner[k]]);
          if (at == corners[b].end()) continue;
          partner.opposite_corner[k] = static_cast<std::uint8_t>(at - corners[b].begin());
          left -= partner.opposite_corner[k];
          ++met;
        }
        if (met < 3) continue;
        partner.face = half_face(TetId{a}, p);
        partner.opposite = half_face(TetId{b}, left);
        partners.push_back(partner);
      }
    }
  }
  return partners;
}

/// Gives the upper side vertices of its own. `separate`: and a component.
inline void part(MechanicsState& state, Body& body, const std::vector<bool>& upper, bool separate,
                 MechanicsScratch& scratch) {
  std::vector<bool> below(state.vertices.size(), false);
  for (std::size_t t = 0; t < body.corners.size(); ++t) {
    if (upper[t]) continue;
    for (const VertexId v : body.corners[t]) below[v.index()] = true;
  }
  std::vector<VertexId> copy(below.size());
  for (std::size_t t = 0; t < body.corners.size(); ++t) {
    if (!upper[t]) continue;
    if (separate) state.elements.component[t] = ComponentId{1};
    for (VertexId& v : body.corners[t]) {
      if (!below[v.index()]) continue;
      if (copy[v.index()].is_none()) copy[v.index()] = append_copy(state.vertices, v);
      v = copy[v.index()];
    }
  }
  std::vector<ComponentId> touched = {ComponentId{0}};
  if (separate) touched.emplace_back(std::size_t{1});
  rebuild(state, body.corners, touched, scratch);
}

/// Which tetrahedra of a block lie above the surface that cells were cut along.
inline std::vector<bool> above(const Body& body) {
  std::vector<bool> upper;
  for (const Corners& t : body.corners) {
    double z = 0;
    for (const VertexId v : t) z += body.rest[v.index()].z();
    upper.push_back(z > 0);
  }
  return upper;
}

}  // namespace sunder::test
