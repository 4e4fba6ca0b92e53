// SPDX-License-Identifier: MIT
// Lines of three numbers.
#include "topology/io/face_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string>

#include "topology/io/text/scan.hpp"

namespace sunder {
namespace {

/// Three numbers and nothing else; false when the line holds something else.
bool read_triple(std::string_view line, std::array<std::uint32_t, 3>& points) {
  const char* at = line.data();
  const char* const end = at + line.size();
  const auto skip = [&] {
    while (at != end && (*at == ' ' || *at == '\t' || *at == '\r' || *at == ',')) ++at;
  };
  for (std::uint32_t& point : points) {
    skip();
    const char* const begin = at;
    const auto [stop, reason] = std::from_chars(begin, end, point);
    if (reason != std::errc{}) return false;
    at = stop;
    skip();
    if (at == stop && at != end) return false;
  }
  return at == end;
}

}  // namespace

Result<std::vector<std::array<std::uint32_t, 3>>> read_face_list(std::string_view bytes,
                                                                 std::string_view name) {
  std::vector<std::array<std::uint32_t, 3>> triples;
  std::size_t number = 0;
  while (!bytes.empty()) {
    ++number;
    const std::string_view line = bytes.substr(0, bytes.find('\n'));
    bytes.remove_prefix(std::min(bytes.size(), line.size() + 1));
    const std::string_view content = line.substr(0, line.find('#'));
    if (content.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    std::array<std::uint32_t, 3> triple{};
    if (!read_triple(content, triple)) {
      // If even the first line is no face, the file may be no list of faces, and is not shown.
      return Finding{.code = "bad_face",
                     .text = fmt::format("{} is no face: three rows of points, counted from 0, "
                                         "were expected",
                                         triples.empty() ? "this line" : io::in_quotes(content)),
                     .remedy = "correct this line",
                     .file = std::string(name),
                     .line = number};
    }
    triples.push_back(triple);
  }
  return triples;
}

}  // namespace sunder
