// SPDX-License-Identifier: MIT
// Deformations of small bodies by their modes, each integrated exactly: in the floating frame.
#pragma once

#include <cstddef>

#include "mechanics/integrators/component_step.hpp"

namespace sunder {

/// Vertices of a component above which its modes are not computed: 1 500 of them take a dense
/// eigenproblem of seconds and 18 MB.
inline constexpr std::size_t modal_vertex_limit = 500;

/// All modes of a component over its free vertices, without the rigid six of a free one.
struct ModalBasis {
  Eigen::MatrixXd shape;      ///< column a mode, S^T M S = 1, body frame, the system's order
  Eigen::VectorXd frequency;  ///< rad/s, ascending
};

/// That of the component, made at first. Needs: `step.system`, at most `modal_vertex_limit`
/// vertices. O(n^3): 0.3 s at 168 vertices.
const ModalBasis& modal_basis(const ComponentStep& step);

/// Deformation of one component, body frame.
struct ModalDeformation {
  LocalField displacement, rate;
};

/// Exact for a load that is constant over the step, at any step:
///   q <- q cos wh + q' sin(wh)/w + p (1 - cos wh)/w^2,  q' <- -q w sin wh + q' cos wh + p
///   sin(wh)/w.
/// Free vertices only; held ones are where they are in the middle of the step. No damping.
/// Two dense products: 10 us at 60 vertices, 1 ms at 300.
void advance_modes(const ComponentStep& step, const ModalDeformation& d, ConstLocalField load);

/// Mean rate over the step of the motion without load, into `rate`. Coriolis forces act on this
/// rate, in steps that resolve oscillations and in those that do not.
void mean_modal_rate(LocalField rate, const ComponentStep& step, const ModalDeformation& d);

/// Displacement (rows, of free vertices) at the end of the step for unit impulses (columns) that
/// act as forces all through it: S diag((1 - cos wh) / (w^2 h)) S^T. Body frame, 3 k x 3 k, m/(N
/// s).
Eigen::MatrixXd modal_response(const ComponentStep& step, std::span<const std::uint32_t> vertices);

}  // namespace sunder
