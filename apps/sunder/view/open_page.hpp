// SPDX-License-Identifier: MIT
// A browser is led to the page and its token, which no other user of the machine may see.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace sunder {

/// Starts a browser (xdg-open) on `url` where there is a display, by way of a file that leads on to
/// it: every user can read the arguments of every process, and these hold the path of that file
/// alone. A code in the address that is good for one use would be read there too, and used before
/// the browser comes to it. The file has mode 0600 and lies in a folder of mode 0700.
/// Gives the path of the file, for `remove_way_in`; nothing where no browser was started.
std::optional<std::filesystem::path> open_page(const std::string& url);

/// Takes the file and its folder away.
void remove_way_in(const std::filesystem::path& file);

}  // namespace sunder
