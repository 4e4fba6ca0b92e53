// SPDX-License-Identifier: MIT
// The equation of an implicit Euler step as a root to find: shared by Broyden and Newton.
#pragma once

#include <cstdint>

#include "mechanics/integrators/component_step.hpp"

namespace sunder {

/// Fields in the world, one column a vertex in the order of the component's system.
using WorldField = Eigen::Matrix3Xd;

/// F(y) = M (y - start) - h (f + f_el(x + h y)) = 0 for the velocities y at the end of the step,
/// start = v + h g. Held vertices: y is their support's, F zero.
struct EulerProblem {
  const ComponentStep& step;  ///< with a system; it needs no factor
  WorldField start;           ///< m/s
  double floor = 0;           ///< N s: the part of |F| from rounding
  std::uint32_t evaluations = 0;
};

/// Needs: `step.system`.
EulerProblem euler_problem(const ComponentStep& step);

/// F(y), N s. One evaluation of the model's forces. Overwrites rows of `scratch.predicted`.
void residual(WorldField& F, EulerProblem& problem, const WorldField& y);

/// How the component lies in `scratch.predicted.position`, body to world: its support's turn, or
/// that of its rigid reference.
Mat3 predicted_turn(const ComponentStep& step);

/// y <- y - B^-1 F for the body-frame matrix of the present factor, over free vertices; `F` becomes
/// that step. R: body to world.
void factor_step(WorldField& F, const ComponentStep& step, const Mat3& R);

/// |F| at which iterations may end: the tolerance times where they began, or rounding.
double good_enough(const EulerProblem& problem, double first);

/// Whether a root is the step and not another solution of its equation. The equation asks that
/// |M^(1/2) (x + h y - x - h start)|^2 / 2 h^2 + strain energy does not change; a stiff body that
/// turns by w h meets that at the angle arctan(w h), where it is least, and half a turn on, where
/// it is greatest and the spin comes out at up to 1 / (w h) times itself. With
/// S = sum m x_end x_ahead^T it is least with regard to turns where tr(S) 1 - sym(S) is positive
/// definite. Iterations that begin far off, stiff bodies at long steps, do find the other one.
bool is_nearest_root(const EulerProblem& problem, const WorldField& y);

/// Writes the prediction: y with the momentum of the mass centre made exact at any tolerance, and x
/// + h y less `parabola_shift`.
void finish_euler(const EulerProblem& problem, WorldField& y, const SolveReport& report);

/// The step by the factor, where iterations were given up; the report says so.
void fall_back(const ComponentStep& step, SolveReport report);

}  // namespace sunder
