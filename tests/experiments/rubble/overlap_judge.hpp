// SPDX-License-Identifier: MIT
// An outside judge of overlaps: knows corners of tetrahedra and whose piece they are, nothing else.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mechanics/state/vec3.hpp"
#include "topology/base/finding.hpp"

namespace sunder::test {

/// One frame: what viewers see.
struct JudgedFrame {
  std::vector<Vec3> points;                             ///< m
  std::vector<Vec3> velocity;                           ///< m/s, row = point; may be empty
  std::vector<Vec3> shift;                              ///< m, from the rest shape; may be empty
  std::vector<std::array<std::uint32_t, 4>> tetrahedra;  ///< rows of points
  std::vector<std::uint32_t> piece;                     ///< row = tetrahedron
};

/// What the judge found. Lengths over the mean edge of all tetrahedra are shares, not per cent.
struct Verdict {
  double mean_edge = 0;              ///< m
  std::size_t pieces = 0, pairs = 0;  ///< pairs of tetrahedra of different pieces that overlap
  double deepest = 0, mean = 0;      ///< overlap over the mean edge; the mean over `pairs`
  std::array<std::uint32_t, 2> where{};  ///< tetrahedra that overlap most
  std::size_t below = 0;    ///< vertices below the floor by more than a thousandth of the mean edge
  double lowest = 0;        ///< of the vertices below the floor, over the mean edge, >= 0
  std::size_t through = 0;  ///< pieces whose middle is below the floor
  /// By lumped corners of unit density: m^3 m/s, m^4 m/s about the origin, m^5/s^2.
  Vec3 momentum = Vec3::Zero(), angular = Vec3::Zero();
  double kinetic = 0, fastest = 0;  ///< the latter in m/s
};

/// Judges one frame, floor z = `floor` (m). Overlap of two tetrahedra is the least way that parts
/// them, by all axes of faces and pairs of edges (`separation_by_all_axes`); pairs by a grid of its
/// own. Less than a millionth of the mean edge counts as none: faces that were one meet to rounding.
/// O(tetrahedra + pairs whose boxes overlap).
Verdict judge_frame(const JudgedFrame& frame, double floor);

/// The same pairs by comparing each tetrahedron with each: the slow twin for tests.
Verdict judge_frame_slowly(const JudgedFrame& frame, double floor);

/// A frame of `sunder run` (VTU). Errors: those of `read_file_mesh`; no_pieces where it has no cell
/// data `component`.
Result<JudgedFrame> read_judged_frame(const std::string& path);

}  // namespace sunder::test
