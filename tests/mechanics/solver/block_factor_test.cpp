// SPDX-License-Identifier: MIT
// The factor in blocks against dense and scalar ones, on graphs of many shapes and on bodies.
#include <catch2/catch.hpp>

#include <cmath>
#include <cstring>
#include <random>
#include <set>
#include <string>

#include <Eigen/SparseCholesky>

#include "mechanics/solver/block_factor.hpp"
#include "mechanics/solver/component_system.hpp"
#include "tests/support/bodies.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

using Edges = std::set<std::pair<std::uint32_t, std::uint32_t>>;

struct NamedGraph {
  std::string name;
  VertexGraph graph;
};

NamedGraph graph_of(const std::string& name, std::uint32_t n, const Edges& edges) {
  std::vector<std::set<std::uint32_t>> neighbours(n);
  for (const auto& [a, b] : edges) {
    neighbours[a].insert(b);
    neighbours[b].insert(a);
  }
  NamedGraph made{name + " " + std::to_string(n), {}};
  made.graph.start.push_back(0);
  for (const auto& list : neighbours) {
    made.graph.neighbour.insert(made.graph.neighbour.end(), list.begin(), list.end());
    made.graph.start.push_back(static_cast<std::uint32_t>(made.graph.neighbour.size()));
  }
  return made;
}

/// Paths, stars, grids, dense ones, several at once, single vertices, nothing, and random ones.
std::vector<NamedGraph> graphs(std::mt19937& random) {
  std::vector<NamedGraph> all;
  all.push_back(graph_of("nothing", 0, {}));
  all.push_back(graph_of("single", 1, {}));
  all.push_back(graph_of("apart", 7, {}));
  for (std::uint32_t n : {2U, 3U, 5U, 17U, 40U}) {
    Edges path, star, dense, two;
    for (std::uint32_t i = 1; i < n; ++i) {
      path.insert({i - 1, i});
      star.insert({0, i});
      if (i % 7 != 3) two.insert({i - 1, i});
      for (std::uint32_t j = 0; j < i; ++j) dense.insert({j, i});
    }
    all.push_back(graph_of("path", n, path));
    all.push_back(graph_of("star", n, star));
    all.push_back(graph_of("dense", n, dense));
    all.push_back(graph_of("disconnected", n, two));
  }
  Edges grid;
  for (std::uint32_t i = 0; i < 150; ++i) {
    if (i % 10 != 9) grid.insert({i, i + 1});
    if (i + 10 < 150) grid.insert({i, i + 10});
    if (i % 10 != 9 && i + 11 < 150) grid.insert({i, i + 11});
  }
  all.push_back(graph_of("grid", 150, grid));
  for (std::uint32_t n : {10U, 60U, 120U}) {
    Edges edges;
    for (std::uint32_t e = 0; e < 3 * n; ++e) {
      const auto a = static_cast<std::uint32_t>(random() % n);
      const auto b = static_cast<std::uint32_t>(random() % n);
      if (a != b) edges.insert({std::min(a, b), std::max(a, b)});
    }
    all.push_back(graph_of("random", n, edges));
  }
  return all;
}

/// Random blocks on the pattern of the graph, made diagonally dominant, in the analysis' order.
BlockMatrix random_matrix(const VertexGraph& graph, const BlockAnalysis& analysis,
                          std::mt19937& random) {
  const std::size_t n = graph.size();
  std::vector<std::uint32_t> place(n);
  for (std::size_t i = 0; i < n; ++i) place[analysis.order[i]] = static_cast<std::uint32_t>(i);
  // Multiples of 1/1024 and products of them: the same numbers everywhere.
  const auto number = [&] { return (static_cast<double>(random() % 2049) - 1024) / 1024; };
  BlockMatrix A;
  A.start.push_back(0);
  for (std::size_t j = 0; j < n; ++j) {
    std::set<std::uint32_t> rows{static_cast<std::uint32_t>(j)};
    for (std::uint32_t v : graph.of(analysis.order[j])) {
      if (place[v] > j) rows.insert(place[v]);
    }
    for (std::uint32_t row : rows) {
      Mat3 block;
      for (int k = 0; k < 9; ++k) block(k) = number();
      if (row == j) {
        const auto degree = static_cast<double>(graph.of(analysis.order[j]).size());
        block = (block + block.transpose()).eval();
        block.diagonal().array() += 3 * degree + 6;
      }
      A.row.push_back(row);
      A.value.insert(A.value.end(), block.data(), block.data() + 9);
    }
    A.start.push_back(static_cast<std::uint32_t>(A.row.size()));
  }
  return A;
}

