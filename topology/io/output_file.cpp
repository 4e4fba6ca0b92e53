// SPDX-License-Identifier: MIT
// Writing beside and renaming, with every system error said.
#include "topology/io/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <system_error>

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

/// The file that a name stands for: links followed, so that renaming does not replace a link.
std::filesystem::path target_of(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_symlink(path, error)) return path;
  const std::filesystem::path target = std::filesystem::weakly_canonical(path, error);
  return error ? path : target;
}

}  // namespace

std::optional<Finding> write_file(const std::filesystem::path& path,
                                  std::span<const std::string_view> parts) {
  const std::filesystem::path target = target_of(path);
  std::error_code error;
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
  const int file = ::open(beside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file < 0) return cannot_write(path, errno, remedy_for(errno));
  int failure = write_all(file, parts);
  if (::close(file) != 0 && failure == 0) failure = errno;
  if (failure == 0 && ::rename(beside.c_str(), target.c_str()) != 0) failure = errno;
  if (failure == 0) return std::nullopt;
  ::unlink(beside.c_str());
  return cannot_write(path, failure, remedy_for(failure));
}

std::optional<Finding> write_file(const std::filesystem::path& path, std::string_view text) {
  return write_file(path, std::span(&text, 1));
}

bool file_exists(const std::filesystem::path& path) {
  std::error_code unknown;
  return std::filesystem::exists(path, unknown);
}

}  // namespace sunder
