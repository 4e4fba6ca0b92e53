// SPDX-License-Identifier: MIT
// Pairs that are kept against pairs that are searched in every step.
#include "mechanics/contact/detection/pairs/near_pairs.hpp"

#include <catch2/catch.hpp>
#include <tuple>

#include "mechanics/contact/contact_step.hpp"
#include "mechanics/contact/detection/contact_overlaps.hpp"
#include "mechanics/contact/detection/contact_partners.hpp"
#include "tests/mechanics/contact/contact_scene.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// Blocks that fly through each other, without any contact.
struct Crowd {
  SeveralBodies all;
  MechanicsState state;
  std::vector<std::array<HalfFaceId, 4>> neighbours;
  std::vector<Vec3> velocity, spin, predicted;
  std::vector<PredictedFrame> frame;
  ContactMemory memory;

  explicit Crowd(std::mt19937& random) {
    std::vector<Body> blocks;
    for (int k = 0; k < 6; ++k) {
      Body block = shaken(kuhn_block({2, 2, 2}, Vec3(1, 0.8, 0.6)), 0.05, random);
      const Eigen::Quaterniond turn = random_rotation(random);
      const Vec3 place = Vec3(k % 3, k / 3, 0) + 0.2 * random_vector(random);
      for (Vec3& x : block.rest) x = turn * x + place;
      blocks.push_back(block);
      velocity.push_back(random_vector(random));
      spin.push_back(2 * random_vector(random));
    }
    // One is far faster than all others.
    velocity[0] *= 8;
    all = together(blocks);
    state = state_of(all, material_of(1e9));
    neighbours = neighbours_of(all.body.corners);
    frame.resize(state.components.size());
  }

  /// Predicts a step of `h` s, and moves by it if asked.
  void predict(double h, bool moves) {
    predicted = state.vertices.position;
    for (std::size_t v = 0; v < predicted.size(); ++v) {
      const std::size_t c = state.vertices.component[v].index();
      const Vec3 arm = state.vertices.position[v] - state.components[c].centre;
      predicted[v] += h * (velocity[c] + spin[c].cross(arm));
    }
    if (!moves) return;
    state.vertices.position = predicted;
    for (Component& c : state.components) c.centre += h * velocity[c.id.index()];
  }

  StepPaths paths(double h) const {
    return {state, all.body.corners, predicted, frame, {}, {}, h, {}, neighbours};
  }
};

using Found = std::vector<std::tuple<TetId, int, TetId, int, VertexId, double>>;

Found found_by(DetectScratch& scratch, Crowd& crowd, double h) {
  ContactSettings settings;
  settings.allowed_penetration = 1e-3;
  update_partners(crowd.memory, scratch, crowd.paths(h));
  find_contacts(scratch, crowd.memory, crowd.paths(h), settings);
  find_overlaps(scratch, crowd.paths(h), settings, 0);
  Found found;
  for (std::size_t k = 0; k < scratch.found.size(); ++k) {
    const ContactPoint& c = scratch.found[k];
    found.emplace_back(c.tetrahedron_a, c.place_a, c.tetrahedron, c.place, c.vertex,
                       scratch.found_gap[k]);
  }
  return found;
}

}  // namespace

TEST_CASE("pairs that are kept give the contacts that a search in each step gives",
          "[mechanics][contact]") {
  std::mt19937 random(5);
  const double h = GENERATE(2e-4, 1e-3);
  Crowd crowd(random);
  DetectScratch kept;
  std::size_t contacts = 0, steps = 200;
  for (std::size_t k = 0; k < steps; ++k) {
    DetectScratch fresh;
    crowd.predict(h, false);
    const Found expected = found_by(fresh, crowd, h);
    CHECK(found_by(kept, crowd, h) == expected);
    contacts += expected.size();
    crowd.predict(h, true);
  }
  CHECK(contacts > steps);
  CHECK(kept.near_edges.searches > 1);
  CHECK(kept.near_edges.searches < steps / 2);
  CHECK(kept.near_solids.searches < steps / 2);
}

