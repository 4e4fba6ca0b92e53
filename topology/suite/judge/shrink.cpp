// SPDX-License-Identifier: MIT
// Dropping steps and tetrahedra in ever smaller chunks.
#include "topology/suite/judge/shrink.hpp"

#include <algorithm>
#include <limits>

namespace sunder::suite {
namespace {

constexpr std::uint32_t gone = std::numeric_limits<std::uint32_t>::max();

/// The run without the tetrahedra of rows [begin, end), and without the steps that name them.
StepsOnBody without_tetrahedra(const StepsOnBody& run, std::size_t begin, std::size_t end) {
  StepsOnBody rest{{.points = run.body.points, .tetrahedra = {}}, {}};
  const auto row = [begin, end](std::uint32_t t) {
    if (t < begin) return t;
    return t < end ? gone : static_cast<std::uint32_t>(t - (end - begin));
  };
  for (std::size_t t = 0; t < run.body.tetrahedra.size(); ++t) {
    if (t < begin || t >= end) rest.body.tetrahedra.push_back(run.body.tetrahedra[t]);
  }
  for (Step step : run.steps) {
    step.a.tetrahedron = row(step.a.tetrahedron);
    if (step.kind == Step::Kind::glue) step.b.tetrahedron = row(step.b.tetrahedron);
    if (step.a.tetrahedron != gone && step.b.tetrahedron != gone) rest.steps.push_back(step);
  }
  return rest;
}

StepsOnBody without_steps(const StepsOnBody& run, std::size_t begin, std::size_t end) {
  StepsOnBody rest = run;
  rest.steps.erase(rest.steps.begin() + static_cast<std::ptrdiff_t>(begin),
                   rest.steps.begin() + static_cast<std::ptrdiff_t>(end));
  return rest;
}

/// The run with only the points that tetrahedra have, in their order.
StepsOnBody without_unused_points(StepsOnBody run) {
  std::vector<std::uint32_t> row(run.body.points.size(), gone);
  for (const auto& t : run.body.tetrahedra) {
    for (const std::uint32_t p : t) row[p] = 0;
  }
  std::vector<Point> points;
  for (std::size_t p = 0; p < row.size(); ++p) {
    if (row[p] == gone) continue;
    row[p] = static_cast<std::uint32_t>(points.size());
    points.push_back(run.body.points[p]);
  }
  run.body.points = std::move(points);
  for (auto& t : run.body.tetrahedra) {
    for (std::uint32_t& p : t) p = row[p];
  }
  for (Step& step : run.steps) {
    step.a.opposite = row[step.a.opposite];
    if (step.kind == Step::Kind::glue) step.b.opposite = row[step.b.opposite];
  }
  return run;
}

struct Shrinking {
  StepsOnBody run;
  const Fails& fails;
  std::size_t work_left;

  /// Takes a candidate when it fails, too.
  bool take(StepsOnBody candidate) {
    const std::size_t steps = candidate.steps.size();
    const std::size_t looks = 1 + std::min<std::size_t>(steps, 64);
    const std::size_t work = looks * candidate.body.tetrahedra.size() + 16 * steps + 16;
    if (work > work_left) return false;
    work_left -= work;
    if (!fails(candidate.body, candidate.steps)) return false;
    run = std::move(candidate);
    return true;
  }

  /// Drops chunks of the items counted by `size`; returns whether any could be dropped.
  template <class Size, class Without>
  bool drop_chunks(const Size& size, const Without& without) {
    bool dropped = false;
    for (std::size_t chunk = std::max<std::size_t>(1, size(run) / 2);; chunk = (chunk + 1) / 2) {
      // From the end: later steps and tetrahedra rarely matter to earlier ones.
      for (std::size_t end = size(run); end > 0;) {
        const std::size_t begin = end > chunk ? end - chunk : 0;
        dropped |= take(without(run, begin, end));
        end = std::min(begin, size(run));
      }
      if (chunk == 1) return dropped;
    }
  }

  bool drop_steps() {
    return drop_chunks([](const StepsOnBody& r) { return r.steps.size(); }, without_steps);
  }
  bool drop_tetrahedra() {
    return drop_chunks([](const StepsOnBody& r) { return r.body.tetrahedra.size(); },
                       without_tetrahedra);
  }
};

}  // namespace

StepsOnBody shrink(const TetMesh& body, std::span<const Step> steps, const Fails& fails,
                   const ShrinkLimits& limits) {
  Shrinking shrinking{{body, {steps.begin(), steps.end()}}, fails, limits.work};
  // Until nothing goes: a step may be droppable only after another one, or a tetrahedron, is gone.
  while (shrinking.drop_steps()) continue;
  while (limits.body && shrinking.drop_tetrahedra()) {
    while (shrinking.drop_steps()) continue;
  }
  if (limits.body) shrinking.take(without_unused_points(shrinking.run));
  return std::move(shrinking.run);
}

}  // namespace sunder::suite
