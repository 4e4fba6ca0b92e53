// SPDX-License-Identifier: MIT
#include "apps/sunder/view/page_files.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <system_error>

namespace sunder {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t most_bytes = 64'000'000;

std::string type_of(const fs::path& file) {
  const fs::path suffix = file.extension();
  if (suffix == ".html") return "text/html; charset=utf-8";
  if (suffix == ".js") return "text/javascript; charset=utf-8";
  if (suffix == ".css") return "text/css; charset=utf-8";
  if (suffix == ".json") return "application/json";
  if (suffix == ".wasm") return "application/wasm";
  return suffix == ".txt" ? "text/plain; charset=utf-8" : "application/octet-stream";
}

Finding no_page(const fs::path& folder) {
  return {.code = "no_page",
          .text = fmt::format("there is no page in {}", folder.string()),
          .remedy =
              "build the page with `./bootstrap all` (needs npm), or name the folder of a "
              "built page with --page"};
}

Finding too_big(const fs::path& folder) {
  return {.code = "page_too_big",
          .text = fmt::format("the files below {} have more than {} bytes", folder.string(),
                              most_bytes),
          .remedy = "name the folder of a built page alone with --page"};
}

Finding unreadable(const fs::path& path, const std::string& why) {
  return {.code = "cannot_open",
          .text = fmt::format("a file of the page cannot be read: {}", why),
          .remedy = "make it readable, or build the page again",
          .file = path.string()};
}

/// Reads one file of the page; `bytes_left` of the page may still come.
std::vector<Finding> add_file(PageFiles& page, const fs::path& folder, const fs::path& path,
                              std::uintmax_t& bytes_left) {
  std::error_code wrong;
  const std::uintmax_t size = fs::file_size(path, wrong);
  if (wrong) return {unreadable(path, wrong.message())};
  if (size > bytes_left) return {too_big(folder)};
  bytes_left -= size;
  std::ifstream in(path, std::ios::binary);
  std::string bytes(std::istreambuf_iterator<char>(in), {});
  if (!in || bytes.size() != size) return {unreadable(path, "it was cut short")};
  page["/" + path.lexically_relative(folder).generic_string()] = {std::move(bytes), type_of(path)};
  return {};
}

}  // namespace

Result<PageFiles> read_page(const fs::path& folder) {
  std::error_code wrong;
  if (!fs::is_regular_file(folder / "index.html", wrong)) return no_page(folder);
  Result<PageFiles> page{PageFiles()};
  std::uintmax_t bytes_left = most_bytes;
  fs::recursive_directory_iterator entry(folder, wrong);
  for (; !wrong && entry != fs::recursive_directory_iterator(); entry.increment(wrong)) {
    std::error_code none;
    if (!entry->is_regular_file(none)) continue;
    page.findings = add_file(*page, folder, entry->path(), bytes_left);
    if (has_error(page.findings)) break;
  }
  if (wrong) page.findings.push_back(unreadable(folder, wrong.message()));
  if (has_error(page.findings)) page.value.reset();
  return page;
}

const PageFile* find_page_file(const PageFiles& page, std::string_view path) {
  const auto file = page.find(path == "/" ? "/index.html" : path);
  return file == page.end() ? nullptr : &file->second;
}

}  // namespace sunder
