// SPDX-License-Identifier: MIT
// The files of the built page, in memory: no request opens a file.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "topology/base/finding.hpp"

namespace sunder {

/// A file of the page as it is sent.
struct PageFile {
  std::string bytes;
  std::string type;  ///< its MIME type
};

/// Files by their paths in the folder of the page, "/scenes/bar.msh".
using PageFiles = std::map<std::string, PageFile, std::less<>>;

/// Reads all files below `folder`. Errors: no_page (no index.html), page_too_big (more than 64 MB:
/// `folder` is not that of a page), cannot_open.
Result<PageFiles> read_page(const std::filesystem::path& folder);

/// The file behind a path of a request, of "/" index.html; null where there is none.
const PageFile* find_page_file(const PageFiles& page, std::string_view path);

}  // namespace sunder
