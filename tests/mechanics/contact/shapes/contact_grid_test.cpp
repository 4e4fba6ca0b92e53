// SPDX-License-Identifier: MIT
// The uniform grid against its slow twin.
#include "mechanics/contact/shapes/contact_grid.hpp"

#include "mechanics/contact/shapes/contact_pairs.hpp"

#include <catch2/catch.hpp>
#include <limits>
#include <random>

using namespace sunder;

namespace {

struct Cloud {
  std::vector<Vec3> points, centres;
  std::vector<double> radii;
  std::vector<ComponentId> point_component, centre_component;

  SphereQuery query() const { return {points, point_component, centres, radii, centre_component}; }
};

Cloud random_cloud(unsigned seed, double radius_spread) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-1, 1);
  std::uniform_real_distribution<double> power(0, 1);
  std::uniform_int_distribution<std::size_t> component(0, 3);
  Cloud cloud;
  for (int k = 0; k < 400; ++k) {
    cloud.points.emplace_back(place(random), place(random), place(random));
    cloud.point_component.emplace_back(component(random));
    cloud.centres.emplace_back(place(random), place(random), place(random));
    cloud.centre_component.emplace_back(component(random));
    cloud.radii.push_back(0.12 * std::pow(radius_spread, power(random)));
  }
  return cloud;
}

}  // namespace

TEST_CASE("the grid finds exactly the pairs that comparing everything finds",
          "[mechanics][contact][grid]") {
  const unsigned seed = GENERATE(1u, 2u, 3u, 4u, 5u);
  const double radius_spread = GENERATE(1.0, 10.0, 1000.0);
  INFO("seed " << seed << ", spread of radii " << radius_spread);
  const Cloud cloud = random_cloud(seed, radius_spread);
  GridScratch scratch;
  std::vector<SpherePair> fast, slow;
  find_sphere_pairs(fast, scratch, cloud.query());
  find_sphere_pairs_brute_force(slow, cloud.query());
  REQUIRE(slow.size() > 10);
  CHECK(fast == slow);
}

TEST_CASE("the grid allocates nothing the second time", "[mechanics][contact][grid]") {
  const Cloud cloud = random_cloud(7, 3.0);
  GridScratch scratch;
  std::vector<SpherePair> pairs;
  find_sphere_pairs(pairs, scratch, cloud.query());
  const auto* cells = scratch.cell_of.data();
  const auto* buckets = scratch.first_of.data();
  const auto* found = pairs.data();
  find_sphere_pairs(pairs, scratch, cloud.query());
  CHECK(scratch.cell_of.data() == cells);
  CHECK(scratch.first_of.data() == buckets);
  CHECK(pairs.data() == found);
}

TEST_CASE("pairs sifted from a search with a margin are those of a fresh search",
          "[mechanics][contact][grid]") {
  const unsigned seed = GENERATE(1u, 2u, 3u);
  INFO("seed " << seed);
  Cloud cloud = random_cloud(seed, 3.0);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> way(-1e-3, 1e-3);
  std::vector<Vec3> point_motion, center_motion;
  for (int k = 0; k < 400; ++k) {
    point_motion.emplace_back(way(random), way(random), way(random));
    center_motion.emplace_back(way(random), way(random), way(random));
  }
  GridScratch grid, fresh_grid;
  PairCache cache;
  std::vector<SpherePair> sifted, fresh;
  for (int step = 0; step < 60; ++step) {
    for (std::size_t k = 0; k < 400; ++k) {
      cloud.points[k] += point_motion[k];
      cloud.centres[k] += center_motion[k];
      cloud.radii[k] *= 1.0001;
    }
    if (step == 30) cloud.point_component[7] = ComponentId{5};  // something broke
    if (step == 40) cloud.points[9] += Vec3::Constant(0.5);     // something jumped
    find_sphere_pairs(sifted, grid, cache, cloud.query());
    find_sphere_pairs(fresh, fresh_grid, cloud.query());
    REQUIRE(sifted == fresh);
  }
  CHECK(cache.searches < 20);
}

TEST_CASE("the grid survives points that are not numbers or very far away",
          "[mechanics][contact][grid]") {
  Cloud cloud = random_cloud(11, 3.0);
  cloud.points[3] = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  cloud.points[4] = Vec3::Constant(1e300);
  cloud.centres[5].x() = std::numeric_limits<double>::infinity();
  cloud.radii[6] = 1e6;
  GridScratch scratch;
  std::vector<SpherePair> fast, slow;
  find_sphere_pairs(fast, scratch, cloud.query());
  find_sphere_pairs_brute_force(slow, cloud.query());
  CHECK(fast == slow);
}

TEST_CASE("a vertex never pairs with a ball of its own component", "[mechanics][contact][grid]") {
  Cloud cloud = random_cloud(13, 10.0);
  cloud.point_component.assign(cloud.points.size(), ComponentId{2});
  cloud.centre_component.assign(cloud.centres.size(), ComponentId{2});
  GridScratch scratch;
  std::vector<SpherePair> pairs;
  find_sphere_pairs(pairs, scratch, cloud.query());
  CHECK(pairs.empty());
}
