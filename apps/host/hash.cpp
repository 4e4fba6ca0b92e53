// SPDX-License-Identifier: MIT
// Steps a scene through the C functions and prints its outcome, as apps/page/hash.mjs does by
// WebAssembly: sunder_host_hash SCENE.json STEPS
#include <chrono>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>

#include "apps/host/sunder.h"

int main(int count, char** arguments) {
  if (count != 3) return std::fprintf(stderr, "usage: sunder_host_hash SCENE.json STEPS\n"), 2;
  sunder_engine* engine = sunder_open(arguments[1], nullptr, 0);
  if (engine == nullptr) return std::fprintf(stderr, "%s", sunder_error(nullptr)), 4;
  const int steps = std::atoi(arguments[2]);
  sunder_report report{};
  report.size = sizeof report;
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < steps && sunder_step(engine, &report) == 0; ++i) {
  }
  const std::chrono::duration<double, std::milli> ms = std::chrono::steady_clock::now() - start;
  std::uint64_t state = 0;
  sunder_hash(engine, &state);
  std::printf("step %" PRIu64 " fans %" PRIu64 " pieces %" PRIu32 " state %016" PRIx64 "\n",
              report.step, report.fans_total, report.pieces, state);
  std::fprintf(stderr, "%.3f ms a step\n", ms.count() / steps);
  sunder_destroy(engine);
}
