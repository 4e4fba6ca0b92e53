// SPDX-License-Identifier: MIT
// Front edges by walks round them, and the domain integral over the tetrahedra around them.
#include "fracture/energy/tip_energy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "fracture/algorithms/fracture_plane.hpp"
#include "fracture/energy/energy_release.hpp"
#include "mechanics/element/second_order.hpp"
#include "mechanics/element/strain_displacement.hpp"
#include "topology/base/sort_unique.hpp"
#include "topology/kernel/fan.hpp"

namespace sunder {
namespace {

/// An edge where a crack ends.
struct FrontEdge {
  VertexId from, to;
  Vec3 ahead;         ///< unit length, in the crack's plane
  double length = 0;  ///< m
};

Vec3 at_rest(const VolumeMap& map, VertexId v) { return Vec3(map.point(v).data()); }

/// The half-face on the surface that a walk round an edge of `face` ends at.
HalfFaceId far_side(const VolumeMap& map, DartId start) {
  DartId d = map.beta2(start);
  while (!map.is_free(d)) d = map.beta2(map.beta3(d));
  return HalfFaceId{map.id(d).index() / 3};
}

bool has_point(const VolumeMap& map, HalfFaceId face, std::uint32_t point) {
  return std::ranges::any_of(corners_of_face(map.corners(tetrahedron_of(face)), face),
                             [&](VertexId v) { return map.point_of_vertex(v) == point; });
}

/// Appends the front edges of one half-face, where it is the lower side of a cracked face.
void add_front_edges(std::vector<FrontEdge>& edges, const Cells& cells, HalfFaceId face) {
  const VolumeMap& map = cells.map;
  const auto& corners = map.corners(tetrahedron_of(face));
  const auto& places = dart_order::face_corners[place_of(face)];
  for (std::size_t i = 0; i < 3; ++i) {
    const DartId start = map.dart(face, corner(tetrahedron_of(face), places[i]));
    const HalfFaceId other = far_side(map, start);
    const VertexId a = corners[places[i]], b = corners[places[(i + 1) % 3]];
    const VertexId c = corners[places[(i + 2) % 3]];
    if (!(face < other) || !has_point(map, other, map.point_of_vertex(c))) continue;
    const Vec3 edge = at_rest(map, b) - at_rest(map, a);
    const Vec3 back = at_rest(map, c) - at_rest(map, a);
    const double length = edge.norm();
    const Vec3 ahead = edge * (edge.dot(back) / edge.squaredNorm()) - back;
    edges.push_back({a, b, ahead.normalized(), length});
  }
}

std::vector<FrontEdge> front_edges(const Cells& cells, std::span<const TetId> tetrahedra) {
  std::vector<FrontEdge> edges;
  for (const TetId t : tetrahedra) {
    for (int place = 0; place < 4; ++place) {
      const HalfFaceId face = half_face(t, place);
      if (is_crack_face(cells, face)) add_front_edges(edges, cells, face);
    }
  }
  return edges;
}

/// Where q is one, ascending, and the tetrahedra that touch it.
struct Domain {
  std::vector<VertexId> ones;
  std::vector<TetId> tetrahedra;

