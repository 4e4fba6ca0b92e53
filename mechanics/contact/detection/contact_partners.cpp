// SPDX-License-Identifier: MIT
// Crack faces against each other.
#include "mechanics/contact/detection/contact_partners.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "topology/base/elementary.hpp"
#include "topology/base/sort_unique.hpp"

namespace sunder {
namespace {

/// Where a node of a face is in its tetrahedron: at a corner, or between two of them.
struct NodePlace {
  std::uint8_t corner = 0, other = 0;

  bool is_edge() const { return corner != other; }
};

/// One node of a pair of crack faces; A is the lower row.
struct Facing {
  VertexId a, b;
  HalfFaceId face;     ///< of A: identifies contacts of the same nodes
  TetId tetrahedron;   ///< of B
  NodePlace place;     ///< of B
  Vec3 area{0, 0, 0};  ///< m^2, from B to A
};

ComponentId component_of(const StepPaths& paths, HalfFaceId face) {
  return paths.state.elements.component[tetrahedron_of(face).index()];
}

VertexId vertex_of(const StepPaths& paths, HalfFaceId face, std::uint8_t corner) {
  return paths.corners[tetrahedron_of(face).index()][corner];
}

VertexId node_of(const StepPaths& paths, HalfFaceId face, NodePlace at) {
  if (!at.is_edge()) return vertex_of(paths, face, at.corner);
  const auto edge = static_cast<std::size_t>(edge_between(at.corner, at.other));
  return paths.state.elements.edge_nodes[tetrahedron_of(face).index()][edge];
}

/// Calls `visit(a, b)` with the places of nodes that meet, of `face` and `opposite`.
template <class Visit>
void for_each_pair(const StepPaths& paths, const Partner& p, Visit visit) {
  const bool has_edges = is_second_order(paths.state.elements, tetrahedron_of(p.face));
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    visit(NodePlace{p.corner[k], p.corner[k]},
          NodePlace{p.opposite_corner[k], p.opposite_corner[k]});
    if (!has_edges) continue;
    visit(NodePlace{p.corner[k], p.corner[next]},
          NodePlace{p.opposite_corner[k], p.opposite_corner[next]});
  }
}

bool among_members(const StepPaths& paths, const Partner& partner) {
  return paths.members.has(component_of(paths, partner.face)) &&
         paths.members.has(component_of(paths, partner.opposite));
}

/// Out of the tetrahedron of `face`: the area of its triangle, or of the opposite one, as the step
/// begins.
Vec3 area_of(const StepPaths& paths, HalfFaceId face, const std::array<std::uint8_t, 3>& corner) {
  const auto place = [&](std::size_t k) -> const Vec3& {
    return paths.state.vertices.position[vertex_of(paths, face, corner[k]).index()];
  };
  return 0.5 * (place(1) - place(0)).cross(place(2) - place(0));
}

Vec3 area_between(const StepPaths& paths, const Partner& p) {
  return 0.5 * (area_of(paths, p.face, p.corner) + area_of(paths, p.opposite, p.opposite_corner));
}

/// Whether the faces have parted everywhere, or slid anywhere, by their reach.
bool is_apart(const StepPaths& paths, const Partner& p) {
  const Vec3 normal = -area_between(paths, p).normalized();
  double least_gap = p.reach, most_slip = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::vector<Vec3>& x = paths.state.vertices.position;
    const Vec3 apart = x[vertex_of(paths, p.face, p.corner[k]).index()] -
                       x[vertex_of(paths, p.opposite, p.opposite_corner[k]).index()];
    const double gap = normal.dot(apart);
    least_gap = std::min(least_gap, gap);
    most_slip = std::max(most_slip, (apart - gap * normal).norm());
  }
  return least_gap >= p.reach || most_slip >= p.reach;
}

/// Every node that has come apart, sorted by rows and face.
std::vector<Facing> facing_nodes(const ContactMemory& memory, const StepPaths& paths) {
  std::vector<Facing> all;
  for (const Partner& p : memory.partners) {
    if (!among_members(paths, p)) continue;
    const Vec3 area = area_between(paths, p);
    for_each_pair(paths, p, [&](NodePlace own, NodePlace other) {
      const VertexId a = node_of(paths, p.face, own), b = node_of(paths, p.opposite, other);
      if (a < b) all.push_back({a, b, p.face, tetrahedron_of(p.opposite), other, -area});
      if (b < a) all.push_back({b, a, p.opposite, tetrahedron_of(p.face), own, area});
    });
  }
  std::sort(all.begin(), all.end(), [](const Facing& p, const Facing& q) {
    return std::tuple(p.a, p.b, p.face) < std::tuple(q.a, q.b, q.face);
  });
  return all;
}

