// SPDX-License-Identifier: MIT
// Elements packed four at a time, and their forces: the inner loop of explicit steps.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mechanics/element/second_order.hpp"
#include "mechanics/solver/aligned_doubles.hpp"

namespace sunder {

/// Columns of vectors in explicit steps: four doubles a row, the last of them unused.
using QuadColumn = AlignedDoubles;

inline Eigen::Map<Vec3> row_of(QuadColumn& column, std::size_t row) {
  return Eigen::Map<Vec3>(&column[4 * row]);
}
inline Eigen::Map<const Vec3> row_of(const QuadColumn& column, std::size_t row) {
  return Eigen::Map<const Vec3>(&column[4 * row]);
}

/// Four tetrahedra of `nodes` nodes. Places that are left over have moduli of zero.
template <std::size_t nodes>
struct alignas(64) ElementBlock {
  double gradient[9][4];         ///< 1/m: of the coordinates of corners 1 to 3, by corner and axis
  double lambda[4], mu[4];       ///< N m: Lame's constants times the rest volume
  double viscosity[4];           ///< s: factor of the stiffness
  std::uint32_t node[nodes][4];  ///< corners, then middles of edges (`edge_ends`)
};
using FirstOrderBlock = ElementBlock<4>;
using SecondOrderBlock = ElementBlock<10>;

/// Sets one of the four places of a block, without viscosity.
template <std::size_t nodes>
void set_element(ElementBlock<nodes>& block, std::size_t lane, const ShapeGradient& gradient,
                 const Lame& scaled, const std::array<std::uint32_t, nodes>& node) {
  for (int a = 0; a < 3; ++a) {
    for (int j = 0; j < 3; ++j) block.gradient[3 * a + j][lane] = gradient(j, a + 1);
  }
  block.lambda[lane] = scaled.lambda;
  block.mu[lane] = scaled.mu;
  block.viscosity[lane] = 0;
  for (std::size_t a = 0; a < nodes; ++a) block.node[a][lane] = node[a];
}

/// Where elements read displacements (m) and their rates (m/s), and add forces (N): columns of
/// nodes in the body's frame.
struct NodeMotion {
  const QuadColumn& displacement;
  const QuadColumn& rate;
  QuadColumn& inner;
};

/// Adds the forces K_e (u + b w) of elements with viscosity b to `inner`: d = u + b w,
/// H = sum_a (d_a - d_0) G_a^T, V sigma = V lambda tr(H) I + V mu (H + H^T), f_a = V sigma G_a.
/// The same bytes on any processor.
void add_block_forces(const NodeMotion& nodes, std::span<const FirstOrderBlock> blocks);

/// The same for elements of second order, with d at the corners k and the middles of edges jk:
/// H_k = 4 (d_k G_k^T + sum_j d_jk G_j^T) - sum_j d_j G_j^T is the gradient at corner k, and with
/// S_k = V sigma(H_k) and their sum S: f_k = (S_k / 5 - S / 20) G_k,
/// f_jk = (S + S_j) G_k / 5 + (S + S_k) G_j / 5.
void add_block_forces(const NodeMotion& nodes, std::span<const SecondOrderBlock> blocks);

/// c of an element: x^T K_e x <= c sum_a k_a |x_a|^2 for all x, with k_a the largest eigenvalue of
/// the diagonal block of node a. Then (2 / h)^2 >= sum_e c k_a / m_a at every node bounds the
/// stable step of central differences: K's largest eigenvalue is that of no partition of the masses
/// lower than this one's.
double coupling_of(const ShapeGradient& gradient, double volume, const Lame& lame,
                   std::size_t nodes);

/// N/m: k_a of that bound, for each node.
std::array<double, 10> stiffness_of_nodes(const ShapeGradient& gradient, double volume,
                                          const Lame& lame, std::size_t nodes);

}  // namespace sunder
