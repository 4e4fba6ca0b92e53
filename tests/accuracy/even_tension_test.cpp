// SPDX-License-Identifier: MIT
// Under even tension a body parts along one surface.
#include "tests/experiments/cases/even_tension.hpp"

#include <catch2/catch.hpp>

#include "topology/io/mesh_file.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::accuracy;

namespace {

Vec3 direction(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Vec3 n;
  for (double& x : n) x = 2 * suite::unit(random) - 1;
  return n.normalized();
}

}  // namespace

TEST_CASE("a crack under even, noisy tension is one surface", "[cracks]") {
  const TetMesh box = suite::jittered(suite::kuhn_box({8, 8, 8}, 0.1), 0.02, 1);
  const TetMesh bunny = *read_mesh(std::filesystem::path(SUNDER_MESHES "/bunny.msh"));
  const bool is_box = GENERATE(true, false);
  TornBody mean;
  constexpr int planes = 10;
  for (std::uint64_t seed = 1; seed <= planes; ++seed) {
    const Vec3 axis = direction(seed);
    EvenTension tension{.axis = axis, .seed = seed};
    const TornBody torn = tear(is_box ? box : bunny, tension);
    mean.raw += torn.raw / planes;
    mean.projected += torn.projected / planes;
    mean.smooth_raw += torn.smooth_raw / planes;
    CHECK(torn.two_largest > 0.95);
    CHECK(torn.debris <= 8);
    mean.debris += torn.debris;
    if (seed > 1) continue;
    tension.crack = CrackMode::paper;
    CHECK(tear(is_box ? box : bunny, tension).raw > 10);
  }
  CHECK(mean.raw < 1.75);
  CHECK(mean.smooth_raw < 1.12);  // as drawn
  CHECK(mean.projected == Approx(1).margin(0.08));
  CHECK(mean.debris <= 2 * planes);
}
