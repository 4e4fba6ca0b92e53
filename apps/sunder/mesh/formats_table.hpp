// SPDX-License-Identifier: MIT
// The content that each format of mesh files can hold, as a table.
#pragma once

#include <optional>
#include <string>

#include "topology/io/format_traits.hpp"

namespace sunder {

/// The Markdown table of docs/reference/formats.md: a row a format.
std::string formats_table();

/// The format of this name; none where there is none.
std::optional<MeshFormat> format_called(const std::string& word);

/// Empty where a format has this name; else an error with the names of all formats.
std::string known_format(const std::string& word);

}  // namespace sunder
