// SPDX-License-Identifier: MIT
// Runs fixtures on a kernel and compares every answer with the fixture and the twin.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "topology/suite/fixtures/fixture.hpp"
#include "topology/suite/fixtures/steps.hpp"
#include "topology/suite/judge/judge_checks.hpp"
#include "topology/suite/judge/judge_truth.hpp"
#include "topology/suite/kernels/judged_kernel.hpp"

namespace sunder::suite {

/// How one kernel did on one fixture.
struct Verdict {
  std::string fixture, kernel;
  std::size_t tetrahedra = 0, operations = 0, steps = 0;
  /// Single comparisons of this kernel's answers; those of the fixture itself are `Truth`'s.
  std::size_t checks = 0;
  /// Questions the kernel cannot be asked.
  std::size_t not_asked = 0;
  std::optional<Mismatch> mismatch;
  /// Why a difference that was seen is expected (`KnownDifference`), empty where there is none.
  std::string known_difference;
  /// Whether the kernel threw: it may be in no state to go on.
  bool lost = false;
  /// Whether that was because it gave no answer in its time (`KernelSilent`).
  bool silent = false;
  /// Time inside the kernel, microseconds.
  double kernel_us = 0;
};

/// Runs one fixture on one kernel. After every step: the split's answer; after every operation:
/// cell counts, vertex orbits and components as partitions, the kernel's own faults, and all that
/// the fixture says. Bodies up to 64 tetrahedra: that after every step, too; those above 1 000:
/// at most 64 times a fixture and where it says counts, and at its end.
/// `truth`: truth_of(fixture), which all kernels can share.
/// A mismatch comes with the shortest sequence of steps found that shows one (`shrink`); with
/// `narrows` false with all steps up to there, at once.
/// A kernel that throws, as one in another process does when it is lost, is a mismatch too.
Verdict judge(const Fixture& fixture, const Truth& truth, JudgedKernel& kernel,
              bool narrows = true);
Verdict judge(const Fixture& fixture, JudgedKernel& kernel);

/// The first wrong answer of a kernel to `steps` on a body, looked at as `judge` does, each step an
/// operation; none when all are right, and for a body that it refuses.
std::optional<Mismatch> first_mismatch(const TetMesh& body, std::span<const Step> steps,
                                       JudgedKernel& kernel);

}  // namespace sunder::suite
