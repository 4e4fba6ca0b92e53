// SPDX-License-Identifier: MIT
// Internal to the reader of MEDIT: sections that the mesh does not hold.
#pragma once

#include <string>
#include <string_view>

#include "topology/io/draft.hpp"

namespace sunder::io {

/// Passes the rows of a section of text behind its keyword, which stands at byte `at`, and reports
/// it. Rows of an unknown one end before the next word that is no number. Fails with wrong_count
/// where `keyword` is no word.
void skip_medit_section(Scanner& s, Draft& draft, std::string_view keyword, std::size_t dimension,
                        std::size_t at);

/// The keyword of a number in binary files; "keyword 99" for those without a word here.
std::string medit_keyword_of(int code);

}  // namespace sunder::io
