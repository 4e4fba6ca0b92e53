// SPDX-License-Identifier: MIT
// Which contacts a step meets, from the paths of points through it; nothing is solved here.
#pragma once

#include <limits>
#include <utility>
#include <vector>

#include "mechanics/contact/contact.hpp"
#include "mechanics/contact/detection/pairs/near_pairs.hpp"
#include "mechanics/contact/shapes/box_pairs.hpp"
#include "mechanics/contact/shapes/contact_pairs.hpp"
#include "mechanics/contact/shapes/manifold.hpp"
#include "mechanics/contact/shapes/piece_surface.hpp"
#include "mechanics/state/pose.hpp"

namespace sunder {

/// A corner of an obstacle on its way.
struct CornerPath {
  std::uint32_t obstacle = 0, corner = 0;
  Vec3 start{0, 0, 0}, end{0, 0, 0};  ///< m
};

/// Edges or tetrahedra with their boxes on their ways, and pairs of those that may meet.
struct SolidPairs {
  std::vector<Bounds> boxes;
  std::vector<std::uint32_t> body;
  std::vector<Vec3> ways;         ///< m
  std::vector<char> moves;        ///< row = body
  std::vector<TetId> tetrahedra;  ///< row = box, where these are tetrahedra
  std::vector<RowPair> found;
  BoxScratch grid;
};

/// Buffers of detection, kept from step to step.
struct DetectScratch {
  GridScratch grid;
  PairCache cache;
  std::vector<SpherePair> pairs;
  /// Share of a tetrahedron's radius within which `pairs` has every vertex, however axes lie.
  double beside_share = 0.1;
  /// |T|: centres of the tetrahedra at the start and half-way, and their balls at rest, m.
  std::vector<Vec3> centre_start, centre_middle;
  std::vector<double> radius, reach;
  double ball_share = 0;                     ///< ball share at which `radius` was measured
  std::vector<Vec3> point_middle;            ///< |V|, and corners of obstacles
  std::vector<ComponentId> point_component;  ///< of both; empty where there are no corners
  std::vector<CornerPath> corner;
  PieceSurface surface;
  SolidPairs solid_pairs;
  std::vector<Bounds> edge_boxes;     ///< row = edge of the surface: on its way, widened
  std::vector<Bounds> obstacle_ways;  ///< likewise row = obstacle: of its corners
  Travel travel;
  std::vector<std::uint64_t> shape;  ///< row = component: changes with its surface
  std::uint64_t shape_version = 0;   ///< of the surface that these two are of
  double mean_edge = 0;              ///< m, of the surface as it was searched last
  NearPairs near_edges;              ///< by numbers of edges (`refresh_edges`)
  NearPairs near_solids;             ///< by numbers of tetrahedra
  std::vector<std::uint32_t>
      edge_row;  ///< row of `PieceSurface::edges`, by numbers (`refresh_edges`)
  std::uint64_t edge_row_version = 0;  ///< of the surface that these are of
  std::vector<RowPair> swept;          ///< pairs of the step at hand, where ways are long
  std::vector<std::pair<VertexId, VertexId>> facing;  ///< of partners, both ways, sorted
  std::vector<ContactPoint> found;
  std::vector<double> found_gap;  ///< m, end of the step, in the tangent plane
  std::vector<std::uint32_t> order, taken;
};

/// Which contacts of a component a search looks for.
enum class Scope : std::uint8_t {
  outside,  ///< none
  near,     ///< those with components inside
  inside,   ///< all
};

/// The input of detection. Corners of obstacles are numbered after the vertices of bodies.
struct StepPaths {
  const MechanicsState& state;
  std::span<const Corners> corners;
  std::span<const Vec3> predicted;        ///< |V|: end of the step, m
  std::span<const PredictedFrame> frame;  ///< row = ComponentId: there too
  std::span<const Obstacle> obstacles;
  std::span<const Pose> ball_end;  ///< row = obstacle: of a free one's mass centre at the end
  double time_step;
  StepMembers members = {};                                    ///< only they meet
  std::span<const std::array<HalfFaceId, 4>> neighbours = {};  ///< `StepInput::neighbours`
  std::span<const CornerPath> corner = {};                     ///< that come near pieces
  /// m: vertices that end so near an obstacle meet it too. The ways of explicit waves are
  /// estimates.
  double margin = 0;
  /// Row = component: of a search for contacts of some components alone. Empty: of all.
  std::span<const Scope> scope = {};

