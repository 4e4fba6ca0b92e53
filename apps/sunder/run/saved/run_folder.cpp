// SPDX-License-Identifier: MIT
// Locks, names and the clearing of a run's folder.
#include "apps/sunder/run/saved/run_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <functional>
#include <optional>
#include <system_error>
#include <utility>

#include "topology/io/files/output_file.hpp"

namespace sunder {

namespace fs = std::filesystem;

namespace {

Finding cannot_lock(const fs::path& path, int error) {
  return {.code = "cannot_write",
          .text = fmt::format("cannot write {}: {}", path.string(),
                              std::generic_category().message(error)),
          .remedy = "give another folder with -o, or make this one writable",
          .file = path.string()};
}

/// The holder's text in a lock file.
std::string said_in(int file) {
  std::array<char, 256> text{};
  const ssize_t read = ::pread(file, text.data(), text.size(), 0);
  std::string line(text.data(), read > 0 ? static_cast<std::size_t>(read) : 0);
  while (!line.empty() && line.back() == '\n') line.pop_back();
  return line.empty() ? "another process" : line;
}

/// Whether the open file is still the one of that name: its last holder may have removed it.
bool is_named(int file, const fs::path& path) {
  struct stat open = {}, named = {};
  return ::fstat(file, &open) == 0 && ::stat(path.c_str(), &named) == 0 &&
         open.st_dev == named.st_dev && open.st_ino == named.st_ino;
}

void say_who(int file) {
  std::array<char, 128> host{};
  ::gethostname(host.data(), host.size() - 1);
  const std::string who = fmt::format("process {} on {}\n", ::getpid(), host.data());
  // Only a help for people: the lock holds without it.
  if (::ftruncate(file, 0) != 0 || ::pwrite(file, who.data(), who.size(), 0) < 0) return;
}

/// The number in a name such as frame_000012.vtu.
std::optional<std::uint64_t> number_in(std::string_view name, std::string_view before,
                                       std::string_view after) {
  if (name.size() <= before.size() + after.size() || !name.starts_with(before) ||
      !name.ends_with(after)) {
    return std::nullopt;
  }
  const std::string_view digits =
      name.substr(before.size(), name.size() - before.size() - after.size());
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc{} || end != digits.data() + digits.size()) return std::nullopt;
  return number;
}

constexpr std::array<std::string_view, 3> places = {"", "frames", "checkpoints"};

/// The file that `name` was to become: write_file writes NAME.PID-N.part, which a kill leaves.
std::string whole_name(const std::string& name) {
  constexpr std::string_view part = ".part";
  if (!name.ends_with(part)) return name;
  return name.substr(0, name.rfind('.', name.size() - part.size() - 1));
}

bool is_ours(const std::string& written) {
  const std::string name = whole_name(written);
  constexpr std::array<std::string_view, 7> tables = {
      "frames.pvd",    "events.jsonl", "cracks.csv", "fragments.csv",
      "obstacles.csv", "history.csv",  "report.json"};
  return number_in(name, "frame_", ".vtu") || number_in(name, "picture_", ".png") ||
         number_in(name, "step_", ".checkpoint") || std::ranges::find(tables, name) != tables.end();
}

/// Removes the files in the places of a run that `goes` names.
std::error_code remove_files(const fs::path& folder,
                             const std::function<bool(const std::string&)>& goes) {
  std::error_code error;
  for (const std::string_view place : places) {
    std::vector<fs::path> old;
    if (!fs::is_directory(folder / place, error)) continue;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder / place, error)) {
      if (goes(entry.path().filename().string())) old.push_back(entry.path());
    }
    for (const fs::path& path : old) {
      if (!error) fs::remove(path, error);
    }
    if (error) return error;
  }
  return {};
}

}  // namespace

Result<FolderLock> FolderLock::take(const fs::path& folder) {
  if (auto finding = make_folder(folder)) return std::move(*finding);
  const fs::path path = folder / "run.lock";
  for (;;) {
    const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (file < 0) return cannot_lock(path, errno);
    if (::flock(file, LOCK_EX | LOCK_NB) != 0) {
      const int reason = errno;
      const std::string holder = said_in(file);
      ::close(file);
      if (reason != EWOULDBLOCK) return cannot_lock(path, reason);
      return Finding{.code = "folder_in_use",
                     .text = fmt::format("{} is being written by {}", folder.string(), holder),
                     .remedy = "wait for it, or give another folder with -o",
                     .file = path.string()};
    }
    if (is_named(file, path)) {
      say_who(file);
      return FolderLock(path, file);
    }
    ::close(file);
  }
}

FolderLock::FolderLock(FolderLock&& other) noexcept
    : path_(std::move(other.path_)), file_(std::exchange(other.file_, -1)) {}

FolderLock& FolderLock::operator=(FolderLock&& other) noexcept {
  if (this == &other) return *this;
  let_go();
  path_ = std::move(other.path_);
  file_ = std::exchange(other.file_, -1);
  return *this;
}

FolderLock::~FolderLock() { let_go(); }

void FolderLock::let_go() {
  if (file_ < 0) return;
  ::unlink(path_.c_str());  // while it is held: the next run makes a new one
  ::close(file_);
  file_ = -1;
}

std::optional<Finding> link_among_files(const fs::path& folder) {
  std::error_code none;
  for (const std::string_view place : places) {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder / place, none)) {
      const std::string name = entry.path().filename().string();
      const bool is_place = std::ranges::find(places, name) != places.end();
      if (!entry.is_symlink(none) || !(is_ours(name) || is_place)) continue;
      return Finding{
          .code = "link_in_folder",
          .text = fmt::format("{} is a link, and a run writes nothing outside its folder",
                              entry.path().string()),
          .remedy =
              "remove the link, or give another folder with -o (which may be a "
              "link itself)",
          .file = entry.path().string()};
    }
  }
  return std::nullopt;
}

bool holds_a_run(const fs::path& folder) {
  std::error_code none;
  for (const std::string_view place : places) {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder / place, none)) {
      if (is_ours(entry.path().filename().string())) return true;
    }
  }
  return false;
}

std::error_code empty_run_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder / "frames", error);
  return error ? error : remove_files(folder, is_ours);
}

std::error_code remove_later(const fs::path& folder, std::uint64_t frames, std::uint64_t pictures) {
  return remove_files(folder, [&](const std::string& name) {
    if (name.ends_with(".part")) return is_ours(name);
    const auto frame = number_in(name, "frame_", ".vtu");
    const auto picture = number_in(name, "picture_", ".png");
    return (frame && *frame >= frames) || (picture && *picture >= pictures);
  });
}

std::string frame_name(std::uint64_t number) {
  return fmt::format("frames/frame_{:06}.vtu", number);
}

std::string picture_name(std::uint64_t number) { return fmt::format("picture_{:03}.png", number); }

}  // namespace sunder
