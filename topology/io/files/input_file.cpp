// SPDX-License-Identifier: MIT
// Reading whole files, and no file outside the folder of the mesh.
#include "topology/io/files/input_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

#include "topology/base/limits.hpp"
#include "topology/io/files/gzip.hpp"
#include "topology/io/text/scan.hpp"

namespace sunder::io {
namespace {

Finding cannot_open(const std::filesystem::path& path, int error) {
  return {
      .code = "cannot_open",
      .text = fmt::format("the file cannot be read: {}", std::generic_category().message(error)),
      .remedy = "check the name and the permissions",
      .file = path.string()};
}

Finding too_large(const std::filesystem::path& path) {
  return {.code = "too_large",
          .text = fmt::format("the file has more than {} bytes, the limit file_bytes",
                              limits().file_bytes),
          .remedy = "give a smaller file, or look at SUNDER_LIMITS and --confined",
          .file = path.string()};
}

/// Whether `path` is `folder` or lies below it; both without links and dots.
bool is_below(const std::filesystem::path& path, const std::filesystem::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first ==
         folder.end();
}

}  // namespace

Result<std::string> bytes_of_file(const std::filesystem::path& path) {
  const char* const name = path == "-" ? "/dev/stdin" : path.c_str();
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(name, "rb"), &std::fclose);
  if (!file) return cannot_open(path, errno);
  std::string bytes;
  std::error_code unknown;
  const auto size = std::filesystem::file_size(name, unknown);
  if (!unknown && size > limits().file_bytes) return too_large(path);
  // One byte more than the file has, so that the first read already meets its end.
  std::size_t filled = 0;
  bytes.resize(unknown ? 1 << 16 : size + 1);
  while (const std::size_t n = std::fread(&bytes[filled], 1, bytes.size() - filled, file.get())) {
    filled += n;
    if (filled > limits().file_bytes) return too_large(path);
    if (filled == bytes.size()) bytes.resize(2 * filled);
  }
  if (std::ferror(file.get())) return cannot_open(path, errno);
  bytes.resize(filled);
  return bytes;
}

Result<std::string> bytes_beside(const std::filesystem::path& folder, const std::string& name) {
  std::error_code unknown;
  const auto root = std::filesystem::weakly_canonical(folder.empty() ? "." : folder, unknown);
  std::filesystem::path path = std::filesystem::weakly_canonical(root / name, unknown);
  if (unknown || !is_below(path, root)) {
    return Finding{.code = "outside_folder",
                   .text = fmt::format("{} is not in the folder of the mesh: nothing outside it is "
                                       "read",
                                       in_quotes(name)),
                   .remedy = "put that file next to the mesh and name it without folders"};
  }
  const std::filesystem::path packed = root / (name + ".gz");
  if (!std::filesystem::exists(path, unknown)) {
    if (!std::filesystem::exists(packed, unknown)) {
      return Finding{.code = "missing_file",
                     .text = fmt::format("there is no file {}", in_quotes(name)),
                     .remedy = "put that file next to the mesh"};
    }
    path = std::filesystem::weakly_canonical(packed, unknown);
    if (unknown || !is_below(path, root)) return cannot_open(packed, ENOENT);
  }
  // A FIFO or a device would be waited for.
  if (std::filesystem::exists(path, unknown) && !std::filesystem::is_regular_file(path, unknown)) {
    return cannot_open(folder / name, EINVAL);
  }
  Result<std::string> bytes = bytes_of_file(path);
  for (Finding& f : bytes.findings) f.file = (folder / name).string();
  if (!bytes || !is_gzip(*bytes)) return bytes;
  try {
    return unpacked(*bytes);
  } catch (ReadFailure& failure) {
    failure.finding.file = (folder / name).string();
    return std::move(failure.finding);
  }
}

}  // namespace sunder::io
