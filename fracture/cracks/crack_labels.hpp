// SPDX-License-Identifier: MIT
// Cracks as surfaces of their own: on which side of each the tetrahedra lie, and where it passes.
#pragma once

#include <span>
#include <vector>

#include "fracture/cracks/crack_label.hpp"
#include "mechanics/state/vec3.hpp"
#include "topology/kernel/fan.hpp"
#include "topology/kernel/volume_map.hpp"

namespace sunder {

/// Where a crack broke a vertex.
struct CrackAnchor {
  CrackId crack;
  /// The row that broke and, where it split, its first copy: one on each side.
  VertexId vertex, copy;
  Vec3 at = Vec3::Zero();      ///< m, rest frame
  Vec3 normal = Vec3::Zero();  ///< unit length, rest frame, towards the crack's positive side
  /// `time`, s: when it broke. Points within `reach` (m) keep their old stress until the release
  /// wave, at `wave_speed` (m/s), arrives. Reach 0: the wave has passed everywhere.
  double time = 0, wave_speed = 0, reach = 0;
  /// 1 + the row of the crack's anchor before; 0: none.
  std::uint32_t before = 0;
};

/// The cracks of all bodies. Crack k labels tetrahedra + or -. Its faces are sewn faces between the
/// two that were unsewn at a broken vertex: the coboundary of the labelling, as far as it has
/// broken. Labels never change, so fans of one crack commute: in any order the same half-faces are
/// unsewn (docs/explanation/cracks.md). Empty with `CrackMode::paper`.
struct CrackLabels {
  std::uint32_t cracks = 0;
  std::vector<CrackLabel> labels;          ///< in the order in which they were decided
  std::vector<std::uint32_t> last_label;   ///< |T|: 1 + its newest label; 0: none
  std::vector<CrackAnchor> anchors;        ///< in the order in which vertices broke
  std::vector<std::uint32_t> last_anchor;  ///< row = CrackId: 1 + its newest anchor; 0: none
  std::vector<CrackId> of_face;            ///< 4 |T|: the crack that unsewed a half-face
};

/// The side of one tetrahedron of a star.
enum class Side : char { undecided, negative, positive };
Side side_of(const CrackLabels& cracks, CrackId crack, TetId tetrahedron);

/// The sides of a crack in a vertex' star.
struct CrackAtVertex {
  CrackId crack;
  bool positive = false, negative = false;

  /// The crack's front passes through the vertex: across faces still sewn its star holds both
  /// sides, so that its fan is not empty. Else the crack is surface to it, or near.
  bool is_front() const { return positive && negative; }
};

/// Every crack that has labelled a tetrahedron of `star`, in rising order. O(labels of the star).
std::vector<CrackAtVertex> cracks_at(const CrackLabels& cracks, const VertexStar& star);

/// A new crack without labels. `tetrahedra`: |T| of the map.
CrackId add_crack(CrackLabels& cracks, std::size_t tetrahedra);

/// Labels a tetrahedron that has no label of the crack.
void add_label(CrackLabels& cracks, CrackId crack, TetId tetrahedron, bool positive);

/// `before` is filled in here.
void add_anchor(CrackLabels& cracks, CrackAnchor anchor);

/// Whether its wave is under way at `time` and has not come as far as `distance` from it (m).
bool holds_back(const CrackAnchor& anchor, double time, double distance);

/// The first anchor with its wave under way at `time`, as a row. O(anchors).
std::size_t first_under_way(const CrackLabels& cracks, double time);

/// A crack's plane, or the mean of several.
struct CrackPlane {
  Vec3 normal = Vec3::Zero();  ///< rest frame, towards the positive side; zero: unknown
  Vec3 at = Vec3::Zero();      ///< m, rest frame, a point of it
};

/// Whether one of an anchor's rows lies in a component. `component`, row = VertexId.
bool is_in(std::span<const ComponentId> component, ComponentId own, const CrackAnchor& anchor);

/// Sums of a crack's anchors near a place, weighted by exp(-r^2 / (2 h^2)) of their distance r at
/// rest, r <= 3 h: of normals, points and weights.
struct AnchorSums {
  Vec3 normal = Vec3::Zero();
  Vec3 at = Vec3::Zero();
  double weight = 0;
};

/// Only anchors in the component `own` count (`is_in`); all if that is none().
/// O(anchors of the crack).
AnchorSums anchors_near(const CrackLabels& cracks, CrackId crack, const Vec3& place, double h,
                        std::span<const ComponentId> component, ComponentId own);

}  // namespace sunder
