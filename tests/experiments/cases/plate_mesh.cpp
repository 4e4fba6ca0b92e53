// SPDX-License-Identifier: MIT
// Points and triangles of a plate's plane, and the prisms over them.
#include "tests/experiments/cases/plate_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <stdexcept>

#include "topology/suite/fixtures/shapes.hpp"

namespace sunder::accuracy {
namespace {

using Plane = std::array<double, 2>;

double cross(const Plane& a, const Plane& b, const Plane& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// A triangle with its circumscribed circle.
struct Circled {
  Triangle corner;
  Plane centre;
  double squared = 0;  ///< m^2, of the radius
};

Circled circled(const std::vector<Plane>& points, const Triangle& t) {
  const Plane &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
  const double bx = b[0] - a[0], by = b[1] - a[1], cx = c[0] - a[0], cy = c[1] - a[1];
  const double twice = 2 * (bx * cy - by * cx);
  const double b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
  const double x = (cy * b2 - by * c2) / twice, y = (bx * c2 - cx * b2) / twice;
  return {t, {a[0] + x, a[1] + y}, x * x + y * y};
}

struct PlaneMesh {
  std::vector<Plane> points;
  std::vector<Triangle> triangles;
};

PlaneMesh grid(const PlateShape& shape) {
  const int nx = int(std::lround(shape.length / shape.cell));
  const int ny = int(std::lround(shape.height / shape.cell));
  const double dx = shape.length / nx, dy = shape.height / ny;
  PlaneMesh mesh;
  const auto row = [&](int i, int j) { return std::uint32_t(j * (nx + 1) + i); };
  for (int j = 0; j <= ny; ++j) {
    for (int i = 0; i <= nx; ++i) mesh.points.push_back({i * dx, j * dy});
  }
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const std::uint32_t a = row(i, j), b = row(i + 1, j), c = row(i + 1, j + 1);
      const std::uint32_t d = row(i, j + 1);
      if (shape.cells == PlateCells::kuhn) {
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
        continue;
      }
      const auto m = std::uint32_t(mesh.points.size());
      mesh.points.push_back({(i + 0.5) * dx, (j + 0.5) * dy});
      mesh.triangles.insert(mesh.triangles.end(), {{a, b, m}, {b, c, m}, {c, d, m}, {d, a, m}});
    }
  }
  return mesh;
}

/// Points on a segment, about a cell apart.
void add_line(std::vector<Plane>& points, const Plane& from, const Plane& to, double cell) {
  const int n = std::max(1, int(std::lround(std::hypot(to[0] - from[0], to[1] - from[1]) / cell)));
  for (int k = 0; k <= n; ++k) {
    const double t = double(k) / n;
    const Plane p = {from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])};
    const auto near = [&](const Plane& q) {
      return std::hypot(p[0] - q[0], p[1] - q[1]) < 0.3 * cell;
    };
    if (std::ranges::none_of(points, near)) points.push_back(p);
  }
}

/// How far a point is from the rim and from the lines, m.
double room_of(const PlateShape& shape, const Plane& p) {
  double room = std::min({p[0], p[1], shape.length - p[0], shape.height - p[1]});
  for (const PlateLine& line : shape.lines) {
    const double x = std::clamp(p[0], line.from, line.to);
    room = std::min(room, std::hypot(p[0] - x, p[1] - line.height));
  }
  return room;
}

PlaneMesh shaken_lattice(const PlateShape& shape) {
  const double length = shape.length, height = shape.height, cell = shape.cell;
  PlaneMesh mesh;
  for (const PlateLine& line : shape.lines) {
    add_line(mesh.points, {line.from, line.height}, {line.to, line.height}, cell);
  }
  add_line(mesh.points, {0, 0}, {length, 0}, cell);
  add_line(mesh.points, {length, 0}, {length, height}, cell);
  add_line(mesh.points, {length, height}, {0, height}, cell);
  add_line(mesh.points, {0, height}, {0, 0}, cell);
  std::mt19937_64 random(shape.seed);
  const double turn = std::numbers::pi / 3 * suite::unit(random);
  const double c = std::cos(turn), s = std::sin(turn);
  const int reach = int(2 * std::hypot(length, height) / cell) + 2;
  for (int j = -reach; j <= reach; ++j) {
    for (int i = -reach; i <= reach; ++i) {
      const double u = cell * (i + 0.5 * (j & 1)), v = cell * 0.5 * std::numbers::sqrt3 * j;
      Plane p = {0.5 * length + c * u - s * v, 0.5 * height + s * u + c * v};
      if (room_of(shape, p) < 0) continue;
      for (double& x : p) x += shape.shake * cell * (2 * suite::unit(random) - 1);
      if (room_of(shape, p) > 0.6 * cell) mesh.points.push_back(p);
    }
  }
  // Rims that bulge by a trace: no three points of a side on one line, where circles have no end.
  std::vector<Plane> bulged = mesh.points;
  const double trace = 4e-4 * cell;
  for (Plane& p : bulged) {
    const double x = p[0] / length, y = p[1] / height;
    if (x == 0 || x == 1) p[0] += (2 * x - 1) * trace * y * (1 - y);
    if (y == 0 || y == 1) p[1] += (2 * y - 1) * trace * x * (1 - x);
  }
  mesh.triangles = delaunay(bulged);
  return mesh;
}

}  // namespace

