// SPDX-License-Identifier: MIT
// `worst_steps SCENE.json STEP DURATION [THREADS]`: the dearest steps of a run with their counts,
// as a CSV.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <vector>

#include "apps/scene/scene_json.hpp"
#include "fracture/simulation/simulation_state.hpp"

using namespace sunder;

namespace {

/// One step as it is printed.
struct Row {
  double ms = 0;
  std::uint64_t step = 0;
  std::size_t fans = 0, vertices = 0, pieces = 0;
  std::uint32_t contacts = 0, sub_steps = 0;
};

Row row_of(const StepReport& report) {
  Row row{std::accumulate(report.stage_ms.begin(), report.stage_ms.end(), 0.0), report.step};
  row.fans = report.fracture.fans.size();
  for (const FanEvent& fan : report.fracture.fans) {
    for (const FaceSplit& split : fan.faces) {
      row.vertices += static_cast<std::size_t>(split.vertex_count);
    }
  }
  row.pieces = report.components;
  row.contacts = report.contact.candidates;
  row.sub_steps = report.impact.sub_steps;
  return row;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4 && argc != 5) {
    std::fputs("usage: worst_steps SCENE.json STEP DURATION [THREADS]\n", stderr);
    return 2;
  }
  Result<SceneFile> file = read_scene(argv[1]);
  for (const Finding& f : file.findings) std::fprintf(stderr, "%s\n", f.text.c_str());
  if (!file) return 3;
  file->scene.integrator.time_step = std::atof(argv[2]);
  file->scene.duration = std::atof(argv[3]);
  const double duration = file->scene.duration;
  Result<Simulation> sim = build_simulation(std::move(file->scene));
  for (const Finding& f : sim.findings) std::fprintf(stderr, "%s\n", f.text.c_str());
  if (!sim) return 3;
  if (argc == 5) sim->threads = static_cast<unsigned>(std::atoi(argv[4]));
  std::vector<Row> rows;
  while (sim->state->mechanics.time < duration * (1 - 1e-9)) {
    const StepReport report = advance(*sim);
    if (report.status.outcome != StepOutcome::fine) return 5;
    rows.push_back(row_of(report));
  }
  std::ranges::sort(rows, std::greater{}, &Row::ms);
  std::puts("ms,step,fans,vertices split,pieces,contacts,sub-steps");
  for (std::size_t i = 0; i < std::min<std::size_t>(rows.size(), 20); ++i) {
    const Row& r = rows[i];
    std::printf("%.1f,%llu,%zu,%zu,%zu,%u,%u\n", r.ms, static_cast<unsigned long long>(r.step),
                r.fans, r.vertices, r.pieces, r.contacts, r.sub_steps);
  }
}
