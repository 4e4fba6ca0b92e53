// SPDX-License-Identifier: MIT
// The claims of the paper's section 5, each compared with our figures.
#pragma once

#include <string>
#include <vector>

#include "apps/bench/paper/bench_paper.hpp"

namespace sunder {

/// A claim with its number in every scene; "-" where there is none.
struct PaperClaim {
  std::string text;
  std::vector<std::string> paper, ours;  ///< row = scene
  /// "holds", "differs" or "holds in N of M", of the scenes that have figures; "-" without any.
  std::string verdict;
};

/// In the paper's order, ours in the paper's mode (implicit Euler in place of Broyden's method).
std::vector<PaperClaim> paper_claims(const PaperBench& bench);

}  // namespace sunder
