// SPDX-License-Identifier: MIT
// Families of bodies for random runs.
#include "topology/suite/random/random_run_bodies.hpp"

#include <algorithm>
#include <utility>

namespace sunder::suite {
namespace {

using Random = std::mt19937_64;

/// A whole number from `low` to `high`.
int between(Random& random, int low, int high) {
  return low + static_cast<int>(below(random, static_cast<std::size_t>(high - low + 1)));
}

Cells cells_between(Random& random, int low, int high) {
  Cells cells;
  for (int& n : cells) n = between(random, low, high);
  return cells;
}

TetMesh any_fan(Random& random) {
  // Long fans are rare: their edge and its two ends have stars of all their tetrahedra.
  const int k = below(random, 8) == 0 ? between(random, 7, 60) : between(random, 3, 7);
  return below(random, 2) == 0 ? closed_fan(k) : open_fan(k - 1);
}

TetMesh any_small(Random& random) {
  switch (below(random, 5)) {
    case 0:
      return two_tetrahedra();
    case 1:
      return side_by_side(two_tetrahedra(), one_tetrahedron());
    case 2:
      return side_by_side(closed_fan(4), two_tetrahedra_sharing_an_edge());
    case 3:
      return side_by_side(open_fan(3), two_tetrahedra_sharing_a_vertex());
    default:
      return octahedron_star();
  }
}

/// Cubes left standing at random: channels, cavities, pinched edges and vertices, several bodies.
TetMesh polycube(Random& random) {
  const Cells cells = cells_between(random, 2, 4);
  const double part = 0.4 + 0.5 * unit(random);
  std::vector<bool> stands;
  for (int i = 0; i < cells[0] * cells[1] * cells[2]; ++i) stands.push_back(unit(random) < part);
  stands[0] = true;  // a body needs something
  return kuhn_cubes(cells, [&](int i, int j, int k) {
    return stands[static_cast<std::size_t>((k * cells[1] + j) * cells[0] + i)];
  });
}

/// Tetrahedra of a box left standing at random: pinched nearly everywhere.
TetMesh scattered(Random& random) {
  TetMesh mesh = kuhn_box(cells_between(random, 2, 3));
  const double part = 0.4 + 0.55 * unit(random);
  std::erase_if(mesh.tetrahedra, [&](const auto&) { return unit(random) >= part; });
  return mesh.tetrahedra.empty() ? two_tetrahedra() : mesh;
}

/// A bar bent into a ring that touches itself at a corner, at an edge, in a triangle, or whole.
TetMesh pinched_bar(Random& random) {
  const int k = between(random, 4, 16);
  switch (below(random, 4)) {
    case 0:
      return bent_bar(k, {{0, 0}});
    case 1:
      return bent_bar(k, {{0, 0}, {0, 1}});
    case 2:
      return bent_bar(k, {{0, 0}, {0, 1}, {1, 1}});
    default:
      return joined_ring(k, false);
  }
}

/// A closed sphere of three dimensions: the boundary of the 4-simplex, tetrahedra of it cut in four
/// round their centres.
TetMesh closed_sphere(Random& random) {
  TetMesh mesh = closed_simplex_boundary();
  for (std::size_t cuts = below(random, 12); cuts > 0; --cuts) {
    const std::size_t t = below(random, mesh.tetrahedra.size());
    const auto old = mesh.tetrahedra[t];
    Point centre = {0, 0, 0};
    for (const std::uint32_t p : old) {
      for (std::size_t i = 0; i < 3; ++i) centre[i] += mesh.points[p][i] / 4;
    }
    const auto fresh = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back(centre);
    for (std::size_t i = 0; i < 4; ++i) {
      auto part = old;
      part[i] = fresh;
      i == 0 ? mesh.tetrahedra[t] = part : mesh.tetrahedra.emplace_back(part);
    }
  }
  return mesh;
}

TetMesh any_shell(Random& random) {
  return below(random, 2) == 0 ? shell(cells_between(random, 3, 4)) : crossing_channels();
}

TetMesh several(Random& random) {
  TetMesh mesh = polycube(random);
  mesh = side_by_side(mesh, pinched_bar(random));
  return side_by_side(mesh, below(random, 2) == 0 ? closed_sphere(random) : any_fan(random));
}

TetMesh any_ring(Random& random) {
  return ring({between(random, 3, 6), between(random, 3, 6), between(random, 1, 2)});
}

/// Rings round an edge and stars round a vertex, half of them with some tetrahedra gone: then the
/// edge or the vertex parts, or its link has holes. From `low` tetrahedra to `low` 2^`doublings`,
/// at most `high`, each doubling as often as any other.
TetMesh round_one_cell(Random& random, int low, int doublings, int high) {
  const int first = low << below(random, static_cast<std::size_t>(doublings));
  const int k = between(random, first, std::min(2 * first, high));
  TetMesh mesh = below(random, 2) == 0 ? edge_ring(k / 4 * 4) : vertex_star(k / 8 * 8);
  for (std::size_t gone = below(random, 2) * (1 + below(random, 8)); gone > 0; --gone) {
    const std::size_t t = below(random, mesh.tetrahedra.size());
    mesh.tetrahedra.erase(mesh.tetrahedra.begin() + static_cast<std::ptrdiff_t>(t));
  }
  return mesh;
}

TetMesh large(Random& random) {
  switch (below(random, 3)) {
    case 0:
      return ring({12, 12, 4});
    case 1:
      return shell({8, 8, 8});
    default:
      return kuhn_box({8, 8, 8});
  }
}

void turn_some_over(TetMesh& mesh, Random& random) {
  for (auto& t : mesh.tetrahedra) {
    const std::size_t i = below(random, 2), j = 2 + below(random, 2);
    if (below(random, 3) == 0) std::swap(t[i], t[j]);
  }
}

void press_flat(TetMesh& mesh, std::size_t axis) {
  for (Point& p : mesh.points) p[axis] = 0;
}

}  // namespace

std::vector<BodyFamily> body_families(std::size_t largest) {
  struct Bounded {
    std::size_t tetrahedra;
    BodyFamily family;
  };
  const auto box = [](int low, int high) {
    return [low, high](Random& random) { return kuhn_box(cells_between(random, low, high)); };
  };
  const auto round = [](int low, int doublings, int high) {
    return [=](Random& random) { return round_one_cell(random, low, doublings, high); };
  };
  std::vector<Bounded> all = {
      {60, {"fans of 3 to 60", 12, any_fan}},
      {8, {"up to 8 tetrahedra", 8, any_small}},
      {38, {"closed spheres", 12, closed_sphere}},
      {96, {"pinched bars and rings", 16, pinched_bar}},
      {162, {"scattered tetrahedra", 16, scattered}},
      {162, {"boxes up to 3^3", 16, box(1, 3)}},
      {384, {"polycubes", 16, polycube}},
      {240, {"rings", 12, any_ring}},
      {384, {"shells and channels", 12, any_shell}},
      {540, {"several bodies", 12, several}},
      {1296, {"boxes 4^3 to 6^3", 12, box(4, 6)}},
      {3072, {"large boxes, rings, shells", 8, large}},
      {6000, {"box 10^3", 4, box(10, 10)}},
      {1000, {"stars and rings to 1000", 12, round(64, 4, 1000)}},
      {10000, {"stars and rings to 10000", 1, round(1024, 4, 10000)}},
  };
  std::vector<BodyFamily> families;
  for (Bounded& b : all) {
    if (b.tetrahedra > largest) continue;
    const auto plain = std::move(b.family.draw);
    b.family.draw = [plain](Random& random) {
      TetMesh mesh = plain(random);
      return below(random, 4) == 0 ? mesh : disguised(std::move(mesh), random);
    };
    families.push_back(std::move(b.family));
  }
  return families;
}

TetMesh disguised(TetMesh mesh, std::mt19937_64& random) {
  // A flat body puts every centre on the plane of some fans, and is reason for a warning only.
  const bool flat = below(random, 32) == 0;
  const double amplitude = 0.1 * unit(random);
  if (below(random, 2) == 0) mesh = jittered(std::move(mesh), amplitude, random());
  if (below(random, 2) == 0) mesh = shuffled(mesh, random());
  if (below(random, 4) == 0) turn_some_over(mesh, random);
  if (flat) press_flat(mesh, below(random, 3));
  return mesh;
}

}  // namespace sunder::suite
