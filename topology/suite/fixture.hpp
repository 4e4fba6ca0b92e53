// SPDX-License-Identifier: MIT
// Fixtures: a body, operations on it and what must come out, as meshes/suite/*.json hold them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "topology/fan.hpp"
#include "topology/finding.hpp"
#include "topology/suite/operation.hpp"
#include "topology/tet_mesh.hpp"

namespace sunder::suite {

/// A face by its three points on the intact body, or by one side of it at any time.
using FaceName = std::variant<std::array<std::uint32_t, 3>, FaceSide>;
/// A vertex by its point (needs: one orbit there), or by one of its corners.
using VertexName = std::variant<std::uint32_t, CornerAt>;

struct SplitFace {
  FaceName face;
};
/// Glues what a split parted: the two sides that the face of these points had on the intact body,
/// or two sides with the same three points.
struct GlueFace {
  std::variant<std::array<std::uint32_t, 3>, std::array<FaceSide, 2>> face;
};
/// Splits the fan of a vertex for a normal, in rising order of (tetrahedron, place).
struct SplitFan {
  VertexName vertex;
  Point normal;
};
/// Splits the section of a plane, in that order too.
struct SplitPlane {
  CuttingPlane plane;
};
/// Splits every face that is still glued, in an order of the intact body's interior faces.
struct Shatter {
  enum class Order { rising, falling, seeded };
  Order order = Order::rising;
  /// seeded only: the order is that of docs/suite.md.
  std::uint64_t seed = 0;
};
using Operation = std::variant<SplitFace, GlueFace, SplitFan, SplitPlane, Shatter>;

/// What is expected at one moment; absent: not said.
struct Expected {
  std::optional<CellCounts> counts;
  std::optional<std::ptrdiff_t> euler_characteristic;
  /// By field, 2 or 3.
  std::map<int, BettiNumbers> betti_mod;
  std::optional<IntegerHomology> homology;
  std::optional<bool> orientable;
  /// Of the operation: what each split did, in order.
  std::optional<std::vector<SplitAnswer>> splits;
  /// Of the operation: how many splits parted (s_v, s_e) vertices and edges.
  std::optional<std::map<std::array<int, 2>, std::size_t>> tally;
  /// Of the operation: faces at which the oracle says yes, and those that parted a component.
  std::optional<std::size_t> predicted, separations;
};

/// Where a named kernel is known to differ from the expectation, and why.
struct KnownDifference {
  std::string kernel;
  std::string why;
  /// Counts right after loading; absent: the kernel refuses the body.
  std::optional<CellCounts> counts;
};

struct ExpectedOperation {
  Operation operation;
  Expected after;
};

struct Fixture {
  /// "09-figure-5/abc": file and case.
  std::string name;
  /// What it shows, and from where it is.
  std::string shows, source;
  TetMesh body;
  /// Codes of all findings of the body, sorted; with `refused` one of them is an error.
  std::vector<std::string> findings;
  bool refused = false;
  /// Distinct index tuples: vertices, edges, faces of the file.
  std::optional<std::array<std::size_t, 3>> file_cells;
  Expected built;
  std::vector<ExpectedOperation> operations;
  std::vector<KnownDifference> known_differences;
};

/// Reads a fixture file with all its cases (docs/suite.md). Errors, all of them: cannot_open,
/// bad_fixture (with the place inside the JSON), and those of a mesh it refers to.
/// Leaves: operations name faces and corners that the intact body has; faces to glue are interior.
Result<std::vector<Fixture>> read_fixtures(const std::filesystem::path& file);

/// All fixtures of a folder's *.json files (*.schema.json aside), files in the order of their
/// names. Errors likewise, and no_fixture.
Result<std::vector<Fixture>> read_fixture_folder(const std::filesystem::path& folder);

}  // namespace sunder::suite
