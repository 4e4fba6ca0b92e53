// SPDX-License-Identifier: MIT
// Gives gnuplot a script and keeps its picture.
#include "apps/sunder/gnuplot.hpp"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <system_error>
#include <utility>

#include "topology/io/files/output_file.hpp"

namespace sunder {
namespace {

/// Runs a shell command and gives its output and its exit code.
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

/// A file in memory that programs started from here can read as /dev/fd/N. It is on no disk, so
/// that a program that ends on the way leaves nothing behind.
class InMemory {
 public:
  explicit InMemory(std::string_view text) : file_(memfd_create("sunder_plot", 0)) {
    if (file_ < 0) error_ = errno;
    while (error_ == 0 && !text.empty()) {
      const ssize_t written = ::write(file_, text.data(), text.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) error_ = errno;
      if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
    }
  }
  ~InMemory() {
    if (file_ >= 0) ::close(file_);
  }
  InMemory(const InMemory&) = delete;
  InMemory& operator=(const InMemory&) = delete;

  std::string path() const { return fmt::format("/dev/fd/{}", file_); }
  /// 0, or why the text is not in it.
  int error() const { return error_; }

 private:
  int file_, error_ = 0;
};

}  // namespace

std::optional<Finding> draw_png(std::string_view script, const std::filesystem::path& png) {
  if (output_of("command -v gnuplot").second != 0) {
    return Finding{
        .code = "gnuplot_missing",
        .text = "gnuplot, which draws the picture, is not installed",
        .remedy = "install it (Debian: apt-get install gnuplot-nox), or do without the picture",
        .file = png.string()};
  }
  const InMemory given(script);
  if (given.error() != 0) {
    return Finding{.code = "gnuplot_failed",
                   .text = fmt::format("gnuplot cannot be given its script: {}",
                                       std::generic_category().message(given.error())),
                   .remedy = "close other programs, or do without the picture",
                   .file = png.string()};
  }
  const auto [picture, exit_code] = output_of("gnuplot " + given.path());
  if (exit_code != 0 || !picture.starts_with("\x89PNG")) {
    return Finding{
        .code = "gnuplot_failed",
        .text = fmt::format("gnuplot ended with exit code {} and drew nothing", exit_code),
        .remedy = "read its message above; it must be able to write PNG",
        .file = png.string()};
  }
  return write_file(png, picture);
}

}  // namespace sunder