Eigen::MatrixXd dense_of(const BlockMatrix& A) {
  return Eigen::MatrixXd(leading_scalars(A, A.size())).selfadjointView<Eigen::Lower>();
}

/// Row by row, 12 numbers each.
AlignedDoubles twelve(const Eigen::MatrixXd& B) {
  AlignedDoubles X(static_cast<std::size_t>(12 * B.rows()));
  for (Eigen::Index i = 0; i < B.rows(); ++i) {
    for (Eigen::Index k = 0; k < 12; ++k) X[static_cast<std::size_t>(12 * i + k)] = B(i, k);
  }
  return X;
}

/// FNV-1a over the bytes of numbers.
std::uint64_t hash_of(const Eigen::VectorXd& x) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (double value : x) {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    for (int byte = 0; byte < 8; ++byte) {
      hash = (hash ^ ((bits >> (8 * byte)) & 255)) * 1099511628211ULL;
    }
  }
  return hash;
}

}  // namespace

TEST_CASE("solves in blocks agree with dense ones on graphs of every shape",
          "[mechanics][block_factor]") {
  std::mt19937 random(4);
  INFO("seed 4");
  FactorScratch scratch;  // one for all, as a simulation may keep it
  for (const NamedGraph& g : graphs(random)) {
    INFO(g.name);
    const BlockAnalysis analysis = analyse(g.graph);
    const BlockMatrix A = random_matrix(g.graph, analysis, random);
    const auto n = static_cast<Eigen::Index>(g.graph.size());
    const Eigen::VectorXd mass = Eigen::VectorXd::Constant(n, 0.5);
    BlockFactor L;
    factor(L, analysis, {A, mass, 2, 3}, scratch);
    REQUIRE(L.positive_definite);
    if (n == 0) continue;
    Eigen::MatrixXd dense = 3 * dense_of(A);
    dense.diagonal().array() += 1;
    const Eigen::MatrixXd B = Eigen::MatrixXd::NullaryExpr(
        3 * n, 12, [&] { return static_cast<double>(random() % 1000) / 500 - 1; });
    const Eigen::MatrixXd expected = dense.llt().solve(B);
    Eigen::VectorXd x = B.col(0);
    solve(x.data(), L, analysis);
    CHECK((x - expected.col(0)).norm() <= 1e-13 * expected.col(0).norm());
    AlignedDoubles X = twelve(B);
    solve_12(X.data(), L, analysis);
    double worst = 0;
    for (Eigen::Index i = 0; i < 3 * n; ++i) {
      for (Eigen::Index k = 0; k < 12; ++k) {
        worst = std::max(worst, std::abs(X[static_cast<std::size_t>(12 * i + k)] - expected(i, k)));
      }
    }
    CHECK(worst <= 1e-13 * expected.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("products in blocks agree with dense ones", "[mechanics][block_factor]") {
  std::mt19937 random(5);
  INFO("seed 5");
  for (const NamedGraph& g : graphs(random)) {
    INFO(g.name);
    const BlockMatrix A = random_matrix(g.graph, analyse(g.graph), random);
    const Eigen::VectorXd x = Eigen::VectorXd::Random(static_cast<Eigen::Index>(3 * A.size()));
    Eigen::VectorXd y(x.size());
    multiply(y.data(), A, x.data());
    CHECK((y - dense_of(A) * x).norm() <= 1e-14 * (1 + y.norm()));
    CHECK(std::abs(quadratic_form(A, x.data()) - x.dot(y)) <= 1e-13 * (1 + x.norm() * y.norm()));
  }
}

TEST_CASE("every row below a supernode's columns lies in an ancestor of it",
          "[mechanics][block_factor]") {
  std::mt19937 random(6);
  INFO("seed 6");
  for (const NamedGraph& g : graphs(random)) {
    INFO(g.name);
    const BlockAnalysis analysis = analyse(g.graph);
    std::uint32_t next = 0;
    for (std::size_t s = 0; s < analysis.supernodes.size(); ++s) {
      const Supernode& node = analysis.supernodes[s];
      CHECK(node.first == next);
      next = node.end;
      for (std::uint32_t row : analysis.rows_below(node)) {
        std::uint32_t above = node.parent;
        while (above != Supernode::none && above != analysis.supernode_of[row]) {
          above = analysis.supernodes[above].parent;
        }
        CHECK(above == analysis.supernode_of[row]);
      }
    }
    CHECK(next == g.graph.size());
  }
}

TEST_CASE("the factor of a body solves as Eigen's does", "[mechanics][block_factor]") {
  std::mt19937 random(7);
  INFO("seed 7");
  for (const bool held : {false, true}) {
    const Body body = shaken(kuhn_block({7, 4, 3}, {1, 0.5, 0.4}), 0.02, random);
    MechanicsState state = state_of(body, Material{});
    MechanicsScratch scratch;
    if (held) {
      state.motions.push_back({});
      for (std::size_t v = 0; v < body.rest.size(); ++v) {
        if (body.rest[v].x() < -0.3) state.vertices.support[v] = MotionId{0};
      }
      const ComponentId all{0};
      rebuild(state, body.corners, {&all, 1}, scratch);
    }
    ComponentSystem system;
    std::vector<std::uint32_t> local_row(body.rest.size());
    build_system(system, local_row, state, body.corners, state.components[0]);
    CHECK((system.free_count < system.size()) == held);
    const double h = 1e-3;
    factor_system(system, {.mass = 1, .stiffness = h * h});
    Eigen::SparseMatrix<double> A = leading_scalars(system.stiffness, system.free_count);
    A *= h * h;
    for (Eigen::Index i = 0; i < A.cols(); ++i) A.coeffRef(i, i) += system.shape.mass[i / 3];
    const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> eigen(A);
    const Eigen::MatrixXd B = Eigen::MatrixXd::Random(A.rows(), 3);
    Eigen::MatrixXd X = B;
    solve_system(system, X);
    const Eigen::MatrixXd expected = eigen.solve(B);
    CHECK((X - expected).norm() <= 1e-11 * expected.norm());
  }
}

TEST_CASE("what is not positive definite has no factor, and its answers are not numbers",
          "[mechanics][block_factor]") {
  std::mt19937 random(8);
  INFO("seed 8");
  const Body body = kuhn_block({2, 2, 2}, {1, 1, 1});
  const MechanicsState state = state_of(body, Material{});
  ComponentSystem system;
  std::vector<std::uint32_t> local_row(body.rest.size());
  build_system(system, local_row, state, body.corners, state.components[0]);
  for (const double mass : {-1.0, std::nan("")}) {
    factor_system(system, {.mass = mass, .stiffness = 1e-6});
    CHECK_FALSE(system.step.factor.positive_definite);
    Eigen::VectorXd x = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(3 * system.size()));
    solve_system(system, x);
    CHECK(x.array().isNaN().all());
    const std::uint32_t first = 0;
    touch_compliance(system, {&first, 1});
    CHECK(system.step.compliance.array().isNaN().all());
  }
}

TEST_CASE("a factor and its answers are the same bytes everywhere", "[mechanics][block_factor]") {
  std::mt19937 random(9);
  Edges edges;
  for (std::uint32_t i = 0; i < 216; ++i) {
    if (i % 6 != 5) edges.insert({i, i + 1});
    if (i / 6 % 6 != 5) edges.insert({i, i + 6});
    if (i + 36 < 216) edges.insert({i, i + 36});
  }
  const NamedGraph g = graph_of("cube", 216, edges);
  const BlockAnalysis analysis = analyse(g.graph);
  const BlockMatrix A = random_matrix(g.graph, analysis, random);
  const Eigen::VectorXd mass = Eigen::VectorXd::Constant(216, 0.25);
  FactorScratch scratch;
  BlockFactor L, again;
  factor(L, analysis, {A, mass, 1, 1}, scratch);
  factor(again, analysis, {A, mass, 1, 1}, scratch);
  REQUIRE(L.panels.size() == again.panels.size());
  CHECK(std::memcmp(L.panels.data(), again.panels.data(), 8 * L.panels.size()) == 0);
  Eigen::VectorXd x(648);
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = static_cast<double>(i % 17) - 8;
  solve(x.data(), L, analysis);
  // Pinned: with and without AVX2.
  CHECK(hash_of(x) == 0xe1d042ec055b57a5);
}
