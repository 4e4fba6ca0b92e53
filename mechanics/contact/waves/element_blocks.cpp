// SPDX-License-Identifier: MIT
// Forces of packed elements, and bounds of their stiffness.
#include "mechanics/contact/waves/element_blocks.hpp"

#include <cmath>

#include "mechanics/element/strain_displacement.hpp"
#include "mechanics/solver/block_lanes.hpp"
#include "mechanics/state/dense_solve.hpp"

namespace sunder {
namespace {

/// Rows and columns of four vectors change places.
SUNDER_INLINE void transpose(Lanes& a, Lanes& b, Lanes& c, Lanes& d) {
  const Lanes ab_low = __builtin_shufflevector(a, b, 0, 4, 2, 6);
  const Lanes ab_high = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Lanes cd_low = __builtin_shufflevector(c, d, 0, 4, 2, 6);
  const Lanes cd_high = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  a = __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
  b = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
  c = __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
  d = __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7);
}

SUNDER_INLINE void add_force(double* inner, const double* displacement, const double* rate,
                             const ElementBlock& e) {
  Lanes d[4][4];  // by corner and axis
  for (int a = 0; a < 4; ++a) {
    for (int lane = 0; lane < 4; ++lane) {
      const std::size_t row = 4 * e.node[a][lane];
      d[a][lane] = load(displacement + row) + spread(e.viscosity[lane]) * load(rate + row);
    }
    transpose(d[a][0], d[a][1], d[a][2], d[a][3]);
  }
  Lanes G[3][3];
  for (int a = 0; a < 3; ++a) {
    for (int j = 0; j < 3; ++j) G[a][j] = load(e.gradient[3 * a + j]);
  }
  Lanes H[3][3];
  for (int i = 0; i < 3; ++i) {
    const Lanes d1 = d[1][i] - d[0][i], d2 = d[2][i] - d[0][i], d3 = d[3][i] - d[0][i];
    for (int j = 0; j < 3; ++j) H[i][j] = d1 * G[0][j] + d2 * G[1][j] + d3 * G[2][j];
  }
  const Lanes mu = load(e.mu), spread_trace = load(e.lambda) * (H[0][0] + H[1][1] + H[2][2]);
  Lanes S[3][3];
  for (int i = 0; i < 3; ++i) {
    S[i][i] = mu * (H[i][i] + H[i][i]) + spread_trace;
    for (int j = 0; j < i; ++j) S[i][j] = S[j][i] = mu * (H[i][j] + H[j][i]);
  }
  Lanes f[4][4];
  for (int i = 0; i < 3; ++i) {
    for (int a = 0; a < 3; ++a) {
      f[a + 1][i] = S[i][0] * G[a][0] + S[i][1] * G[a][1] + S[i][2] * G[a][2];
    }
    f[0][i] = -(f[1][i] + f[2][i] + f[3][i]);
  }
  for (int a = 0; a < 4; ++a) {
    f[a][3] = Lanes{0, 0, 0, 0};
    transpose(f[a][0], f[a][1], f[a][2], f[a][3]);
    for (int lane = 0; lane < 4; ++lane) {
      double* row = inner + 4 * e.node[a][lane];
      store(row, load(row) + f[a][lane]);
    }
  }
}

/// Of first order: the eigenvalue is that of strains, 6 x 6.
double coupling_of_strains(const ShapeGradient& G, const Lame& lame) {
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  const StrainDisplacement B = strain_displacement(G);
  const double wave = lame.lambda + 2 * lame.mu;
  Matrix6 M = Matrix6::Zero();
  for (int a = 0; a < 4; ++a) {
    const auto own = B.middleCols<3>(3 * a);
    M += own * own.transpose() / (wave * G.col(a).squaredNorm());
  }
  const Matrix6 root = Eigen::LLT<Matrix6>(elasticity_matrix(lame)).matrixL();
  const Matrix6 S = root.transpose() * M * root;
  return Eigen::SelfAdjointEigenSolver<Matrix6>(S, Eigen::EigenvaluesOnly).eigenvalues()[5];
}

/// Of second order: of the whole matrix.
double coupling_of_nodes(const ShapeGradient& gradient, double volume, const Lame& lame) {
  constexpr std::size_t nodes = 10;
  const std::array<double, 10> stiffness = stiffness_of_nodes(gradient, volume, lame, nodes);
  Eigen::MatrixXd K(3 * nodes, 3 * nodes);
  for (std::size_t a = 0; a < nodes; ++a) {
    for (std::size_t b = 0; b < nodes; ++b) {
      K.block<3, 3>(static_cast<Eigen::Index>(3 * b), static_cast<Eigen::Index>(3 * a)) =
          node_block(gradient, volume, lame, nodes, b, a) / std::sqrt(stiffness[a] * stiffness[b]);
    }
  }
  return symmetric_eigen(K, Eigen::EigenvaluesOnly).eigenvalues().tail<1>()[0];
}

}  // namespace

void set_element(ElementBlock& block, std::size_t lane, const ShapeGradient& gradient,
                 const Lame& scaled, const std::array<std::uint32_t, 4>& node) {
  for (int a = 0; a < 3; ++a) {
    for (int j = 0; j < 3; ++j) block.gradient[3 * a + j][lane] = gradient(j, a + 1);
  }
  block.lambda[lane] = scaled.lambda;
  block.mu[lane] = scaled.mu;
  block.viscosity[lane] = 0;
  for (std::size_t a = 0; a < 4; ++a) block.node[a][lane] = node[a];
}

SUNDER_LANES void add_block_forces(const NodeMotion& nodes, std::span<const ElementBlock> blocks) {
  const double* displacement = nodes.displacement.data();
  const double* rate = nodes.rate.data();
  double* inner = nodes.inner.data();
  for (const ElementBlock& block : blocks) add_force(inner, displacement, rate, block);
}

void add_second_order_forces(const NodeMotion& nodes,
                             std::span<const SecondOrderElement> elements) {
  for (const SecondOrderElement& e : elements) {
    NodeVectors d;
    for (std::size_t a = 0; a < e.node.size(); ++a) {
      d[a] = row_of(nodes.displacement, e.node[a]) + e.viscosity * row_of(nodes.rate, e.node[a]);
    }
    std::array<Mat3, 4> stress = corner_gradients(e.gradient, d);
    for (Mat3& at : stress) at = stress_of(at, e.lame);
    for (std::size_t a = 0; a < e.node.size(); ++a) {
      row_of(nodes.inner, e.node[a]) += second_order_force(e.gradient, e.volume, stress, a);
    }
  }
}

std::array<double, 10> stiffness_of_nodes(const ShapeGradient& gradient, double volume,
                                          const Lame& lame, std::size_t nodes) {
  std::array<double, 10> stiffness{};
  for (std::size_t a = 0; a < nodes; ++a) {
    if (nodes == 4) {
      const auto column = gradient.col(static_cast<Eigen::Index>(a));
      stiffness[a] = volume * (lame.lambda + 2 * lame.mu) * column.squaredNorm();
      continue;
    }
    const Mat3 block = node_block(gradient, volume, lame, nodes, a, a);
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(block, Eigen::EigenvaluesOnly);
    stiffness[a] = solver.eigenvalues()[2];
  }
  return stiffness;
}

double coupling_of(const ShapeGradient& gradient, double volume, const Lame& lame,
                   std::size_t nodes) {
  return nodes == 4 ? coupling_of_strains(gradient, lame)
                    : coupling_of_nodes(gradient, volume, lame);
}

}  // namespace sunder
