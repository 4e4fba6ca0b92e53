// SPDX-License-Identifier: MIT
// Text for people moves no terminal, and streams that take nothing end no program.
#include "topology/io/files/printing.hpp"

#include <catch2/catch.hpp>
#include <cstdio>
#include <random>
#include <string>

using namespace sunder;

TEST_CASE("control characters are escaped, all other text stays", "[io][printing]") {
  const std::string text = "a 12 \xc3\xa4 \xe2\x82\xac \xf0\x9f\x98\x80 ~";
  CHECK(plain_line(text) == text);
  CHECK(plain_line("a\x1b[31m\r\n\tb\x7f") == "a\\x1b[31m\\x0d\\x0a\\x09b\\x7f");
  CHECK(plain_lines("a\x1b\n\tb\r") == "a\\x1b\n\tb\\x0d");
  CHECK(plain_line("\xc2\x9b") == "\\xc2\\x9b");           // CSI in one character
  CHECK(plain_line("\xe2\x80\xae") == "\\xe2\\x80\\xae");  // right to left from here
  CHECK(plain_line("\xff\xc3") == "\\xff\\xc3");           // no UTF-8
  CHECK(plain_line("\xc0\xaf\xed\xa0\x80\xf4\x90\x80\x80") ==
        "\\xc0\\xaf\\xed\\xa0\\x80\\xf4\\x90\\x80\\x80");  // too long, half a pair, too large
  CHECK(plain_line(std::string("a\0b", 3)) == "a\\x00b");
}

TEST_CASE("random bytes come out as one line of printable text", "[io][printing]") {
  std::mt19937 random(5);
  for (int k = 0; k < 2000; ++k) {
    std::string bytes(random() % 20, '\0');
    for (char& c : bytes) c = static_cast<char>(random());
    for (const char c : plain_line(bytes)) {
      const auto byte = static_cast<unsigned char>(c);
      REQUIRE((byte >= ' ' && byte != 0x7f));
    }
    CHECK(plain_line(plain_line(bytes)) == plain_line(bytes));
  }
}

TEST_CASE("JSON keeps its meaning where it is escaped", "[io][printing]") {
  CHECK(json_escaped("{\"a\x7f\": \"\xc2\x9b\xe2\x80\xae\xc3\xa4\"}\n") ==
        "{\"a\\u007f\": \"\\u009b\\u202e\xc3\xa4\"}\n");
}

TEST_CASE("a stream that takes nothing throws nothing", "[io][printing]") {
  for (const char* mode : {"r", "w"}) {
    std::FILE* const full = std::fopen("/dev/full", mode);
    REQUIRE(full != nullptr);
    std::setvbuf(full, nullptr, _IONBF, 0);
    CHECK_NOTHROW(print(full, "{} {}\n", 1, "two"));
    CHECK(std::ferror(full) != 0);
    std::fclose(full);
  }
}
