// SPDX-License-Identifier: MIT
// Programs of others, run without a shell.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sunder {

/// How a program ended.
struct ProcessEnd {
  /// None where it was not started, was ended by a signal, or took too long.
  std::optional<int> exit_code;
  bool took_too_long = false;
  /// The last lines that it printed, at most 2 000 bytes.
  std::string words;
};

/// The path of this program; empty where the system does not know it.
std::filesystem::path own_program();

/// The path of a program in the folders of PATH; none where there is no such file to execute.
std::optional<std::filesystem::path> find_program(const std::string& name);

/// Runs a program in `folder` and waits for it, at most `limit`; then it is killed. Standard input
/// is empty. On Linux it ends with this process too. Its output goes into a file of the folder.
ProcessEnd run_process(const std::filesystem::path& program,
                       const std::vector<std::string>& arguments,
                       const std::filesystem::path& folder, std::chrono::seconds limit);

/// A folder of its own in the system's folder for temporary files; it goes with the object.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  /// Empty where it could not be made.
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace sunder
