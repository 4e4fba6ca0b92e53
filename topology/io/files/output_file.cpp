// SPDX-License-Identifier: MIT
// Writing a second file and renaming it, with every system error reported.
#include "topology/io/files/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <string>
#include <system_error>

#include "topology/io/files/gzip.hpp"
#include "topology/io/files/printing.hpp"

namespace sunder {
namespace {

Finding cannot_write(const std::filesystem::path& path, int error, std::string remedy) {
  return {
      .code = "cannot_write",
      .text = fmt::format("the file cannot be written: {}", std::generic_category().message(error)),
      .remedy = std::move(remedy),
      .file = path.string()};
}

std::string remedy_for(int error) {
  switch (error) {
    case ENOENT:
      return "create the folder first, or name another one";
    case ENOTDIR:
      return "a part of the path is a file: name another folder";
    case EISDIR:
      return "name a file, not a folder";
    case EACCES:
    case EPERM:
    case EROFS:
      return "choose a place that you may write to";
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return "make room on the disk, or write elsewhere";
    default:
      return "write elsewhere";
  }
}

Finding no_folder(const std::filesystem::path& folder, const std::error_code& error,
                  const std::filesystem::path& place) {
  const bool lacks_more = error == std::errc::no_such_file_or_directory;
  return {.code = "cannot_write",
          .text = fmt::format("the folder {} cannot be made: {}", folder.string(), error.message()),
          .remedy = lacks_more
                        ? fmt::format("make it first: mkdir -p {}", shell_word(folder.string()))
                        : remedy_for(error.value()),
          .file = place.string()};
}

/// 0, or the system's error number.
int write_all(int file, std::span<const std::string_view> parts) {
  for (std::string_view part : parts) {
    while (!part.empty()) {
      const ssize_t written = ::write(file, part.data(), part.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) return errno;
      part.remove_prefix(static_cast<std::size_t>(written));
    }
  }
  return 0;
}

/// The file that a name stands for: links followed, so that renaming does not replace a link; the
/// last one may lead to a file that is not there yet.
std::filesystem::path target_of(std::filesystem::path path) {
  constexpr int most_links = 40;  // as many as Linux follows
  std::error_code error;
  for (int k = 0; k < most_links && std::filesystem::is_symlink(path, error); ++k) {
    const std::filesystem::path target = std::filesystem::read_symlink(path, error);
    if (error) break;
    path = path.parent_path() / target;
  }
  return path;
}

/// Opens a new file that is to replace `target`, for its readers alone: with the mode of that, and
/// its owner and group as far as the system lets us. -1 where it cannot be made.
int open_beside(const std::filesystem::path& beside, const std::filesystem::path& target) {
  struct stat old = {};
  const bool replaces = ::stat(target.c_str(), &old) == 0;
  const int file =
      ::open(beside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, replaces ? 0600 : 0666);
  if (file < 0 || !replaces) return file;
  const bool is_owner = old.st_uid == ::geteuid() && old.st_gid == ::getegid();
  const bool changed = is_owner || ::fchown(file, old.st_uid, old.st_gid) == 0;
  // Rights of another group must not become those of ours.
  static_cast<void>(::fchmod(file, old.st_mode & (changed ? 0777 : 0707)));
  return file;
}

}  // namespace

std::optional<Finding> write_file(const std::filesystem::path& path,
                                  std::span<const std::string_view> parts, Durable durable) {
  std::string whole;
  std::string_view gzip;
  if (path.extension() == ".gz") {
    gzip = whole = io::packed(parts);
    parts = std::span(&gzip, 1);
  }
  if (path == "-") {
    const int failure = write_all(STDOUT_FILENO, parts);
    return failure == 0 ? std::nullopt
                        : std::optional(cannot_write(path, failure, remedy_for(failure)));
  }
  const std::filesystem::path target = target_of(path);
  if (auto finding = make_folder_of(target)) return finding;
  std::error_code error;
  if (std::filesystem::is_symlink(target, error)) {
    return cannot_write(path, ELOOP, "name a file: these links lead to each other");
  }
  const auto status = std::filesystem::status(target, error);
  if (std::filesystem::is_directory(status)) return cannot_write(path, EISDIR, remedy_for(EISDIR));
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    // Renaming onto a device or a pipe would replace it.
    return cannot_write(path, EINVAL, "name an ordinary file");
  }
  // Two threads, or two processes, may be writing the same name at once.
  static std::atomic<unsigned> serial = 0;
  const std::filesystem::path beside =
      fmt::format("{}.{}-{}.part", target.string(), ::getpid(), serial++);
  const int file = open_beside(beside, target);
  if (file < 0) return cannot_write(path, errno, remedy_for(errno));
  int failure = write_all(file, parts);
  if (durable == Durable::yes && failure == 0 && ::fsync(file) != 0) failure = errno;
  if (::close(file) != 0 && failure == 0) failure = errno;
  if (failure == 0 && ::rename(beside.c_str(), target.c_str()) != 0) failure = errno;
  if (failure == 0) {
    return durable == Durable::yes
               ? sync_file(target.has_parent_path() ? target.parent_path() : ".")
               : std::nullopt;
  }
  ::unlink(beside.c_str());
  return cannot_write(path, failure, remedy_for(failure));
}

