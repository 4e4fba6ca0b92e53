// SPDX-License-Identifier: MIT
#include "topology/io/text/scan.hpp"

#include <catch2/catch.hpp>

using namespace sunder::io;

namespace {

std::string failure_of(std::string_view text) {
  Scanner s{text};
  try {
    read_number<std::int32_t>(s, "a number");
  } catch (const ReadFailure& failure) {
    return failure.finding.code;
  }
  return "";
}

}  // namespace

TEST_CASE("words and numbers are read over blanks and line ends of any kind", "[io][scan]") {
  Scanner s{"  alpha\r\n\t+12 -0.5e3 rest of it \nnext"};
  CHECK(next_word(s) == "alpha");
  CHECK(read_number<int>(s, "a number") == 12);
  CHECK(read_number<double>(s, "a number") == -500);
  CHECK(rest_of_line(s) == "rest of it");
  CHECK(line_of(s.text, s.at) == 3);
  CHECK(peek_word(s) == "next");
  CHECK(next_word(s) == "next");
  CHECK(next_word(s).empty());
}

TEST_CASE("what is no number says why", "[io][scan]") {
  CHECK(failure_of("12").empty());
  CHECK(failure_of("12x") == "bad_number");
  CHECK(failure_of("+-1") == "bad_number");
  CHECK(failure_of("3000000000") == "number_out_of_range");
  CHECK(failure_of("  ") == "truncated_file");
}

TEST_CASE("a count that the rest of the file cannot hold is refused", "[io][scan]") {
  Scanner fits{"3 a b c"};
  CHECK(read_count(fits, "nodes", 2) == 3);
  Scanner large{"4000000000 a b c"};
  CHECK_THROWS_AS(read_count(large, "nodes", 2), ReadFailure);
}
