// SPDX-License-Identifier: MIT
// Starts that are one crack, and votes of planes on tetrahedra.
#include "fracture/breaking/decide_sides.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include "fracture/breaking/choose_crack.hpp"
#include "mechanics/state/settings/material.hpp"
#include "topology/base/union_find.hpp"

namespace sunder {
namespace {

/// A fan that starts a crack.
struct Start {
  std::size_t plan = 0;
  Vec3 place = Vec3::Zero();
  double h = 0;
  ComponentId component;
};

std::vector<Start> starts_of(const Cells& cells, const MechanicsState& mechanics,
                             std::span<const PlannedFan> plans) {
  std::vector<Start> starts;
  for (std::size_t p = 0; p < plans.size(); ++p) {
    if (!plans[p].crack.is_none()) continue;
    const VertexId v = plans[p].v.vertex;

    starts.push_back({p, Vec3(cells.map.point(v).data()),
                      mean_edge_length(mechanics.vertices, cells.map.corners(), plans[p].v),
                      cells.labels.of_vertex[v.index()]});
  }
  return starts;
}

bool are_one_crack(const Start& a, const Start& b, std::span<const PlannedFan> plans) {
  if (a.component != b.component) return false;
  const double h = std::min(a.h, b.h);
  const Vec3 way = a.place - b.place;
  const Vec3& normal = plans[a.plan].normal;
  const Vec3& other = plans[b.plan].normal;
  return way.norm() <= 3 * h && std::abs(normal.dot(other)) >= cos_branch_angle &&
         std::abs(normal.dot(way)) <= h / 2 && std::abs(other.dot(way)) <= h / 2;
}

void name_starts(Cells& cells, const MechanicsState& mechanics, std::span<PlannedFan> plans) {
  const std::vector<Start> starts = starts_of(cells, mechanics, plans);
  UnionFind groups(starts.size());
  const auto count = static_cast<std::uint32_t>(starts.size());
  for (std::uint32_t a = 0; a < count; ++a) {
    for (std::uint32_t b = 0; b < a; ++b) {
      if (are_one_crack(starts[a], starts[b], plans)) groups.join(a, b);
    }
  }
  for (std::uint32_t s = 0; s < count; ++s) {
    PlannedFan& plan = plans[starts[s].plan];
    const std::uint32_t first = groups.root(s);  // the lowest of them
    if (first == s) {
      plan.crack = add_crack(cells.cracks, cells.map.tetrahedra());
      continue;
    }
    const PlannedFan& leader = plans[starts[first].plan];
    plan.crack = leader.crack;
    if (plan.normal.dot(leader.normal) < 0) plan.normal = -plan.normal;
  }
}

}  // namespace

void decide_sides(Cells& cells, const MechanicsState& mechanics, std::span<PlannedFan> plans) {
  name_starts(cells, mechanics, plans);
  std::map<std::pair<CrackId, TetId>, double> sums;
  std::vector<std::vector<CentreDistance>> distances;
  for (const PlannedFan& plan : plans) {
    distances.push_back(distances_of(cells, plan.v, {plan.normal, plan.at}));
    for (std::size_t i = 0; i < plan.v.corners.size(); ++i) {
      sums[{plan.crack, tetrahedron_of(plan.v.corners[i])}] += distances.back()[i].distance;
    }
  }
  for (std::size_t p = 0; p < plans.size(); ++p) {
    PlannedFan& plan = plans[p];
    plan.positive.clear();
    for (std::size_t i = 0; i < plan.v.corners.size(); ++i) {
      const TetId t = tetrahedron_of(plan.v.corners[i]);
      const Side known = side_of(cells.cracks, plan.crack, t);
      plan.positive.push_back(known == Side::undecided
                                  ? sums[{plan.crack, t}] >= -distances[p][i].tolerance
                                  : known == Side::positive);
    }
  }
}

void note_crack(Cells& cells, const MechanicsState& mechanics, const PlannedFan& fan,
                FanEvent& event) {
  CrackLabels& cracks = cells.cracks;
  event.crack = fan.crack;
  for (std::size_t i = 0; i < fan.v.corners.size(); ++i) {
    const TetId t = tetrahedron_of(fan.v.corners[i]);
    if (side_of(cracks, fan.crack, t) != Side::undecided) continue;
    add_label(cracks, fan.crack, t, fan.positive[i] != 0);
    event.labels.push_back(cracks.labels.back());
  }
  event.anchor = fan.at;
  CrackAnchor anchor{fan.crack, fan.v.vertex, VertexId::none(), fan.at, fan.normal};
  const TetId first = tetrahedron_of(fan.v.corners.front());
  anchor.time = mechanics.time;
  anchor.wave_speed = compression_wave_speed(material_of(mechanics, first));
  anchor.reach = std::max(3 * mean_edge_length(mechanics.vertices, cells.map.corners(), fan.v),
                          anchor.wave_speed * fan.untested);
  for (const FaceSplit& split : event.faces) {
    cracks.of_face[split.face.index()] = cracks.of_face[split.opposite.index()] = fan.crack;
    for (int i = 0; i < split.vertex_count && anchor.copy.is_none(); ++i) {
      if (split.split_vertices[i].old_row == anchor.vertex) {
        anchor.copy = split.split_vertices[i].new_row;
      }
    }
  }
  add_anchor(cracks, anchor);
}

}  // namespace sunder
