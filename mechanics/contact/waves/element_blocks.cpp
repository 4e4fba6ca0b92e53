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

/// By node and axis: u + b w of four elements. The fourth axis is empty.
template <std::size_t nodes>
SUNDER_INLINE void read(Lanes (&d)[nodes][4], const double* displacement, const double* rate,
                        const ElementBlock<nodes>& e) {
  for (std::size_t a = 0; a < nodes; ++a) {
    for (std::size_t lane = 0; lane < 4; ++lane) {
      const std::size_t row = 4 * e.node[a][lane];
      d[a][lane] = load(displacement + row) + spread(e.viscosity[lane]) * load(rate + row);
    }
    transpose(d[a][0], d[a][1], d[a][2], d[a][3]);
  }
}

/// Adds the forces on one node of each of four elements. `f`: by axis, the last one is not used.
SUNDER_INLINE void add(double* inner, const std::uint32_t (&node)[4], Lanes (&f)[4]) {
  f[3] = Lanes{0, 0, 0, 0};
  transpose(f[0], f[1], f[2], f[3]);
  for (int lane = 0; lane < 4; ++lane) {
    double* row = inner + 4 * node[lane];
    store(row, load(row) + f[lane]);
  }
}

template <std::size_t nodes>
SUNDER_INLINE void read_gradients(Lanes (&G)[3][3], const ElementBlock<nodes>& e) {
  for (int a = 0; a < 3; ++a) {
    for (int j = 0; j < 3; ++j) G[a][j] = load(e.gradient[3 * a + j]);
  }
}

/// V sigma of a gradient.
template <std::size_t nodes>
SUNDER_INLINE void find_stress(Lanes (&S)[3][3], const Lanes (&H)[3][3],
                               const ElementBlock<nodes>& e) {
  const Lanes mu = load(e.mu), spread_trace = load(e.lambda) * (H[0][0] + H[1][1] + H[2][2]);
  for (int i = 0; i < 3; ++i) {
    S[i][i] = mu * (H[i][i] + H[i][i]) + spread_trace;
    for (int j = 0; j < i; ++j) S[i][j] = S[j][i] = mu * (H[i][j] + H[j][i]);
  }
}

SUNDER_INLINE void add_force(double* inner, const double* displacement, const double* rate,
                             const FirstOrderBlock& e) {
  Lanes d[4][4], G[3][3], H[3][3], S[3][3], f[4][4];
  read(d, displacement, rate, e);
  read_gradients(G, e);
  for (int i = 0; i < 3; ++i) {
    const Lanes d1 = d[1][i] - d[0][i], d2 = d[2][i] - d[0][i], d3 = d[3][i] - d[0][i];
    for (int j = 0; j < 3; ++j) H[i][j] = d1 * G[0][j] + d2 * G[1][j] + d3 * G[2][j];
  }
  find_stress(S, H, e);
  for (int i = 0; i < 3; ++i) {
    for (int a = 0; a < 3; ++a) {
      f[a + 1][i] = S[i][0] * G[a][0] + S[i][1] * G[a][1] + S[i][2] * G[a][2];
    }
    f[0][i] = -(f[1][i] + f[2][i] + f[3][i]);
  }
  for (int a = 0; a < 4; ++a) add(inner, e.node[a], f[a]);
}

/// Row of the node that corner k shares with corner j: itself, or the middle of their edge.
constexpr int node_between(int k, int j) { return k == j ? k : 4 + edge_between(k, j); }

/// V sigma at the corners, and their sum.
SUNDER_INLINE void find_corner_stresses(Lanes (&S)[4][3][3], Lanes (&sum)[3][3],
                                        const Lanes (&d)[10][4], const Lanes (&G)[3][3],
                                        const SecondOrderBlock& e) {
  Lanes mean[3][3], H[3][3];
  for (int i = 0; i < 3; ++i) {
    const Lanes d1 = d[1][i] - d[0][i], d2 = d[2][i] - d[0][i], d3 = d[3][i] - d[0][i];
    for (int j = 0; j < 3; ++j) mean[i][j] = d1 * G[0][j] + d2 * G[1][j] + d3 * G[2][j];
  }
  const Lanes four = spread(4);
  for (int k = 0; k < 4; ++k) {
    for (int i = 0; i < 3; ++i) {
      const Lanes at0 = d[node_between(k, 0)][i];
      const Lanes d1 = four * (d[node_between(k, 1)][i] - at0);
      const Lanes d2 = four * (d[node_between(k, 2)][i] - at0);
      const Lanes d3 = four * (d[node_between(k, 3)][i] - at0);
      for (int j = 0; j < 3; ++j) {
        H[i][j] = d1 * G[0][j] + d2 * G[1][j] + d3 * G[2][j] - mean[i][j];
      }
    }
    find_stress(S[k], H, e);
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) sum[i][j] = S[0][i][j] + S[1][i][j] + (S[2][i][j] + S[3][i][j]);
  }
}

SUNDER_INLINE void add_force(double* inner, const double* displacement, const double* rate,
                             const SecondOrderBlock& e) {
  Lanes d[10][4], G[3][3], S[4][3][3], sum[3][3];
  read(d, displacement, rate, e);
  read_gradients(G, e);
  find_corner_stresses(S, sum, d, G, e);
  const Lanes fifth = spread(0.2), quarter = spread(0.25);
  // t[k][j] = (S + S_k) G_j / 5
  Lanes t[4][4][3];
  for (int k = 0; k < 4; ++k) {
    for (int i = 0; i < 3; ++i) {
      Lanes M[3];
      for (int j = 0; j < 3; ++j) M[j] = fifth * (sum[i][j] + S[k][i][j]);
      for (int a = 0; a < 3; ++a) {
        t[k][a + 1][i] = M[0] * G[a][0] + M[1] * G[a][1] + M[2] * G[a][2];
      }
      t[k][0][i] = -(t[k][1][i] + t[k][2][i] + t[k][3][i]);
    }
  }
  Lanes mean[4][3];  // S G_k / 4
  for (int i = 0; i < 3; ++i) {
    for (int a = 0; a < 3; ++a) {
      mean[a + 1][i] = quarter * (sum[i][0] * G[a][0] + sum[i][1] * G[a][1] + sum[i][2] * G[a][2]);
    }
    mean[0][i] = -(mean[1][i] + mean[2][i] + mean[3][i]);
  }
  Lanes f[4];
  for (int k = 0; k < 4; ++k) {
    for (int i = 0; i < 3; ++i) f[i] = t[k][k][i] - mean[k][i];
    add(inner, e.node[k], f);
    for (int j = 0; j < k; ++j) {
      for (int i = 0; i < 3; ++i) f[i] = t[j][k][i] + t[k][j][i];
      add(inner, e.node[node_between(k, j)], f);
    }
  }
}

template <class Block>
SUNDER_INLINE void add_forces(const NodeMotion& nodes, std::span<const Block> blocks) {
  const double* displacement = nodes.displacement.data();
  const double* rate = nodes.rate.data();
  double* inner = nodes.inner.data();
  for (const Block& block : blocks) add_force(inner, displacement, rate, block);
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

SUNDER_LANES void add_block_forces(const NodeMotion& nodes,
                                   std::span<const FirstOrderBlock> blocks) {
  add_forces(nodes, blocks);
}

SUNDER_LANES void add_block_forces(const NodeMotion& nodes,
                                   std::span<const SecondOrderBlock> blocks) {
  add_forces(nodes, blocks);
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
