// SPDX-License-Identifier: MIT
// A topology kernel as the suite sees it: a name and the questions it can answer. The kernels that
// come with Sunder, and one that runs in another process.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "topology/base/finding.hpp"
#include "topology/base/tet_mesh.hpp"
#include "topology/kernel/plane_side.hpp"
#include "topology/suite/kernels/operation.hpp"

namespace sunder::suite {

/// One kernel with (after `load`) one body. Functions that may be empty say so; the suite then
/// leaves that check out and counts it as not asked.
struct JudgedKernel {
  std::string name;
  /// Takes a body, forgetting any before. Findings as `check_mesh` names them where the kernel has
  /// such checks; an error among them: the body is refused. Flat and folded tetrahedra are no
  /// reason to refuse: this is about topology.
  std::function<std::vector<Finding>(const TetMesh&)> load;
  /// Whether `load` gives every finding of `check_mesh` (warnings and notes too), so that its codes
  /// can be compared with the fixture's; otherwise only its refusals count.
  bool names_findings = false;
  /// Needs: a side of a face of the body.
  std::function<SplitAnswer(FaceSide)> split;
  /// False: refused, nothing changed. Needs: the two sides have the same three points. May be
  /// empty.
  std::function<bool(FaceSide, FaceSide)> glue;
  std::function<CellCounts()> counts;
  /// For each corner 4 t + i (i: place in the file's tetrahedron) a number of its vertex orbit:
  /// equal exactly for corners of one orbit. Which numbers they are does not matter.
  std::function<std::vector<std::uint32_t>()> vertex_of_corner;
  /// Likewise the component of each tetrahedron.
  std::function<std::vector<std::uint32_t>()> component_of_tetrahedron;
  /// Everything the kernel finds wrong with itself (involutions, rows against darts, split laws
  /// since the last call); empty when all is well. May be empty.
  std::function<std::vector<std::string>()> own_faults;
  /// The faces of the fan of a vertex for a normal (section 4.1, algorithm 4), each once from
  /// whichever side, in any order. May be empty.
  std::function<std::vector<FaceSide>(CornerAt, Point)> fan;
  /// The faces, at all copies of a point, between a positive and a negative tetrahedron of a crack,
  /// each once from its positive side, in any order. May be empty.
  std::function<std::vector<FaceSide>(std::uint32_t point, const CrackSides&)> crack_fan;
  /// The faces of the section of a plane through the whole body as it is now, each once from its
  /// positive side, in any order. May be empty.
  std::function<std::vector<FaceSide>(const CuttingPlane&)> plane;
  /// Homology over Z of the body as it is now; nothing when it is too large for the kernel. May be
  /// empty.
  std::function<std::optional<IntegerHomology>()> homology;
  /// Whether the body as it is now is orientable. May be empty.
  std::function<std::optional<bool>()> orientable;
};

/// `VolumeMap` answered by CGAL's darts, rows kept equal to them ("sunder").
JudgedKernel volume_map_kernel();
/// `VolumeMap` of rows alone ("dense").
JudgedKernel dense_map_kernel();
/// `DenseMap`, rows alone, as the coarser of two nested maps ("nested"): the finer one, a
/// `VolumeMap`, has a third of the faces open from the beginning, as cohesive cracks have; that
/// they stay nested is among its own faults.
JudgedKernel nested_kernel();
/// CGAL's map left to itself ("cgal"): cells sewn and unsewn by its managed `sew<3>` and
/// `unsew<3>`, splits counted by its attribute functors on 0- and 1-attributes.
JudgedKernel cgal_kernel();
/// Union-find over corners, edges and tetrahedra ("twin"): no dart, no walk.
JudgedKernel twin_kernel();

/// How long a kernel in another process may take for its name, s, and for an answer about a small
/// body.
constexpr double default_answer_seconds = 10;

/// A kernel in another process that speaks the protocol of docs/reference/suite.md on its stdin
/// and stdout. `command` goes to /bin/sh. It has `seconds` (> 0) to say hello, and (1 + T / 10 000)
/// times as long for an answer about T tetrahedra: kernels in slow languages take some 0.1 ms a
/// tetrahedron to count cells. An answer that is not one, or none within that time, ends the
/// process and throws `KernelLost`.
JudgedKernel process_kernel(const std::string& command, double seconds = default_answer_seconds);

/// Another process died, hung or gave an unreadable answer; `what()` names the question.
struct KernelLost : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// It gave no answer in its time.
struct KernelSilent : KernelLost {
  using KernelLost::KernelLost;
};

}  // namespace sunder::suite
