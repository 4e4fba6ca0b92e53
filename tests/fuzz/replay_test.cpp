// SPDX-License-Identifier: MIT
// The fuzzers' corpus, and their former findings, held to the same promises in every build.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "reader_laws.hpp"

using namespace sunder::test;

namespace {

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("what the fuzzers reach and what they found is answered", "[fuzz]") {
  for (const FuzzTarget& target : fuzz_targets()) {
    for (const char* kind : {"corpus", "found"}) {
      const auto folder = std::filesystem::path(SUNDER_FUZZ_FOLDER) / kind / target.name;
      if (!std::filesystem::is_directory(folder)) continue;
      std::vector<std::filesystem::path> files;
      for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        files.push_back(entry.path());
      }
      std::ranges::sort(files);
      for (const auto& file : files) {
        INFO(file.string());
        CHECK(target.broken_law(target, bytes_of(file)) == "");
      }
    }
  }
}
