// SPDX-License-Identifier: MIT
// The union over breaks, face by face.
#include "topology/suite/judge/crack_formula.hpp"

#include <algorithm>

namespace sunder::suite {
namespace {

bool opposite(CrackSide a, CrackSide b) {
  return a != b && a != CrackSide::none && b != CrackSide::none;
}

}  // namespace

std::set<HalfFaceId> crack_faces(const GlueTwin& now, std::span<const BreakPoint> breaks) {
  std::set<HalfFaceId> faces;
  for (const BreakPoint& b : breaks) {
    for (const std::uint32_t t : now.around[b.point]) {
      for (std::uint32_t p = 0; p < 4; ++p) {
        const HalfFaceId face{4 * t + p}, across = now.glued[face.index()];
        if (across.is_none() || now.tetrahedra[t][p] == b.point) continue;
        if (opposite(b.sides[t], b.sides[across.index() / 4])) faces.insert(std::min(face, across));
      }
    }
  }
  return faces;
}

GlueTwin without_faces(GlueTwin twin, const std::set<HalfFaceId>& faces) {
  for (const HalfFaceId face : faces) {
    const HalfFaceId across = twin.glued[face.index()];
    twin.glued[face.index()] = twin.glued[across.index()] = HalfFaceId::none();
  }
  return twin;
}

}  // namespace sunder::suite
