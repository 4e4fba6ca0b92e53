// SPDX-License-Identifier: MIT
// `falling_scene [SCENE.json] [STEP] [DURATION]`: a CSV of the outcome at steps of h, h/4, h/16,
// with and without impact windows.
#include <cstdio>
#include <cstdlib>

#include "apps/scene/scene_json.hpp"
#include "tests/experiments/cases/falling_scene.hpp"

using namespace sunder;
using namespace sunder::accuracy;

namespace {

void print_row(const Scene& scene) {
  const FallOutcome o = run_fall(scene);
  std::printf("%s,%g,%.6g,%zu,%zu,%.4f,%.2g,%zu\n", scene.impact.window ? "yes" : "no",
              scene.integrator.time_step, o.first_fan, o.fans, o.pieces, o.largest_share, o.deepest,
              o.sub_steps);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  Scene scene = falling_cube();
  if (argc > 1) {
    Result<SceneFile> file = read_scene(argv[1]);
    for (const Finding& f : file.findings) std::fprintf(stderr, "%s\n", f.text.c_str());
    if (!file) return 3;
    scene = std::move(file->scene);
  }
  if (argc > 2) scene.integrator.time_step = std::atof(argv[2]);
  if (argc > 3) scene.duration = std::atof(argv[3]);
  std::puts("window,step,first fan,fans,pieces,largest share,deepest,sub-steps");
  const double h = scene.integrator.time_step;
  for (const bool window : {true, false}) {
    scene.impact.window = window;
    for (const double part : {1.0, 4.0, 16.0}) {
      scene.integrator.time_step = h / part;
      print_row(scene);
    }
  }
}
