// SPDX-License-Identifier: MIT
// Laws for the counts of a body, and for the changes of these counts by one face split.
#pragma once

#include <cstddef>

#include "topology/suite/judge/judge_checks.hpp"
#include "topology/suite/kernels/operation.hpp"

namespace sunder::suite {

/// Betti numbers from counts: b0 components, b3 = `closed` (components without any boundary),
/// b2 = sheets - components + closed, b1 = b0 + b2 - b3 - chi.
/// Needs: a body in which every closed surface bounds together with parts of the boundary (the map
/// from the second homology of the boundary is onto). Then that holds after any cut too: the
/// filling of the surface before the cut consists of the same tetrahedra after it.
BettiNumbers betti_from_sheets(const CellCounts& counts, std::size_t closed);

/// Counts after a split with the effect `answer`. Sheets are copied: no split determines them.
CellCounts counts_after(const CellCounts& before, const SplitAnswer& answer);

/// Likewise before a split with the effect `answer`.
CellCounts counts_before(const CellCounts& after, const SplitAnswer& answer);

/// Checks an answer against effects that no split of any body can have: one vertex apart needs two
/// edges apart, two or three need all three; a separation needs three (or the oracle would miss
/// it).
void judge_answer(Checks& checks, const SplitAnswer& answer);

/// Checks a change of the Betti numbers against the table of changes that a split can make. With
/// all three vertices apart the old body is the new one and an arc; with fewer, the two copies of
/// the face share a part of the triangle, hence b0 stays. Needs: the face did split.
void judge_change(Checks& checks, const BettiNumbers& before, const BettiNumbers& after,
                  const SplitAnswer& answer);

}  // namespace sunder::suite
