// SPDX-License-Identifier: MIT
// One body on one kernel and on the twin: every step is judged as it is made.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "topology/base/tet_mesh.hpp"
#include "topology/suite/fixtures/fixture.hpp"
#include "topology/suite/judge/glue_twin.hpp"
#include "topology/suite/judge/judge_checks.hpp"
#include "topology/suite/kernels/judged_kernel.hpp"
#include "topology/suite/kernels/operation.hpp"

namespace sunder::suite {

/// Spreads a check that costs as much as the body is large: it falls due so often that it costs
/// `allowance` tetrahedra a time on average, on small bodies every time.
struct Pace {
  std::size_t allowance = 0;
  std::size_t saved = 0;
};
/// Counts one more time; whether the check is due.
bool due(Pace& pace, std::size_t cost);

/// How often each check ran.
struct CheckCounts {
  /// Answers of splits against union-find round the face, and against the laws.
  std::size_t splits = 0;
  /// Glues; splits of boundary faces and glues of whole faces, which have to be refused.
  std::size_t glues = 0, refusals = 0;
  /// Kernel's counts after a split or glue against the running ones; change of Betti numbers.
  std::size_t laws = 0, betti_changes = 0;
  /// Counts and partitions against union-find over the whole body.
  std::size_t wholes = 0;
  /// The kernel's fans against the suite's own.
  std::size_t fans = 0;
  /// The kernel's sections of planes likewise.
  std::size_t sections = 0;
  /// The kernel's own faults asked for.
  std::size_t faults = 0;
  /// Homology of the whole body over GF(2) and Z.
  std::size_t homologies = 0;
};

struct Trial {
  TetMesh body;
  JudgedKernel kernel;
  GlueTwin twin;
  /// Cells as the answers of the twin have them, running; sheets are those last counted.
  CellCounts counts;
  /// Components without any boundary: now, and when the body was loaded.
  std::size_t closed = 0, closed_intact = 0;
  /// Whether `betti_from_sheets` holds for this body; where not, homology is computed.
  bool sheets_tell_betti = false;
  /// Over GF(2), of the body as it is now; absent when the last step was not looked at so far.
  std::optional<BettiNumbers> betti;
  /// Everything asked of the kernel since it was loaded.
  std::vector<Step> steps;
  Pace law_pace{.allowance = 96}, whole_pace{.allowance = 256}, fault_pace{.allowance = 64};
  CheckCounts times;
  /// The first mismatch is here; after it nothing more need be asked.
  Checks checks;
};

/// Loads the body and judges it whole. Needs: a body that can be built.
Trial begin_trial(TetMesh body, JudgedKernel kernel);

/// Splits a face from this side and judges the answer, which is returned as it should be; a face on
/// the boundary has to be refused.
SplitAnswer split(Trial& trial, HalfFaceId face);

/// Glues two half-faces with the same points; false, and nothing changes, where one of them is not
/// on the boundary. Needs: the kernel can glue.
bool glue(Trial& trial, HalfFaceId a, HalfFaceId b);

/// Counts and partitions against union-find over all.
void judge_whole(Trial& trial);
/// The kernel's fan at a vertex for a normal, as a set, against `steps` (the suite's own).
void judge_fan(Trial& trial, const SplitFan& fan, std::span<const Step> steps);
/// The kernel's faces for a break, each from its positive side, against `steps`.
void judge_break(Trial& trial, const BreakPoint& broken, std::span<const Step> steps);
/// And for the section of a plane.
void judge_plane(Trial& trial, const CuttingPlane& plane, std::span<const Step> steps);
/// The kernel's own list of faults.
void judge_faults(Trial& trial);
/// Homology of the body as it is, by the twin, against the kernel's counts, the formula for b1, the
/// universal coefficients and the kernel's own homology and orientability.
void judge_homology(Trial& trial);
/// After an operation: whole and faults where due.
void judge_where_due(Trial& trial);

}  // namespace sunder::suite
