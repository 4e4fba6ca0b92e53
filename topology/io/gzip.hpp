// SPDX-License-Identifier: MIT
// Internal to topology/io: files packed by gzip.
#pragma once

#include <string>
#include <string_view>

namespace sunder::io {

/// Whether `bytes` begin like a gzip file.
bool is_gzip(std::string_view bytes);

/// What was packed, all members of the file one after the other. Throws ReadFailure (bad_gzip,
/// truncated_file). Allocates at most twice what it unfolds to.
std::string unpacked(std::string_view bytes);

}  // namespace sunder::io
