// SPDX-License-Identifier: MIT
// A kernel and the twin: random splits and glues, every answer compared.
#pragma once

#include <catch2/catch.hpp>

#include <string>
#include <vector>

#include "topology/suite/fixtures/shapes.hpp"
#include "topology/suite/kernels/judged_kernel.hpp"

namespace sunder::test {

/// Whether equal numbers stand at the same places in both.
bool same_partition(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b);

/// Every face of a body from each of its sides, in no order: two sides for interior faces, one for
/// those of the boundary.
std::vector<std::vector<suite::FaceSide>> faces_of(const TetMesh& mesh);

/// Loads the body into both and takes `steps` random steps, three splits to one glue, some splits
/// on faces already cut; counts and partitions are compared every `every` steps and at the end.
struct Walk {
  std::size_t steps = 200, every = 20;
  std::uint64_t seed = 1;
};
void walk_beside_twin(suite::JudgedKernel& kernel, const TetMesh& mesh, const Walk& walk);

}  // namespace sunder::test
