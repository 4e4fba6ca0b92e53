// SPDX-License-Identifier: MIT
// Packing and unpacking gzip through zlib, member by member.
#include "topology/io/files/gzip.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <memory>

#include "topology/base/limits.hpp"
#include "topology/io/text/scan.hpp"

namespace sunder::io {
namespace {

[[noreturn]] void fail_gzip(std::string_view code, std::string text) {
  throw ReadFailure{{.code = std::string(code),
                     .text = std::move(text),
                     .remedy = "the file is damaged: copy or pack it again"}};
}

[[noreturn]] void fail_too_large(std::size_t packed) {
  throw ReadFailure{
      {.code = "too_large",
       .text = fmt::format("{} packed bytes unfold to more than {}, the limit unpacked_bytes",
                           packed, limits().unpacked_bytes),
       .remedy = "unpack it first if you trust it, or look at SUNDER_LIMITS and --confined"}};
}

}  // namespace

bool is_gzip(std::string_view bytes) { return bytes.substr(0, 2) == "\x1f\x8b"; }

std::string unpacked(std::string_view bytes) {
  z_stream stream{};
  constexpr int gzip_only = 16 + MAX_WBITS;
  if (inflateInit2(&stream, gzip_only) != Z_OK) throw std::bad_alloc();
  const std::unique_ptr<z_stream, int (*)(z_stream*)> owner(&stream, &inflateEnd);
  std::string out;
  std::size_t filled = 0, taken = 0;
  constexpr std::size_t most = std::size_t{1} << 30;  // zlib counts in 32 bits
  while (true) {
    if (filled == out.size()) {
      if (filled > limits().unpacked_bytes) fail_too_large(bytes.size());
      // One byte beyond the limit shows that there is more.
      out.resize(std::min<std::size_t>(std::max<std::size_t>(4096, 2 * filled),
                                       limits().unpacked_bytes + 1));
    }
    const std::size_t in = std::min(most, bytes.size() - taken);
    const std::size_t room = std::min(most, out.size() - filled);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + taken));
    stream.avail_in = static_cast<uInt>(in);
    stream.next_out = reinterpret_cast<Bytef*>(out.data() + filled);
    stream.avail_out = static_cast<uInt>(room);
    const int status = inflate(&stream, Z_NO_FLUSH);
    taken += in - stream.avail_in;
    filled += room - stream.avail_out;
    if (status == Z_STREAM_END) {
      if (!is_gzip(bytes.substr(taken))) break;  // padding behind the last member is passed over
      inflateReset(&stream);
    } else if (status == Z_BUF_ERROR ||
               (status == Z_OK && taken == bytes.size() && stream.avail_out > 0)) {
      fail_gzip("truncated_file", fmt::format("the packed data end after {} bytes, {} unpacked",
                                              bytes.size(), filled));
    } else if (status != Z_OK) {
      fail_gzip("bad_gzip", fmt::format("the packed data are wrong near byte {}: {}", taken,
                                        stream.msg == nullptr ? zError(status) : stream.msg));
    }
  }
  if (filled > limits().unpacked_bytes) fail_too_large(bytes.size());
  out.resize(filled);
  return out;
}

std::string packed(std::span<const std::string_view> parts) {
  z_stream stream{};
  constexpr int gzip = 16 + MAX_WBITS, memory = 8;
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, gzip, memory, Z_DEFAULT_STRATEGY) !=
      Z_OK) {
    throw std::bad_alloc();
  }
  const std::unique_ptr<z_stream, int (*)(z_stream*)> owner(&stream, &deflateEnd);
  std::string out;
  std::size_t filled = 0;
  constexpr std::size_t most = std::size_t{1} << 30;  // zlib counts in 32 bits
  // Takes all input, and with Z_FINISH gives all output.
  const auto push = [&](std::string_view text, int flush) {
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
    stream.avail_in = static_cast<uInt>(text.size());
    int status = Z_OK;
    do {
      if (filled == out.size()) out.resize(std::max<std::size_t>(4096, 2 * filled));
      const std::size_t room = std::min(most, out.size() - filled);
      stream.next_out = reinterpret_cast<Bytef*>(out.data() + filled);
      stream.avail_out = static_cast<uInt>(room);
      status = deflate(&stream, flush);
      filled += room - stream.avail_out;
    } while (flush == Z_FINISH ? status != Z_STREAM_END : stream.avail_in > 0);
  };
  for (std::string_view part : parts) {
    for (; !part.empty(); part.remove_prefix(std::min(most, part.size()))) {
      push(part.substr(0, most), Z_NO_FLUSH);
    }
  }
  push({}, Z_FINISH);
  out.resize(filled);
  return out;
}

}  // namespace sunder::io
