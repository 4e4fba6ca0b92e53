// SPDX-License-Identifier: MIT
// Broyden's method with limited memory on the equation of implicit Euler.
#include "mechanics/baselines/broyden.hpp"

#include "mechanics/baselines/euler_problem.hpp"
#include "mechanics/frame/rigid_reference.hpp"
#include "mechanics/integrators/baseline_system.hpp"

namespace sunder {
namespace {

/// The steps since the method last began.
struct Updates {
  std::vector<WorldField>& steps;
  std::size_t count = 0;

  void clear() { count = 0; }
  void push(const WorldField& s) {
    if (steps.size() == count) steps.emplace_back();
    steps[count++] = s;
  }
};

double dot(const WorldField& a, const WorldField& b) { return a.cwiseProduct(b).sum(); }

/// z = -B0^-1 F becomes the step -B^-1 F. False where the update has no inverse.
bool apply_updates(WorldField& z, const Updates& updates) {
  for (std::size_t j = 0; j + 1 < updates.count; ++j) {
    const WorldField& s = updates.steps[j];
    z += updates.steps[j + 1] * (dot(s, z) / s.squaredNorm());
  }
  if (updates.count == 0) return true;
  const WorldField& last = updates.steps[updates.count - 1];
  const double left = 1 - dot(last, z) / last.squaredNorm();
  if (!(std::abs(left) > 1e-8)) return false;
  z /= left;
  return true;
}

/// z = -B0^-1 F, in place.
void first_guess(WorldField& z, const ComponentStep& step, const Mat3& R) {
  if (step.input.settings.broyden_start == BroydenStart::factor) return factor_step(z, step, R);
  z = -(z * step.system->shape.mass.cwiseInverse().asDiagonal());
}

}  // namespace

void step_broyden(const ComponentStep& step) {
  constexpr double hopeless = 1e12;
  const IntegratorSettings& settings = step.input.settings;
  EulerProblem problem = euler_problem(step);
  WorldField y = problem.start, F;
  residual(F, problem, y);
  // The factor is turned as the body will be.
  const Mat3 R = predicted_turn(step);
  const double first = F.norm(), target = good_enough(problem, first);
  Updates updates{baseline_of(step).updates};
  SolveReport report;
  WorldField z;
  while (!(F.norm() <= target)) {
    report.force_evaluations = problem.evaluations;
    const bool going = F.norm() <= hopeless * first;
    if (!going || report.iterations >= settings.max_iterations) return fall_back(step, report);
    if (updates.count >= settings.broyden_memory) updates.clear();
    z = F;
    first_guess(z, step, R);
    if (!apply_updates(z, updates)) {
      updates.clear();
      z = F;
      first_guess(z, step, R);
    }
    updates.push(z);
    y += z;
    residual(F, problem, y);
    ++report.iterations;
  }
  report.force_evaluations = problem.evaluations;
  if (!is_nearest_root(problem, y)) return fall_back(step, report);
  finish_euler(problem, y, report);
}

}  // namespace sunder
