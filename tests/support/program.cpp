// SPDX-License-Identifier: MIT
// Running the program through the shell, its outputs in files.
#include "tests/support/program.hpp"

#include <stdlib.h>
#include <sys/wait.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "topology/io/mesh_file.hpp"

namespace sunder::test {
namespace {

std::string quoted(const std::string& word) {
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? "'\\''" : std::string(1, c);
  return out + "'";
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

Workplace::Workplace() {
  std::string name = (std::filesystem::temp_directory_path() / "sunder-apps-XXXXXX").string();
  if (mkdtemp(name.data()) != nullptr) folder_ = name;
}

Workplace::~Workplace() {
  std::error_code ignored;
  if (!folder_.empty()) std::filesystem::remove_all(folder_, ignored);
}

Outcome Workplace::run(const std::vector<std::string>& arguments) const {
  const std::filesystem::path out = folder_.string() + ".out", err = folder_.string() + ".err";
  std::string command = quoted(SUNDER_PROGRAM);
  for (const std::string& argument : arguments) command += " " + quoted(argument);
  command += " >" + quoted(out.string()) + " 2>" + quoted(err.string()) + " </dev/null";
  const int status = std::system(command.c_str());
  Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, bytes_of(out), bytes_of(err)};
  std::filesystem::remove(out);
  std::filesystem::remove(err);
  return outcome;
}

std::string Workplace::write(const std::string& name, const std::string& bytes) const {
  std::ofstream(folder_ / name, std::ios::binary) << bytes;
  return path(name);
}

std::string Workplace::write(const std::string& name, const TetMesh& mesh) const {
  write_mesh(folder_ / name, mesh);
  return path(name);
}

std::vector<std::string> Workplace::names() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string sample_mesh(const std::string& name) {
  return (std::filesystem::path(SUNDER_MESHES) / name).string();
}

}  // namespace sunder::test
