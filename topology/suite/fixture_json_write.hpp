// SPDX-License-Identifier: MIT
// Fixture files that say everything: the body itself, every step, every answer.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "topology/suite/fixture.hpp"
#include "topology/suite/judge_truth.hpp"
#include "topology/suite/operation.hpp"
#include "topology/tet_mesh.hpp"

namespace sunder::suite {

/// The file of a fixture with its body listed, every operation resolved into steps (splits from a
/// named side, glues of two named sides) and every expectation filled in from the twin: a reader
/// needs no geometry and no order of faces. Where a large body was not looked at, only splits are
/// told. Needs: truth == truth_of(fixture). Leaves a file that `read_fixtures` reads.
std::string fixture_json(const Fixture& fixture, const Truth& truth);

/// A fixture file "NAME", case "steps", that repeats a run. `shows` says where it is from.
/// Findings are those of `check_mesh`.
struct RunName {
  std::string name, shows, source;
};
std::string fixture_json(const TetMesh& body, std::span<const Step> steps, const RunName& name);

}  // namespace sunder::suite
