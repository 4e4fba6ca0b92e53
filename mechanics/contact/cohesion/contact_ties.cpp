// SPDX-License-Identifier: MIT
// From tied corners to rows, and back.
#include "mechanics/contact/cohesion/contact_ties.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "mechanics/contact/solver/tie_row.hpp"
#include "mechanics/ties/tie_law.hpp"
#include "topology/base/sort_unique.hpp"

namespace sunder {
namespace {

VertexId node_of(const StepPaths& paths, HalfFaceId face, std::uint8_t place) {
  return nodes_of(paths.state.elements, paths.corners, tetrahedron_of(face)).row[place];
}

/// Whether the component of a tie deforms in this step.
bool is_at_work(const Tie& tie, const StepPaths& paths) {
  const ComponentId id = paths.state.elements.component[tetrahedron_of(tie.face).index()];
  const Component& component = paths.state.components[id.index()];
  return paths.members.has(id) && deforms(component.rung) && !component.rigid;
}

/// Every corner that has come apart as a pair of its own, sorted by vertices and face.
std::vector<TiePair> corners_apart(ContactMemory& memory, const StepPaths& paths) {
  std::vector<TiePair> all;
  for (Tie& tie : memory.ties) {
    if (!is_at_work(tie, paths)) continue;
    const ComponentId id = paths.state.elements.component[tetrahedron_of(tie.face).index()];
    const Vec3 normal = paths.state.components[id.index()].orientation * tie.normal;
    for (std::size_t k = 0; k < 3; ++k) {
      if (!tie.corners[k].is_apart()) continue;
      TiePair pair{.a = node_of(paths, tie.face, tie.corner[k]),
                   .b = node_of(paths, tie.opposite, tie.opposite_corner[k]),
                   .face = tie.face,
                   .tetrahedron = tetrahedron_of(tie.opposite),
                   .place = tie.opposite_corner[k],
                   .normal = normal,
                   .area = tie.corners[k].area,
                   .shear = tie.shear,
                   .corners = {&tie.corners[k]}};
      if (pair.b < pair.a) {
        std::swap(pair.a, pair.b);
        pair.face = tie.opposite;
        pair.tetrahedron = tetrahedron_of(tie.face);
        pair.place = tie.corner[k];
        pair.normal = -normal;
      }
      all.push_back(std::move(pair));
    }
  }
  std::sort(all.begin(), all.end(), [](const TiePair& p, const TiePair& q) {
    return std::tuple(p.a, p.b, p.face) < std::tuple(q.a, q.b, q.face);
  });
  return all;
}

/// Whether a corner lies in the plane of a pair, within 45 degrees: a crack turns from fan to fan.
bool is_of(const TiePair& corner, const TiePair& pair) {
  constexpr double cos_of_plane = 0.7;
  return pair.a == corner.a && pair.b == corner.b && pair.shear == corner.shear &&
         corner.normal.dot(pair.normal.normalized()) > cos_of_plane;
}

Vec3 opening_at_start(const TiePair& pair, const StepPaths& paths) {
  return paths.at_start(pair.a) - paths.at_start(pair.b);
}

/// N/m; infinite where a corner has not opened.
double stiffness_of(const TiePair& pair) {
  double sum = 0;
  for (const TieCorner* corner : pair.corners) sum += secant_stiffness(*corner);
  return sum;
}

}  // namespace

double give_of(const TiePair& pair, double h) {
  const double stiffness = stiffness_of(pair);
  return stiffness > 0 && std::isfinite(stiffness) ? 1 / (stiffness * h) : 0;
}

double mode_factor(const TiePair& pair, const Vec3& impulse, const Vec3& opening) {
  // A tie has an impulse before it opens.
  return std::sqrt(impulse.isZero(0) ? mode_ratio(opening, pair.normal, pair.shear)
                                     : mode_ratio_of_traction(-impulse, pair.normal, pair.shear));
}

Vec3 opening_at_end(const TiePair& pair, const StepPaths& paths) {
  return paths.predicted[pair.a.index()] - paths.predicted[pair.b.index()];
}

std::vector<TiePair> gather_ties(ContactMemory& memory, const StepPaths& paths) {
  std::vector<TiePair> pairs;
  for (TiePair& corner : corners_apart(memory, paths)) {
    // Those of the same vertices follow each other.
    auto same = pairs.rbegin();
    while (same != pairs.rend() && same->a == corner.a && same->b == corner.b &&
           !is_of(corner, *same)) {
      ++same;
    }
    if (same != pairs.rend() && is_of(corner, *same)) {
      same->normal = same->normal * same->area + corner.normal * corner.area;
      same->normal.normalize();
      same->area += corner.area;
      same->corners.push_back(corner.corners.front());
    } else {
      pairs.push_back(std::move(corner));
    }
  }
  return pairs;
}

double tie_bound(const TiePair& pair, const Vec3& opening) {
  const double effective = effective_opening(opening, pair.normal, pair.shear);
  double sum = 0;
  for (const TieCorner* corner : pair.corners) {
    sum += corner->area * mean_traction(*corner, effective);
  }
  return sum;
}

double opening_end_of(const TiePair& pair) {
  double least = std::numeric_limits<double>::infinity();
  for (const TieCorner* corner : pair.corners) least = std::min(least, corner->opening_end);
  return least;
}

ContactPoint contact_of(const TiePair& pair) {
  ContactPoint contact;
  contact.vertex = pair.a;
  contact.tetrahedron = pair.tetrahedron;
  contact.face = pair.face;
  contact.weights = {};
  if (pair.place < 4) {
    contact.weights[pair.place] = 1;
  } else {
    // In the middle of an edge the shape functions of all other nodes are nothing.
    for (const int end : edge_ends[pair.place - 4]) contact.weights[end] = 0.5;
  }
  contact.normal = pair.normal;
  return contact;
}

double measure_tie(Constraint& row, const TiePair& pair, const Vec3& impulse,
                   const StepPaths& paths) {
  const double h = paths.time_step;
  const Vec3 end = opening_at_end(pair, paths);
  row.normal = pair.normal;
  // The response is still that of the solve before.
  if (!row.is_bond()) row.law = CohesiveBond{};
  CohesiveBond& bond = row.bond();
  bond.sliding_stiffness = sliding_stiffness(pair.shear);
  bond.most = h * tie_bound(pair, end) * mode_factor(pair, impulse, end);
  row.compliance = give_of(pair, h);
  row.impulse = impulse;
  row.slip = end;
  if (!(bond.response > 0)) return row.slip.norm();
  return (bond_wanted(row, row.slip) - impulse).norm() * bond.response;
}

bool settle_tie(TieReport& report, TiePair& pair, const TieOpening& opening, const Vec3& force) {
  const double before = effective_opening(opening.start, pair.normal, pair.shear);
  const double now = effective_opening(opening.end, pair.normal, pair.shear);
  const double mode_before = mode_ratio(opening.start, pair.normal, pair.shear);
  const double mode = mode_ratio(opening.end, pair.normal, pair.shear);
  report.work -= force.dot(opening.end - opening.start);
  bool opens = false;
  for (TieCorner* corner : pair.corners) {
    const double taken = dissipated_energy(*corner, corner->opened, mode);
    report.stored -= stored_energy(*corner, std::min(before, corner->opened), mode_before);
    opens = opens || (now > corner->opened && !corner->is_spent());
    corner->opened = std::max(corner->opened, now);
    const double takes = dissipated_energy(*corner, corner->opened, mode) - taken;
    corner->taken += takes;
    report.dissipated += takes;
    report.stored += stored_energy(*corner, now, mode);
  }
  return opens;
}

bool has_torn(const TiePair& pair, std::span<const double> opened_before) {
  constexpr double tear = 0.01;
  for (std::size_t k = 0; k < pair.corners.size(); ++k) {
    const TieCorner& corner = *pair.corners[k];
    const bool was_spent = opened_before[k] >= corner.opening_end;
    if (!was_spent && corner.opened > opened_before[k] + tear * corner.opening_end) return true;
  }
  return false;
}

TieReport settle_ties(std::span<TiePair> pairs, std::span<const Vec3> impulse,
                      const StepPaths& paths) {
  TieReport report;
  std::vector<double> before;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    TiePair& pair = pairs[k];
    before.clear();
    for (const TieCorner* corner : pair.corners) before.push_back(corner->opened);
    ++report.pairs;
    report.opening +=
        settle_tie(report, pair, {opening_at_start(pair, paths), opening_at_end(pair, paths)},
                   impulse[k] / paths.time_step);
    if (has_torn(pair, before)) {
      report.torn.push_back(paths.state.vertices.component[pair.a.index()]);
    }
  }
  sort_unique(report.torn);
  return report;
}

}  // namespace sunder
