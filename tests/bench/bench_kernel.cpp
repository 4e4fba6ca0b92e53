// SPDX-License-Identifier: MIT
// What the kernel costs on cubes: memory, building, splitting; CGAL's managed unsew<3> beside it.
#include <malloc.h>
#include <time.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <vector>

#include "topology/suite/shapes.hpp"
#include "topology/build_map.hpp"
#include "topology/check.hpp"
#include "topology/components.hpp"
#include "topology/dart_map.hpp"
#include "topology/split_face.hpp"

namespace {

using namespace sunder;
using namespace sunder::suite;

/// Seconds of a clock. On a machine that others use too, wall time is their load as well as our
/// work; the thread's own time is printed beside it.
double now(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double median(std::vector<double> v) {
  std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
  return v[v.size() / 2];
}

/// Microseconds, on the wall and of this thread.
struct Cost {
  double wall = 0, thread = 0;
};

/// For each of `n` things that `work` does, median of `repeats` runs.
template <class Prepare, class Work>
Cost cost(int repeats, std::size_t n, const Prepare& prepare, const Work& work) {
  std::vector<double> wall, thread;
  for (int i = 0; i < repeats; ++i) {
    auto subject = prepare();
    const double start = now(CLOCK_MONOTONIC), thread_start = now(CLOCK_THREAD_CPUTIME_ID);
    work(subject);
    thread.push_back(1e6 * (now(CLOCK_THREAD_CPUTIME_ID) - thread_start) / static_cast<double>(n));
    wall.push_back(1e6 * (now(CLOCK_MONOTONIC) - start) / static_cast<double>(n));
  }
  return {median(wall), median(thread)};
}

void print_cost(const char* what, const Cost& c) {
  std::printf("  %-32s %8.3f us wall %8.3f us thread\n", what, c.wall, c.thread);
}

/// Interior faces in a random order, each from a random side.
std::vector<HalfFaceId> random_faces(const VolumeMap& map, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<HalfFaceId> faces;
  for (std::size_t i = 0; i < 4 * map.tetrahedra(); ++i) {
    const HalfFaceId f{i}, across = map.neighbour(f);
    if (!across.is_none() && f < across) faces.push_back(below(random, 2) == 0 ? f : across);
  }
  for (std::size_t i = faces.size(); i > 1; --i) std::swap(faces[i - 1], faces[below(random, i)]);
  return faces;
}

MapRows rows_of(const VolumeMap& map) {
  MapRows rows;
  rows.corners.assign(map.corners().begin(), map.corners().end());
  rows.neighbours.assign(map.neighbours().begin(), map.neighbours().end());
  rows.points.assign(map.points().begin(), map.points().end());
  rows.point_of_vertex.assign(map.point_of_vertex().begin(), map.point_of_vertex().end());
  return rows;
}

void print_bytes(const char* when, const VolumeMap& map) {
  const MapBytes b = map.bytes();
  const double t = static_cast<double>(map.tetrahedra());
  const auto each = [t](std::size_t bytes) { return static_cast<double>(bytes) / t; };
  std::printf(
      "  bytes a tetrahedron, %-9s %6.1f = darts %.1f + attributes %.1f + adjacency %.1f + handles "
      "%.1f + vertex columns %.1f\n",
      when, each(b.darts + b.attributes + b.adjacency + b.handles + b.vertex_columns),
      each(b.darts), each(b.attributes), each(b.adjacency), each(b.handles),
      each(b.vertex_columns));
}

struct SplitCosts {
  Cost first_fifth, whole, with_components, managed_first_fifth;
};

SplitCosts split_costs(const VolumeMap& map, int repeats) {
  const std::vector<HalfFaceId> faces = random_faces(map, 1);
  const std::size_t fifth = faces.size() / 5;
  SplitCosts costs;
  const auto copy = [&map] { return map; };
  const auto split_first = [&faces](VolumeMap& m, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) split_face(m, faces[i]);
  };
  costs.first_fifth = cost(repeats, fifth, copy, [&](VolumeMap& m) { split_first(m, fifth); });
  costs.whole =
      cost(repeats, faces.size(), copy, [&](VolumeMap& m) { split_first(m, faces.size()); });
  costs.with_components = cost(repeats, faces.size(), copy, [&](VolumeMap& m) {
    Components labels = label_components(m);
    ComponentScratch scratch;
    for (const HalfFaceId f : faces) {
      const FaceSplit split = split_face(m, f);
      update_components(m, std::span(&split, 1), Detection::exact, labels, scratch);
    }
  });
  const auto managed = [&map] {
    auto darts = std::make_unique<DartMap>(rows_of(map));
    darts->complex().set_automatic_attributes_management(true);
    return darts;
  };
  const auto unsew = [&](std::unique_ptr<DartMap>& m) {
    for (std::size_t i = 0; i < fifth; ++i) {
      m->complex().unsew<3>(m->dart_at(tetrahedron_of(faces[i]), 3 * place_of(faces[i])));
    }
  };
  costs.managed_first_fifth = cost(repeats, fifth, managed, unsew);
  return costs;
}

void measure(int n, int repeats) {
  const TetMesh mesh = kuhn_box({n, n, n});
  const std::size_t T = mesh.tetrahedra.size();
  const auto nothing = [] { return 0; };
  const Cost check_cost = cost(repeats, T, nothing, [&](int) { (void)check_mesh(mesh).size(); });
  const Cost build_cost = cost(repeats, T, nothing, [&](int) { (void)build_map(mesh); });
  const std::size_t heap_before = mallinfo2().uordblks + mallinfo2().hblkhd;
  VolumeMap map = std::move(*build_map(mesh));
  const std::size_t heap = mallinfo2().uordblks + mallinfo2().hblkhd - heap_before;
  std::printf("%zu tetrahedra, median of %d\n", T, repeats);
  print_bytes("intact", map);
  std::printf("  heap in use by the map (glibc) %7.1f bytes a tetrahedron\n",
              static_cast<double>(heap) / static_cast<double>(T));
  print_cost("build with all findings, a tet", build_cost);
  print_cost("of it findings, a tet", check_cost);
  const SplitCosts costs = split_costs(map, repeats);
  print_cost("split_face, first fifth", costs.first_fifth);
  print_cost("split_face, to total shatter", costs.whole);
  print_cost("... with exact components", costs.with_components);
  print_cost("CGAL managed unsew<3>, fifth", costs.managed_first_fifth);
  for (const HalfFaceId f : random_faces(map, 1)) split_face(map, f);
  print_bytes("shattered", map);
}

}  // namespace

int main(int argc, char** argv) {
  const int repeats = argc > 1 ? std::max(1, std::atoi(argv[1])) : 5;
  for (const int n : {4, 10, 20}) measure(n, repeats);
}
