// SPDX-License-Identifier: MIT
// Judges the kernel, with the fault that SUNDER_FAULT names, on the fixtures of a folder, smallest
// first, until one kills it.
#include <algorithm>
#include <cstdio>

#include "topology/suite/fixtures/fixture.hpp"
#include "topology/suite/judge/judge.hpp"

int main(int argc, char** argv) {
  using namespace sunder::suite;
  if (argc != 2) return std::fputs("usage: sunder_mutant FIXTURES\n", stderr), 2;
  sunder::Result<std::vector<Fixture>> fixtures = read_fixture_folder(argv[1]);
  if (!fixtures) return std::fputs("sunder_mutant: the fixtures cannot be read\n", stderr), 3;
  std::stable_sort(fixtures->begin(), fixtures->end(), [](const Fixture& a, const Fixture& b) {
    return a.body.tetrahedra.size() < b.body.tetrahedra.size();
  });
  JudgedKernel kernel = volume_map_kernel();
  for (const Fixture& fixture : *fixtures) {
    // Before the fixture is run: a fault may end the process or never come back.
    std::printf("%s\n", fixture.name.c_str());
    std::fflush(stdout);
    const Verdict verdict = judge(fixture, truth_of(fixture), kernel, false);
    if (!verdict.mismatch) continue;
    const Mismatch& m = *verdict.mismatch;
    std::printf("killed: %s: %s, not %s\n", m.what.c_str(), m.answered.c_str(), m.expected.c_str());
    return 1;
  }
  return 0;
}
