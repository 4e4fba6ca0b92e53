// SPDX-License-Identifier: MIT
// Labels and anchors as chains through two lists.
#include "fracture/cracks/crack_labels.hpp"

#include <algorithm>
#include <cmath>

#include "topology/base/assert.hpp"
#include "topology/base/elementary.hpp"

namespace sunder {

Side side_of(const CrackLabels& cracks, CrackId crack, TetId tetrahedron) {
  if (cracks.last_label.empty()) return Side::undecided;
  std::uint32_t row = cracks.last_label[tetrahedron.index()];
  while (row > 0) {
    const CrackLabel& label = cracks.labels[row - 1];
    if (label.crack == crack) return label.positive ? Side::positive : Side::negative;
    row = label.before;
  }
  return Side::undecided;
}

std::vector<CrackAtVertex> cracks_at(const CrackLabels& cracks, const VertexStar& star) {
  std::vector<CrackAtVertex> met;
  if (cracks.cracks == 0) return met;
  for (const CornerId c : star.corners) {
    std::uint32_t row = cracks.last_label[tetrahedron_of(c).index()];
    for (; row > 0; row = cracks.labels[row - 1].before) {
      const CrackLabel& label = cracks.labels[row - 1];
      auto at = std::ranges::find(met, label.crack, &CrackAtVertex::crack);
      if (at == met.end()) at = met.insert(met.end(), {label.crack});
      (label.positive ? at->positive : at->negative) = true;
    }
  }
  std::ranges::sort(met, {}, &CrackAtVertex::crack);
  return met;
}

CrackId add_crack(CrackLabels& cracks, std::size_t tetrahedra) {
  if (cracks.last_label.empty()) {
    cracks.last_label.assign(tetrahedra, 0);
    cracks.of_face.assign(4 * tetrahedra, CrackId::none());
  }
  cracks.last_anchor.push_back(0);
  return CrackId{cracks.cracks++};
}

void add_label(CrackLabels& cracks, CrackId crack, TetId tetrahedron, bool positive) {
  SUNDER_ASSERT(side_of(cracks, crack, tetrahedron) == Side::undecided, "labels never change");
  std::uint32_t& last = cracks.last_label[tetrahedron.index()];
  cracks.labels.push_back({crack, tetrahedron, positive, last});
  last = static_cast<std::uint32_t>(cracks.labels.size());
}

void add_anchor(CrackLabels& cracks, CrackAnchor anchor) {
  std::uint32_t& last = cracks.last_anchor[anchor.crack.index()];
  anchor.before = last;
  cracks.anchors.push_back(anchor);
  last = static_cast<std::uint32_t>(cracks.anchors.size());
}

bool holds_back(const CrackAnchor& anchor, double time, double distance) {
  return anchor.reach > 0 && distance <= anchor.reach &&
         anchor.wave_speed * (time - anchor.time) <= distance;
}

std::size_t first_under_way(const CrackLabels& cracks, double time) {
  const auto found = std::ranges::find_if(
      cracks.anchors, [&](const CrackAnchor& a) { return holds_back(a, time, a.reach); });
  return static_cast<std::size_t>(found - cracks.anchors.begin());
}

bool is_in(std::span<const ComponentId> component, ComponentId own, const CrackAnchor& anchor) {
  const auto has = [&](VertexId v) { return !v.is_none() && component[v.index()] == own; };
  return has(anchor.vertex) || has(anchor.copy);
}

AnchorSums anchors_near(const CrackLabels& cracks, CrackId crack, const Vec3& place, double h,
                        std::span<const ComponentId> component, ComponentId own) {
  AnchorSums sums;

  std::uint32_t row = cracks.last_anchor[crack.index()];
  while (row > 0) {
    const CrackAnchor& anchor = cracks.anchors[row - 1];
    row = anchor.before;
    const double squared = (anchor.at - place).squaredNorm();
    if (squared > 9 * h * h) continue;
    if (!own.is_none() && !is_in(component, own, anchor)) continue;
    const double weight = exponential(-squared / (2 * h * h));
    sums.normal += weight * anchor.normal;
    sums.at += weight * anchor.at;
    sums.weight += weight;
  }
  return sums;
}

}  // namespace sunder
