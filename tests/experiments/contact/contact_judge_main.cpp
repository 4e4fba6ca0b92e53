// SPDX-License-Identifier: MIT
// `contact_judge FOLDER...`: overlaps and crossings in the frames of `sunder run`.
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "apps/sunder/export/result_frames.hpp"
#include "tests/experiments/contact/contact_judge.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

constexpr const char* usage = R"(usage: contact_judge [--tolerance SHARE] [--frames] FOLDER...
Judges folders of `sunder run` by their frames alone:
  overlap   the deepest overlap of tetrahedra of different pieces, and of tetrahedra with obstacles,
            by all separating axes
  crossing  pairs that overlap between two frames or in the second, and not in the first, deeper
            than SHARE of the mean edge (0.02). Corners go evenly from frame to frame. `passed`:
            apart again in the second. None twice as deep is missed.
The number of a body is that of its piece in the first frame. --frames prints every frame.
Frames should be close in time: --frame-interval of one step.
Exit codes: 0 nothing crossed, 1 something crossed, 2 usage, 3 no result.
)";

ContactFrame frame_of(const ResultFrame& result) {
  ContactFrame frame{result.position, result.tetrahedra, {}, result.obstacles};
  for (const std::int64_t c : result.component)
    frame.piece.push_back(static_cast<std::uint32_t>(c));
  return frame;
}

std::string name_of(const DeepestPair& pair, const ContactFrame& first, const ContactFrame& now) {
  const auto tetrahedron = [&](std::uint32_t t) {
    return "body " + std::to_string(first.piece[t]) + " piece " + std::to_string(now.piece[t]) +
           " tetrahedron " + std::to_string(t);
  };
  if (pair.a == DeepestPair::none) return "none";
  return tetrahedron(pair.a) + " and " +
         (pair.obstacle != DeepestPair::none ? "obstacle " + std::to_string(pair.obstacle)
                                             : tetrahedron(pair.b));
}

void print_overlap(const char* what, const DeepestPair& pair, double time, double edge,
                   const std::string& names) {
  std::printf("  %-22s %.4g m, %.3g of the mean edge, at %.6g s: %s\n", what, pair.depth,
              pair.depth / edge, time, names.c_str());
}

/// Whether something crossed.
bool judge(const RunResult& run, double share, bool prints_frames) {
  const ContactFrame first = frame_of(run.frames.front());
  const double edge = mean_edge(first);
  std::printf("  %zu frames, %zu tetrahedra, mean edge %.4g m\n", run.frames.size(),
              first.tetrahedra.size(), edge);
  struct Worst {
    DeepestPair pair;
    double time = 0;
    std::string names = "none";
  } pieces, obstacles;
  double mean = 0;
  bool crossed = false;
  ContactFrame before = first;
  for (std::size_t k = 0; k < run.frames.size(); ++k) {
    const ContactFrame now = frame_of(run.frames[k]);
    const double time = run.frames[k].time;
    const FrameOverlaps seen = judge_overlaps(now, edge);
    mean = std::max(mean, seen.mean);
    const auto take = [&](Worst& worst, const DeepestPair& pair) {
      if (pair.depth > worst.pair.depth) worst = {pair, time, name_of(pair, first, now)};
    };
    take(pieces, seen.pieces);
    take(obstacles, seen.obstacles);
    if (prints_frames) {
      std::printf("  frame %zu, %.6g s: %zu pairs, deepest %.4g m, mean %.4g m, obstacles %.4g m\n",
                  k, time, seen.pairs, seen.pieces.depth, seen.mean, seen.obstacles.depth);
    }
    if (k == 0) continue;
    for (const Crossing& c : judge_crossings(before, now, share * edge)) {
      crossed = true;
      std::printf("  crossing, %s: frames %zu and %zu, %.4g m deep at %.3g of the way: %s\n",
                  c.passed ? "passed" : "went in", k - 1, k, c.deepest.depth, c.deepest.time,
                  name_of(c.deepest, first, now).c_str());
    }
    before = now;
  }
  print_overlap("deepest of pieces:", pieces.pair, pieces.time, edge, pieces.names);
  std::printf("  %-22s %.4g m, %.3g of the mean edge\n", "largest mean of pairs:", mean,
              mean / edge);
  print_overlap("deepest of obstacles:", obstacles.pair, obstacles.time, edge, obstacles.names);
  std::printf("  %s\n", crossed ? "something crossed" : "nothing crossed");
  return crossed;
}

}  // namespace

int main(int argc, char** argv) {
  double share = 0.02;
  bool prints_frames = false, crossed = false;
  std::vector<std::string> folders;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == "--frames") {
      prints_frames = true;
    } else if (word == "--tolerance" && i + 1 < argc) {
      share = std::atof(argv[++i]);
    } else {
      folders.emplace_back(word);
    }
  }
  if (folders.empty() || folders.front().starts_with("-") || !(share > 0)) {
    std::fputs(usage, stderr);
    return 2;
  }
  for (const std::string& folder : folders) {
    std::printf("%s\n", folder.c_str());
    const Result<RunResult> run = read_run_result(folder);
    for (const Finding& f : run.findings) std::fprintf(stderr, "%s\n", f.text.c_str());
    if (!run) return 3;
    crossed = judge(*run, share, prints_frames) || crossed;
  }
  return crossed ? 1 : 0;
}
