// SPDX-License-Identifier: MIT
// Second-order tetrahedra, straight at rest: ten nodes, the corners and the middles of the edges.
// Node k < 4 is corner k, node 4 + e the middle of edge e (`edge_ends`). Displacement is quadratic,
// strain and stress are linear: their values at the four corners determine them.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mechanics/element/strain_displacement.hpp"
#include "mechanics/state/mechanics_state.hpp"

namespace sunder {

/// The share of a tetrahedron's mass that one of its `count` nodes has: a quarter of four; of ten
/// 1/36 for a corner and 4/27 for the middle of an edge, the diagonal of the consistent mass scaled
/// to the sum (Hinton, Rock and Zienkiewicz, Earthquake Engineering and Structural Dynamics 4,
/// 1976). Mass and mass centre are those of the body.
constexpr double node_share(std::size_t count, std::size_t node) {
  return count == 4 ? 0.25 : node < 4 ? 1.0 / 36 : 4.0 / 27;
}

/// The share of a second-order tetrahedron's weight that a node feels, the integral of its shape
/// function: -1/20 for a corner, 1/5 for the middle of an edge.
constexpr double node_weight(std::size_t node) { return node < 4 ? -1.0 / 20 : 1.0 / 5; }

/// Adds the block of K_e between nodes `a` and `b` (0 to 9), column by column, at `to`: the
/// integral of the gradients' products, exact. `scaled`: the constants times the rest volume, N m.
void add_second_order_block(double* to, const ShapeGradient& gradient, std::size_t a, std::size_t b,
                            const Lame& scaled);

/// The block of K_e between nodes `b` and `a` of a tetrahedron of either order, with 4 or 10
/// (`count`) of them, N/m. `volume`: at rest, m^3.
Mat3 node_block(const ShapeGradient& gradient, double volume, const Lame& constants,
                std::size_t count, std::size_t b, std::size_t a);

/// A vector at each of the ten nodes.
using NodeVectors = std::array<Vec3, 10>;

/// sum_a d_a (grad N_a)^T at the four corners, of vectors d at the nodes: of displacements H, no
/// unit.
std::array<Mat3, 4> corner_gradients(const ShapeGradient& gradient, const NodeVectors& d);

/// H at the four corners of tetrahedron `t`, no unit, from the displacements of its nodes. Needs:
/// of second order.
std::array<Mat3, 4> corner_gradients(const ElementColumns& elements,
                                     std::span<const Corners> corners,
                                     std::span<const Vec3> displacement, TetId t);

/// A linear field in a tetrahedron, from its corners to the four points of Gauss' rule of degree 2,
/// and back. The mean over these points of products of two such fields is exact.
std::array<Mat3, 4> at_points(const std::array<Mat3, 4>& at_corners);
std::array<Mat3, 4> at_corners_of(const std::array<Mat3, 4>& at_points);

/// grad N_a of node `a` (0 to 9) at one of those points, 1/m.
Vec3 node_gradient(const ShapeGradient& gradient, std::size_t a, std::size_t point);

/// The mean over a tetrahedron of a : b, both linear in it and given at its corners.
double mean_product(const std::array<Mat3, 4>& a, const std::array<Mat3, 4>& b);

/// The force K_e d_e on node `a` (0 to 9) from the stresses at the corners: the integral of
/// sigma grad N_a, exact. N, body frame.
Vec3 second_order_force(const ShapeGradient& gradient, double rest_volume,
                        const std::array<Mat3, 4>& stress, std::size_t a);

/// The force K_e d_e on a node of tetrahedron `t` of either order (0 to 3, or 9), from stresses as
/// in `ElementColumns`, |T| rows each. N, body frame.
Vec3 node_force(const ElementColumns& elements, std::span<const Mat3> stress,
                std::span<const std::array<Mat3, 4>> corner_stress, TetId t, std::size_t node);

/// Appends the row of a node in the middle between two vertices at rest, or of a body that moves
/// rigidly; its mass follows with `rebuild`.
VertexId append_middle(VertexColumns& vertices, VertexId a, VertexId b);

/// Adds the excess of the weight of second-order tetrahedra at their nodes over that of the nodes'
/// masses to `force` (N, world, |V| rows, resized with zeros). Its sum is zero, and so is its
/// moment.
void add_consistent_weight(std::vector<Vec3>& force, const MechanicsState& state,
                           std::span<const Corners> corners, const Vec3& gravity);

}  // namespace sunder
