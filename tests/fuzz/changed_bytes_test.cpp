// SPDX-License-Identifier: MIT
// Right inputs of a run with random bytes changed, held to the promises: for a second in the tests,
// for SUNDER_FUZZ_SECONDS each where that is set. Inputs that once broke a promise are in found/.
#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "run_laws.hpp"

using namespace sunder::test;

namespace {

/// Changes of the kinds that find things: bits, digits, whole numbers, parts left out, doubled,
/// moved.
std::string changed(std::string bytes, std::mt19937_64& random) {
  for (std::uint64_t n = 1 + random() % 3; n > 0 && !bytes.empty(); --n) {
    const std::size_t at = random() % bytes.size();
    const std::size_t size = std::min<std::size_t>(1 + random() % 24, bytes.size() - at);
    switch (random() % 9) {
      case 0:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
        break;
      case 1:
        bytes[at] = static_cast<char>(random());
        break;
      case 2:
        bytes.erase(at, size);
        break;
      case 3:
        bytes.insert(random() % bytes.size(), bytes.substr(at, size));
        break;
      case 4: {
        constexpr const char* words[] = {
            "-1",   "0",  "1e308", "1e-308",          "4294967295",       "-0.0",
            "null", "[]", "{}",    "\"\\u001b[31m\"", "9007199254740993", "true"};
        bytes.insert(at, words[random() % std::size(words)]);
        break;
      }
      case 5: {
        constexpr unsigned char numbers[][8] = {{0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff},
                                                {0, 0, 0, 0, 0, 0, 0xf8, 0x7f},
                                                {0, 0, 0, 0, 0, 0, 0xf0, 0x7f},
                                                {0xff, 0xff, 0xff, 0x7f, 0, 0, 0, 0},
                                                {0, 0, 0, 0, 0, 0, 0, 0},
                                                {1, 0, 0, 0, 0, 0, 0, 0}};
        const auto& number = numbers[random() % std::size(numbers)];
        for (std::size_t i = 0; i < 8 && at + i < bytes.size(); ++i) {
          bytes[at + i] = static_cast<char>(number[i]);
        }
        break;
      }
      case 6: {
        // A digit, or a number in the text, becomes another.
        const std::size_t digit = bytes.find_first_of("0123456789", at);
        if (digit != std::string::npos) bytes[digit] = static_cast<char>('0' + random() % 10);
        break;
      }
      case 7: {
        // A whole number of a text, with its sign, point and exponent, becomes an extreme one.
        constexpr const char* extremes[] = {"1e17",       "1e308", "-1e300", "1e-300", "1e16",
                                            "1e-22",      "1e20",  "-1e20",  "1e-30",  "5e-324",
                                            "4294967296", "-1e17", "0.1e-6", "1e9"};
        const std::size_t begin = bytes.find_first_of("0123456789", at);
        if (begin == std::string::npos) break;
        const std::size_t end = bytes.find_first_not_of("0123456789.eE+-", begin);
        const std::size_t length = (end == std::string::npos ? bytes.size() : end) - begin;
        bytes.replace(begin, length, extremes[random() % std::size(extremes)]);
        break;
      }
      default:
        bytes.resize(at);
    }
  }
  return bytes;
}

void keep(const FuzzTarget& target, const std::string& bytes) {
  std::ofstream("found-" + target.name, std::ios::binary) << bytes;
}

}  // namespace

TEST_CASE("changed scenes, states, logs, checkpoints and answers are answered", "[fuzz][changed]") {
  const char* const wanted = std::getenv("SUNDER_FUZZ_SECONDS");
  const char* const only = std::getenv("SUNDER_FUZZ_TARGET");
  const std::chrono::duration<double> time(wanted ? std::atof(wanted) : 1.0);
  for (const FuzzTarget& target : run_targets()) {
    if (only && target.name != only) continue;
    const std::string seed = seed_of(target);
    REQUIRE_FALSE(seed.empty());
    INFO(target.name);
    CHECK(target.broken_law(target, seed) == "");
    if (target.name == "log") CHECK(seed.find("\"fan\":") != std::string::npos);  // there are fans
    std::mt19937_64 random(wanted ? std::random_device{}() : 21);
    const auto start = std::chrono::steady_clock::now();
    std::size_t runs = 0;
    for (; std::chrono::steady_clock::now() - start < time; ++runs) {
      const std::string bytes = changed(seed, random);
      keep(target, bytes);
      const std::string broken = target.broken_law(target, bytes);
      INFO(bytes.substr(0, 2000));
      REQUIRE(broken == "");
    }
    std::filesystem::remove("found-" + target.name);
    if (wanted) WARN(target.name << ": " << runs << " inputs in " << time.count() << " s");
  }
}

TEST_CASE("inputs of runs that once broke a promise are answered", "[fuzz][changed]") {
  for (const FuzzTarget& target : run_targets()) {
    const auto folder = std::filesystem::path(SUNDER_FUZZ_FOLDER) / "found" / target.name;
    if (!std::filesystem::is_directory(folder)) continue;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      std::ifstream in(entry.path(), std::ios::binary);
      const std::string bytes{std::istreambuf_iterator<char>(in), {}};
      INFO(entry.path().string());
      CHECK(target.broken_law(target, bytes) == "");
    }
  }
}
