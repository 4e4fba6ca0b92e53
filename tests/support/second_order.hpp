// SPDX-License-Identifier: MIT
// Nodes in the middles of edges for bodies that are given by corners alone, and boundary nodes.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "mechanics/element/second_order.hpp"
#include "mechanics/rebuild.hpp"
#include "mechanics/state/mechanics_state.hpp"
#include "tests/support/bodies.hpp"

namespace sunder::test {

/// Tetrahedron and opposite corner of every face that no other tetrahedron has.
inline std::vector<std::pair<TetId, int>> boundary_faces_of(std::span<const Corners> corners) {
  std::map<std::array<VertexId, 3>, std::pair<int, std::pair<TetId, int>>> seen;
  for (std::size_t t = 0; t < corners.size(); ++t) {
    for (int place = 0; place < 4; ++place) {
      std::array<VertexId, 3> key;
      for (int i = 1; i < 4; ++i) {
        key[static_cast<std::size_t>(i - 1)] =
            corners[t][static_cast<std::size_t>((place + i) % 4)];
      }
      std::ranges::sort(key);
      auto& [count, where] = seen[key];
      ++count;
      where = {TetId{t}, place};
    }
  }
  std::vector<std::pair<TetId, int>> faces;
  for (const auto& [key, face] : seen) {
    if (face.first == 1) faces.push_back(face.second);
  }
  return faces;
}

/// Makes all tetrahedra of a body at rest second-order: a row for the middle of each edge, which
/// two vertices name. Call `rebuild` after it.
inline void raise_order(MechanicsState& state, std::span<const Corners> corners) {
  std::map<std::pair<VertexId, VertexId>, VertexId> rows;
  state.elements.edge_nodes.assign(corners.size(), {});
  const Mat3 none = Mat3::Zero();
  state.elements.corner_stress.assign(corners.size(), {none, none, none, none});
  for (std::size_t t = 0; t < corners.size(); ++t) {
    for (std::size_t e = 0; e < 6; ++e) {
      const VertexId a = corners[t][static_cast<std::size_t>(edge_ends[e][0])];
      const VertexId b = corners[t][static_cast<std::size_t>(edge_ends[e][1])];
      const auto [at, fresh] = rows.try_emplace(std::minmax(a, b), VertexId{state.vertices.size()});
      if (fresh) {
        append_middle(state.vertices, a, b);
      }
      state.elements.edge_nodes[t][e] = at->second;
    }
  }
}

/// A body at rest with tetrahedra of an order.
inline MechanicsState state_of_order(int order, const Body& body, const Material& material) {
  MechanicsState state = state_of(body, material);
  if (order == 1) return state;
  raise_order(state, body.corners);
  MechanicsScratch scratch;
  const std::vector<ComponentId> whole = {ComponentId{0}};
  rebuild(state, body.corners, whole, scratch);
  return state;
}

/// Holds all nodes with x at rest below a place.
inline void hold_below(MechanicsState& state, const Body& body, double x) {
  state.motions.push_back({});
  for (std::size_t v = 0; v < state.vertices.size(); ++v) {
    if (state.vertices.rest_position[v].x() < x) state.vertices.support[v] = MotionId{0};
  }
  MechanicsScratch scratch;
  const std::vector<ComponentId> whole = {ComponentId{0}};
  rebuild(state, body.corners, whole, scratch);
}

/// Which nodes lie on the boundary, a row each.
inline std::vector<bool> boundary_nodes(const MechanicsState& state,
                                        std::span<const Corners> corners) {
  std::vector<bool> outside(state.vertices.size(), false);
  for (const auto& [t, place] : boundary_faces_of(corners)) {
    for (int k = 0; k < 4; ++k) {
      if (k == place) continue;
      outside[corners[t.index()][static_cast<std::size_t>(k)].index()] = true;
      for (int j = 0; j < k; ++j) {
        if (j == place) continue;
        const auto e = static_cast<std::size_t>(edge_between(j, k));
        outside[state.elements.edge_nodes[t.index()][e].index()] = true;
      }
    }
  }
  return outside;
}

/// The corner of a block with the least coordinates.
inline Vec3 lowest_corner(const Body& body) {
  Vec3 low = body.rest.front();
  for (const Vec3& x : body.rest) low = low.cwiseMin(x);
  return low;
}

/// Points inside a block moved at random by up to `amount`, m.
inline Body jittered(Body body, double amount, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<bool> outside(body.rest.size(), false);
  for (const auto& [t, place] : boundary_faces_of(body.corners)) {
    for (int k = 0; k < 4; ++k) {
      if (k != place) outside[body.corners[t.index()][static_cast<std::size_t>(k)].index()] = true;
    }
  }
  for (std::size_t v = 0; v < body.rest.size(); ++v) {
    if (!outside[v]) body.rest[v] += amount * random_vector(random);
  }
  return body;
}

}  // namespace sunder::test
