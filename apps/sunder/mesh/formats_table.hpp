// SPDX-License-Identifier: MIT
// What each format of mesh files holds, as a table.
#pragma once

#include <string>

namespace sunder {

/// The Markdown table of docs/formats.md: a row a format.
std::string formats_table();

}  // namespace sunder
