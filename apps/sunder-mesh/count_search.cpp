// SPDX-License-Identifier: GPL-3.0-or-later
// A bracketing search over sizes for a number of tetrahedra.
#include "apps/sunder-mesh/count_search.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "topology/base/assert.hpp"

namespace sunder {
namespace {

struct Sample {
  double scale = 1;
  double count = 0;
};

/// The samples next to the goal: `fine` has too many tetrahedra, `coarse` too few.
struct Bracket {
  std::optional<Sample> fine;
  std::optional<Sample> coarse;
};

double next_scale(const Bracket& bracket, const Sample& last, double goal) {
  if (!bracket.fine || !bracket.coarse) {
    // Far from the goal the cube root is right only roughly: never leap more than fourfold. Near it
    // one per cent more makes sure that the goal is passed, and so bracketed.
    const double step = std::clamp(std::cbrt(std::max(last.count, 1.0) / goal), 0.25, 4.0);
    return last.scale * step * (last.count > goal ? 1.01 : 1 / 1.01);
  }
  const double low = std::log(bracket.fine->scale);
  const double high = std::log(bracket.coarse->scale);
  const double at_low = std::log(bracket.fine->count);
  const double at_high = std::log(std::max(bracket.coarse->count, 1.0));
  const double part = (at_low - std::log(goal)) / (at_low - at_high);
  // Keeping off the ends makes the bracket shrink although the count is a staircase.
  return std::exp(low + std::clamp(part, 0.1, 0.9) * (high - low));
}

}  // namespace

Result<TetMesh> mesh_with_count(const std::function<Result<TetMesh>(double scale)>& mesh_at,
                                const CountGoal& goal,
                                const std::function<void(const CountTry&)>& report) {
  SUNDER_ASSERT(goal.tetrahedra > 0 && goal.tries > 0, "a search has a goal and a try");
  const double wanted = static_cast<double>(goal.tetrahedra);
  Result<TetMesh> best;
  Bracket bracket;
  Sample sample;
  for (int number = 1; number <= goal.tries; ++number) {
    Result<TetMesh> result = mesh_at(sample.scale);
    const std::size_t count = result ? result->tetrahedra.size() : 0;
    report({number, sample.scale, count, result ? result->points.size() : 0});
    sample.count = static_cast<double>(count);
    const bool is_nearer =
        result && (!best || std::abs(sample.count - wanted) <
                                std::abs(static_cast<double>(best->tetrahedra.size()) - wanted));
    if (is_nearer || !best) best = std::move(result);
    if (count == goal.tetrahedra) break;
    (sample.count > wanted ? bracket.fine : bracket.coarse) = sample;
    sample.scale = next_scale(bracket, sample, wanted);
    // Sizes this near differ by rounding only; so do their meshes.
    if (bracket.fine && bracket.coarse &&
        std::abs(bracket.coarse->scale / bracket.fine->scale - 1) < 1e-6) {
      break;
    }
  }
  return best;
}

}  // namespace sunder