std::vector<Triangle> delaunay(const std::vector<Plane>& given) {
  std::vector<Plane> points = given;
  Plane low = given.front(), high = given.front();
  for (const Plane& p : given) {
    for (std::size_t a : {0, 1}) {
      low[a] = std::min(low[a], p[a]);
      high[a] = std::max(high[a], p[a]);
    }
  }
  const double size = std::max(high[0] - low[0], high[1] - low[1]);
  const auto n = std::uint32_t(given.size());
  points.push_back({low[0] - 1000 * size, low[1] - 1000 * size});
  points.push_back({high[0] + 2000 * size, low[1] - 1000 * size});
  points.push_back({low[0] - 1000 * size, high[1] + 2000 * size});
  std::vector<Circled> live = {circled(points, {n, n + 1, n + 2})};
  for (std::uint32_t p = 0; p < n; ++p) {
    std::map<std::array<std::uint32_t, 2>, int> rim;  // directed edges of the removed triangles
    const auto holds = [&](const Circled& t) {
      const double x = points[p][0] - t.centre[0], y = points[p][1] - t.centre[1];
      return x * x + y * y < t.squared;
    };
    std::erase_if(live, [&](const Circled& t) {
      if (!holds(t)) return false;
      for (std::size_t k = 0; k < 3; ++k) ++rim[{t.corner[k], t.corner[(k + 1) % 3]}];
      return true;
    });
    for (const auto& [edge, count] : rim) {
      if (!rim.contains({edge[1], edge[0]})) {
        live.push_back(circled(points, {edge[0], edge[1], p}));
      }
    }
  }
  std::vector<Triangle> triangles;
  for (const Circled& t : live) {
    if (std::ranges::any_of(t.corner, [&](std::uint32_t v) { return v >= n; })) continue;
    const double twice = cross(points[t.corner[0]], points[t.corner[1]], points[t.corner[2]]);
    if (twice > 1e-9 * t.squared) triangles.push_back(t.corner);
  }
  return triangles;
}

TetMesh plate_mesh(const PlateShape& shape) {
  const PlaneMesh plane = shape.cells == PlateCells::delaunay ? shaken_lattice(shape) : grid(shape);
  double area = 0;
  for (const Triangle& t : plane.triangles) {
    area += 0.5 * cross(plane.points[t[0]], plane.points[t[1]], plane.points[t[2]]);
  }
  if (std::abs(area - shape.length * shape.height) > 1e-9 * area) {
    throw std::runtime_error("plate: the triangles do not fill the rectangle; take another seed");
  }
  TetMesh mesh;
  const auto n = std::uint32_t(plane.points.size());
  for (int l = 0; l <= shape.layers; ++l) {
    for (const Plane& p : plane.points) mesh.points.push_back({p[0], p[1], l * shape.thickness});
  }
  for (std::uint32_t l = 0; l < std::uint32_t(shape.layers); ++l) {
    for (Triangle t : plane.triangles) {
      // Counterclockwise, and odd once sorted where the corners were turned over by that.
      const auto place = std::ranges::min_element(t) - t.begin();
      const bool odd = t[std::size_t((place + 1) % 3)] > t[std::size_t((place + 2) % 3)];
      std::ranges::sort(t);
      const auto low = [&](std::size_t k) { return l * n + t[k]; };
      const auto top = [&](std::size_t k) { return (l + 1) * n + t[k]; };
      for (std::array<std::uint32_t, 4> c : {std::array{low(0), low(1), low(2), top(2)},
                                             {low(0), top(1), low(1), top(2)},
                                             {low(0), top(0), top(1), top(2)}}) {
        if (odd) std::swap(c[0], c[1]);
        mesh.tetrahedra.push_back(c);
      }
    }
  }
  return mesh;
}

}  // namespace sunder::accuracy
