// SPDX-License-Identifier: MIT
// Cohesive bonds between lumped masses: energy taken, momentum kept.
#include "mechanics/contact/waves/lumped_bonds.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/bodies.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// Two nodes of one body, bonded, that part at a speed.
struct Pull {
  WaveBodies waves;
  LumpedBonds bonds;
  LumpedContacts contacts;
  TieCorner corner{.area = 2e-4, .strength = 1e6, .opened = 0, .opening_end = 1e-5, .taken = 0};
  std::vector<TiePair> pairs;

  explicit Pull(const Vec3& velocity) {
    WaveNodes& nodes = waves.nodes;
    for (const double sign : {1.0, -1.0}) {
      nodes.mass.push_back(sign > 0 ? 0.3 : 0.2);
      nodes.inverse_mass.push_back(1 / nodes.mass.back());
      nodes.cluster.push_back(ScaledCells::none);
      nodes.vertex.emplace_back(nodes.size());
      nodes.is_held.push_back(0);
      nodes.position.insert(nodes.position.end(), {1.0, 2.0, 3.0, 0.0});
      const Vec3 v = (sign > 0 ? 0.4 : -0.6) * velocity;
      nodes.velocity.insert(nodes.velocity.end(), {v.x(), v.y(), v.z(), 0.0});
    }
    waves.bodies.push_back({});
    waves.bodies[0].id = ComponentId{0};
    waves.bodies[0].end_node = 2;
    waves.node_of_vertex = {0, 1};
    waves.measures_work = true;
    contacts.twist.assign(1, Vec3::Zero());
    pairs.push_back({.a = VertexId{0},
                     .b = VertexId{1},
                     .normal = Vec3::UnitZ(),
                     .area = corner.area,
                     .corners = {&corner}});
    const Vec3 none = Vec3::Zero();
    make_bonds(bonds, pairs, {&none, 1}, waves);
  }
  Pull(const Pull&) = delete;
  Pull& operator=(const Pull&) = delete;

  double kinetic() const {
    double sum = 0;
    for (std::size_t i = 0; i < 2; ++i) {
      sum += 0.5 * waves.nodes.mass[i] * row_of(waves.nodes.velocity, i).squaredNorm();
    }
    return sum;
  }

  void step(double h) {
    const RowStep row_step{h};
    waves.velocity_before = waves.nodes.velocity;
    begin_bonds(bonds, pairs, waves.nodes, row_step);
    CHECK(sweep_bonds(bonds, pairs, waves.nodes, row_step, 1e-6, 100)[1] < 1e-6);
    settle_bonds(bonds, pairs, waves, contacts, row_step);
    for (std::size_t i = 0; i < 2; ++i) {
      row_of(waves.nodes.position, i) += h * row_of(waves.nodes.velocity, i);
    }
  }
};

}  // namespace

TEST_CASE("a bond that opens takes its fracture energy, in steps of any length",
          "[mechanics][waves]") {
  const double steps = GENERATE(3.0, 10.0, 300.0);
  const Vec3 direction = GENERATE(Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(1, 2, 2) / 3);
  Pull pull(0.5 * direction);
  const double start = pull.kinetic(), energy = 0.5 * 1e6 * 1e-5 * 2e-4;
  REQUIRE(energy < 0.9 * start);
  const double h = 1e-5 / 0.5 / steps;
  int taken = 0;
  while (!pull.corner.is_spent() && taken++ < 10000) pull.step(h);
  CHECK(pull.corner.is_spent());
  CHECK(pull.corner.taken == Approx(energy).epsilon(1e-9));
  const TieReport report = report_of(pull.bonds, pull.pairs, pull.waves);
  CHECK(report.work == Approx(energy).epsilon(0.01));
  CHECK(report.torn == std::vector<ComponentId>{ComponentId{0}});
  // The motion's loss is the law's energy and the loss of the steps.
  CHECK(start - pull.kinetic() == Approx(report.work + pull.bonds.numerical).epsilon(1e-9));
  CHECK(pull.bonds.numerical >= -1e-12 * start);
  CHECK(pull.bonds.numerical < 3 / steps * energy);
}

TEST_CASE("a bond that motion cannot open brings its nodes to one velocity", "[mechanics][waves]") {
  Pull pull(Vec3(0, 0, 0.05));
  for (int k = 0; k < 400; ++k) pull.step(1e-6);
  CHECK_FALSE(pull.corner.is_spent());
  CHECK(pull.corner.opened > 0);
  const Vec3 slip = row_of(pull.waves.nodes.velocity, 0) - row_of(pull.waves.nodes.velocity, 1);
  CHECK(slip.norm() < 0.05);
  const Vec3 momentum =
      0.3 * row_of(pull.waves.nodes.velocity, 0) + 0.2 * row_of(pull.waves.nodes.velocity, 1);
  CHECK(momentum.norm() < 1e-15);
}
