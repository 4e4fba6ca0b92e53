// SPDX-License-Identifier: MIT
// The laws that hold for the counts of a body, and for what one face split changes of them.
#pragma once

#include <cstddef>

#include "topology/suite/judge/judge_checks.hpp"
#include "topology/suite/kernels/operation.hpp"

namespace sunder::suite {

/// Betti numbers from counts: b0 components, b3 = `closed` (components without any boundary),
/// b2 = sheets - components + closed, b1 = b0 + b2 - b3 - chi.
/// Needs: a body in which every closed surface bounds together with parts of the boundary (the map
/// from the second homology of the boundary is onto). Then that holds after any cut too: what
/// filled the surface before the cut consists of the same tetrahedra after it.
BettiNumbers betti_from_sheets(const CellCounts& counts, std::size_t closed);

/// Counts after a split that did what `answer` says. Sheets are copied: no split tells them.
CellCounts counts_after(const CellCounts& before, const SplitAnswer& answer);

/// Likewise before a split that did what `answer` says.
CellCounts counts_before(const CellCounts& after, const SplitAnswer& answer);

/// Holds an answer against what no split of any body can do: one vertex apart needs two edges
/// apart, two or three need all three; a separation needs three (or the oracle would miss it).
void judge_answer(Checks& checks, const SplitAnswer& answer);

/// Holds a change of the Betti numbers against the table of what a split can make. With all three
/// vertices apart the old body is the new one and an arc; with fewer, the two copies of the face
/// share a part of the triangle, hence b0 stays. Needs: the face did split.
void judge_change(Checks& checks, const BettiNumbers& before, const BettiNumbers& after,
                  const SplitAnswer& answer);

}  // namespace sunder::suite
