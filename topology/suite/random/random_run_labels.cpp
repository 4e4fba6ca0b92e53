// SPDX-License-Identifier: MIT
// Random labels, which need not be any plane's.
#include "topology/suite/random/random_run_labels.hpp"

#include <array>
#include <cmath>

#include "topology/base/point_math.hpp"
#include "topology/suite/fixtures/shapes.hpp"

namespace sunder::suite {
namespace {

Point center_of(const TetMesh& body, std::size_t t) {
  Point center = {0, 0, 0};
  for (const std::uint32_t p : body.tetrahedra[t]) {
    for (std::size_t i = 0; i < 3; ++i) center[i] += body.points[p][i] / 4;
  }
  return center;
}

CrackSide side_if(bool positive) { return positive ? CrackSide::positive : CrackSide::negative; }

/// By a plane through the centre of a tetrahedron.
void label_by_plane(const TetMesh& body, std::mt19937_64& random, CrackSides& sides) {
  const Point at = center_of(body, below(random, sides.size()));
  Point normal;
  for (double& x : normal) x = 2 * unit(random) - 1;
  for (std::size_t t = 0; t < sides.size(); ++t) {
    const Point center = center_of(body, t);
    double distance = 0;
    for (std::size_t i = 0; i < 3; ++i) distance += normal[i] * (center[i] - at[i]);
    sides[t] = side_if(distance >= 0);
  }
}

/// By the cubes that a lattice of any width puts the centres in.
void label_like_a_board(const TetMesh& body, std::mt19937_64& random, CrackSides& sides) {
  const Point from = center_of(body, 0), to = center_of(body, below(random, sides.size()));
  const double reach = detail::distance(from, to);
  const double width = reach > 0 ? reach / static_cast<double>(1 + below(random, 4)) : 1;
  for (std::size_t t = 0; t < sides.size(); ++t) {
    double cubes = 0;
    for (const double x : center_of(body, t)) cubes += std::floor(x / width);
    sides[t] = side_if(std::fmod(cubes, 2) == 0);
  }
}

/// A region that grows over glued faces, up to half of the tetrahedra, against all others.
void label_by_growing(const GlueTwin& now, std::mt19937_64& random, CrackSides& sides) {
  sides.assign(sides.size(), CrackSide::negative);
  std::vector<std::size_t> grown = {below(random, sides.size())};
  sides[grown[0]] = CrackSide::positive;
  const std::size_t most = 1 + below(random, 1 + sides.size() / 2);
  for (std::size_t tries = 0; grown.size() < most && tries < 8 * most; ++tries) {
    const std::size_t from = grown[below(random, grown.size())];
    const HalfFaceId across = now.glued[4 * from + below(random, 4)];
    if (across.is_none() || sides[across.index() / 4] == CrackSide::positive) continue;
    sides[across.index() / 4] = CrackSide::positive;
    grown.push_back(across.index() / 4);
  }
}

/// A point of a face across which the sides differ, if one is met in a few draws; else any point
/// that a tetrahedron has.
std::uint32_t any_point(const GlueTwin& now, const CrackSides& sides, std::mt19937_64& random) {
  std::size_t face = below(random, now.glued.size());
  for (int tries = 0; tries < 20; ++tries) {
    const HalfFaceId across = now.glued[face];
    if (!across.is_none() && sides[face / 4] != sides[across.index() / 4]) break;
    face = below(random, now.glued.size());
  }
  return now.tetrahedra[face / 4][(face + 1 + below(random, 3)) % 4];
}

}  // namespace

CrackSides any_labels(const TetMesh& body, const GlueTwin& now, std::mt19937_64& random) {
  CrackSides sides(body.tetrahedra.size());
  switch (below(random, 4)) {
    case 0:
      label_by_plane(body, random, sides);
      break;
    case 1:
      for (CrackSide& side : sides) side = side_if(below(random, 2) == 0);
      break;
    case 2:
      label_like_a_board(body, random, sides);
      break;
    default:
      label_by_growing(now, random, sides);
  }
  if (below(random, 3) == 0) {
    for (CrackSide& side : sides) side = below(random, 6) == 0 ? CrackSide::none : side;
  }
  return sides;
}

std::vector<BreakPoint> any_breaks(const TetMesh& body, const GlueTwin& now,
                                   std::mt19937_64& random) {
  std::vector<CrackSides> cracks(1 + below(random, 3));
  for (CrackSides& sides : cracks) sides = any_labels(body, now, random);
  std::vector<BreakPoint> breaks;
  for (std::size_t left = 1 + below(random, 12); left > 0; --left) {
    if (!breaks.empty() && below(random, 10) == 0) {
      breaks.push_back(breaks[below(random, breaks.size())]);
      continue;
    }
    const CrackSides& sides = cracks[below(random, cracks.size())];
    breaks.push_back({any_point(now, sides, random), sides});
  }
  return breaks;
}

}  // namespace sunder::suite
