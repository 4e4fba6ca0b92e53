// SPDX-License-Identifier: MIT
// Contacts of vertices, balls and tetrahedron spheres along their paths through a step.
#include "mechanics/contact/contact_detect.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "mechanics/contact/contact_partners.hpp"
#include "mechanics/contact/nearest_point.hpp"
#include "mechanics/contact/obstacle_geometry.hpp"
#include "topology/base/assert.hpp"

namespace sunder {
namespace {

Vec3 ball_centre(const Obstacle& ball) { return std::get<Sphere>(ball.shape).center; }
double ball_radius(const Obstacle& ball) { return std::get<Sphere>(ball.shape).radius; }

/// The obstacle's shape about its own reference: balls about their centre, the rest as it stands.
Shape shape_about_reference(const Obstacle& obstacle) {
  if (!obstacle.mass) return obstacle.shape;
  return Sphere{Vec3::Zero(), ball_radius(obstacle)};
}

/// Whether a path ends nearer to the plane that it meets than it is long.
bool is_near(const FirstTouch& touch, const Path& path) {
  return touch.gap_end < (path.end - path.start).norm();
}

/// Adds a contact whose sides are `end` apart at the end of the step.
void add(DetectScratch& scratch, ContactPoint contact, const FirstTouch& touch, const Vec3& end) {
  contact.normal = touch.normal;
  contact.gap_start = touch.gap_start;
  contact.offset = touch.gap_end - touch.normal.dot(end);
  scratch.found.push_back(contact);
  scratch.found_gap.push_back(touch.gap_end);
}

/// Adds the contact if its path ends near.
void add_if_near(DetectScratch& scratch, const ContactPoint& contact, const Shape& shape,
                 const Path& path) {
  const FirstTouch touch = first_touch(shape, path);
  if (is_near(touch, path)) add(scratch, contact, touch, path.end);
}

void find_vertex_obstacle(DetectScratch& scratch, const StepPaths& paths, std::uint32_t row,
                          double friction) {
  const Obstacle& obstacle = paths.obstacles[row];
  const Shape shape = shape_about_reference(obstacle);
  ContactPoint contact;
  contact.obstacle = row;
  contact.friction = 0.5 * (friction + obstacle.friction);
  if (obstacle.mass && !paths.members.has_ball(row)) return;
  for (std::size_t v = 0; v < paths.predicted.size(); ++v) {
    if (!paths.members.has(paths.state.vertices.component[v])) continue;
    contact.vertex = VertexId{v};
    const ContactPath path = path_of(contact, paths);
    add_if_near(scratch, contact, shape, {path.start, path.end, 0});
  }
}

void find_balls(DetectScratch& scratch, const StepPaths& paths) {
  for (std::uint32_t a = 0; a < paths.obstacles.size(); ++a) {
    const Obstacle& ball = paths.obstacles[a];
    if (!ball.mass || !paths.members.has_ball(a)) continue;
    for (std::uint32_t b = 0; b < paths.obstacles.size(); ++b) {
      const Obstacle& other = paths.obstacles[b];
      if (a == b || (other.mass && (b < a || !paths.members.has_ball(b)))) continue;
      ContactPoint contact;
      contact.ball = a;
      contact.obstacle = b;
      contact.friction = 0.5 * (ball.friction + other.friction);
      const ContactPath path = path_of(contact, paths);
      add_if_near(scratch, contact, shape_about_reference(other),
                  {path.start, path.end, ball_radius(ball)});
    }
  }
}

/// Every pair whose paths come within a radius of each other lies, half-way, within the radius and
/// half their relative motion. The motion counted is cut at two radii: see the limits in
/// contact.hpp.
void pair_up(DetectScratch& scratch, const StepPaths& paths) {
  const std::vector<Vec3>& start = paths.state.vertices.position;
  const std::size_t points = start.size();
  Vec3 mean = Vec3::Zero();
  for (std::size_t v = 0; v < points; ++v) mean += paths.predicted[v] - start[v];
  mean /= static_cast<double>(std::max<std::size_t>(points, 1));
  double largest = 0;
  scratch.point_middle.resize(points);
  for (std::size_t v = 0; v < points; ++v) {
    largest = std::max(largest, (paths.predicted[v] - start[v] - mean).norm());
    scratch.point_middle[v] = 0.5 * (start[v] + paths.predicted[v]);
  }
  const std::size_t count = paths.corners.size();
  scratch.reach.resize(count);
  scratch.centre_middle.resize(count);
  for (std::size_t t = 0; t < count; ++t) {
    const Vec3 end = centre_of(paths.corners[t], paths.predicted);
    const double motion = (end - scratch.centre_start[t] - mean).norm() + largest;
    scratch.centre_middle[t] = 0.5 * (scratch.centre_start[t] + end);
    scratch.reach[t] = scratch.radius[t] + 0.5 * std::min(motion, 2 * scratch.radius[t]);
  }
  find_sphere_pairs(scratch.pairs, scratch.grid, scratch.cache,
                    {scratch.point_middle, paths.state.vertices.component, scratch.centre_middle,
                     scratch.reach, paths.state.elements.component});
}

bool several_components(const StepPaths& paths) {
  const std::vector<ComponentId>& all = paths.state.elements.component;
  return std::any_of(all.begin(), all.end(), [&](ComponentId c) { return c != all.front(); });
}

double allowance_of(std::span<const ContactMemory::Allowance> allowances, const SpherePair& pair) {
  const auto found = std::lower_bound(
      allowances.begin(), allowances.end(), pair,
      [](const ContactMemory::Allowance& a, const SpherePair& p) { return a.pair < p; });
  return found != allowances.end() && found->pair == pair ? found->overlap : -1;
}

/// New vertex rows come from splits: they were of the component that their tetrahedra were of.
void extend_remembered(ContactMemory& memory, const StepPaths& paths) {
  const std::size_t known = memory.vertex_component.size();
  memory.vertex_component.resize(paths.state.vertices.size());
  for (std::size_t t = 0; t < paths.corners.size(); ++t) {
    for (VertexId v : paths.corners[t]) {
      if (v.index() >= known) {
        memory.vertex_component[v.index()] = memory.tetrahedron_component[t];
      }
    }
  }
}

/// Of the contacts from row `first` on, keeps the deepest for each vertex and component, sorted so.
void keep_deepest(DetectScratch& scratch, const StepPaths& paths, std::size_t first) {
  const auto component_of = [&](const ContactPoint& c) {
    return paths.state.elements.component[c.tetrahedron.index()];
  };
  std::vector<std::uint32_t>& order = scratch.order;
  order.clear();
  for (std::size_t k = first; k < scratch.found.size(); ++k) {
    order.push_back(static_cast<std::uint32_t>(k));
  }
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const ContactPoint &p = scratch.found[a], &q = scratch.found[b];
    return std::tuple(p.vertex, component_of(p), scratch.found_gap[a], p.tetrahedron) <
           std::tuple(q.vertex, component_of(q), scratch.found_gap[b], q.tetrahedron);
  });
  order.erase(std::unique(order.begin(), order.end(),
                          [&](std::uint32_t a, std::uint32_t b) {
                            const ContactPoint &p = scratch.found[a], &q = scratch.found[b];
                            return p.vertex == q.vertex && component_of(p) == component_of(q);
                          }),
              order.end());
  scratch.deepest.clear();
  scratch.deepest_gap.clear();
  for (const std::uint32_t k : order) {
    scratch.deepest.push_back(scratch.found[k]);
    scratch.deepest_gap.push_back(scratch.found_gap[k]);
  }
  std::copy(scratch.deepest.begin(), scratch.deepest.end(),
            scratch.found.begin() + static_cast<std::ptrdiff_t>(first));
  std::copy(scratch.deepest_gap.begin(), scratch.deepest_gap.end(),
            scratch.found_gap.begin() + static_cast<std::ptrdiff_t>(first));
  scratch.found.resize(first + order.size());
  scratch.found_gap.resize(first + order.size());
}

