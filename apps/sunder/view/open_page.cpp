// SPDX-License-Identifier: MIT
#include "apps/sunder/view/open_page.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <unistd.h>

#include <cstdlib>
#include <system_error>

namespace sunder {
namespace {

namespace fs = std::filesystem;

/// The user's own folder of this login, else the one for temporary files.
fs::path folder_of_user() {
  const char* own = std::getenv("XDG_RUNTIME_DIR");
  std::error_code none;
  if (own != nullptr && fs::is_directory(own, none)) return own;
  return fs::temp_directory_path(none);
}

bool write_private(const fs::path& file, const std::string& text) {
  const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (descriptor < 0) return false;
  const bool is_whole =
      write(descriptor, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  return close(descriptor) == 0 && is_whole;
}

/// A file that leads a browser on to `url`, alone in a folder that the user alone can open.
std::optional<fs::path> write_way_in(const std::string& url) {
  std::string folder = (folder_of_user() / "sunder-view-XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) return {};  // of mode 0700
  const fs::path file = fs::path(folder) / "page.html";
  // The address is ours: digits, letters and marks that mean nothing in HTML.
  const std::string text = fmt::format(
      "<!doctype html>\n<meta charset=\"utf-8\">\n<meta name=\"referrer\" "
      "content=\"no-referrer\">\n"
      "<title>Sunder</title>\n<script>location.replace(\"{0}\");</script>\n"
      "<a href=\"{0}\">The page of sunder view</a>\n",
      url);
  if (write_private(file, text)) return file;
  remove_way_in(file);
  return {};
}

bool start_browser(const fs::path& file) {
  posix_spawn_file_actions_t silent;
  posix_spawnattr_t own;
  if (posix_spawn_file_actions_init(&silent) != 0) return false;
  if (posix_spawnattr_init(&own) != 0) return false;
  posix_spawn_file_actions_addopen(&silent, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&silent, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  // Ctrl-C, which goes to the terminal's group of processes, ends this program and no browser.
  posix_spawnattr_setflags(&own, POSIX_SPAWN_SETPGROUP);
  std::string program = "xdg-open", argument = file.string();
  char* arguments[] = {program.data(), argument.data(), nullptr};
  pid_t process = 0;
  const int wrong = posix_spawnp(&process, program.c_str(), &silent, &own, arguments, environ);
  posix_spawn_file_actions_destroy(&silent);
  posix_spawnattr_destroy(&own);
  return wrong == 0;
}

bool has_display() {
  return std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr;
}

}  // namespace

std::optional<fs::path> open_page(const std::string& url) {
  if (!has_display()) return {};
  std::optional<fs::path> file = write_way_in(url);
  if (!file || start_browser(*file)) return file;
  remove_way_in(*file);
  return {};
}

void remove_way_in(const fs::path& file) {
  std::error_code none;
  fs::remove(file, none);
  fs::remove(file.parent_path(), none);
}

}  // namespace sunder
