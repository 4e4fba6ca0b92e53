// SPDX-License-Identifier: MIT
// Random bodies, and meshes as careless files hold them.
#pragma once

#include <cmath>
#include <limits>
#include <random>

#include "topology/mesh/file_mesh.hpp"
#include "topology/suite/fixtures/shapes.hpp"

namespace sunder::test {

using suite::below;
using suite::unit;
using Random = std::mt19937_64;

/// A body out of all shapes, some in disguise: shaken, shuffled, two of them, some cells away.
inline TetMesh body(Random& random) {
  static const std::vector<suite::NamedMesh> shapes = suite::all_shapes();
  TetMesh mesh = shapes[below(random, shapes.size())].mesh;
  if (below(random, 4) == 0)
    mesh = suite::side_by_side(mesh, shapes[below(random, shapes.size())].mesh);
  if (below(random, 2) == 0) mesh = suite::jittered(mesh, 0.2 * unit(random), random());
  if (below(random, 2) == 0) mesh = suite::shuffled(mesh, random());
  if (below(random, 3) == 0) {
    std::erase_if(mesh.tetrahedra, [&](const auto&) { return below(random, 4) == 0; });
  }
  if (below(random, 3) == 0) {
    for (auto& t : mesh.tetrahedra) {
      if (below(random, 8) == 0) std::swap(t[0], t[1]);
    }
  }
  return mesh;
}

inline bool is_finite(const Point& p) {
  return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

/// A mesh as careless files hold them: copies, turned and flat cells, loose and nearly equal
/// points, lists of cells of lower dimension, data.
inline FileMesh careless(Random& random) {
  TetMesh mesh = body(random);
  const auto some_point = [&] {
    return static_cast<std::uint32_t>(below(random, mesh.points.size()));
  };
  if (mesh.tetrahedra.empty()) return file_mesh_of(mesh);
  for (std::size_t i = below(random, 3); i > 0; --i) {
    switch (below(random, 9)) {
      case 0:
        mesh.tetrahedra.push_back(mesh.tetrahedra[below(random, mesh.tetrahedra.size())]);
        break;
      case 1:
        mesh.tetrahedra.push_back({some_point(), some_point(), some_point(), some_point()});
        break;
      case 2:
        mesh.points.push_back(mesh.points[some_point()]);
        break;
      case 3:
        mesh.points[some_point()] = mesh.points[some_point()];
        break;
      case 4:
        mesh.points[some_point()][below(random, 3)] += 1e-7 * unit(random);
        break;
      case 5:
        mesh.points[some_point()][below(random, 3)] = below(random, 2) == 0
                                                          ? std::numeric_limits<double>::quiet_NaN()
                                                          : std::numeric_limits<double>::infinity();
        break;
      case 6:
        mesh.tetrahedra[below(random, mesh.tetrahedra.size())][below(random, 4)] = some_point();
        break;
      case 7:
        mesh.tetrahedra.back()[0] = static_cast<std::uint32_t>(mesh.points.size());
        break;
      default: {
        // A copy of a point in a middle of two others: it may hang in an edge.
        const Point a = mesh.points[some_point()], b = mesh.points[some_point()];
        mesh.points[some_point()] = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
      }
    }
  }
  if (below(random, 3) == 0) {
    // Cells with points of their own, in place or a rounding away.
    for (auto& t : mesh.tetrahedra) {
      if (below(random, 6) != 0) continue;
      for (auto& corner : t) {
        mesh.points.push_back(mesh.points[corner < mesh.points.size() ? corner : 0]);
        if (below(random, 4) == 0) mesh.points.back()[1] += 1e-9 * unit(random);
        corner = static_cast<std::uint32_t>(mesh.points.size() - 1);
      }
    }
  }
  FileMesh file = file_mesh_of(mesh);
  const auto in = [&](std::uint32_t p) { return p < file.points.size() ? p : 0; };
  for (std::size_t i = below(random, 40); i > 0; --i) {
    const auto& t = file.tetrahedra.corners[below(random, file.tetrahedra.corners.size())];
    const std::size_t k = below(random, 4);
    file.triangles.corners.push_back({in(t[k]), in(t[(k + 1) % 4]), in(t[(k + 2) % 4])});
    if (i % 3 == 0) file.edges.corners.push_back({in(t[k]), in(t[(k + 2) % 4])});
    if (i % 4 == 0) file.vertices.corners.push_back({in(t[k])});
  }
  const auto label = [&](auto& cells) {
    const std::size_t n = cells.corners.size();
    if (below(random, 2) == 0) {
      for (std::size_t i = 0; i < n; ++i)
        cells.region.push_back(static_cast<std::int32_t>(below(random, 3)));
    }
    if (below(random, 3) == 0) {
      for (std::size_t i = 0; i < n; ++i)
        cells.entity.push_back(static_cast<std::int32_t>(below(random, 2)));
    }
    if (below(random, 3) == 0) {
      for (std::size_t i = 0; i < n; ++i)
        cells.source_id.push_back(static_cast<std::int64_t>(10 * i + 7));
    }
    if (below(random, 2) == 0) {
      std::vector<double> values;
      for (std::size_t i = 0; i < 3 * n; ++i) values.push_back(unit(random));
      cells.data.push_back({"vector", 3, NumberType::float64, values});
    }
    if (below(random, 3) == 0) {
      std::vector<std::int64_t> values;
      for (std::size_t i = 0; i < 2 * n; ++i) values.push_back(static_cast<std::int64_t>(100 + i));
      cells.data.push_back({"two", 2, NumberType::int16, values});
    }
  };
  label(file.vertices), label(file.edges), label(file.triangles), label(file.tetrahedra);
  file.region_name[3][1] = "one";
  file.region_name[2][2] = "two";
  if (below(random, 2) == 0) {
    std::vector<std::int64_t> values;
    for (std::size_t i = 0; i < 2 * file.points.size(); ++i)
      values.push_back(static_cast<std::int64_t>(i));
    file.point_data.push_back({"pair", 2, NumberType::int32, values});
  }
  if (below(random, 3) == 0) file.point_region.assign(file.points.size(), 4);
  if (below(random, 3) == 0) {
    for (std::size_t i = 0; i < file.points.size(); ++i)
      file.source_point_id.push_back(static_cast<std::int64_t>(2 * i));
  }
  return file;
}

}  // namespace sunder::test
