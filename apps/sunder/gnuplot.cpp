// SPDX-License-Identifier: MIT
// Writes a script, runs gnuplot on it, keeps what it draws.
#include "apps/sunder/gnuplot.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>

#include "topology/io/output_file.hpp"

namespace sunder {
namespace {

/// Runs a shell command and gives what it prints; its exit code behind it.
std::pair<std::string, int> output_of(const std::string& command) {
  std::string out;
  std::FILE* const pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return {out, 127};
  std::array<char, 65536> buffer;
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe)) {
    out.append(buffer.data(), n);
  }
  const int status = pclose(pipe);
  return {out, WIFEXITED(status) ? WEXITSTATUS(status) : 1};
}

}  // namespace

std::optional<Finding> draw_png(std::string_view script, const std::filesystem::path& png) {
  if (output_of("command -v gnuplot").second != 0) {
    return Finding{
        .code = "gnuplot_missing",
        .text = "gnuplot, which draws the picture, is not installed",
        .remedy = "install it (Debian: apt-get install gnuplot-nox), or do without the picture",
        .file = png.string()};
  }
  std::string name = (std::filesystem::temp_directory_path() / "sunder_plot_XXXXXX").string();
  const int script_file = mkstemp(name.data());
  if (script_file >= 0) close(script_file);
  if (auto failure = write_file(name, script)) return failure;
  const auto [picture, exit_code] = output_of("gnuplot '" + name + "'");
  std::filesystem::remove(name);
  if (exit_code != 0 || !picture.starts_with("\x89PNG")) {
    return Finding{
        .code = "gnuplot_failed",
        .text = fmt::format("gnuplot ended with exit code {} and drew nothing", exit_code),
        .remedy = "see what it said above; it has to be able to write PNG",
        .file = png.string()};
  }
  return write_file(png, picture);
}

}  // namespace sunder
