// SPDX-License-Identifier: MIT
// fork, exec, wait.
#include "apps/sunder/process/run_process.hpp"

#include <fcntl.h>
#if defined(__linux__)
#include <sys/prctl.h>
#endif
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <system_error>
#include <thread>

namespace sunder {
namespace {

namespace fs = std::filesystem;

constexpr const char* log_name = "printed.txt";

/// In the child: only calls that are safe after fork.
[[noreturn]] void become(const char* program, char* const* arguments, const char* folder) {
#if defined(__linux__)
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // it does not outlive a parent that is killed
#endif
  const int nothing = open("/dev/null", O_RDONLY);
  if (chdir(folder) != 0) _exit(127);
  const int log = open(log_name, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (nothing < 0 || log < 0) _exit(127);
  dup2(nothing, STDIN_FILENO);
  dup2(log, STDOUT_FILENO);
  dup2(log, STDERR_FILENO);
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_DFL);
  execv(program, arguments);
  _exit(127);
}

std::string last_words(const fs::path& log) {
  constexpr std::size_t most = 2000;
  std::ifstream in(log, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(in), {});
  return text.size() > most ? text.substr(text.size() - most) : text;
}

}  // namespace

fs::path own_program() {
  std::error_code unknown;
  return fs::read_symlink("/proc/self/exe", unknown);
}

std::optional<fs::path> find_program(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::string_view folders = path == nullptr ? "/usr/local/bin:/usr/bin:/bin" : path;
  while (!folders.empty()) {
    const std::size_t colon = std::min(folders.find(':'), folders.size());
    const fs::path file = fs::path(folders.substr(0, colon)) / name;
    std::error_code none;
    if (fs::is_regular_file(file, none) && access(file.c_str(), X_OK) == 0) {
      return fs::absolute(file, none);
    }
    folders.remove_prefix(std::min(colon + 1, folders.size()));
  }
  return std::nullopt;
}

ProcessEnd run_process(const fs::path& program, const std::vector<std::string>& arguments,
                       const fs::path& folder, std::chrono::seconds limit) {
  std::vector<std::string> words = {program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> raw;
  for (std::string& word : words) raw.push_back(word.data());
  raw.push_back(nullptr);
  const std::string path = program.string(), place = folder.string();
  ProcessEnd end;
  const pid_t child = fork();
  if (child < 0) return end;
  if (child == 0) become(path.c_str(), raw.data(), place.c_str());
  const auto last = std::chrono::steady_clock::now() + limit;
  int status = 0;
  for (;;) {
    const pid_t ended = waitpid(child, &status, WNOHANG);
    if (ended == child || (ended < 0 && errno != EINTR)) break;
    if (!end.took_too_long && std::chrono::steady_clock::now() > last) {
      end.took_too_long = true;
      kill(child, SIGKILL);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  if (!end.took_too_long && WIFEXITED(status)) end.exit_code = WEXITSTATUS(status);
  end.words = last_words(folder / log_name);
  return end;
}

TemporaryFolder::TemporaryFolder() {
  std::error_code none;
  std::string pattern = (fs::temp_directory_path(none) / "sunder_break_XXXXXX").string();
  if (mkdtemp(pattern.data()) != nullptr) path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code none;
  if (!path_.empty()) fs::remove_all(path_, none);
}

}  // namespace sunder
