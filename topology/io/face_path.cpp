// SPDX-License-Identifier: MIT
// Lists of faces by their paths.
#include "topology/io/face_list.hpp"
#include "topology/io/files/input_file.hpp"

namespace sunder {

Result<std::vector<std::array<std::uint32_t, 3>>> read_face_list(
    const std::filesystem::path& path) {
  Result<std::string> bytes = io::bytes_of_file(path);
  if (!bytes) {
    if (bytes.findings.front().code != "cannot_open") return bytes.findings.front();
    return Finding{.code = "cannot_open",
                   .text = "the file cannot be read",
                   .remedy = "name a file with three rows of points a line",
                   .file = path.string()};
  }
  return read_face_list(*bytes, path.string());
}

}  // namespace sunder
