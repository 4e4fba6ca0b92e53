// SPDX-License-Identifier: MIT
// `rubble_judge [--floor Z] FRAME.vtu...`: an outside judge's findings for frames of `sunder run`.
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "tests/experiments/rubble/frame_judge.hpp"

using namespace sunder;
using namespace sunder::test;

int main(int argc, char** argv) {
  double floor = 0;
  int first = 1;
  if (argc > 2 && std::string_view(argv[1]) == "--floor") {
    floor = std::atof(argv[2]);
    first = 3;
  }
  if (first >= argc) {
    std::fputs("usage: rubble_judge [--floor Z] FRAME.vtu...\n", stderr);
    return 2;
  }
  std::puts(
      "frame,pieces,mean edge mm,pairs that overlap,deepest %,mean %,below the floor,lowest %,"
      "through the floor,fastest m/s,kinetic/density,P/density,L/density,tetrahedra that overlap "
      "most");
  for (int i = first; i < argc; ++i) {
    const Result<JudgedFrame> frame = read_judged_frame(argv[i]);
    for (const Finding& f : frame.findings) std::fprintf(stderr, "%s\n", f.text.c_str());
    if (!frame) return 3;
    const Verdict v = judge_frame(*frame, floor);
    const SeenOverlaps& o = v.overlaps;
    const double percent = 100 / o.edge;
    std::printf(
        "%s,%zu,%.4g,%zu,%.3g,%.3g,%zu,%.3g,%zu,%.3g,%.4g,%.4g %.4g %.4g,%.4g %.4g %.4g,%u %u\n",
        argv[i], v.pieces, 1e3 * o.edge, o.pairs, percent * o.deepest, percent * o.mean, v.below,
        percent * v.lowest, v.through, v.fastest, v.kinetic, v.momentum[0], v.momentum[1],
        v.momentum[2], v.angular[0], v.angular[1], v.angular[2], o.where[0], o.where[1]);
  }
}
