// SPDX-License-Identifier: MIT
// Which tetrahedra count as flat: the tolerance from both sides, wherever they lie and however
// large.
#include <cmath>

#include "tests/support/built.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

/// A tetrahedron of two legs of `length` (m) and a height, all exact, at x = `far`.
TetMesh leaf(double far, double length, double height) {
  TetMesh mesh = one_tetrahedron();
  mesh.points = {{far, 0, 0}, {far + length, 0, 0}, {far, length, 0}, {far, 0, height}};
  return mesh;
}

bool is_flat(const TetMesh& mesh) {
  const std::vector<std::string> found = codes(check_mesh(mesh));
  return std::ranges::find(found, "flat_tetrahedron") != found.end();
}

}  // namespace

TEST_CASE("flat is what 18 roundings of the largest coordinate can have made",
          "[topology][findings]") {
  // Six times the volume is length^2 height, and rounding makes up to 18 eps |x| length^2 of it.
  for (const double far : {0.0, 1.0, 0x1p10, -0x1p20, 0x1p30}) {
    for (const double length : {0x1p-10, 1.0, 0x1p12}) {
      INFO("at " << far << " m, length " << length << " m");
      const double largest = std::max(std::abs(far), std::abs(far + length));
      const double limit = 18 * 0x1p-52 * std::max(largest, length);
      // Powers of two on both sides of it, so that nothing is rounded.
      const double below = std::exp2(std::floor(std::log2(limit)));
      REQUIRE((far + length) - far == length);
      REQUIRE((below < limit && limit < 2 * below));
      CHECK(is_flat(leaf(far, length, below)));
      CHECK(is_flat(leaf(far, length, -below)));
      CHECK_FALSE(is_flat(leaf(far, length, 2 * below)));
      CHECK_FALSE(is_flat(leaf(far, length, -2 * below)));
    }
  }
}
