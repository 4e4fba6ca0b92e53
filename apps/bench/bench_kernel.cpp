// SPDX-License-Identifier: MIT
// Memory, building and splitting of a body.
#include "apps/bench/bench_kernel.hpp"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>

#include "apps/bench/bench_fans.hpp"
#include "apps/bench/clock.hpp"
#include "topology/kernel/components.hpp"
#include "topology/kernel/map_mesh.hpp"
#include "topology/kernel/split_face.hpp"
#include "topology/mesh/build_map.hpp"
#include "topology/suite/fixtures/shapes.hpp"
#include "topology/suite/kernels/managed_unsew.hpp"

namespace sunder {
namespace {

double heap_in_use() {
  const auto info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

/// The map of a body that is known to have one.
VolumeMap map_of(const TetMesh& mesh, MapKernel kernel = MapKernel::dense) {
  return std::move(*build_map(mesh, Severity::error, kernel));
}

void add_bytes(const std::string& when, const VolumeMap& map, double heap, const FigureSink& add) {
  const MapBytes b = map.bytes();
  const auto each = [&](auto bytes) {
    return static_cast<double>(bytes) / static_cast<double>(map.tetrahedra());
  };
  add("bytes_" + when, each(total(b)));
  add("bytes_" + when + "_darts", each(b.darts));
  add("bytes_" + when + "_attributes", each(b.attributes));
  add("bytes_" + when + "_adjacency", each(b.adjacency));
  add("bytes_" + when + "_handles", each(b.handles));
  add("bytes_" + when + "_vertex_columns", each(b.vertex_columns));
  add("heap_" + when, each(heap));
}

void measure_memory(const TetMesh& mesh, const KernelBenchSettings& settings,
                    const FigureSink& add) {
  const double before = heap_in_use();
  VolumeMap map = map_of(mesh, settings.kernel);
  add_bytes("intact", map, heap_in_use() - before, add);
  {
    const std::vector<HalfFaceId> faces = random_faces(map, settings.seed);
    for (const HalfFaceId f : faces) split_face(map, f);
  }
  add_bytes("shattered", map, heap_in_use() - before, add);
}

/// Microseconds a face of `work` on a fresh copy of the map.
template <class Work>
double each_face(const VolumeMap& map, std::span<const HalfFaceId> faces, const Work& work) {
  VolumeMap copy = map;
  const double start = thread_us();
  for (const HalfFaceId f : faces) work(copy, f);
  return (thread_us() - start) / static_cast<double>(faces.size());
}

double split_with_components(const VolumeMap& map, std::span<const HalfFaceId> faces) {
  Components labels = label_components(map);
  ComponentScratch scratch;
  return each_face(map, faces, [&](VolumeMap& m, HalfFaceId f) {
    const FaceSplit split = split_face(m, f);
    update_components(m, std::span(&split, 1), Detection::exact, labels, scratch);
  });
}

void measure_times(const VolumeMap& map, const TetMesh& mesh, const KernelBenchSettings& settings,
                   const FigureSink& add) {
  const std::vector<HalfFaceId> faces = random_faces(map, settings.seed);
  const auto first = std::span(faces).first(std::clamp<std::size_t>(faces.size() / 5, 1, 40000));
  std::vector<double> build, split, unsew, managed, all, components;
  for (int run = 0; run < settings.runs; ++run) {
    const double start = thread_us();
    map_of(mesh, settings.kernel);
    build.push_back((thread_us() - start) / static_cast<double>(map.tetrahedra()));
    split.push_back(each_face(map, first, [](VolumeMap& m, HalfFaceId f) { split_face(m, f); }));
    unsew.push_back(each_face(map, first, [](VolumeMap& m, HalfFaceId f) { m.unsew(f); }));
    managed.push_back(suite::managed_unsew_us(map, first));
    all.push_back(each_face(map, faces, [](VolumeMap& m, HalfFaceId f) { split_face(m, f); }));
    components.push_back(split_with_components(map, faces));
  }
  add("build", median(build));
  add("split_first", median(split));
  add("unsew_first", median(unsew));
  add("star_test", median(split) - median(unsew));
  add("managed_unsew", median(managed));
  add("managed_ratio", median(managed) / median(split));
  add("split_all", median(all));
  add("split_components", median(components));
}

BenchBody cube(int n) {
  TetMesh mesh = suite::kuhn_box({n, n, n});
  return {fmt::format("cube {}", mesh.tetrahedra.size()), std::move(mesh), n};
}

BenchBody ring(const suite::Cells& cells) {
  // By way of the map, to lose the points of the hole.
  const TetMesh with_hole = suite::ring(cells);
  TetMesh mesh = mesh_of_map(map_of(with_hole), with_hole, MeshPoints::vertices);
  return {fmt::format("ring {}", mesh.tetrahedra.size()), std::move(mesh), 0};
}

}  // namespace

std::vector<BenchBody> bench_bodies(bool quick) {
  std::vector<BenchBody> bodies = {cube(4), cube(10)};
  if (!quick) bodies.push_back(cube(20));
  if (!quick) bodies.push_back(cube(40));
  bodies.push_back(ring({3, 3, 1}));
  bodies.push_back(ring({20, 20, 10}));
  if (!quick) bodies.push_back(ring({60, 60, 20}));
  return bodies;
}

KernelBench bench_kernel(const KernelBenchSettings& settings,
                         const std::function<void(const BenchBody&)>& progress) {
  KernelBench bench{.machine = machine_name(), .runs = settings.runs, .seed = settings.seed};
  for (const BenchBody& body : bench_bodies(settings.quick)) {
    progress(body);
    const FigureSink add = [&](const std::string& quantity, double value) {
      bench.figures.push_back({body.name, body.mesh.tetrahedra.size(), quantity, value});
    };
    measure_memory(body.mesh, settings, add);
    const VolumeMap map = map_of(body.mesh, settings.kernel);
    measure_times(map, body.mesh, settings, add);
    if (body.cube_cells > 0) measure_quiet_fans(map, body.cube_cells, settings.seed, add);
    measure_searches(map, settings.runs, settings.seed, add);
    measure_oracle(map, settings.seed, add);
  }
  return bench;
}

}  // namespace sunder
