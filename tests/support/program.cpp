// SPDX-License-Identifier: MIT
// Running the program through the shell, its outputs in files.
#include "tests/support/program.hpp"

#include <sys/wait.h>

#include <cstdlib>
#include <fstream>

#include "topology/io/mesh_file.hpp"

namespace sunder::test {
namespace {

std::string quoted(const std::string& word) {
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? "'\\''" : std::string(1, c);
  return out + "'";
}

}  // namespace

Outcome run_program(const std::string& words) {
  const Folder said;
  const std::filesystem::path out = said.path() / "out", err = said.path() / "err";
  const std::string command = quoted(SUNDER_PROGRAM) + " " + words + " >" + quoted(out.string()) +
                              " 2>" + quoted(err.string()) + " </dev/null";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, bytes_of(out), bytes_of(err)};
}

Outcome Workplace::run(const std::vector<std::string>& arguments) const {
  std::string words;
  for (const std::string& argument : arguments) words += quoted(argument) + " ";
  return run_program(words);
}

std::string Workplace::write(const std::string& name, const std::string& bytes) const {
  std::ofstream(folder_.path() / name, std::ios::binary) << bytes;
  return path(name);
}

std::string Workplace::write(const std::string& name, const TetMesh& mesh) const {
  write_mesh(folder_.path() / name, mesh);
  return path(name);
}

std::string sample_mesh(const std::string& name) {
  return (std::filesystem::path(SUNDER_MESHES) / name).string();
}

}  // namespace sunder::test
