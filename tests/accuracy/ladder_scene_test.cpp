// SPDX-License-Identifier: MIT
// The sample scenes break into the same pieces on the ladder as always full, as far as their
// outcome is decided by more than rounding.
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
  // The bunny breaks within a few sub-steps, and rounding decides from some fan on: a start moved
  // by 1e-12 changes it. `least` fans come before that.
  const auto [name, duration, least] = GENERATE(
      std::tuple{"paper/block", 2.0, std::size_t{30}}, std::tuple{"bunny", 0.005, std::size_t{90}},
      std::tuple{"charts/monolith", 0.1, std::size_t{40}});
  const Scene scene = sample_scene(name, duration);
  const LadderOutcome full = run_on_ladder(always_full(scene));
  const LadderOutcome ladder = run_on_ladder(scene);
  const LadderOutcome moved = run_on_ladder(moved_by_nothing(always_full(scene)));
  const std::size_t decided = same_fans(moved, full);
  CAPTURE(name, full.fans.size(), ladder.fans.size());
  CHECK(decided >= least);
  CHECK(same_fans(ladder, full) >= least);
  // Flying pieces lose vibrations of 1e-7 on the ladder: more than rounding, and some late fans.
  const auto fans = static_cast<double>(full.fans.size());
  if (decided == full.fans.size()) CHECK(ladder.fans.size() == Approx(fans).epsilon(0.03));
  const auto full_rung = static_cast<std::size_t>(Rung::full);
  // The slab lies on its supports while gravity grows: nothing of it flies or rests.
  if (scene.name != "block") CHECK(ladder.tetrahedra[full_rung] < full.tetrahedra[full_rung]);
}
