// SPDX-License-Identifier: MIT
// `ladder_scene SCENE.json...`: for each scene the fans, the time and the rungs on the ladder,
// always full, and always full from a start moved by 1e-12; as a CSV.
#include <cstdio>

#include "apps/scene/scene_json.hpp"
#include "tests/experiments/cases/ladder_scene.hpp"

using namespace sunder;
using namespace sunder::accuracy;

namespace {

void print_row(const Scene& scene, const char* run, const LadderOutcome& o,
               const LadderOutcome& full) {
  const std::size_t same = same_fans(o, full);
  std::printf("%s,%s,%zu,%zu,%zu,", scene.name.c_str(), run, o.fans.size(), o.pieces, same);
  if (same < std::min(o.fans.size(), full.fans.size())) {
    std::printf("%.6g", std::min(o.time[same], full.time[same]));
  }
  std::printf(",%.0f,%.2f", o.ms, o.ms / full.ms);
  for (const std::size_t steps : o.tetrahedra) std::printf(",%zu", steps);
  std::puts("");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  std::puts(
      "scene,run,fans,pieces,same as full,first difference,ms,of "
      "full,full,quasi-static,rigid,asleep");
  for (int i = 1; i < argc; ++i) {
    const Result<SceneFile> file = read_scene(argv[i]);
    for (const Finding& f : file.findings) std::fprintf(stderr, "%s\n", f.text.c_str());
    if (!file) return 3;
    const Scene& scene = file->scene;
    const LadderOutcome full = run_on_ladder(always_full(scene));
    print_row(scene, "always full", full, full);
    print_row(scene, "ladder", run_on_ladder(scene), full);
    print_row(scene, "moved by 1e-12", run_on_ladder(moved_by_nothing(always_full(scene))), full);
  }
}
