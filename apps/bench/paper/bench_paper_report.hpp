// SPDX-License-Identifier: MIT
// The figures of `sunder bench paper` in the paper's layout, as text and Markdown, and as CSV.
#pragma once

#include <string>

#include "apps/bench/paper/bench_paper.hpp"

namespace sunder {

/// Tables 1 to 4, the threshold tests and the claims, columns aligned.
std::string paper_text(const PaperBench& bench);

/// The same tables in GitHub's Markdown.
std::string paper_markdown(const PaperBench& bench);

/// table,scene,mode,quantity,unit,value below two lines of comment; the paper's own numbers are
/// lines of the mode "paper". Everything that is measured; table 5: of the claims.
std::string paper_csv(const PaperBench& bench);

}  // namespace sunder
