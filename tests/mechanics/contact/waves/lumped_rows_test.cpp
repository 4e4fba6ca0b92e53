// SPDX-License-Identifier: MIT
// Rows of contacts on lumped nodes and rigid bodies: signs, friction, momenta.
#include "mechanics/contact/waves/lumped_rows.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "mechanics/integrators/rigid_motion.hpp"
#include "tests/support/bodies.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// Nodes with masses 1, 2, ... at random places, a rigid body, and rows between them.
struct Problem {
  WaveBodies waves;
  LumpedContacts contacts;

  explicit Problem(std::mt19937& random, std::size_t count) {
    WaveNodes& nodes = waves.nodes;
    for (std::size_t i = 0; i < count; ++i) {
      nodes.mass.push_back(1.0 + static_cast<double>(i % 5));
      nodes.inverse_mass.push_back(1 / nodes.mass.back());
      nodes.cluster.push_back(ScaledCells::none);
      nodes.vertex.emplace_back(i);
      nodes.is_held.push_back(0);
      for (QuadColumn* column : {&nodes.position, &nodes.velocity}) {
        const Vec3 value = random_vector(random);
        column->insert(column->end(), {value.x(), value.y(), value.z(), 0.0});
      }
    }
    contacts.twist.assign(2, Vec3::Zero());
    waves.velocity_before = nodes.velocity;
  }

  void add_rigid(const Vec3& centre, const Vec3& velocity) {
    WaveRigid body;
    body.component = ComponentId{9};
    body.inverse_mass = 0.5;
    body.inverse_inertia = Vec3(1, 2, 3).asDiagonal();
    body.centre = centre;
    body.velocity = body.velocity_before = velocity;
    contacts.rigid.push_back(body);
  }

  LumpedSide nodes_side(std::vector<LumpedEnd> ends, std::uint32_t body) {
    LumpedSide side;
    side.first = static_cast<std::uint32_t>(contacts.ends.size());
    side.count = static_cast<std::uint32_t>(ends.size());
    side.body = body;
    side.is_component = true;
    contacts.ends.insert(contacts.ends.end(), ends.begin(), ends.end());
    return side;
  }

  void add_row(const LumpedSide& a, const LumpedSide& b, const Vec3& normal, double friction) {
    LumpedRow row;
    row.sides = {a, b};
    row.normal = normal.normalized();
    row.friction = friction;
    for (const LumpedSide& side : row.sides) {
      const auto [along, across] = response_of(side, contacts, waves.nodes, row.normal);
      row.normal_response += along;
      row.tangential_response += across;
      if (side.rigid == LumpedSide::none) continue;
      double& reach = contacts.rigid[side.rigid].reach;
      reach = std::max(reach, side.arm.norm());
    }
    contacts.rows.push_back(row);
  }

  void place_rows(double step) {
    measure_gaps(contacts, waves.nodes, 0);
    for (LumpedRow& row : contacts.rows) row.apart = row.sides[0].place - row.sides[1].place;
    measure_gaps(contacts, waves.nodes, 0);
    begin_rows(contacts, waves.nodes, {step});
  }

  void solve(double step, int sweeps) {
    place_rows(step);
    for (int k = 0; k < sweeps && sweep_rows(contacts, waves.nodes, step) > 1e-13; ++k) {
    }
    settle_rows(contacts, waves);
  }

  Vec3 velocity_of(const LumpedSide& side) const {
    if (side.rigid != LumpedSide::none) {
      const WaveRigid& body = contacts.rigid[side.rigid];
      return body.velocity + body.spin.cross(side.arm);
    }
    Vec3 sum = Vec3::Zero();
    for (std::uint32_t e = side.first; e < side.first + side.count; ++e) {
      sum += contacts.ends[e].weight * row_of(waves.nodes.velocity, contacts.ends[e].node);
    }
    return sum;
  }
};

}  // namespace

TEST_CASE("rows press, never pull, and rub against the slip inside Coulomb's cone",
          "[mechanics][waves]") {
  std::mt19937 random(21);
  for (int trial = 0; trial < 40; ++trial) {
    Problem problem(random, 12);
    problem.add_rigid(random_vector(random), random_vector(random));
    for (std::uint32_t k = 0; k < 3; ++k) {
      const LumpedSide a = problem.nodes_side({{k, 1.0}}, 0);
      const LumpedSide b = problem.nodes_side({{3 + k, 0.25}, {6 + k, 0.5}, {9 + k, 0.25}}, 1);
      problem.add_row(a, b, random_vector(random), 0.4);
    }
    LumpedSide rigid;
    rigid.rigid = 0;
    rigid.is_component = true;
    rigid.arm = 0.3 * random_vector(random);
    problem.add_row(problem.nodes_side({{0, 0.5}, {1, 0.5}}, 0), rigid, random_vector(random), 0.4);
    problem.solve(0.1, 5000);
    for (const LumpedRow& row : problem.contacts.rows) {
      const Vec3 slip = problem.velocity_of(row.sides[0]) - problem.velocity_of(row.sides[1]);
      const double pressed = row.normal.dot(row.impulse), parts = row.normal.dot(slip);
      const Vec3 across = slip - parts * row.normal;
      const Vec3 rubs = row.impulse - pressed * row.normal;
      CHECK(pressed >= 0);
      CHECK(parts > -1e-10);
      CHECK(pressed * parts < 1e-9);
      CHECK(rubs.norm() <= 0.4 * pressed * (1 + 1e-12));
      if (across.norm() > 1e-8) {
        CHECK(rubs.norm() == Approx(0.4 * pressed).margin(1e-9));
        CHECK(rubs.dot(across) <= 1e-9);
      }
    }
  }
}

