// SPDX-License-Identifier: MIT
// Internal to the readers: the one way to report content of a file that is not kept.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace sunder::io {

struct Draft;

/// Content of one kind that is left out.
struct Skipped {
  std::size_t count = 0;
  /// The first few different names, in the order of the file.
  std::vector<std::string> names;
  bool has_more = false;
  /// The place of the first.
  std::string file;
  std::size_t line = 0;
};

/// By kind, in the plural: "sections", "normals of points".
using SkippedKinds = std::map<std::string, Skipped, std::less<>>;

/// Counts content of the file that the mesh does not hold, at the place where it is passed over.
/// Each kind becomes one warning `skipped_data` with its names. The rule for readers: all content
/// that they do not know is reported; exempt are only comments, titles and repeated data of the
/// mesh. `name` may be empty; `at`: byte of the draft's text.
void add_skipped(Draft& draft, std::string_view kind, std::string_view name, std::size_t at,
                 std::size_t count = 1);

/// Makes the findings of all that was counted. `finish` does so.
void report_skipped(Draft& draft);

}  // namespace sunder::io
