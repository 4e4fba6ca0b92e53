// SPDX-License-Identifier: MIT
// Runs the program as a shell would and returns its output.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/folder.hpp"
#include "topology/base/tet_mesh.hpp"

namespace sunder::test {

/// How the program ended, and its output.
struct Outcome {
  int exit_code = -1;
  std::string out;
  std::string err;
  std::string text() const { return out + err; }
  /// stdout as JSON; discarded where it is none.
  nlohmann::json json() const { return nlohmann::json::parse(out, nullptr, false); }
};

/// Runs the program on `words`, which the shell takes apart.
Outcome run_program(const std::string& words);

/// A folder with the program at hand.
class Workplace {
 public:
  Outcome run(const std::vector<std::string>& arguments) const;
  /// The path of a file here.
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  /// Writes a file here and gives its path.
  std::string write(const std::string& name, const std::string& bytes) const;
  std::string write(const std::string& name, const TetMesh& mesh) const;
  /// Names of the files here, sorted.
  std::vector<std::string> names() const { return folder_.names(); }

 private:
  Folder folder_;
};

/// A mesh of the repository's meshes/.
std::string sample_mesh(const std::string& name);

}  // namespace sunder::test
