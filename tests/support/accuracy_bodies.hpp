// SPDX-License-Identifier: MIT
// Pressures on bodies of closed forms, their equilibrium when free, and stresses at their vertices.
#pragma once

#include <functional>
#include <map>
#include <stdexcept>
#include <vector>

#include "fracture/algorithms/node_stress.hpp"
#include "mechanics/state/loads.hpp"
#include "tests/support/shapes.hpp"

namespace sunder::accuracy {

/// Tetrahedron and opposite corner of every boundary face with all vertices `inside`.
inline std::vector<std::pair<TetId, int>> boundary_faces(
    const Body& body, const std::function<bool(const Vec3&)>& inside) {
  std::map<std::array<std::uint32_t, 3>, int> uses;
  const auto key = [&](std::size_t t, int place) {
    std::array<std::uint32_t, 3> k;
    for (int i = 1; i < 4; ++i) {
      k[std::size_t(i - 1)] = body.corners[t][std::size_t((place + i) % 4)].value;
    }
    std::sort(k.begin(), k.end());
    return k;
  };
  for (std::size_t t = 0; t < body.corners.size(); ++t) {
    for (int place = 0; place < 4; ++place) ++uses[key(t, place)];
  }
  std::vector<std::pair<TetId, int>> faces;
  for (std::size_t t = 0; t < body.corners.size(); ++t) {
    for (int place = 0; place < 4; ++place) {
      const auto face = key(t, place);
      bool all = uses[face] == 1;
      for (std::uint32_t v : face) all = all && inside(body.rest[v]);
      if (all) faces.emplace_back(TetId{t}, place);
    }
  }
  return faces;
}

/// Pressure (Pa) on those faces, as forces on vertices.
inline void press(std::vector<Vec3>& force, const Body& body, const MechanicsState& state,
                  double pressure, const std::function<bool(const Vec3&)>& inside) {
  std::vector<CornerLoad> loads;
  for (const auto& [t, place] : boundary_faces(body, inside)) {
    for (const CornerLoad& load : face_pressure(state.elements, t, place, pressure)) {
      loads.push_back(load);
    }
  }
  add_corner_loads(force, loads, state, body.corners, 0);
}

/// Equilibrium of a free body under loads in balance with themselves and its spin: large steps
/// without numerical memory (rho_inf = 0) come to it by themselves. `h` (s) >> its periods.
inline void settle(MechanicsState& state, const Body& body, double h, const Loads& loads = {},
                   int steps = 12) {
  const StepStatus status =
      test::run(state, body, {.time_step = h, .rho_infinity = 0}, steps, loads);
  if (status.outcome != StepOutcome::fine) throw std::runtime_error(to_finding(status).text);
}

inline std::vector<Mat3> node_stress(const MechanicsState& state, const Body& body) {
  std::vector<Mat3> stress;
  average_node_stress(stress, {body.corners, state.elements.stress, state.elements.rest_volume},
                      body.rest.size());
  return stress;
}

/// t^T sigma t.
inline double along(const Mat3& sigma, const Vec3& t) { return t.dot(sigma * t); }

}  // namespace sunder::accuracy