TEST_CASE("sweeps that leave rows alone end where sweeps over all rows do", "[mechanics][waves]") {
  std::mt19937 random(22);
  for (int trial = 0; trial < 20; ++trial) {
    Problem all(random, 30);
    for (int k = 0; k < 8; ++k) all.add_rigid(random_vector(random), random_vector(random));
    std::uniform_int_distribution<std::uint32_t> node(0, 29), rigid(0, 7);
    for (int k = 0; k < 60; ++k) {
      LumpedSide side;
      side.rigid = rigid(random);
      side.is_component = true;
      side.arm = 0.3 * random_vector(random);
      const LumpedSide other = k % 2 == 0 ? all.nodes_side({{node(random), 1.0}}, 0) : side;
      if (k % 2 == 1) side.rigid = (other.rigid + 1 + rigid(random) % 7) % 8;
      all.add_row(other, side, random_vector(random), trial % 2 == 0 ? 0 : 0.4);
    }
    Problem some = all;
    all.solve(0.1, 20000);
    some.place_rows(0.1);
    int sweeps = 0;
    const double tolerance = 1e-9;
    CHECK(relax_rows(some.contacts, some.waves.nodes, 0.1, {tolerance, 20000}, sweeps) <=
          tolerance);
    for (std::size_t k = 0; k < all.contacts.rows.size(); ++k) {
      const LumpedRow &a = all.contacts.rows[k], &b = some.contacts.rows[k];
      const Vec3 slip_a = all.velocity_of(a.sides[0]) - all.velocity_of(a.sides[1]);
      const Vec3 slip_b = some.velocity_of(b.sides[0]) - some.velocity_of(b.sides[1]);
      CHECK((slip_a - slip_b).norm() < 1e-6);
    }
  }
}

TEST_CASE("a sweep of rows that hold already visits each of them once", "[mechanics][waves]") {
  std::mt19937 random(23);
  Problem problem(random, 12);
  for (std::uint32_t k = 0; k < 6; ++k) {
    problem.add_row(problem.nodes_side({{k, 1.0}}, 0), problem.nodes_side({{6 + k, 1.0}}, 1),
                    random_vector(random), 0.4);
  }
  problem.solve(0.1, 5000);
  int sweeps = 0;
  CHECK(relax_rows(problem.contacts, problem.waves.nodes, 0.1, {1e-9, 100}, sweeps) < 1e-9);
  CHECK(sweeps == 1);
}

TEST_CASE("momentum and angular momentum are kept, however few the sweeps", "[mechanics][waves]") {
  std::mt19937 random(22);
  const int sweeps = GENERATE(1, 3, 1000);
  for (int trial = 0; trial < 20; ++trial) {
    Problem problem(random, 8);
    problem.add_rigid(random_vector(random), random_vector(random));
    const auto momenta = [&] {
      Vec3 p = Vec3::Zero(), l = Vec3::Zero();
      for (std::size_t i = 0; i < 8; ++i) {
        const Vec3 mv = problem.waves.nodes.mass[i] * row_of(problem.waves.nodes.velocity, i);
        p += mv;
        l += Vec3(row_of(problem.waves.nodes.position, i)).cross(mv);
      }
      const WaveRigid& body = problem.contacts.rigid[0];
      // The twist of the rigid body is exact; its spin follows with its own inertia.
      p += body.impulse;
      l += body.centre.cross(body.impulse) + body.twist;
      for (const Vec3& twist : problem.contacts.twist) l += twist;
      return std::pair(p, l);
    };
    const auto [p, l] = momenta();
    problem.add_row(problem.nodes_side({{0, 1.0}}, 0),
                    problem.nodes_side({{1, 0.3}, {2, 0.3}, {3, 0.4}}, 1), random_vector(random),
                    0.7);
    LumpedSide rigid;
    rigid.rigid = 0;
    rigid.arm = random_vector(random);
    problem.add_row(problem.nodes_side({{4, 0.5}, {5, 0.5}}, 0), rigid, random_vector(random), 0.7);
    problem.solve(0.1, sweeps);
    const auto [p_end, l_end] = momenta();
    CHECK((p_end - p).norm() < 1e-13 * (1 + p.norm()));
    CHECK((l_end - l).norm() < 1e-13 * (1 + l.norm()));
  }
}