std::optional<Finding> make_folder_of(const std::filesystem::path& path) {
  const std::filesystem::path folder = path.parent_path();
  std::error_code error;
  if (folder.empty() || std::filesystem::is_directory(folder, error)) return std::nullopt;
  error.clear();
  std::filesystem::create_directory(folder, error);
  return error ? std::optional(no_folder(folder, error, path)) : std::nullopt;
}

std::optional<Finding> make_folder(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) return std::nullopt;
  error.clear();
  std::filesystem::create_directories(path, error);
  return error ? std::optional(no_folder(path, error, path)) : std::nullopt;
}

std::optional<Finding> write_file(const std::filesystem::path& path, std::string_view text) {
  return write_file(path, std::span(&text, 1));
}

Result<AppendedFile> AppendedFile::open(const std::filesystem::path& path, std::uint64_t bytes) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (file < 0) return cannot_write(path, errno, remedy_for(errno));
  AppendedFile opened(path, file);
  if (::ftruncate(file, static_cast<off_t>(bytes)) != 0) {
    return cannot_write(path, errno, remedy_for(errno));
  }
  return opened;
}

AppendedFile::AppendedFile(AppendedFile&& other) noexcept
    : path_(std::move(other.path_)), file_(std::exchange(other.file_, -1)) {}

AppendedFile& AppendedFile::operator=(AppendedFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(file_, other.file_);
  return *this;
}

AppendedFile::~AppendedFile() {
  if (file_ >= 0) ::close(file_);
}

std::optional<Finding> AppendedFile::append(std::string_view text) {
  const off_t end = ::lseek(file_, 0, SEEK_END);
  const int failure = write_all(file_, std::span(&text, 1));
  if (failure == 0) return std::nullopt;
  // No half line; where even that fails, there is one.
  if (end >= 0) static_cast<void>(::ftruncate(file_, end) == 0);
  return cannot_write(path_, failure, remedy_for(failure));
}

std::optional<Finding> sync_file(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  int failure = file < 0 || ::fsync(file) != 0 ? errno : 0;
  if (file >= 0) ::close(file);
  // File systems that cannot sync say so; there is nothing to do about that.
  if (failure == EINVAL || failure == EROFS) failure = 0;
  if (failure == 0) return std::nullopt;
  return cannot_write(path, failure, remedy_for(failure));
}

bool file_exists(const std::filesystem::path& path) {
  std::error_code unknown;
  return std::filesystem::exists(path, unknown);
}

}  // namespace sunder