  Scope scope_of(ComponentId id) const { return scope.empty() ? Scope::inside : scope[id.index()]; }
  /// Whether all contacts of a component are looked for.
  bool is_inside(ComponentId id) const { return members.has(id) && scope_of(id) == Scope::inside; }
  /// Whether contacts of a component with any other are looked for.
  bool is_searched(ComponentId id) const {
    return members.has(id) && scope_of(id) != Scope::outside;
  }
  /// Whether contacts between two components are looked for.
  bool may_meet(ComponentId a, ComponentId b) const {
    return is_searched(a) && is_searched(b) && (is_inside(a) || is_inside(b));
  }
  bool is_corner(VertexId v) const { return v.index() >= predicted.size(); }
  const CornerPath& corner_of(VertexId v) const { return corner[v.index() - predicted.size()]; }
  const Vec3& at_start(VertexId v) const {
    return is_corner(v) ? corner_of(v).start : state.vertices.position[v.index()];
  }
  const Vec3& at_end(VertexId v) const {
    return is_corner(v) ? corner_of(v).end : predicted[v.index()];
  }
  /// Where a vertex is when it has gone a part of its way, on a straight line, m.
  Vec3 at(VertexId v, double part) const { return (1 - part) * at_start(v) + part * at_end(v); }
};

/// Mean of a tetrahedron's four positions.
Vec3 centre_of(const Corners& corners, std::span<const Vec3> position);

/// A tetrahedron's four positions at the start.
std::array<Vec3, 4> places_of(const Corners& corners, const StepPaths& paths);

/// Centres of the tetrahedra at the start, and their balls: `share` of the bounding balls at rest.
void measure_balls(DetectScratch& scratch, const StepPaths& paths, double share);

/// Puts every vertex, and corner of `paths`, with a path that comes within the ball of a
/// tetrahedron into `scratch.pairs`. Paths are relative to the ball's centre. Needs:
/// `measure_balls`.
void pair_up(DetectScratch& scratch, const StepPaths& paths);

/// A contact's weights from those of the point of its tetrahedron that is touched: these, but of a
/// rigid one the place of side A itself as the step begins.
std::array<double, 4> weights_on(const ContactPoint& contact, const std::array<double, 4>& touched,
                                 const StepPaths& paths);

/// The nodes of B, a tetrahedron, that a contact acts on, and their shares: its corners by the
/// contact's weights; of second order, where it deforms, shape functions there: with the weights
/// L_i those are L_i (2 L_i - 1) of corners and 4 L_i L_j of edges, on one face at most.
struct TouchedNodes {
  std::array<VertexId, 6> row;
  std::array<double, 6> share;
  std::size_t count = 0;

  /// Of positions or velocities, a row a node.
  Vec3 sum(std::span<const Vec3> values) const {
    Vec3 result = Vec3::Zero();
    for (std::size_t i = 0; i < count; ++i) result += share[i] * values[row[i].index()];
    return result;
  }
};
TouchedNodes touched_nodes(const ContactPoint& contact, const MechanicsState& state,
                           std::span<const Corners> corners);

/// The nodes of a body that side A acts on: the vertex, or corners of the tetrahedron by
/// `weights_a`. Side A is where they are on the mean. Needs: A of a body.
TouchedNodes nodes_of_a(const ContactPoint& contact, std::span<const Corners> corners);

/// Where side A of a contact is on its obstacle, put as `shape` is, m: the centre of a ball.
/// Needs: A of an obstacle.
Vec3 point_of_obstacle(const ContactPoint& contact, const Shape& shape);

/// Where side A of a contact is at the start, m: the centre of a ball.
Vec3 start_of_side_a(const ContactPoint& contact, const StepPaths& paths);

/// The same at the predicted end of the step.
Vec3 end_of_side_a(const ContactPoint& contact, const StepPaths& paths);

/// Adds a contact that ends with a gap, m, to `scratch.found`: its offset follows from the paths.
void add_found(DetectScratch& scratch, const StepPaths& paths, ContactPoint contact,
               double gap_end);

/// Leaves out the contacts in `scratch.found` for which `stays(row)` is false. It may change the
/// contact of its row.
template <class Stays>
void keep_found(DetectScratch& scratch, Stays stays) {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < scratch.found.size(); ++k) {
    if (!stays(k)) continue;
    scratch.found[kept] = scratch.found[k];
    scratch.found_gap[kept++] = scratch.found_gap[k];
  }
  scratch.found.resize(kept);
  scratch.found_gap.resize(kept);
}

