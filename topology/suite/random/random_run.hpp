// SPDX-License-Identifier: MIT
// The long run: random bodies torn apart at random, every answer of a kernel judged; and the
// smallest run found that still fails.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "topology/suite/fixtures/shapes.hpp"
#include "topology/suite/judge/shrink.hpp"
#include "topology/suite/kernels/judged_kernel.hpp"
#include "topology/suite/random/random_run_tear.hpp"

namespace sunder::suite {

struct RandomOptions {
  /// Fans with at least one face, over all families together.
  std::size_t fans = 1000;
  std::uint64_t seed = 1;
  /// Bodies besides the generated ones, a family each. Needs: the kernel can take them.
  std::vector<NamedMesh> meshes;
  /// Families with bodies of possibly more tetrahedra than this are left out (`meshes` are not).
  std::size_t largest = 10000;
  /// Called after every operation with the number of fans done. May be empty.
  std::function<void(std::size_t)> progress;
};

/// A run that went wrong.
struct RandomFailure {
  /// The mismatch as it was first seen; `steps` are all that had been done.
  Mismatch first;
  /// The body and the steps of the first mismatch, and a shorter run that still fails.
  StepsOnBody found, shrunk;
  /// The first mismatch of the shrunk run. None: the kernel did right when asked the same again, or
  /// the wrong answer was not one to a step (a fan's faces, homology); then nothing was taken away.
  std::optional<Mismatch> last;
  /// A fixture file (docs/reference/suite.md) with the shrunk run, ready to be saved.
  std::string fixture;
};

struct FamilyReport {
  std::string name;
  std::size_t bodies = 0;
  /// Of all bodies: fewest and most tetrahedra.
  std::size_t fewest = 0, most = 0;
  TearCounts counts;
  CheckCounts checks;
  /// Single comparisons.
  std::size_t comparisons = 0;
  /// Bodies for which sheets do not give the Betti numbers over GF(2), which are computed instead.
  /// 0 for generated bodies.
  std::size_t without_sheet_law = 0;
  std::optional<RandomFailure> failure;
};

/// The run ends with its first failure: the last family has it then, and those after it are absent.
struct RandomReport {
  std::vector<FamilyReport> families;
};

/// Tears bodies of every family (random_run_bodies.hpp) until `fans` fans are split. The operations
/// are in random_run_tear.hpp and the checks in random_run_trial.hpp. `fresh_kernel` is asked for
/// two kernels of one kind. Same seed and kernel, same report, on every machine. About 2 ms per fan
/// for kernels as fast as `volume_map_kernel`.
RandomReport run_random(const RandomOptions& options,
                        const std::function<JudgedKernel()>& fresh_kernel);

/// All families together, without their failures.
FamilyReport total_of(const RandomReport& report);

}  // namespace sunder::suite