/// Of the vertex against the middle of the tetrahedron, where its ball is.
Path path_about_middle(const SpherePair& pair, const StepPaths& paths) {
  const Corners& corners = paths.corners[pair.tetrahedron.index()];
  const std::size_t v = pair.vertex.index();
  const std::vector<Vec3>& start = paths.state.vertices.position;
  return {start[v] - centre_of(corners, start),
          paths.predicted[v] - centre_of(corners, paths.predicted), 0};
}

void find_between_pieces(DetectScratch& scratch, const ContactMemory& memory,
                         const StepPaths& paths, const ContactSettings& settings) {
  pair_up(scratch, paths);
  const std::size_t first = scratch.found.size();
  for (const SpherePair& pair : scratch.pairs) {
    if (!paths.members.has(paths.state.vertices.component[pair.vertex.index()]) ||
        !paths.members.has(paths.state.elements.component[pair.tetrahedron.index()])) {
      continue;
    }
    if (faces(scratch, pair, paths.corners)) continue;
    ContactPoint contact;
    contact.vertex = pair.vertex;
    contact.tetrahedron = pair.tetrahedron;
    contact.friction = settings.friction;
    const double allowed = std::max(0.0, allowance_of(memory.allowances, pair));
    const Sphere ball{Vec3::Zero(), scratch.radius[pair.tetrahedron.index()] - allowed};
    const Path path = path_about_middle(pair, paths);
    const FirstTouch touch = first_touch(ball, path);
    if (!is_near(touch, path)) continue;
    contact.weights = weights_at(touch.part, pair, paths);
    add(scratch, contact, touch, path_of(contact, paths).end);
  }
  keep_deepest(scratch, paths, first);
}

