// SPDX-License-Identifier: MIT
// Bodies and rows as the contact solver takes them, made up at random; no mesh.
#pragma once

#include <Eigen/Eigenvalues>
#include <random>
#include <vector>

#include "mechanics/contact/solver/row_response.hpp"
#include "mechanics/frame/rotation.hpp"
#include "tests/support/bodies.hpp"

namespace sunder::test {

/// Bodies with the rows that act on them.
struct RowProblem {
  std::vector<RespondingBody> bodies;
  std::vector<Constraint> rows;
  std::vector<RowResponse> responses;  ///< one per row, from `prepare_rows` on
  double step = 1e-2;

  RowSolve solve() { return {rows, responses, bodies, step}; }
};

inline double random_number(std::mt19937& random, double least, double most) {
  return std::uniform_real_distribution<double>(least, most)(random);
}

inline Mat3 random_inertia(std::mt19937& random) {
  const Mat3 turn = random_rotation(random).toRotationMatrix();
  const Vec3 size = Vec3(3, 3, 3) + random_vector(random);
  return turn * size.asDiagonal() * turn.transpose();
}

inline RespondingBody random_rigid_body(std::mt19937& random) {
  RespondingBody body;
  body.inverse_mass = random_number(random, 0.5, 1.5);
  body.inverse_inertia = random_inertia(random);
  return body;
}

/// A free body with an elastic response between `arms.size()` slots at rest arms `arms` (m) and
/// weights `weights`, `ratio` times stiffer than the body is free over a step.
inline RespondingBody random_elastic_body(std::mt19937& random, std::span<const Vec3> arms,
                                          std::span<const double> weights, double ratio,
                                          double step) {
  RespondingBody body = random_rigid_body(random);
  body.turn = random_rotation(random).toRotationMatrix();
  body.rigid_mass = step * random_number(random, 0.2, 0.4);
  body.rigid_inertia = step * random_inertia(random);
  const auto size = static_cast<Eigen::Index>(3 * arms.size());
  const Eigen::MatrixXd any =
      Eigen::MatrixXd::NullaryExpr(size, size, [&] { return random_number(random, -1, 1); });
  body.elastic = step / ratio / static_cast<double>(size) * any * any.transpose();
  body.elastic.diagonal().array() += 0.1 * step / ratio;
  // The rigid response of E, which other terms take off again: the whole stays positive definite.
  for (std::size_t a = 0; a < arms.size(); ++a) {
    for (std::size_t b = 0; b < arms.size(); ++b) {
      Mat3 rigid = -cross_matrix(arms[a]) * body.rigid_inertia * cross_matrix(arms[b]);
      rigid.diagonal().array() += weights[a] * weights[b] * body.rigid_mass;
      body.elastic.block<3, 3>(static_cast<Eigen::Index>(3 * a),
                               static_cast<Eigen::Index>(3 * b)) += rigid;
    }
  }
  return body;
}

/// Rows between random points of two rigid bodies and two elastic ones.
inline RowProblem random_rows(unsigned seed, std::size_t count, double ratio) {
  std::mt19937 random(seed);
  RowProblem problem;
  std::array<std::vector<Vec3>, 4> arms;
  std::array<std::vector<double>, 4> weights;
  for (std::size_t k = 0; k < count; ++k) {
    Constraint row;
    row.normal = random_vector(random).normalized();
    row.contact().gap = 0.01 * random_number(random, -1, 0.5);
    row.slip = 0.01 * random_vector(random);
    row.contact().friction = 0.4;
    const std::uint32_t first = static_cast<std::uint32_t>(random() % 4);
    const std::uint32_t second = (first + 1 + static_cast<std::uint32_t>(random() % 3)) % 4;
    row.side_count = 2;
    for (std::uint32_t s = 0; s < 2; ++s) {
      RowSide& side = row.sides[s];
      side.body = s == 0 ? first : second;
      side.weight = s == 0 ? 1 : -1;
      side.arm = random_vector(random);
      if (side.body < 2) continue;
      side.rest_arm = random_vector(random);
      side.slot = static_cast<std::uint32_t>(arms[side.body].size());
      arms[side.body].push_back(side.rest_arm);
      weights[side.body].push_back(side.weight);
    }
    problem.rows.push_back(row);
  }
  for (std::size_t b = 0; b < 4; ++b) {
    problem.bodies.push_back(
        b < 2 ? random_rigid_body(random)
              : random_elastic_body(random, arms[b], weights[b], ratio, problem.step));
  }
  return problem;
}

/// The quantities that `solve_contacts` fills in before it sweeps; nothing is pressed yet.
inline void prepare_rows(RowProblem& problem) {
  set_to_rest(problem.bodies);
  problem.responses.clear();
  for (const Constraint& row : problem.rows) {
    RowResponse own = own_response(row, problem.bodies, problem.step);
    own.normal_response = row.normal.dot(own.response * row.normal) + row.compliance;
    const Mat3 across = Mat3::Identity() - row.normal * row.normal.transpose();
    own.tangential_response = Eigen::SelfAdjointEigenSolver<Mat3>(across * own.response * across)
                                  .eigenvalues()
                                  .maxCoeff();
    own.push_most = own.normal_response > 0 ? 100 * row.contact().push / own.normal_response : 0;
    problem.responses.push_back(own);
  }
}

/// Radii of the disks by the normal impulses as they are.
inline void set_disks(RowProblem& problem) {
  for (std::size_t k = 0; k < problem.rows.size(); ++k) {
    const Constraint& row = problem.rows[k];
    problem.responses[k].disk = row.contact().friction * std::max(0.0, row.normal.dot(row.impulse));
  }
}

/// One plain sweep of projected Gauss-Seidel with the disks as they are. Gives the largest
/// distance (m) of a row from where it should be.
inline double plain_sweep(RowProblem& problem) {
  double farthest = 0;
  for (std::size_t k = 0; k < problem.rows.size(); ++k) {
    Constraint& row = problem.rows[k];
    const RowResponse& response = problem.responses[k];
    const Vec3 n = row.normal;
    const double before = n.dot(row.impulse);
    const auto gap = [&] {
      return row.contact().gap + n.dot(relative_displacement(row, problem.bodies, problem.step)) +
             row.compliance * n.dot(row.impulse);
    };
    double wanted = before - gap() / response.normal_response;
    if (row.contact().push > 0) {
      const double give = row.contact().push / response.push_most;
      const double pushed =
          before + (row.contact().push - gap() - give * before) / (response.normal_response + give);
      wanted = std::max(wanted, std::min(pushed, response.push_most));
    }
    wanted = std::clamp(wanted, row.contact().least, row.contact().most);
    add_impulse(row, problem.bodies, (wanted - before) * n);
    row.impulse += (wanted - before) * n;
    farthest = std::max(farthest, std::abs(wanted - before) * response.normal_response);
    const Vec3 total = row.slip + relative_displacement(row, problem.bodies, problem.step);
    const Vec3 friction = row.impulse - wanted * n;
    Vec3 rubs = friction - (total - n * n.dot(total)) / response.tangential_response;
    if (rubs.norm() > response.disk) rubs *= response.disk / rubs.norm();
    add_impulse(row, problem.bodies, rubs - friction);
    row.impulse += rubs - friction;
    farthest = std::max(farthest, (rubs - friction).norm() * response.tangential_response);
  }
  return farthest;
}

/// All impulses of the rows one below the other.
inline Eigen::VectorXd impulses_of(const RowProblem& problem) {
  Eigen::VectorXd all(static_cast<Eigen::Index>(3 * problem.rows.size()));
  for (std::size_t k = 0; k < problem.rows.size(); ++k) {
    all.segment<3>(static_cast<Eigen::Index>(3 * k)) = problem.rows[k].impulse;
  }
  return all;
}

/// The displacement of each row by the motion of the bodies, m.
inline Eigen::VectorXd displacements_of(const RowProblem& problem) {
  Eigen::VectorXd all(static_cast<Eigen::Index>(3 * problem.rows.size()));
  for (std::size_t k = 0; k < problem.rows.size(); ++k) {
    all.segment<3>(static_cast<Eigen::Index>(3 * k)) =
        relative_displacement(problem.rows[k], problem.bodies, problem.step);
  }
  return all;
}

/// The response of all rows to all impulses, column by column: unit impulses on bodies at rest.
inline Eigen::MatrixXd dense_response(RowProblem problem) {
  const auto size = static_cast<Eigen::Index>(3 * problem.rows.size());
  Eigen::MatrixXd response(size, size);
  for (std::size_t k = 0; k < problem.rows.size(); ++k) {
    for (int i = 0; i < 3; ++i) {
      set_to_rest(problem.bodies);
      add_impulse(problem.rows[k], problem.bodies, Vec3::Unit(i));
      response.col(static_cast<Eigen::Index>(3 * k) + i) = displacements_of(problem);
    }
  }
  return response;
}

}  // namespace sunder::test
