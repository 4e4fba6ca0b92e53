// SPDX-License-Identifier: MIT
// Random surfaces on a grid of even numbers, with all kinds of carelessness.
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <random>
#include <set>

#include "tests/support/cell_rows.hpp"
#include "topology/suite/fixtures/shapes.hpp"

namespace sunder::test {

/// A body of cubes of a grid of 3 x 3 x 3, its skin as quadrilaterals that look outward.
inline std::vector<Rows> skin_of_cubes(std::mt19937_64& random,
                                       const std::function<std::uint32_t(int, int, int)>& point) {
  std::set<std::array<int, 3>> cubes;
  for (std::size_t i = 1 + suite::below(random, 6); i > 0; --i) {
    cubes.insert({static_cast<int>(suite::below(random, 3)),
                  static_cast<int>(suite::below(random, 3)),
                  static_cast<int>(suite::below(random, 3))});
  }
  std::vector<Rows> faces;
  for (const auto& cube : cubes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const int way : {-1, 1}) {
        auto beside = cube;
        beside[axis] += way;
        if (cubes.contains(beside)) continue;
        Rows face;
        for (const auto& [u, v] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
          auto corner = cube;
          corner[axis] += way > 0 ? 1 : 0;
          corner[(axis + 1) % 3] += u;
          corner[(axis + 2) % 3] += v;
          face.push_back(point(corner[0], corner[1], corner[2]));
        }
        if (way < 0) std::ranges::reverse(face);
        faces.push_back(face);
      }
    }
  }
  return faces;
}

/// A surface on a grid of even numbers: cubes' skins whole or with all kinds of carelessness, of
/// quadrilaterals, triangles, polygons with corners in the middle of their sides, of second order.
inline FileMesh careless_surface(std::mt19937_64& random) {
  FileMesh mesh;
  const auto point = [](int i, int j, int k) {
    return static_cast<std::uint32_t>((k * 4 + j) * 4 + i);
  };
  for (int i = 0; i < 64; ++i)
    mesh.points.push_back({2.0 * (i % 4), 2.0 * (i / 4 % 4), 2.0 * (i / 16)});
  std::vector<Rows> faces = skin_of_cubes(random, point);
  const bool has_middles = suite::below(random, 2) == 0;
  std::map<std::set<std::uint32_t>, std::uint32_t> middles;
  const auto middle_of = [&](std::uint32_t a, std::uint32_t b) {
    const auto [at, is_new] =
        middles.emplace(std::set{a, b}, static_cast<std::uint32_t>(mesh.points.size()));
    if (is_new) {
      Point m;
      for (std::size_t k = 0; k < 3; ++k) m[k] = (mesh.points[a][k] + mesh.points[b][k]) / 2;
      mesh.points.push_back(m);
    }
    return at->second;
  };
  if (has_middles) {
    for (Rows& face : faces) {
      Rows all;
      for (std::size_t k = 0; k < 4; ++k) {
        all.push_back(face[k]);
        if (face[k] % 3 == 0 || face[(k + 1) % 4] % 3 == 0)
          all.push_back(middle_of(face[k], face[(k + 1) % 4]));
      }
      std::ranges::rotate(
          all, all.begin() + static_cast<std::ptrdiff_t>(suite::below(random, all.size())));
      face = all;
    }
  }
  for (std::size_t i = suite::below(random, 4); i > 0; --i) {
    Rows& some = faces[suite::below(random, faces.size())];
    const auto any = [&] { return static_cast<std::uint32_t>(suite::below(random, 64)); };
    switch (suite::below(random, 7)) {
      case 0:
        some = faces.back();  // one away, one twice
        break;
      case 1:
        std::ranges::reverse(some);
        break;
      case 2:
        faces.push_back({any(), any(), any()});
        break;
      case 3:
        some[0] = some[1];
        break;
      case 4:
        some[suite::below(random, some.size())] = any();
        break;
      case 5:
        // Points of its own, one of them given with another sign of nought.
        for (auto& p : some) {
          mesh.points.push_back(mesh.points[p]);
          for (double& x : mesh.points.back()) x = x == 0 ? -0.0 : x;
          p = static_cast<std::uint32_t>(mesh.points.size() - 1);
        }
        break;
      default:
        if (faces.size() > 1) faces.pop_back();
    }
  }
  if (suite::below(random, 8) == 0) {
    for (Rows& face : faces) std::ranges::reverse(face);
  }
  const std::size_t ways = suite::below(random, 3);
  for (const Rows& face : faces) {
    if (face.size() == 4 && suite::below(random, 3) < ways) {
      append_cell(mesh, CellKind::triangle, Rows{face[0], face[1], face[2]});
      append_cell(mesh, CellKind::triangle, Rows{face[2], face[3], face[0]});
    } else if (face.size() == 3 || face.size() == 4) {
      // Of second order by chance: more nodes, the same corners.
      Rows nodes = face;
      while (nodes.size() < 9) nodes.push_back(0);
      const CellKind kinds[2][3] = {{CellKind::triangle, CellKind::triangle6, CellKind::triangle7},
                                    {CellKind::quad4, CellKind::quad8, CellKind::quad9}};
      const CellKind kind =
          kinds[face.size() - 3][suite::below(random, 4) == 0 ? 1 + suite::below(random, 2) : 0];
      nodes.resize(traits_of(kind).nodes);
      append_cell(mesh, kind, nodes);
    } else {
      append_cell(mesh, CellKind::polygon, face);
    }
  }
  return mesh;
}

}  // namespace sunder::test