TEST_CASE("a gap is closed and no more, and a deep side comes out at its push",
          "[mechanics][waves]") {
  std::mt19937 random(23);
  Problem problem(random, 2);
  row_of(problem.waves.nodes.velocity, 0) = Vec3(0, 0, -1);
  row_of(problem.waves.nodes.velocity, 1) = Vec3::Zero();
  problem.add_row(problem.nodes_side({{0, 1.0}}, 0), problem.nodes_side({{1, 1.0}}, 1),
                  Vec3::UnitZ(), 0);
  LumpedRow& row = problem.contacts.rows[0];
  SECTION("open") { row.gap_start = 0.04; }
  SECTION("deep") {
    row.push = 0.2;
    row.push_most = 100;
  }
  const double expected = row.push > 0 ? row.push : -row.gap_start / 0.1;
  problem.solve(0.1, 100);
  const Vec3 slip = problem.velocity_of(problem.contacts.rows[0].sides[0]) -
                    problem.velocity_of(problem.contacts.rows[0].sides[1]);
  CHECK(slip.z() == Approx(expected));
}

TEST_CASE("a free rigid body keeps its energy as it turns, and turns as by short steps",
          "[mechanics][waves]") {
  std::mt19937 random(24);
  Problem problem(random, 0);
  problem.add_rigid({0, 0, 0}, {0, 0, 0});
  WaveRigid& body = problem.contacts.rigid[0];
  body.angular_momentum = {0.3, 4, 0.2};
  body.spin = body.inverse_inertia * body.angular_momentum;
  const Mat3 inertia = Vec3(1, 0.5, 1.0 / 3).asDiagonal();
  const double energy = body.angular_momentum.dot(body.spin);
  const double step = 1e-3;  // 0.008 rad
  double time = 0;
  for (int k = 0; k < 20000; ++k) {
    body.turned += step * body.spin;
    body.since_turn += step;
    turn_rigid(problem.contacts, 0);
    time += step;
  }
  CHECK(body.angular_momentum.dot(body.spin) == Approx(energy).epsilon(1e-11));
  const Mat3 back = body.orientation.toRotationMatrix().transpose();
  CHECK((back * body.inverse_inertia * back.transpose() - inertia.inverse()).norm() < 1e-10);
  const Vec3& L = body.angular_momentum;
  Eigen::Quaterniond expected{1, 0, 0, 0};
  const int parts = 200000;
  for (int k = 0; k < parts; ++k) {
    expected = turn_through_step(expected, {inertia, Vec3::Zero(), L, L, time / parts});
  }
  CHECK(body.orientation.angularDistance(expected) < 1e-2);
}

TEST_CASE("the moment that a deep side misses is work that is counted", "[mechanics][waves]") {
  std::mt19937 random(25);
  Problem problem(random, 1);
  problem.waves.measures_work = true;
  row_of(problem.waves.nodes.velocity, 0) = Vec3(0.4, 0.3, -2);
  problem.waves.velocity_before = problem.waves.nodes.velocity;
  problem.add_rigid({0, 0, 0}, {0, 0, 0});
  LumpedSide rigid;
  rigid.rigid = 0;
  rigid.is_component = true;
  // Far from the node: a deep overlap.
  rigid.arm = row_of(problem.waves.nodes.position, 0) + Vec3(0.1, 0.2, 0.3);
  problem.add_row(problem.nodes_side({{0, 1.0}}, 0), rigid, Vec3::UnitZ(), 0.5);
  WaveRigid& body = problem.contacts.rigid[0];
  body.angular_momentum = {1, 2, 3};
  body.spin = body.spin_before = body.inverse_inertia * body.angular_momentum;
  const Mat3 inertia = body.inverse_inertia.inverse();
  const auto energy = [&] {
    const WaveNodes& nodes = problem.waves.nodes;
    return 0.5 *
           (nodes.mass[0] * row_of(nodes.velocity, 0).squaredNorm() +
            body.velocity.squaredNorm() / body.inverse_mass + body.spin.dot(inertia * body.spin));
  };
  const double before = energy();
  problem.solve(0.1, 100);
  turn_rigid(problem.contacts, 0);
  CHECK(problem.contacts.work.contact != 0);
  CHECK((inertia * body.spin - body.angular_momentum - body.twist).norm() < 1e-12);
  CHECK(energy() - before == Approx(problem.contacts.work.contact));
}