TEST_CASE("a search for some bodies finds all their contacts, and no others",
          "[mechanics][contact]") {
  std::mt19937 random(8);
  Crowd crowd(random);
  ContactSettings settings;
  settings.allowed_penetration = 1e-3;
  constexpr double h = 0.02;
  const auto search = [&](const std::vector<Scope>& scope, const std::vector<Scope>& inside) {
    StepPaths paths = crowd.paths(h);
    paths.scope = scope;
    DetectScratch scratch;
    update_partners(crowd.memory, scratch, paths);
    find_contacts(scratch, crowd.memory, paths, settings);
    find_overlaps(scratch, paths, settings, 0);
    std::vector<std::pair<ContactKey, double>> found;
    for (std::size_t k = 0; k < scratch.found.size(); ++k) {
      bool counts = false;
      for_each_component(scratch.found[k], crowd.state, [&](ComponentId id) {
        counts = counts || inside[id.index()] == Scope::inside;
      });
      if (counts) found.emplace_back(key_of(scratch.found[k]), scratch.found_gap[k]);
    }
    CHECK((&scope != &inside || found.size() == scratch.found.size()));
    return found;
  };
  const std::size_t bodies = crowd.state.components.size();
  const std::vector<Scope> everything(bodies, Scope::inside);
  std::size_t contacts = 0;
  for (int k = 0; k < 30; ++k) {
    crowd.predict(h, false);
    std::vector<Scope> scope(bodies, Scope::near);
    for (Scope& one : scope) one = random() % 3 == 0 ? Scope::inside : Scope::near;
    const auto found = search(scope, scope);
    CHECK(found == search(everything, scope));
    contacts += found.size();
    scope[static_cast<std::size_t>(k) % bodies] = Scope::outside;
    CHECK(search(scope, scope).size() <= found.size());
    crowd.predict(h, true);
  }
  CHECK(contacts > 100);
}

TEST_CASE("ways are measured against the affine field of all", "[mechanics][contact]") {
  std::mt19937 random(6);
  Crowd crowd(random);
  for (std::size_t k = 0; k < crowd.velocity.size(); ++k) {
    crowd.velocity[k] = Vec3(100, 0, 0);
    crowd.spin[k].setZero();
  }
  Travel travel;
  travel.reach = 0.5;
  crowd.predict(0.01, false);
  update_travel(travel, crowd.paths(0.01));
  CHECK(travel.farthest < 1e-12);
  // A cloud that grows has the bound of its field alone.
  for (Vec3& x : crowd.predicted) x *= 1.01;
  update_travel(travel, crowd.paths(0.01));
  CHECK(travel.farthest == Approx(0.25 * (0.01 * std::sqrt(3.0) + 0.0003)));
}

TEST_CASE("two features come nearer by the ways of their bodies at most", "[mechanics][contact]") {
  std::mt19937 random(7);
  Crowd crowd(random);
  Travel travel;
  travel.reach = 2;
  crowd.predict(0.01, true);
  update_travel(travel, crowd.paths(0.01));
  const std::vector<Vec3> start = crowd.state.vertices.position;
  const std::vector<double> so_far = travel.so_far;
  for (int k = 0; k < 10; ++k) {
    crowd.predict(0.01, true);
    update_travel(travel, crowd.paths(0.01));
  }
  const std::vector<Vec3>& end = crowd.state.vertices.position;
  std::size_t nearer = 0;
  for (std::size_t v = 0; v < start.size(); ++v) {
    for (std::size_t w = 0; w < v; ++w) {
      const std::size_t a = crowd.state.vertices.component[v].index();
      const std::size_t b = crowd.state.vertices.component[w].index();
      const double before = (start[v] - start[w]).norm();
      if (a == b || before > travel.reach) continue;
      const double ways = travel.so_far[a] - so_far[a] + travel.so_far[b] - so_far[b];
      const double approach = before - (end[v] - end[w]).norm();
      CHECK(approach <= ways * (1 + 1e-9));
      nearer += approach > 0.2 * ways;
    }
  }
  CHECK(nearer > 0);
}
