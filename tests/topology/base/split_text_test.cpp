// SPDX-License-Identifier: MIT
#include "topology/base/split_text.hpp"

#include <catch2/catch.hpp>

using sunder::lines_of;
using sunder::split_text;
using Parts = std::vector<std::string_view>;

TEST_CASE("a text is parted at separators, empty parts are kept", "[topology][base]") {
  CHECK(split_text("", ',').empty());
  CHECK(split_text("a", ',') == Parts{"a"});
  CHECK(split_text("a,,b c,", ',') == Parts{"a", "", "b c", ""});
  CHECK(split_text(",", ',') == Parts{"", ""});
}

TEST_CASE("lines have no ends, and none comes behind the last end", "[topology][base]") {
  CHECK(lines_of("").empty());
  CHECK(lines_of("\n") == Parts{""});
  CHECK(lines_of("a\r\n\nb") == Parts{"a", "", "b"});
  CHECK(lines_of("a\nb\n") == Parts{"a", "b"});
}
