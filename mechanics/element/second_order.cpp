// SPDX-License-Identifier: MIT
// Shape functions in barycentric coordinates L: L_a (2 L_a - 1) at corners, 4 L_i L_j on edges.
#include "mechanics/element/second_order.hpp"

namespace sunder {
namespace {

/// One term of the gradient of a shape function: 4 L_factor - (1 at corners), times the gradient
/// G_along of L_along.
struct Term {
  int factor, along;
};

struct Terms {
  std::array<Term, 2> term;
  std::size_t count;
  bool is_corner;
};

constexpr Terms terms_of(std::size_t node) {
  if (node < 4) {
    const int a = static_cast<int>(node);
    return {{{{a, a}, {a, a}}}, 1, true};
  }
  const auto [i, j] = edge_ends[node - 4];
  return {{{{i, j}, {j, i}}}, 2, false};
}

/// Barycentric coordinates of Gauss' points of degree 2: one `near_share`, three `far_share`.
constexpr double far_share = 0.13819660112501051518;  // (5 - sqrt 5) / 20
constexpr double near_share = 1 - 3 * far_share;

}  // namespace

void add_second_order_block(double* to, const ShapeGradient& G, std::size_t a, std::size_t b,
                            const Lame& scaled) {
  const Terms of_a = terms_of(a), of_b = terms_of(b);
  // Means over a tetrahedron: 1/4 of L_i, (1 + delta_ij) / 20 of L_i L_j.
  const double less = of_a.is_corner || of_b.is_corner ? 1 : 0;
  for (std::size_t i = 0; i < of_a.count; ++i) {
    for (std::size_t j = 0; j < of_b.count; ++j) {
      const Term& p = of_a.term[i];
      const Term& q = of_b.term[j];
      const double mean = (p.factor == q.factor ? 1.6 : 0.8) - less;
      add_stiffness_block(to, G.col(p.along), G.col(q.along),
                          {mean * scaled.lambda, mean * scaled.mu});
    }
  }
}

Mat3 node_block(const ShapeGradient& G, double volume, const Lame& constants, std::size_t count,
                std::size_t b, std::size_t a) {
  if (count == 4) {
    return stiffness_block(G.col(static_cast<Eigen::Index>(b)), G.col(static_cast<Eigen::Index>(a)),
                           volume, constants);
  }
  Mat3 block = Mat3::Zero();
  add_second_order_block(block.data(), G, b, a, {volume * constants.lambda, volume * constants.mu});
  return block;
}

std::array<Mat3, 4> corner_gradients(const ShapeGradient& G, const NodeVectors& d) {
  std::array<Mat3, 4> H;
  for (int c = 0; c < 4; ++c) {
    Mat3& at = H[static_cast<std::size_t>(c)];
    at.setZero();
    for (std::size_t node = 0; node < d.size(); ++node) {
      const Terms terms = terms_of(node);
      for (std::size_t i = 0; i < terms.count; ++i) {
        const auto [factor, along] = terms.term[i];
        const double value = (factor == c ? 4 : 0) - (terms.is_corner ? 1 : 0);
        if (value != 0) at += value * d[node] * G.col(along).transpose();
      }
    }
  }
  return H;
}

std::array<Mat3, 4> corner_gradients(const ElementColumns& elements,
                                     std::span<const Corners> corners,
                                     std::span<const Vec3> displacement, TetId t) {
  const ElementNodes nodes = nodes_of(elements, corners, t);
  NodeVectors d;
  for (std::size_t a = 0; a < d.size(); ++a) d[a] = displacement[nodes.row[a].index()];
  return corner_gradients(elements.shape_gradient[t.index()], d);
}

std::array<Mat3, 4> at_points(const std::array<Mat3, 4>& at_corners) {
  const Mat3 shared = far_share * (at_corners[0] + at_corners[1] + at_corners[2] + at_corners[3]);
  std::array<Mat3, 4> at;
  for (std::size_t q = 0; q < 4; ++q) at[q] = (near_share - far_share) * at_corners[q] + shared;
  return at;
}

std::array<Mat3, 4> at_corners_of(const std::array<Mat3, 4>& at_points) {
  const Mat3 shared = far_share * (at_points[0] + at_points[1] + at_points[2] + at_points[3]);
  std::array<Mat3, 4> at;
  for (std::size_t c = 0; c < 4; ++c) at[c] = (at_points[c] - shared) / (near_share - far_share);
  return at;
}

Vec3 node_gradient(const ShapeGradient& G, std::size_t a, std::size_t point) {
  const Terms terms = terms_of(a);
  Vec3 gradient = Vec3::Zero();
  for (std::size_t i = 0; i < terms.count; ++i) {
    const auto [factor, along] = terms.term[i];
    const double L = static_cast<std::size_t>(factor) == point ? near_share : far_share;
    gradient += (4 * L - (terms.is_corner ? 1 : 0)) * G.col(along);
  }
  return gradient;
}

double mean_product(const std::array<Mat3, 4>& a, const std::array<Mat3, 4>& b) {
  Mat3 sum_a = Mat3::Zero(), sum_b = Mat3::Zero();
  double own = 0;
  for (std::size_t c = 0; c < 4; ++c) {
    sum_a += a[c];
    sum_b += b[c];
    own += a[c].cwiseProduct(b[c]).sum();
  }
  return (sum_a.cwiseProduct(sum_b).sum() + own) / 20;
}

Vec3 second_order_force(const ShapeGradient& G, double rest_volume,
                        const std::array<Mat3, 4>& stress, std::size_t a) {
  const Terms terms = terms_of(a);
  const Mat3 sum = stress[0] + stress[1] + stress[2] + stress[3];
  Vec3 force = Vec3::Zero();
  for (std::size_t i = 0; i < terms.count; ++i) {
    const auto [factor, along] = terms.term[i];
    // Means of 4 L_factor sigma, and of sigma at corners.
    const Mat3 mean = 0.2 * (sum + stress[static_cast<std::size_t>(factor)]) -
                      (terms.is_corner ? 0.25 : 0.0) * sum;
    force += rest_volume * (mean * G.col(along));
  }
  return force;
}

Vec3 node_force(const ElementColumns& elements, std::span<const Mat3> stress,
                std::span<const std::array<Mat3, 4>> corner_stress, TetId t, std::size_t node) {
  const ShapeGradient& G = elements.shape_gradient[t.index()];
  const double volume = elements.rest_volume[t.index()];
  if (is_second_order(elements, t)) {
    return second_order_force(G, volume, corner_stress[t.index()], node);
  }
  return volume * (stress[t.index()] * G.col(static_cast<Eigen::Index>(node)));
}

VertexId append_middle(VertexColumns& vertices, VertexId a, VertexId b) {
  const auto middle = [&](std::vector<Vec3>& column) {
    const Vec3 value = 0.5 * (column[a.index()] + column[b.index()]);
    column.back() = value;
  };
  const VertexId row = append_copy(vertices, a);
  middle(vertices.rest_position);
  middle(vertices.position);
  middle(vertices.velocity);
  vertices.mass[row.index()] = 0;
  vertices.support[row.index()] = MotionId::none();
  return row;
}

void add_consistent_weight(std::vector<Vec3>& force, const MechanicsState& state,
                           std::span<const Corners> corners, const Vec3& gravity) {
  force.resize(state.vertices.size(), Vec3::Zero());
  for (std::size_t t = 0; t < state.elements.size(); ++t) {
    if (!is_second_order(state.elements, TetId{t})) continue;
    const ElementNodes nodes = nodes_of(state.elements, corners, TetId{t});
    for (std::size_t k = 0; k < nodes.count; ++k) {
      const double share = node_weight(k) - node_share(nodes.count, k);
      force[nodes.row[k].index()] += share * state.elements.mass[t] * gravity;
    }
  }
}

}  // namespace sunder
