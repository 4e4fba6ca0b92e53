// SPDX-License-Identifier: MIT
// From a failing run to a small one: fewer steps, a smaller body.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "topology/base/tet_mesh.hpp"
#include "topology/suite/kernels/operation.hpp"

namespace sunder::suite {

/// A run: steps on a body.
struct StepsOnBody {
  TetMesh body;
  std::vector<Step> steps;
};

/// Whether a run fails. It is asked of fresh bodies only, and has to start from scratch each time.
using Fails = std::function<bool(const TetMesh& body, std::span<const Step> steps)>;

struct ShrinkLimits {
  /// Whether tetrahedra may be dropped; else the body stays as it is.
  bool body = true;
  /// Bound on the time: steps of all trials together, 16 each, and their tetrahedra once per trial
  /// and once per step of up to 64, after which a body is looked at.
  std::size_t work = 8000000;
};

/// A smaller run that still fails: steps, then tetrahedra (with the steps that name them), are
/// dropped in halves, quarters, ... and one at a time as long as the rest fails; points that no
/// tetrahedron needs go last [Zeller and Hildebrandt 2002, ddmin].
/// Needs: fails(body, steps). Leaves: a run that fails; unless the work ran out, one that does not
/// fail without any one of its steps.
StepsOnBody shrink(const TetMesh& body, std::span<const Step> steps, const Fails& fails,
                   const ShrinkLimits& limits = {});

}  // namespace sunder::suite
