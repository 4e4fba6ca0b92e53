// SPDX-License-Identifier: MIT
// The one pass behind check_mesh and build_map: adjacency, orientation, orbits, and faults.
// Internal. Works in the mesh's own numbering; `finish_rows` exchanges corners only at the end.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "topology/base/finding.hpp"
#include "topology/base/tet_mesh.hpp"
#include "topology/kernel/counts.hpp"
#include "topology/kernel/volume_map.hpp"
#include "topology/mesh/check.hpp"

namespace sunder {

/// The state of a mesh during its survey; columns have one entry per tetrahedron or corner.
struct Survey {
  const TetMesh& mesh;
  Severity bad_volume = Severity::error;
  std::vector<Finding> findings = {};

  /// Tetrahedra of four different points in range, and no copy of an earlier one.
  std::vector<char> usable = {};
  /// Sign of the volume where it stands out of rounding, 0 where it does not.
  std::vector<signed char> sign = {};
  /// Half-face across each face, in the mesh's numbering; none() at the boundary.
  std::vector<std::array<HalfFaceId, 4>> neighbours = {};
  /// Bit p: the outward order of face p is an odd permutation of its sorted points.
  std::vector<std::uint8_t> odd = {};
  /// Corners 2 and 3 are to be exchanged.
  std::vector<char> flipped = {};
  /// Vertex row of each corner, and the point of each row.
  std::vector<std::array<std::uint32_t, 4>> rows = {};
  std::vector<std::uint32_t> point_of_row = {};

  /// Sets of tetrahedra that hang together by faces; those of them without a boundary.
  std::size_t components = 0, closed_components = 0;
  /// Edge orbits, and how many of them end in each row.
  std::size_t edges = 0;
  std::vector<std::uint32_t> edges_at_row = {};

  /// Whether `places` is filled.
  bool keeps_places = false;
  std::vector<FindingPlaces> places = {};
};

/// Which corner of a tetrahedron the point is (one of them).
inline int place_of_point(const std::array<std::uint32_t, 4>& t, std::uint32_t p) {
  return t[0] == p ? 0 : t[1] == p ? 1 : t[2] == p ? 2 : 3;
}

/// The places that share a finding: counts all, keeps the first few, or all when asked.
class Places {
 public:
  explicit Places(PlaceKind kind, bool keeps_all = false) : kind_(kind), keeps_all_(keeps_all) {}
  void add(std::size_t row) { add(std::array{static_cast<std::uint32_t>(row)}); }
  /// A place that takes as many rows as its kind says.
  template <std::size_t N>
  void add(const std::array<std::uint32_t, N>& place) {
    ++count_;
    if (keeps_all_ || rows_.size() + N <= Finding::max_ids) {
      rows_.insert(rows_.end(), place.begin(), place.end());
    }
  }
  PlaceKind kind() const { return kind_; }
  std::size_t count() const { return count_; }
  const std::vector<std::uint32_t>& rows() const { return rows_; }

 private:
  PlaceKind kind_;
  bool keeps_all_;
  std::size_t count_ = 0;
  std::vector<std::uint32_t> rows_;
};

/// Code, severity, text and remedy of a finding. In `text`, "%" stands for the number of places.
struct FindingWords {
  const char* code;
  Severity severity;
  const char* text;
  const char* remedy;
};

/// Appends a finding when it has a place, and its places where the survey keeps them.
void report(Survey& survey, const FindingWords& words, const Places& places);

/// Rows and darts are numbered in 32 bits, 12 darts per tetrahedron.
inline constexpr std::size_t most_tetrahedra = 0xffffffffU / 12;
inline constexpr std::size_t most_points = 0xffffffffU;

/// Reports a mesh of more than `tetrahedra` or `points`; nothing else can be asked of it then.
void survey_size(Survey& survey, std::size_t tetrahedra, std::size_t points);

/// Stages, in this order. Each reads the results of the earlier ones.
void survey_entries(Survey& survey);      // ranges, numbers, repeated vertices, volumes
void survey_faces(Survey& survey);        // adjacency, copies, overfull faces
void survey_orientation(Survey& survey);  // parity walk, then geometry
void survey_vertices(Survey& survey);     // orbits, pinches, unused and coincident points

/// All stages. Findings are sorted, errors first.
Survey survey_mesh(const TetMesh& mesh, Severity bad_volume, bool keeps_places = false);

/// Errors first; those of one severity stay in their order.
void sort_findings(std::vector<Finding>& findings);

/// Stages that only a check of a whole file needs; check.hpp lists their findings.
void survey_links(Survey& survey);    // needs a survey without errors but those of volumes
void survey_contact(Survey& survey);  // needs finite coordinates
void survey_triangles(Survey& survey, const std::vector<std::array<std::uint32_t, 3>>& triangles);

/// The counts of `count_cells` for the map of a surveyed mesh, from its neighbours alone.
/// Needs: a survey without errors but those of volumes. O(|T|), about 20 ns each.
Counts count_cells(const Survey& survey);

/// Shapes of the usable tetrahedra with finite coordinates; none where there is no such.
std::optional<Quality> quality_of(const Survey& survey);

/// The rows of a map from a survey without errors.
MapRows finish_rows(Survey&& survey);

}  // namespace sunder