  bool has(VertexId v) const { return std::ranges::binary_search(ones, v); }
};

Domain grown(const VolumeMap& map, std::span<const TetId> star_of_vertex) {
  Domain domain;
  for (const TetId t : star_of_vertex) {
    const Corners& c = map.corners(t);
    domain.ones.insert(domain.ones.end(), c.begin(), c.end());
  }
  sort_unique(domain.ones);
  for (const VertexId v : domain.ones) {
    const std::vector<TetId> around = star(map, v);
    domain.tetrahedra.insert(domain.tetrahedra.end(), around.begin(), around.end());
  }
  sort_unique(domain.tetrahedra);
  return domain;
}

/// Integral of q over the front, as it would sweep along `e`, m; nothing where some of it turns
/// away from `e` by more than 60 degrees.
std::optional<double> swept(std::span<const FrontEdge> edges, const Domain& domain, const Vec3& e) {
  double sum = 0;
  for (const FrontEdge& edge : edges) {
    const double q = 0.5 * (domain.has(edge.from) + domain.has(edge.to));
    if (q == 0) continue;
    if (edge.ahead.dot(e) < 0.5) return {};
    sum += q * edge.length * edge.ahead.dot(e);
  }
  return sum;
}

/// Eshelby's H^T sigma - W I of a tetrahedron, its mean, Pa.
Mat3 energy_momentum(const Cells& cells, const ElementColumns& elements, const Deformed& deformed,
                     TetId t) {
  if (is_second_order(elements, t)) {
    const auto H = corner_gradients(elements, cells.map.corners(), deformed.displacement, t);
    const std::array<Mat3, 4>& sigma = deformed.corner_stress[t.index()];
    // Both are linear, so the integral of l_i l_j, V (1 + delta_ij) / 20, gives that of products.
    Mat3 product =
        (H[0] + H[1] + H[2] + H[3]).transpose() * (sigma[0] + sigma[1] + sigma[2] + sigma[3]);
    for (std::size_t k = 0; k < 4; ++k) product += H[k].transpose() * sigma[k];
    product /= 20;
    return product - 0.5 * product.trace() * Mat3::Identity();
  }
  const CornerVectors u = at_corners(deformed.displacement, cells.map.corners(t));
  const Mat3 H = displacement_gradient(elements.shape_gradient[t.index()], u);
  const Mat3& sigma = deformed.stress[t.index()];
  const double W = 0.5 * sigma.cwiseProduct(H).sum();
  return H.transpose() * sigma - W * Mat3::Identity();
}

/// sum V (H^T sigma - W I) grad q, N m / m.
Vec3 material_force(const Cells& cells, const ElementColumns& elements, const Deformed& deformed,
                    const Domain& domain) {
  Vec3 force = Vec3::Zero();
  for (const TetId t : domain.tetrahedra) {
    const Corners& c = cells.map.corners(t);
    const ShapeGradient& G = elements.shape_gradient[t.index()];
    Vec3 slope = Vec3::Zero();
    for (std::size_t a = 0; a < 4; ++a) {
      if (domain.has(c[a])) slope += G.col(static_cast<Eigen::Index>(a));
    }
    force +=
        elements.rest_volume[t.index()] * (energy_momentum(cells, elements, deformed, t) * slope);
  }
  return force;
}

}  // namespace

std::optional<double> tip_energy(const Cells& cells, const ElementColumns& elements,
                                 const Deformed& deformed, VertexId vertex, TipDomain size) {
  Domain domain{{vertex}, star(cells.map, vertex)};
  std::vector<FrontEdge> edges = front_edges(cells, domain.tetrahedra);
  Vec3 e = Vec3::Zero();
  for (const FrontEdge& edge : edges) {
    if (edge.from == vertex || edge.to == vertex) e += edge.length * edge.ahead;
  }
  if (e.isZero(0)) return {};
  e.normalize();
  std::optional<double> area;
  if (size == TipDomain::two_rings) {
    Domain wide = grown(cells.map, domain.tetrahedra);
    const std::vector<FrontEdge> all = front_edges(cells, wide.tetrahedra);
    area = swept(all, wide, e);
    if (area) domain = std::move(wide);
  }
  if (!area) area = swept(edges, domain, e);
  if (!area) return {};
  return std::max(0.0, material_force(cells, elements, deformed, domain).dot(e) / *area);
}

double tip_strength(const Cells& cells, const MechanicsState& mechanics, const Deformed& deformed,
                    const StressedVertex& at) {
  constexpr double never = std::numeric_limits<double>::infinity();
  if (cells.unbreakable[at.vertex.index()]) return never;
  const std::vector<TetId> around = star(cells.map, at.vertex);
  double needed = never;
  for (const TetId t : around) {
    const Material& m = mechanics.materials[mechanics.elements.material[t.index()].index()];
    needed = std::min(needed, fracture_energy_of(m));
  }
  std::optional<double> released;
  if (needed < never) released = tip_energy(cells, mechanics.elements, deformed, at.vertex);
  if (!released) return vertex_strength(cells, mechanics, at.vertex, around);
  const double tension = principal_tension(at.stress).value;
  if (!(tension > 0) || *released == 0) return never;
  return tension * std::sqrt(needed / *released);
}

}  // namespace sunder
