// SPDX-License-Identifier: MIT
// Headers of ustar.
#include "apps/bench/suite/tar.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string_view>

namespace sunder {
namespace {

constexpr std::size_t block = 512;

/// Fields of a ustar header: where they begin.
enum : std::size_t {
  at_name = 0,
  at_mode = 100,
  at_owner = 108,
  at_group = 116,
  at_size = 124,
  at_time = 136,
  at_sum = 148,
  at_type = 156,
  at_magic = 257,
  at_prefix = 345
};

std::string header_of(const PackedFile& file) {
  std::string header(block, '\0');
  const auto put = [&header](std::size_t at, std::string_view text) {
    std::copy(text.begin(), text.end(), header.begin() + static_cast<std::ptrdiff_t>(at));
  };
  const std::size_t slash = file.name.rfind('/');
  const bool folder = slash != std::string::npos;
  const std::string_view name = std::string_view(file.name).substr(folder ? slash + 1 : 0);
  const std::string_view prefix = std::string_view(file.name).substr(0, folder ? slash : 0);
  if (name.size() > 100 || prefix.size() > 155) throw std::length_error("name in a tar archive");
  put(at_name, name);
  put(at_prefix, prefix);
  put(at_mode, file.executable ? "0000755" : "0000644");
  put(at_owner, "0000000");
  put(at_group, "0000000");
  put(at_size, fmt::format("{:011o}", file.bytes.size()));
  put(at_time, "00000000000");
  put(at_type, "0");
  put(at_magic, {"ustar\00000", 8});
  put(at_sum, "        ");
  unsigned sum = 0;
  for (const char c : header) sum += static_cast<unsigned char>(c);
  put(at_sum, fmt::format("{:06o}", sum));
  header[at_sum + 6] = '\0';
  return header;
}

}  // namespace

std::string tar_of(std::span<const PackedFile> files) {
  std::string tar;
  for (const PackedFile& file : files) {
    tar += header_of(file);
    tar += file.bytes;
    tar.resize((tar.size() + block - 1) / block * block);
  }
  tar.resize(tar.size() + 2 * block);
  return tar;
}

}  // namespace sunder