/// Velocity of side A against side B at the start, m/s.
Vec3 relative_velocity(const ContactPoint& contact, const StepPaths& paths) {
  const std::vector<Vec3>& velocity = paths.state.vertices.velocity;
  Vec3 sum = contact.ball == ContactPoint::none ? velocity[contact.vertex.index()]
                                                : paths.obstacles[contact.ball].velocity;
  if (contact.obstacle != ContactPoint::none)
    return sum - paths.obstacles[contact.obstacle].velocity;
  return sum - weighted_sum(paths.corners[contact.tetrahedron.index()], contact.weights, velocity);
}

}  // namespace

Vec3 centre_of(const Corners& corners, std::span<const Vec3> position) {
  return 0.25 * (position[corners[0].index()] + position[corners[1].index()] +
                 position[corners[2].index()] + position[corners[3].index()]);
}

void measure_balls(DetectScratch& scratch, const StepPaths& paths, double share) {
  const std::size_t count = paths.corners.size();
  const std::vector<Vec3>& rest = paths.state.vertices.rest_position;
  scratch.centre_start.resize(count);
  for (std::size_t t = 0; t < count; ++t) {
    scratch.centre_start[t] = centre_of(paths.corners[t], paths.state.vertices.position);
  }
  if (scratch.radius.size() == count && scratch.ball_share == share) return;
  scratch.ball_share = share;
  scratch.radius.resize(count);
  for (std::size_t t = 0; t < count; ++t) {
    const Vec3 centre = centre_of(paths.corners[t], rest);
    double squared = 0;
    for (VertexId v : paths.corners[t]) {
      squared = std::max(squared, (rest[v.index()] - centre).squaredNorm());
    }
    scratch.radius[t] = share * std::sqrt(squared);
  }
}

std::array<double, 4> weights_at(double part, const SpherePair& pair, const StepPaths& paths) {
  const auto place = [&](VertexId v) -> Vec3 {
    const Vec3& start = paths.state.vertices.position[v.index()];
    return start + part * (paths.predicted[v.index()] - start);
  };
  const Corners& c = paths.corners[pair.tetrahedron.index()];
  const ComponentId id = paths.state.elements.component[pair.tetrahedron.index()];
  if (paths.state.components[id.index()].isolated) {
    const std::vector<Vec3>& x = paths.state.vertices.position;
    return affine_weights({x[c[0].index()], x[c[1].index()], x[c[2].index()], x[c[3].index()]},
                          x[pair.vertex.index()]);
  }
  return nearest_point({place(c[0]), place(c[1]), place(c[2]), place(c[3])}, place(pair.vertex));
}

Vec3 weighted_sum(const Corners& corners, const std::array<double, 4>& weights,
                  std::span<const Vec3> values) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < 4; ++i) sum += weights[i] * values[corners[i].index()];
  return sum;
}

Vec3 lever_of(const ContactPoint& contact, const Corners& corners, std::span<const Vec3> start) {
  return start[contact.vertex.index()] - weighted_sum(corners, contact.weights, start);
}

