// SPDX-License-Identifier: MIT
// Runs the program as a shell would and brings back what it said.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "topology/kernel/tet_mesh.hpp"

namespace sunder::test {

struct Outcome {
  int exit_code = -1;
  std::string out;
  std::string err;
  /// stdout as JSON; discarded where it is none.
  nlohmann::json json() const { return nlohmann::json::parse(out, nullptr, false); }
};

/// A folder of its own for each test; gone at the end.
class Workplace {
 public:
  Workplace();
  ~Workplace();
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;

  Outcome run(const std::vector<std::string>& arguments) const;
  /// The path of a file here.
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  /// Writes a file here and gives its path.
  std::string write(const std::string& name, const std::string& bytes) const;
  std::string write(const std::string& name, const TetMesh& mesh) const;
  /// Names of the files here, sorted.
  std::vector<std::string> names() const;

 private:
  std::filesystem::path folder_;
};

/// A mesh of the repository's meshes/.
std::string sample_mesh(const std::string& name);

}  // namespace sunder::test
