// SPDX-License-Identifier: MIT
// Content that readers leave out, counted by kind and named.
#include "topology/io/skipped.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "topology/io/draft.hpp"
#include "topology/io/text/scan.hpp"

namespace sunder::io {
namespace {

/// A name as a message shows it, without control characters.
std::string shown(std::string_view name) {
  const std::string quoted = in_quotes(name);
  const std::size_t end = quoted.find_last_not_of('\'');
  return quoted.substr(1, end == std::string::npos ? 0 : end);
}

void add_name(Skipped& skipped, std::string_view name) {
  constexpr std::size_t most = 12;
  if (name.empty() || skipped.has_more) return;
  std::string text = shown(name);
  if (std::ranges::find(skipped.names, text) != skipped.names.end()) return;
  skipped.has_more = skipped.names.size() == most;
  if (!skipped.has_more) skipped.names.push_back(std::move(text));
}

}  // namespace

void add_skipped(Draft& draft, std::string_view kind, std::string_view name, std::size_t at,
                 std::size_t count) {
  if (count == 0) return;
  auto found = draft.skipped.find(kind);
  if (found == draft.skipped.end()) {
    found = draft.skipped.emplace(kind, Skipped{}).first;
    found->second.file = draft.file;
    found->second.line = draft.text.empty() ? 0 : line_of(draft.text, at);
  }
  found->second.count += count;
  add_name(found->second, name);
}

void report_skipped(Draft& draft) {
  for (const auto& [kind, skipped] : draft.skipped) {
    std::string text = fmt::format("{} are left out", kind);
    for (std::size_t i = 0; i < skipped.names.size(); ++i) {
      text += fmt::format("{}{}", i == 0 ? ": " : ", ", skipped.names[i]);
    }
    draft.findings.push_back({.code = "skipped_data",
                              .severity = Severity::warning,
                              .count = skipped.count,
                              .text = text + (skipped.has_more ? ", ..." : ""),
                              .remedy = "nothing to do, unless they matter: the mesh is kept "
                                        "without them",
                              .file = skipped.file,
                              .line = skipped.line});
  }
  draft.skipped.clear();
}

}  // namespace sunder::io
