// SPDX-License-Identifier: MIT
// Shape functions in barycentric coordinates L: L_a (2 L_a - 1) at corners, 4 L_i L_j on edges.
#include "mechanics/element/second_order.hpp"

#include "mechanics/element/energy.hpp"

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

std::array<Mat3, 4> corner_gradients(const ElementColumns& elements,
                                     std::span<const Corners> corners,
                                     std::span<const Vec3> displacement, TetId t) {
  const ShapeGradient& G = elements.shape_gradient[t.index()];
  const ElementNodes nodes = nodes_of(elements, corners, t);
  std::array<Mat3, 4> H;
  for (int c = 0; c < 4; ++c) {
    Mat3& at = H[static_cast<std::size_t>(c)];
    at.setZero();
    for (std::size_t node = 0; node < nodes.count; ++node) {
      const Terms terms = terms_of(node);
      for (std::size_t i = 0; i < terms.count; ++i) {
        const auto [factor, along] = terms.term[i];
        const double value = (factor == c ? 4 : 0) - (terms.is_corner ? 1 : 0);
        if (value != 0) {
          at += value * displacement[nodes.row[node].index()] * G.col(along).transpose();
        }
      }
    }
  }
  return H;
}

std::array<Mat3, 4> corner_stress(const MechanicsState& state, std::span<const Corners> corners,
                                  TetId t) {
  if (!is_second_order(state.elements, t)) {
    const Mat3& stress = state.elements.stress[t.index()];
    return {stress, stress, stress, stress};
  }
  std::array<Mat3, 4> stress =
      corner_gradients(state.elements, corners, state.vertices.displacement, t);
  const Lame constants = lame(material_of(state, t));
  for (Mat3& s : stress) s = stress_of(Mat3(s), constants);
  return stress;
}

double linear_stress_energy(const std::array<Mat3, 4>& stress, double rest_volume,
                            const Material& material) {
  const StressEnergy energy(material);
  Mat3 sum = stress[0] + stress[1] + stress[2] + stress[3];
  double densities = energy.density(sum);
  for (const Mat3& s : stress) densities += energy.density(s);
  return rest_volume / 20 * densities;
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
