// SPDX-License-Identifier: MIT
// Headers of ustar, and zlib's gzip.
#include "apps/bench/suite/tar_gz.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
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

std::string gzip(std::string& bytes) {
  z_stream stream = {};
  constexpr int with_gzip_header = 16;
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, MAX_WBITS + with_gzip_header, 8,
                   Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::bad_alloc();
  }
  std::string packed;
  std::array<char, 1 << 16> buffer;
  // avail_in has 32 bits.
  constexpr std::size_t most = 1 << 30;
  std::size_t at = 0;
  for (int status = Z_OK; status != Z_STREAM_END;) {
    if (stream.avail_in == 0 && at < bytes.size()) {
      stream.next_in = reinterpret_cast<Bytef*>(bytes.data() + at);
      stream.avail_in = static_cast<uInt>(std::min(most, bytes.size() - at));
      at += stream.avail_in;
    }
    stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
    stream.avail_out = buffer.size();
    status = deflate(&stream, at == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
    packed.append(buffer.data(), buffer.size() - stream.avail_out);
  }
  deflateEnd(&stream);
  return packed;
}

}  // namespace

std::string tar_gz(std::span<const PackedFile> files) {
  std::string tar;
  for (const PackedFile& file : files) {
    tar += header_of(file);
    tar += file.bytes;
    tar.resize((tar.size() + block - 1) / block * block);
  }
  tar.resize(tar.size() + 2 * block);
  return gzip(tar);
}

}  // namespace sunder