ContactPath path_of(const ContactPoint& contact, const StepPaths& paths) {
  ContactPath path;
  if (contact.ball != ContactPoint::none) {
    path = {ball_centre(paths.obstacles[contact.ball]), paths.ball_end[contact.ball]};
  } else {
    const std::size_t v = contact.vertex.index();
    path = {paths.state.vertices.position[v], paths.predicted[v]};
  }
  path.size = path.start.norm() + path.end.norm();
  if (contact.obstacle != ContactPoint::none) {
    const Obstacle& obstacle = paths.obstacles[contact.obstacle];
    if (obstacle.mass) {
      path.start -= ball_centre(obstacle);
      path.end -= paths.ball_end[contact.obstacle];
    } else {
      path.end -= paths.time_step * obstacle.velocity;
    }
  } else {
    const Corners& corners = paths.corners[contact.tetrahedron.index()];
    const ComponentId id = paths.state.elements.component[contact.tetrahedron.index()];
    const Component& component = paths.state.components[id.index()];
    const Vec3 lever = lever_of(contact, corners, paths.state.vertices.position);
    path.end -= weighted_sum(corners, contact.weights, paths.predicted);
    path.end -= component.isolated ? lever
                                   : paths.frame[id.index()].orientation *
                                         (component.orientation.conjugate() * lever);
    path.start.setZero();
  }
  return path;
}

Meeting meeting_of(const ContactPoint& contact, const StepPaths& paths) {
  const ContactPath path = path_of(contact, paths);
  const double h = paths.time_step;
  const double start = contact.normal.dot(path.start) + contact.offset;
  const double end = gap_end(contact, path);
  const double speed = contact.normal.dot(relative_velocity(contact, paths));
  if (start <= 0) return {0, -speed};
  const double acceleration = 2 * (end - start - speed * h) / (h * h);
  const double squared = speed * speed - 2 * acceleration * start;
  if (!(squared >= 0)) return {};
  const double root = std::sqrt(squared);
  const double time = 2 * start / (root - speed);
  if (!(time >= 0 && time <= h)) return {};
  return {time, root};
}

void update_allowances(ContactMemory& memory, DetectScratch& scratch, const StepPaths& paths,
                       const ContactSettings& settings) {
  const MechanicsState& state = paths.state;
  const bool first_call = memory.tetrahedron_component.empty();
  const bool pieces = several_components(paths);
  scratch.allowances.clear();
  if (pieces) {
    measure_balls(scratch, paths, settings.ball_share);
    if (!first_call) extend_remembered(memory, paths);
    find_sphere_pairs(scratch.pairs, scratch.grid, scratch.cache,
                      {state.vertices.position, state.vertices.component, scratch.centre_start,
                       scratch.radius, state.elements.component});
    for (const SpherePair& pair : scratch.pairs) {
      const std::size_t t = pair.tetrahedron.index(), v = pair.vertex.index();
      const double overlap =
          scratch.radius[t] - (state.vertices.position[v] - scratch.centre_start[t]).norm();
      const bool were_one =
          first_call || memory.vertex_component[v] == memory.tetrahedron_component[t];
      const bool partners = faces(scratch, pair, paths.corners);
      const double before = partners ? -1 : allowance_of(memory.allowances, pair);
      if (before < 0 && !were_one && !partners) continue;
      scratch.allowances.push_back({pair, before < 0 ? overlap : std::min(before, overlap)});
    }
  }
  std::swap(memory.allowances, scratch.allowances);
  memory.vertex_component = state.vertices.component;
  memory.tetrahedron_component = state.elements.component;
}

void find_contacts(DetectScratch& scratch, const ContactMemory& memory, const StepPaths& paths,
                   const ContactSettings& settings) {
  SUNDER_ASSERT(paths.predicted.size() == paths.state.vertices.size(), "predict before contact");
  scratch.found.clear();
  scratch.found_gap.clear();
  for (std::uint32_t row = 0; row < paths.obstacles.size(); ++row) {
    find_vertex_obstacle(scratch, paths, row, settings.friction);
  }
  find_balls(scratch, paths);
  if (!settings.between_pieces) return;
  find_between_partners(scratch, memory, paths, settings);
  if (several_components(paths)) {
    find_between_pieces(scratch, memory, paths, settings);
  }
}

}  // namespace sunder
