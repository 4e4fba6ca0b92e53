// SPDX-License-Identifier: MIT
// Judges frames of finished runs: knows corners of tetrahedra and their pieces, nothing else.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mechanics/state/vec3.hpp"
#include "tests/experiments/rubble/outside_judge.hpp"
#include "topology/base/finding.hpp"

namespace sunder::test {

/// One frame: the part that viewers see.
struct JudgedFrame {
  std::vector<Vec3> points;                              ///< m
  std::vector<Vec3> velocity;                            ///< m/s, row = point; may be empty
  std::vector<Vec3> shift;                               ///< m, from the rest shape; may be empty
  std::vector<std::array<std::uint32_t, 4>> tetrahedra;  ///< rows of points
  std::vector<std::uint32_t> piece;                      ///< row = tetrahedron
};

/// The judge's findings.
struct Verdict {
  SeenOverlaps overlaps;  ///< parts are tetrahedra
  std::size_t pieces = 0;
  std::size_t below = 0;    ///< vertices below the floor by more than a thousandth of the mean edge
  double lowest = 0;        ///< m, of the vertices below the floor, >= 0
  std::size_t through = 0;  ///< pieces with their middle below the floor
  /// By lumped corners of unit density: m^3 m/s, m^4 m/s about the origin, m^5/s^2.
  Vec3 momentum = Vec3::Zero(), angular = Vec3::Zero();
  double kinetic = 0, fastest = 0;  ///< the latter in m/s
};

/// Judges one frame, floor z = `floor` (m).
Verdict judge_frame(const JudgedFrame& frame, double floor);

/// The tetrahedra of a frame.
std::vector<SeenPart> parts_of(const JudgedFrame& frame);

/// A frame of `sunder run` (VTU). Errors: those of `read_file_mesh`; no_pieces where it has no cell
/// data `component`.
Result<JudgedFrame> read_judged_frame(const std::string& path);

}  // namespace sunder::test
