// SPDX-License-Identifier: MIT
// Blocks cut into Kuhn tetrahedra, and short ways to set a body up and to step it.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "mechanics/element/energy.hpp"
#include "mechanics/rebuild.hpp"
#include "mechanics/state/mechanics_state.hpp"
#include "mechanics/step.hpp"

namespace sunder::test {

using std::numbers::pi;

/// A mesh as mechanics takes it.
struct Body {
  std::vector<Vec3> rest;
  std::vector<Corners> corners;
};

/// `cells` cells along the axes of a box of `size`, centred on the origin; six tetrahedra a cell.
inline Body kuhn_block(std::array<int, 3> cells, const Vec3& size) {
  Body body;
  const auto [nx, ny, nz] = cells;
  const auto row = [ny = ny, nz = nz](int i, int j, int k) {
    return VertexId{static_cast<std::size_t>((i * (ny + 1) + j) * (nz + 1) + k)};
  };
  for (int i = 0; i <= nx; ++i) {
    for (int j = 0; j <= ny; ++j) {
      for (int k = 0; k <= nz; ++k) {
        const Vec3 unit(double(i) / nx - 0.5, double(j) / ny - 0.5, double(k) / nz - 0.5);
        body.rest.push_back(unit.cwiseProduct(size));
      }
    }
  }
  // One tetrahedron an order of the axes: from the low corner to the high one along them.
  constexpr std::array<std::array<int, 3>, 6> orders = {
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  for (int i = 0; i < nx; ++i) {
    for (int j = 0; j < ny; ++j) {
      for (int k = 0; k < nz; ++k) {
        for (std::size_t o = 0; o < 6; ++o) {
          std::array<int, 3> at = {i, j, k};
          Corners t;
          t[0] = row(at[0], at[1], at[2]);
          for (std::size_t a = 0; a < 3; ++a) {
            ++at[static_cast<std::size_t>(orders[o][a])];
            t[a + 1] = row(at[0], at[1], at[2]);
          }
          if (o >= 3) std::swap(t[1], t[2]);  // odd orders are mirrored
          body.corners.push_back(t);
        }
      }
    }
  }
  return body;
}

/// Moves inner and outer vertices alike by up to `amount` (m) a coordinate.
inline Body shaken(Body body, double amount, std::mt19937& random) {
  std::uniform_real_distribution<double> shift(-amount, amount);
  for (Vec3& x : body.rest) x += Vec3(shift(random), shift(random), shift(random));
  return body;
}

/// A single regular-cornered tetrahedron of edge length `size` along the axes.
inline Body single_tetrahedron(double size) {
  return {{Vec3::Zero(), size * Vec3::UnitX(), size * Vec3::UnitY(), size * Vec3::UnitZ()},
          {{VertexId{0}, VertexId{1}, VertexId{2}, VertexId{3}}}};
}

inline MechanicsState state_of(const Body& body, const Material& material) {
  BodyDescription description{body.rest, body.corners, {}, {}, {&material, 1}};
  return *make_state(description);
}

inline Vec3 random_vector(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  return {unit(random), unit(random), unit(random)};
}

inline Mat3 random_matrix(std::mt19937& random) {
  Mat3 A;
  A << random_vector(random), random_vector(random), random_vector(random);
  return A;
}

inline Eigen::Quaterniond random_rotation(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
      .normalized();
}

/// Adds a smooth displacement field of relative size `amount` and the frame that goes with it.
inline void deform(MechanicsState& state, double amount, std::mt19937& random) {
  const Vec3 a = random_vector(random), b = random_vector(random), phase = random_vector(random);
  for (const Component& component : state.components) {
    const Mat3 R = component.orientation.toRotationMatrix();
    for (VertexId v : component.vertices) {
      const Vec3 r = state.vertices.rest_position[v.index()] / component.rest_radius;
      const Vec3 wave(std::sin(3 * a.dot(r) + phase.x()), std::sin(3 * b.dot(r) + phase.y()),
                      std::cos(2 * (a + b).dot(r) + phase.z()));
      state.vertices.position[v.index()] += R * (amount * component.rest_radius * wave);
    }
    reframe(state, component.id);
  }
}

/// Steps `count` times without anything from outside but `loads`; gives the last status.
inline StepStatus run(
    MechanicsState& state, const Body& body, const IntegratorSettings& settings, int count,
    const Loads& loads = {}, const std::function<void()>& after = [] {}) {
  MechanicsScratch scratch;
  StepStatus status;
  for (int i = 0; i < count; ++i) {
    status = advance(state, scratch, {body.corners, loads, settings});
    after();
    if (status.outcome != StepOutcome::fine) break;
  }
  return status;
}

/// Kinetic and strain energy, J. Needs: `elements.stress` up to date.
inline double total_energy(const MechanicsState& state) {
  return kinetic_energy(state.vertices) + strain_energy(state);
}

/// Projection of the displacement on the first axial mode of a bar of 1 m along x, kg m.
inline double axial_amplitude(const MechanicsState& state) {
  double sum = 0;
  for (std::size_t v = 0; v < state.vertices.size(); ++v) {
    sum += state.vertices.mass[v] * state.vertices.displacement[v].x() *
           std::sin(pi * state.vertices.rest_position[v].x());
  }
  return sum;
}

}  // namespace sunder::test
