// SPDX-License-Identifier: MIT
// A host program: steps a scene, prints each piece's mass and motion as it comes off, writes a
// frame.
#include <cstdio>
#include <cstdlib>
#include <sunder/fragments.hpp>
#include <sunder/frames.hpp>
#include <sunder/scene.hpp>
#include <vector>

namespace {

/// Prints the findings; true when none of them is an error.
bool is_fine(const std::vector<sunder::Finding>& findings) {
  for (const sunder::Finding& f : findings) {
    std::fprintf(stderr, "%s: %s; %s\n", f.code.c_str(), f.text.c_str(), f.remedy.c_str());
  }
  return !sunder::has_error(findings);
}

void print(const char* word, const sunder::Fragment& f) {
  std::printf("%s %u: %.17g kg at (%.4g, %.4g, %.4g) m, %.3g m/s, %.3g rad/s\n", word, f.id.value,
              f.mass, f.center[0], f.center[1], f.center[2], f.velocity.norm(), f.spin.norm());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return std::puts("usage: break SCENE.json SECONDS FRAME.vtu"), 2;
  auto file = sunder::read_scene(argv[1]);
  if (!is_fine(file.findings)) return 3;
  file->scene.duration = std::atof(argv[2]);
  auto sim = sunder::build_simulation(file->scene);
  if (!is_fine(sim.findings)) return 3;
  for (const sunder::Fragment& body : sunder::fragments(*sim)) print("body", body);

  const auto steps = sunder::step_count(sim->scene);
  while (sunder::steps_taken(*sim) < steps) {
    const sunder::StepReport step = sunder::advance(*sim);
    for (const sunder::ComponentId id : step.new_components) {
      std::printf("%.6f s, off %u: ", step.time, sunder::fragment(*sim, id).parent.value);
      print("piece", sunder::fragment(*sim, id));
    }
    if (step.status.outcome != sunder::StepOutcome::fine) {
      return is_fine({sunder::to_finding(step.status)}) ? 0 : 5;
    }
  }

  double mass = 0;
  const auto pieces = sunder::fragments(*sim);
  for (const sunder::Fragment& piece : pieces) mass += piece.mass;
  std::printf("end: %zu pieces of %.17g kg\n", pieces.size(), mass);
  return is_fine(sunder::write_frame(argv[3], *sim)) ? 0 : 4;
}
