// SPDX-License-Identifier: MIT
// The sample scenes break into the same pieces on the ladder as always full, as far as their
// outcome is decided by more than rounding.
#include <algorithm>
#include <catch2/catch.hpp>
#include <tuple>

#include "apps/scene/scene_json.hpp"
#include "tests/experiments/cases/ladder_scene.hpp"

using namespace sunder;
using namespace sunder::accuracy;

namespace {

Scene sample_scene(const char* name, double duration) {
  Result<SceneFile> file = read_scene(std::string(SUNDER_MESHES "/scenes/") + name + ".json");
  REQUIRE(file);
  file->scene.duration = duration;
  return file->scene;
}

}  // namespace

TEST_CASE("the fans of the sample scenes are those of always-full dynamics", "[ladder][scenes]") {
  // The bunny shatters within a few sub-steps; from its 151st fan on pieces that touch at a vertex
  // make rounding decide: a start moved by 1e-12 parts there too.
  constexpr std::size_t all = 1000000;
  const auto [name, duration, leading] =
      GENERATE_COPY(std::tuple{"block", 2.0, all}, std::tuple{"bunny", 0.0204, std::size_t{150}},
                    std::tuple{"monolith", 0.1, all});
  const Scene scene = sample_scene(name, duration);
  const LadderOutcome full = run_on_ladder(always_full(scene));
  const LadderOutcome ladder = run_on_ladder(scene);
  CAPTURE(name, full.fans.size(), ladder.fans.size());
  CHECK(full.fans.size() >= 40);
  CHECK(same_fans(ladder, full) >= std::min(leading, full.fans.size()));
  if (leading == all) CHECK(ladder.fans.size() == full.fans.size());
  const auto full_rung = static_cast<std::size_t>(Rung::full);
  // The slab lies on its supports while gravity grows: nothing of it flies or rests.
  if (scene.name != "block") CHECK(ladder.tetrahedra[full_rung] < full.tetrahedra[full_rung]);
}
