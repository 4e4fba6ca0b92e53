// SPDX-License-Identifier: MIT
// The frames that a run has left in its folder.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

#include "mechanics/contact/shapes/obstacle.hpp"
#include "mechanics/state/vec3.hpp"
#include "topology/base/finding.hpp"

namespace sunder {

/// One VTU frame. Tetrahedra keep their rows and the order of their corners through a run; vertices
/// that split are appended.
struct ResultFrame {
  double time = 0;               ///< s
  std::filesystem::path file;    ///< it was read from
  std::vector<Vec3> position;    ///< m, a vertex
  std::vector<Vec3> reference;   ///< m, a vertex: where its piece's rigid reference has it
  std::vector<Vec3> crack_move;  ///< m, a vertex: brings crack faces near their planes; may be none
  std::vector<std::array<std::uint32_t, 4>> tetrahedra;
  std::vector<std::int64_t> component;  ///< a tetrahedron
  std::vector<Obstacle> obstacles;      ///< where they are; none where the report has none
};

/// The data of a piece in fragments.csv.
struct ResultPiece {
  double mass = 0;              ///< kg
  std::int64_t birth_step = 0;  ///< in which it came off; 0: the start
};

struct RunResult {
  std::vector<ResultFrame> frames;             ///< in their order, at least one
  std::map<std::int64_t, ResultPiece> pieces;  ///< by component, at the end
  Vec3 gravity{0, 0, 0};                       ///< m/s^2
};

/// Corners of the face opposite to corner `place` of a positive tetrahedron, from outside.
std::array<std::uint32_t, 3> face_of(const std::array<std::uint32_t, 4>& t, int place);

/// Half-faces 4 t + place with no other tetrahedron on the same three vertices. O(|T| log |T|).
std::vector<char> boundary_of(const ResultFrame& frame);

/// Reads frames.pvd, the frames that it names, fragments.csv, and gravity and obstacles of
/// report.json and obstacles.csv in `folder`, as `sunder run` leaves them. Errors: no_result (files
/// or columns that are not there), those of `read_file_mesh`, `read_obstacles` and, of a report
/// that was damaged, `parse_scene_text`.
Result<RunResult> read_run_result(const std::filesystem::path& folder);

}  // namespace sunder
