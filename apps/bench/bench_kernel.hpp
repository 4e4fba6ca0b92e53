// SPDX-License-Identifier: MIT
// `sunder bench kernel`: the measuring of memory, building and splitting, body by body.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "apps/bench/bench_figures.hpp"
#include "topology/base/tet_mesh.hpp"
#include "topology/kernel/volume_map.hpp"

namespace sunder {

struct KernelBenchSettings {
  /// Only bodies of up to 6 000 tetrahedra.
  bool quick = false;
  /// Times are medians over this many runs; at least 1.
  int runs = 5;
  std::uint64_t seed = 1;
  /// The kernel of all maps.
  MapKernel kernel = MapKernel::dense;
};

/// A body to measure.
struct BenchBody {
  std::string name;
  TetMesh mesh;
  /// Cells along each edge of a cube; 0 for another body.
  int cube_cells = 0;
};

/// Cubes of 384, 6 000, 48 000 and 384 000 tetrahedra; rings of 48, 4 560 and 28 320.
std::vector<BenchBody> bench_bodies(bool quick);

/// Measures everything. `progress` is called with each body before its turn. Counts depend on the
/// seed alone, times on the machine.
KernelBench bench_kernel(const KernelBenchSettings& settings,
                         const std::function<void(const BenchBody&)>& progress);

}  // namespace sunder
