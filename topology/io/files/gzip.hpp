// SPDX-License-Identifier: MIT
// Internal to topology/io: files packed by gzip.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace sunder::io {

/// Whether `bytes` begin like a gzip file.
bool is_gzip(std::string_view bytes);

/// The unpacked bytes, all members of the file one after the other. Throws ReadFailure (bad_gzip,
/// truncated_file; too_large, beyond `Limits::unpacked_bytes`). Allocates at most twice the
/// unpacked size.
std::string unpacked(std::string_view bytes);

/// The parts as one member of a gzip file, without name or time: the same bytes whenever it is
/// made.
std::string packed(std::span<const std::string_view> parts);

}  // namespace sunder::io
