// SPDX-License-Identifier: MIT
// The constant matrices of one component in its body frame: K, a factor of A, columns of A^-1.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Dense>

#include "mechanics/frame/mean_axis.hpp"
#include "mechanics/solver/block_factor.hpp"
#include "mechanics/solver/factor_border.hpp"
#include "mechanics/state/component.hpp"
#include "mechanics/state/mechanics_state.hpp"

namespace sunder {

/// A = mass M + stiffness K: the matrix of every second-order implicit scheme, constant in the
/// component's frame for one step size.
struct SystemMatrix {
  double mass = 1;       ///< no unit
  double stiffness = 0;  ///< s^2
  friend bool operator==(const SystemMatrix&, const SystemMatrix&) = default;
};

/// The factor of one A with the parts of its inverse computed so far.
struct SystemFactor {
  BlockFactor factor;
  BorderFactor border;
  bool factored = false;
  SystemMatrix matrix;  ///< matrix of `factor`, when factored

  /// Compliance cache: the local vertices touched so far and A^-1 between them, 3 k x 3 k.
  std::vector<std::uint32_t> touched;
  Eigen::MatrixXd compliance;  ///< 1/kg; body frame; capacity grows by doubling
  std::vector<char> needed;    ///< supernodes that entries between touched vertices depend on
  /// Scratch of `solve_system` for extended rows.
  mutable std::vector<double> extended;
};

/// Everything constant between two changes of a component.
struct ComponentSystem {
  /// Its own numbering, n: free vertices in the order in which they are eliminated, then those held
  /// along all axes. So the free dofs are the leading block of every matrix and the factor needs no
  /// permutation.
  std::vector<VertexId> order;
  std::size_t free_count = 0;
  /// Scalar rows (3 i + axis) of free vertices that are held along some axes, ascending. In factors
  /// they stand for themselves; `solve_system` takes nothing there and gives nothing.
  std::vector<std::uint32_t> held_scalars;
  RestShape shape;         ///< in that order
  BlockMatrix stiffness;   ///< K, all n vertices, N/m
  BlockAnalysis analysis;  ///< of the free vertices, or of those that the factor was made for
  /// Extended row of every free vertex; empty: its own number.
  std::vector<std::uint32_t> factor_row;
  FactorBorder border;
  std::uint32_t border_age = 0;  ///< parts of steps that the border has served

  SystemFactor step;

  /// Its input, by which a later split identifies copies and their originals.
  std::vector<TetId> tetrahedra;
  std::vector<Corners> corners;
  std::vector<EdgeNodes> edge_nodes;  ///< empty where all are of first order
  std::vector<VertexId> row_vertex;   ///< of every extended row

  std::size_t size() const { return order.size(); }
};

/// How far a border goes: this many copies, but one to this many vertices of the factor at most,
/// for this many parts of steps. Fixed numbers, so that results do not depend on timing; where a
/// new factor costs as much is measured by `sunder bench step`.
struct BorderLimits {
  static constexpr std::size_t copies = 32, vertices_to_copy = 20;
  static constexpr std::uint32_t age = 100;
};

/// The input of systems.
struct SystemInput {
  const MechanicsState& state;
  std::span<const Corners> corners;  ///< |T|
  const Component& component;
};

/// Makes K and the numbering of `component`; writes its rows of `local_row`. No factor yet.
/// O(blocks of L), 3 ms at 6 000 tetrahedra.
void build_system(ComponentSystem& system, std::span<std::uint32_t> local_row,
                  const MechanicsState& state, std::span<const Corners> corners,
                  const Component& component);

/// Gives the result of `build_system`, but the factor of `old` serves on under a border. `old` is
/// the system of the same component before vertices of it split or pieces came off it. False, with
/// `system` unfinished, where that cannot be or would not pay: too many copies (`BorderLimits`),
/// more than half gone, no factor, or other vertices held. Moves the parts that it needs out of
/// `old`.
bool extend_system(ComponentSystem& system, ComponentSystem& old,
                   std::span<std::uint32_t> local_row, const SystemInput& input);

/// Factors A over the free dofs unless that very matrix is factored already. Drops the compliance
/// cache when the matrix changes. 10 ms at 6 000 tetrahedra.
void factor_system(ComponentSystem& system, const SystemMatrix& matrix);

/// x <- A^-1 x over the free vertices (3 free_count rows, any number of columns), in place; zero at
/// `held_scalars`, for any input there. Becomes NaN where A was not positive definite, which only
/// an overflow can bring about.
void solve_system(const ComponentSystem& system, Eigen::Ref<Eigen::MatrixXd> x);

/// Marks the supernodes on which the rows of free vertices (local) depend: their own and all above.
void mark_supernodes(std::vector<char>& marked, const ComponentSystem& system,
                     std::span<const std::uint32_t> vertices);

/// y = K x, all n vertices.
void multiply_stiffness(Eigen::Ref<Eigen::VectorXd> y, const ComponentSystem& system,
                        const Eigen::Ref<const Eigen::VectorXd>& x);

/// Up to four vertices with columns of A^-1 that are solved for together: twelve right-hand sides
/// fill the registers.
struct ColumnBlock {
  static constexpr std::uint32_t size = 4;
  ComponentSystem* system = nullptr;
  std::uint32_t count = 0;
  std::array<std::uint32_t, size> place{};  ///< in `SystemFactor::touched`

  std::span<const std::uint32_t> places() const { return {place.data(), count}; }
};

/// Scratch of one thread at work on columns.
struct ColumnScratch {
  AlignedDoubles X;
  std::vector<char> loaded;
};

/// Gives `local_vertices` (free ones, in the system's numbering) places in the compliance cache.
/// The columns of new ones are appended to `missing`; the cache is right after `fill_columns`.
std::vector<std::uint32_t> note_touched(ComponentSystem& system,
                                        std::span<const std::uint32_t> local_vertices,
                                        std::vector<ColumnBlock>& missing);

/// Solves for columns, block by block: same bytes for any number of threads. `scratch`: one a
/// thread.
void fill_columns(std::span<const ColumnBlock> blocks, unsigned threads,
                  std::vector<ColumnScratch>& scratch);

/// Both at once, on one thread: three back-solves for each new vertex.
std::vector<std::uint32_t> touch_compliance(ComponentSystem& system,
                                            std::span<const std::uint32_t> local_vertices);

}  // namespace sunder
