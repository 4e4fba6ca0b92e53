// SPDX-License-Identifier: MIT
// The truth about a fixture, by the twin alone: its operations as steps, the effect of each step,
// and the body at the moments that kernels are asked about. Shared by all kernels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "topology/suite/fixtures/fixture.hpp"
#include "topology/suite/judge/glue_twin.hpp"
#include "topology/suite/judge/judge_checks.hpp"
#include "topology/suite/kernels/operation.hpp"

namespace sunder::suite {

/// The body at one moment.
struct Moment {
  CellCounts counts;
  std::vector<std::uint32_t> vertex_of_corner, component_of_tetrahedron;
  friend bool operator==(const Moment&, const Moment&) = default;
};

struct TrueStep {
  Step step;
  /// split: the side that lay across; meaningless for a face on the boundary.
  FaceSide across;
  SplitAnswer split;
  /// glue: whether both sides were free.
  bool glued = false;
  std::optional<Moment> after;
};

struct TrueOperation {
  std::vector<TrueStep> steps;
  /// Absent where a large body is not looked at.
  std::optional<Moment> after;
  /// Where the fixture expects homology, and the body is small or that over Z is expected.
  std::optional<IntegerHomology> homology;
};

struct Truth {
  /// Whether there is a body to run on; nothing below but `checks` holds without.
  bool is_body = false;
  GlueTwin intact;
  Moment built;
  std::optional<IntegerHomology> homology;
  std::vector<TrueOperation> operations;
  /// Where all operations are breaks: the same ones, last first. They lead to the same map.
  std::vector<TrueOperation> backwards;
  /// The fixture's own expectations, compared with the above; and the laws of a split.
  Checks checks;
};

/// Whether union-find can hold it: rows in range, four different points per tetrahedron, no face in
/// more than two, at least one tetrahedron.
bool is_body(const TetMesh& mesh);

/// Runs a fixture on the twin. A refused fixture has no operations, and `built` is empty.
Truth truth_of(const Fixture& fixture);

}  // namespace sunder::suite
