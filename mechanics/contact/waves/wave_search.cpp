// SPDX-License-Identifier: MIT
// Which contacts a part of an impact has: found along the ways of free flight, and kept for bodies
// that go those ways.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

#include "mechanics/contact/detection/contact_partners.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "mechanics/contact/waves/explicit_wave.hpp"
#include "mechanics/state/living.hpp"
#include "mechanics/state/wave_travel.hpp"

namespace sunder {
namespace {

/// Where everything gets in `ahead` s as it moves now, for detection.
void predict_free_flight(ContactStep& step, double ahead) {
  MechanicsScratch::Predicted& predicted = step.pass.mechanics.predicted;
  const VertexColumns& v = step.pass.state.vertices;
  predict(step.pass.mechanics, step.pass.state, step.pass.input, {});
  predicted.position = v.position;
  predicted.velocity = v.velocity;
  for_each_living(step.pass.state, {}, [&](const Component& c) {
    PredictedFrame& frame = predicted.frame[c.id.index()];
    frame.centre = c.centre;
    frame.orientation = c.orientation;
    if (!step.pass.input.members.has(c.id) || c.rung == Rung::asleep) return;
    frame.centre += ahead * (c.supported ? c.frame_velocity : Vec3(c.momentum / c.mass));
    for (const VertexId i : c.vertices)
      predicted.position[i.index()] += ahead * v.velocity[i.index()];
  });
  step.scratch.ball_end.resize(step.pass.obstacles.size());
  for (std::size_t k = 0; k < step.pass.obstacles.size(); ++k) {
    const Obstacle& free = step.pass.obstacles[k];
    if (!free.mass) continue;
    step.scratch.ball_end[k] = {pose_of(free.shape).centre + ahead * free.velocity,
                                turned_obstacle(free, angular_momentum_of(free), ahead)};
  }
}

/// Whether the bodies of a contact are members that move. A sleeping one waits for the next
/// detection.
bool takes_part(const ContactStep& step, const ContactPoint& contact) {
  bool all = true;
  for_each_component(contact, step.pass.state, [&](ComponentId id) {
    const bool sleeps = step.pass.state.components[id.index()].rung == Rung::asleep;
    all = all && step.pass.input.members.has(id) && !sleeps;
  });
  return all;
}

/// m: how far a vertex may be from where it was expected: a share of the smallest mean cell of
/// those that deform.
double stray_limit(const ContactStep& step) {
  constexpr double share = 0.02;
  const MechanicsState& state = step.pass.state;
  double cell = std::numeric_limits<double>::infinity();
  for_each_living(state, step.pass.input.members, [&](const Component& c) {
    if (deforms_in_wave(c)) cell = std::min(cell, mean_cell(state, c));
  });
  return std::isfinite(cell) ? share * cell : 0;
}

/// Expects that bodies inside the search, and free obstacles, go on as they move now.
void expect_from_here(WaveSearch& search, const ContactStep& step) {
  const VertexColumns& v = step.pass.state.vertices;
  search.position.resize(v.size());
  search.velocity.resize(v.size());
  for (std::size_t i = 0; i < v.size(); ++i) {
    if (search.scope[v.component[i].index()] != Scope::inside) continue;
    search.velocity[i] = v.velocity[i];
    search.position[i] = v.position[i] - search.clock * v.velocity[i];
  }
  search.obstacle.clear();
  for (const Obstacle& obstacle : step.pass.obstacles) {
    const Vec3 centre = obstacle.mass ? pose_of(obstacle.shape).centre : Vec3(Vec3::Zero());
    search.obstacle.push_back({centre - search.clock * obstacle.velocity, obstacle.velocity});
  }
}

/// Row = component: the boxes around the ways of its vertices, wider by `margin` (m).
std::vector<Bounds> boxes_on_ways(const StepPaths& paths, double margin) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  std::vector<Bounds> boxes(paths.state.components.size(),
                            {Vec3::Constant(infinite), Vec3::Constant(-infinite)});
  const Vec3 wide = Vec3::Constant(margin);
  for (std::size_t i = 0; i < paths.predicted.size(); ++i) {
    Bounds& box = boxes[paths.state.vertices.component[i].index()];
    const Vec3 &start = paths.state.vertices.position[i], &end = paths.predicted[i];
    box.low = box.low.cwiseMin(start.cwiseMin(end) - wide);
    box.high = box.high.cwiseMax(start.cwiseMax(end) + wide);
  }
  return boxes;
}

/// Whether a member obstacle that is free has strayed by more than `most` m.
bool any_obstacle_strayed(const WaveSearch& search, const ContactStep& step, double most) {
  for (std::size_t k = 0; k < search.obstacle.size(); ++k) {
    const Obstacle& free = step.pass.obstacles[k];
    if (!free.mass || !step.pass.input.members.has_ball(k)) continue;
    const auto& [position, velocity] = search.obstacle[k];
    const Vec3 astray = pose_of(free.shape).centre - position - search.clock * velocity;
    if (astray.squaredNorm() > most * most) return true;
  }
  return false;
}

/// Puts components of members inside the search that have a vertex farther than `most` m from its
/// expected place. A free obstacle so far from its own puts all inside. Gives whether any is.
bool find_strayed(WaveSearch& search, const ContactStep& step, double most) {
  const VertexColumns& v = step.pass.state.vertices;
  const bool all = any_obstacle_strayed(search, step, most);
  search.scope.assign(step.pass.state.components.size(), all ? Scope::inside : Scope::outside);
  bool any = all;
  for (std::size_t i = 0; i < v.size() && !all; ++i) {
    if (!step.pass.input.members.has(v.component[i])) continue;
    const Vec3 expected = search.position[i] + search.clock * search.velocity[i];
    if (!((v.position[i] - expected).squaredNorm() > most * most)) continue;
    search.scope[v.component[i].index()] = Scope::inside;
    any = true;
  }
  return any;
}

bool is_everything(const std::vector<Scope>& scope) {
  return std::ranges::all_of(scope, [](Scope one) { return one == Scope::inside; });
}

/// Marks the components that may come near one inside, within `margin` (m). A search of more than
/// half of all components becomes a search of everything.
void find_near(WaveSearch& search, const StepPaths& paths, double margin) {
  if (is_everything(search.scope)) return;
  const std::vector<Bounds> boxes = boxes_on_ways(paths, margin);
  std::vector<Scope>& scope = search.scope;
  for (std::size_t c = 0; c < boxes.size(); ++c) {
    if (scope[c] != Scope::inside) continue;
    for (std::size_t d = 0; d < boxes.size(); ++d) {
      if (scope[d] == Scope::outside && boxes[c].overlaps(boxes[d])) scope[d] = Scope::near;
    }
  }
  if (2 * std::ranges::count(scope, Scope::inside) > std::ssize(scope)) {
    std::ranges::fill(scope, Scope::inside);
  }
}

using VertexCopy = std::pair<VertexId, VertexId>;

/// Vertices that fans have split since the part before, each with a copy of it: they are still
/// where it was. Sorted.
std::vector<VertexCopy> copies_since(const std::vector<Vec3>& position, std::size_t before) {
  std::map<std::array<double, 3>, std::vector<VertexId>> at;
  const auto key_of = [&](std::size_t v) {
    return std::array{position[v].x(), position[v].y(), position[v].z()};
  };
  for (std::size_t v = before; v < position.size(); ++v) at[key_of(v)].emplace_back(v);
  std::vector<VertexCopy> copies;
  for (std::size_t v = 0; v < before && !at.empty(); ++v) {
    const auto found = at.find(key_of(v));
    if (found == at.end()) continue;
    for (const VertexId copy : found->second) copies.emplace_back(VertexId{v}, copy);
  }
  return copies;
}

/// Copies are expected where the split vertex is.
void expect_copies(WaveSearch& search, std::span<const VertexCopy> copies,
                   const VertexColumns& vertices) {
  const auto before = static_cast<std::ptrdiff_t>(search.position.size());
  search.position.insert(search.position.end(), vertices.position.begin() + before,
                         vertices.position.end());
  search.velocity.insert(search.velocity.end(), vertices.velocity.begin() + before,
                         vertices.velocity.end());
  for (const auto& [vertex, copy] : copies) {
    search.position[copy.index()] = search.position[vertex.index()];
    search.velocity[copy.index()] = search.velocity[vertex.index()];
  }
}

/// Whether the search of the part at hand covers a contact.
bool is_searched(const ContactStep& step, const ContactPoint& contact) {
  const WaveSearch& search = step.scratch.wave->search;
  const bool is_on_obstacle = !contact.is_body_a() || !contact.is_body_b();
  if (!contact.face.is_none() || (is_on_obstacle && !contact.vertex.is_none())) return true;
  bool any = search.any && !contact.is_body_a() && !contact.is_body_b();
  for_each_component(contact, step.pass.state, [&](ComponentId id) {
    any = any || search.scope[id.index()] == Scope::inside;
  });
  return any;
}

/// Takes the contacts of the part before that the search does not cover, with their present gaps.
/// Contacts of split vertices hold for all copies.
void keep_contacts(ContactStep& step, std::span<const VertexCopy> copies) {
  const StepPaths paths = paths_of(step);
  const auto take = [&](ContactPoint contact) {
    if (!takes_part(step, contact) || is_searched(step, contact)) return;
    // Sides that have come out of an overlap may slide off its patch.
    if (contact.is_of_overlap() && contact.gap_start >= 0) return;
    contact.impulse.setZero();
    contact.offset = contact.gap_start - contact.normal.dot(path_of(contact, paths).start);
    step.contacts.push_back(contact);
  };
  for (ContactPoint contact : step.scratch.wave->kept) {
    take(contact);
    if (contact.vertex.is_none()) continue;
    for (const VertexCopy& copy :
         std::ranges::equal_range(copies, contact.vertex, {}, &VertexCopy::first)) {
      contact.vertex = copy.second;
      take(contact);
    }
  }
}

/// Vertices on obstacles and crack faces as they are now.
void find_at_hand(ContactStep& step) {
  predict_free_flight(step, step.h());
  const StepPaths paths = paths_of(step);
  DetectScratch& detect = step.scratch.detect;
  find_on_obstacles(detect, paths, step.settings);
  if (step.settings.between_pieces) {
    find_between_partners(detect, step.memory, paths, step.settings);
  }
  std::ranges::copy_if(detect.found, std::back_inserter(step.contacts),
                       [&](const ContactPoint& contact) { return takes_part(step, contact); });
}

std::ptrdiff_t sleepers(const MechanicsState& state) {
  return std::ranges::count(state.components, Rung::asleep, &Component::rung);
}

/// All contacts of the components inside the search, and of those that these wake, for as long as
/// contacts last; with vertices on obstacles and crack faces of all.
void search_again(ContactStep& step) {
  WaveSearch& search = step.scratch.wave->search;
  step.ahead = search.lasts - search.clock;
  predict_free_flight(step, step.ahead);
  step.look = ContactStep::Look::all;
  find_near(search, paths_of(step), step.margin + 10 * step.settings.allowed_penetration);
  const std::ptrdiff_t asleep = sleepers(step.pass.state);
  step.scope = search.scope;
  update_partners(step.memory, step.scratch.detect, paths_of(step));
  step.scope = is_everything(search.scope) ? std::span<const Scope>() : search.scope;
  meet(step, 0);
  if (!step.scope.empty() && sleepers(step.pass.state) != asleep) {
    std::ranges::fill(search.scope, Scope::inside);
    step.scope = {};
    meet(step, 0);
  }
  step.scope = {};
  step.ahead = 0;
  step.contacts = step.scratch.detect.found;
  expect_from_here(search, step);
}

}  // namespace

void gather_contacts(ContactStep& step) {
  WaveSearch& search = step.scratch.wave->search;
  const VertexColumns& vertices = step.pass.state.vertices;
  const double lasts = step.pass.input.part.contacts_for;
  step.margin = stray_limit(step);
  std::vector<VertexCopy> copies;
  if (lasts > 0) {
    search.clock = 0;
    search.lasts = lasts;
    search.scope.assign(step.pass.state.components.size(), Scope::inside);
    search.any = true;
  } else {
    copies = copies_since(vertices.position, search.position.size());
    expect_copies(search, copies, vertices);
    search.any = find_strayed(search, step, step.margin);
  }
  search.any ? search_again(step) : find_at_hand(step);
  keep_contacts(step, copies);
}

}  // namespace sunder