/// m: how deep solids that slide over a seam may dip into it and touch only their supports.
inline double rim_of(const ContactSettings& settings) { return 2 * settings.allowed_penetration; }

/// From the point of B, a tetrahedron, to where side A is (`place`), both at the start of a step,
/// m. An impulse acts on B at the end of it, as if it were fast to B. `start`: positions there.
inline Vec3 lever_of(const TouchedNodes& touched, const Vec3& place, std::span<const Vec3> start) {
  return place - touched.sum(start);
}

/// Where side A of a contact is, and the reference of side B, at the start and end of the step.
struct ContactPath {
  Vec3 start{0, 0, 0};  ///< A - reference of B, m
  Vec3 end{0, 0, 0};
  double size = 0;  ///< m: of the coordinates it is a difference of, for their rounding
};
ContactPath path_of(const ContactPoint& contact, const StepPaths& paths);

/// The obstacle's shape where paths against it are (`path_of`): free ones about their mass centre,
/// turned as they are at the start; the rest as it stands.
Shape shape_about_reference(const Obstacle& obstacle);

/// Gap at the end of the step in the contact's tangent plane, m.
inline double gap_end(const ContactPoint& contact, const ContactPath& path) {
  return contact.normal.dot(path.end) + contact.offset;
}

/// When, after how many seconds, and how fast (m/s) the sides of a contact meet. The gap is the
/// parabola with the gap and speed of the start and the gap of the end. A pair closer than
/// `touching` (m) at the start meets at once. Otherwise gravity and strain, which contact carries,
/// would accelerate a resting body over the tiny gap. Infinite time: not in this step.
struct Meeting {
  double time = std::numeric_limits<double>::infinity();
  double speed = 0;
};
Meeting meeting_of(const ContactPoint& contact, const StepPaths& paths, double touching);

/// Where the vertices of the members are in the step, and how far the fastest goes, m.
struct VertexReach {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  double farthest = 0;

  /// Whether anything between two corners of a box along the axes is within reach.
  bool meets(const Vec3& least, const Vec3& most) const {
    return (least.array() <= high.array()).all() && (most.array() >= low.array()).all();
  }
};

/// Whether a step has pieces that may meet each other.
bool has_several_pieces(const StepPaths& paths, const ContactSettings& settings);

/// Whether pieces may meet each other or spheres, and neighbours are given: `find_overlaps`.
bool may_overlap(const StepPaths& paths, const ContactSettings& settings);

/// Contacts of vertices with obstacles alone, into `scratch.found`: the first of `find_contacts`.
/// O(vertices times obstacles near them).
void find_on_obstacles(DetectScratch& scratch, const StepPaths& paths,
                       const ContactSettings& settings);

/// Puts all contacts with a path that ends nearer to the tangent plane than it is long into
/// `scratch.found`. Their order: vertices by obstacle, obstacles by corner and then by edge,
/// partners, pieces by vertex, balls on pieces, edges. `settings` gives the friction.
void find_contacts(DetectScratch& scratch, const ContactMemory& memory, const StepPaths& paths,
                   const ContactSettings& settings);

}  // namespace sunder
