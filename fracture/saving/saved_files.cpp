// SPDX-License-Identifier: MIT
// Saved states in files, which find names and errors; the bytes are saved_state.cpp's.
#include <fstream>
#include <iterator>

#include "fracture/saving/saved_state.hpp"
#include "topology/io/files/output_file.hpp"

namespace sunder {

std::vector<Finding> save(const Simulation& simulation, const std::filesystem::path& path) {
  std::vector<Finding> findings;
  if (auto finding = write_file(path, saved_state(simulation))) {
    findings.push_back(std::move(*finding));
  }
  return findings;
}

Result<Simulation> load(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), {}};
  Result<Simulation> result;
  if (!file.is_open() || file.bad()) {
    result = Finding{.code = "cannot_open",
                     .text = "it cannot be read",
                     .remedy = "check its path and that you may read it"};
  } else {
    result = restore(bytes);
  }
  for (Finding& finding : result.findings) {
    finding.file = path.string();
    finding.text = path.string() + ": " + finding.text;
  }
  return result;
}

}  // namespace sunder