/// Of pairs of the same two nodes: one for all that lie in one plane, with their areas.
void merge_planes(std::vector<Facing>& all) {
  const double one_plane = cosine(10 * std::numbers::pi / 180);
  std::size_t kept = 0, first = 0;
  for (const Facing& corner : all) {
    if (kept > 0 && (all[kept - 1].a != corner.a || all[kept - 1].b != corner.b)) first = kept;
    const auto plane = std::find_if(
        all.begin() + static_cast<std::ptrdiff_t>(first),
        all.begin() + static_cast<std::ptrdiff_t>(kept), [&](const Facing& other) {
          return corner.area.dot(other.area) > one_plane * corner.area.norm() * other.area.norm();
        });
    if (plane != all.begin() + static_cast<std::ptrdiff_t>(kept)) {
      plane->area += corner.area;
    } else {
      all[kept++] = corner;
    }
  }
  all.resize(kept);
}

/// Where the impulse acts on B: its node; of a rigid tetrahedron the place of A.
std::array<double, 4> weights_of(const ContactPoint& contact, NodePlace at,
                                 const StepPaths& paths) {
  std::array<double, 4> weights{};
  weights[at.corner] += 0.5;
  weights[at.other] += 0.5;
  return weights_on(contact, weights, paths);
}

}  // namespace

void update_partners(ContactMemory& memory, DetectScratch& scratch, const StepPaths& paths) {
  std::erase_if(memory.partners, [&](const Partner& p) {
    const ComponentId a = component_of(paths, p.face), b = component_of(paths, p.opposite);
    return a != b && paths.may_meet(a, b) && is_apart(paths, p);
  });
  std::vector<std::pair<VertexId, VertexId>> before = std::move(scratch.facing);
  scratch.facing.clear();
  for (const Partner& p : memory.partners) {
    for_each_pair(paths, p, [&](NodePlace own, NodePlace other) {
      const VertexId a = node_of(paths, p.face, own), b = node_of(paths, p.opposite, other);
      if (a == b) return;
      scratch.facing.emplace_back(a, b);
      scratch.facing.emplace_back(b, a);
    });
  }
  sort_unique(scratch.facing);
  if (before == scratch.facing) return;
  std::vector<std::pair<VertexId, VertexId>> lost;
  std::ranges::set_difference(before, scratch.facing, std::back_inserter(lost));
  scratch.travel.parted.resize(paths.state.components.size(), 0);
  for (const auto& [a, b] : lost) {
    ++scratch.travel.parted[paths.state.vertices.component[a.index()].index()];
  }
}

bool faces(const DetectScratch& scratch, const SpherePair& pair, const StepPaths& paths) {
  const auto first = std::lower_bound(scratch.facing.begin(), scratch.facing.end(),
                                      std::pair(pair.vertex, VertexId{0}));
  for (auto it = first; it != scratch.facing.end() && it->first == pair.vertex; ++it) {
    const ElementNodes nodes = nodes_of(paths.state.elements, paths.corners, pair.tetrahedron);
    if (std::count(nodes.begin(), nodes.end(), it->second) > 0) return true;
  }
  return false;
}

void find_between_partners(DetectScratch& scratch, const ContactMemory& memory,
                           const StepPaths& paths, const ContactSettings& settings) {
  std::vector<Facing> nodes = facing_nodes(memory, paths);
  merge_planes(nodes);
  const std::vector<Vec3>& x = paths.state.vertices.position;
  for (const Facing& node : nodes) {
    ContactPoint contact;
    contact.vertex = node.a;
    contact.tetrahedron = node.tetrahedron;
    contact.face = node.face;
    contact.weights = weights_of(contact, node.place, paths);
    contact.friction = settings.friction;
    contact.normal = node.area.normalized();
    contact.gap_start = contact.normal.dot(x[node.a.index()] - x[node.b.index()]);
    contact.offset = contact.gap_start;
    const Vec3 end = path_of(contact, paths).end;
    const double gap = contact.normal.dot(end) + contact.offset;
    if (!(gap < end.norm())) continue;
    scratch.found.push_back(contact);
    scratch.found_gap.push_back(gap);
  }
}

}  // namespace sunder
