// SPDX-License-Identifier: MIT
// Selective mass scaling: few bad cells do not set the step of all others.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "mechanics/state/step_input.hpp"

namespace sunder {

struct WaveBodies;
struct WaveBody;
struct WaveNodes;

/// Cells of one body that share nodes. The other cells allow a far longer step than they do. Their
/// nodes respond with M' = M + sum a_e K_e over these cells, in place of M, with a_e = (h^2 + 2 h
/// b_e) / 4, h the step and b_e the viscosity of a cell. So h^2 K_e + 2 h C_e of each is within 4
/// M', and the stable step is that of the other cells. K_e gives no force to rigid motions: momenta
/// do not change, and smooth motions hardly do [Olovsson, Simonsson and Unosson 2005, Int. J.
/// Numer. Meth. Engng 63, 1436-1445]. With central differences it is the trapezoidal rule for these
/// cells alone.
struct ScaledCells {
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  std::size_t body = 0;             ///< row of `WaveBodies::bodies`
  std::vector<std::uint32_t> node;  ///< rows of `WaveNodes`
  std::vector<TetId> cell;
  std::vector<double> viscosity;  ///< s, row = cell
  Eigen::MatrixXd response;       ///< 1/kg, body frame: M'^-1; 0 for motions that supports hold
  bool is_free = true;            ///< no node is held
  std::vector<double> key;        ///< the numbers that give `response`
  /// Where the last kick found them: R of the body, mass centre (m), inverse inertia (1/(kg m^2)).
  Mat3 R = Mat3::Identity();
  Vec3 centre = Vec3::Zero();
  Mat3 inverse_inertia = Mat3::Zero();
  std::vector<Vec3> before;  ///< m/s: velocities before the last kick
  std::vector<Vec3> force;   ///< N s: impulses of the last kick
  std::vector<Vec3> given;   ///< N s: impulses at each node since then (`push_node`)
  std::vector<Vec3> change;  ///< m/s: scratch
  Eigen::VectorXd own;       ///< likewise, body frame
};

/// Chooses the cells that are scaled, and takes them out of `WaveNodes::stiffness`. All other nodes
/// allow the step aimed at: 96 per cent of all or more. The share is the one of largest gain with
/// small clusters. No cell is scaled where the gain is less than a half. `is_scaled`: row = TetId.
/// Needs: nodes and their sums of stiffness.
void choose_scaled_cells(WaveBodies& waves, std::vector<char>& is_scaled,
                         const MechanicsState& state, const StepInput& input);

/// Computes the responses for steps of `step` s. Those that have not changed are kept.
void prepare_scaled_cells(WaveBodies& waves, const MechanicsState& state, const StepInput& input,
                          double step);

/// Before a kick: notes the velocities of scaled nodes of a body, and where these are.
void begin_scaled_kick(WaveNodes& nodes, const WaveBody& body, const Mat3& R);

/// After it: gives the nodes the velocities of M' in place of those of M.
void end_scaled_kick(WaveNodes& nodes, const WaveBody& body);

/// J: the change of kinetic energy of a body's scaled nodes since the last kick began, less the
/// work of forces and impulses there. The energy of M' - M gives and takes it.
double scaled_work(const WaveBodies& waves, const WaveBody& body);

/// Adds an impulse (N s) at a node to the velocities: its own by 1/m, those of its cluster by
/// M'^-1. Momentum and angular momentum change by those of the impulse.
void push_node(WaveNodes& nodes, std::uint32_t node, const Vec3& impulse);

/// 1/kg: the change of the velocity of node `of` by an impulse at `at`, world axes.
Mat3 response_between(const WaveNodes& nodes, std::uint32_t of, std::uint32_t at);

}  // namespace sunder
