// SPDX-License-Identifier: MIT
// Runs fixtures on a kernel and holds every answer against what the fixture and the twin say.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "topology/suite/fixture.hpp"
#include "topology/suite/judged_kernel.hpp"

namespace sunder::suite {

/// The first answer that was not the expected one.
struct Mismatch {
  /// Number of steps done when it showed: 0 right after loading.
  std::size_t step = 0;
  /// Which operation of the fixture that was, counted from 1; 0 right after loading.
  std::size_t operation = 0;
  /// "edges", "split vertices of face 1 4 14", ...; then what was expected and what was answered.
  std::string what, expected, answered;
  /// The shortest sequence of steps found that still shows a mismatch.
  std::vector<Step> steps;
};

/// How one kernel did on one fixture.
struct Verdict {
  std::string fixture, kernel;
  std::size_t tetrahedra = 0, operations = 0, steps = 0;
  /// Single comparisons made.
  std::size_t checks = 0;
  /// Questions the kernel cannot be asked.
  std::size_t not_asked = 0;
  std::optional<Mismatch> mismatch;
  /// Why a difference that was seen is expected (`KnownDifference`), empty where there is none.
  std::string known_difference;
  /// Time inside the kernel, microseconds.
  double kernel_us = 0;
};

/// The steps an operation comes to on the body as the twin has it now.
std::vector<Step> steps_of(const Operation& operation, const GlueTwin& intact, const GlueTwin& now,
                           const TetMesh& body);

/// Runs one fixture on one kernel. After every step: the split's answer; after every operation:
/// cell counts, vertex orbits and components as partitions, the kernel's own faults, and all that
/// the fixture says. Large bodies: counts and partitions at most 64 times a fixture, and at its
/// end.
Verdict judge(const Fixture& fixture, JudgedKernel& kernel);

}  // namespace sunder::suite
