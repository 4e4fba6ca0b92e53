// SPDX-License-Identifier: MIT
// Lines of three numbers.
#include "topology/io/face_list.hpp"

#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <string>

#include "topology/io/scan.hpp"

namespace sunder {
namespace {

/// Three numbers and nothing else; false when the line holds something else.
bool read_triple(const std::string& line, std::array<std::uint32_t, 3>& points) {
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

Result<std::vector<std::array<std::uint32_t, 3>>> read_face_list(
    const std::filesystem::path& path) {
  std::ifstream in(path);
  if (!in || std::filesystem::is_directory(path)) {
    return Finding{.code = "cannot_open",
                   .text = "the file cannot be read",
                   .remedy = "name a file with three rows of points a line",
                   .file = path.string()};
  }
  std::vector<std::array<std::uint32_t, 3>> triples;
  std::size_t number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    const std::string content = line.substr(0, line.find('#'));
    if (content.find_first_not_of(" \t\r") == std::string::npos) continue;
    std::array<std::uint32_t, 3> triple{};
    if (!read_triple(content, triple)) {
      return Finding{.code = "bad_face",
                     .text = fmt::format("{} is no face: three rows of points, counted from 0, "
                                         "were expected",
                                         io::in_quotes(content)),
                     .remedy = "correct this line",
                     .file = path.string(),
                     .line = number};
    }
    triples.push_back(triple);
  }
  return triples;
}

}  // namespace sunder
