// SPDX-License-Identifier: MIT
// Programs outside the repository that a test needs; without them it is skipped, never failed.
#pragma once

#include <catch2/catch.hpp>
#include <cstdlib>
#include <string>

namespace sunder::test {

/// Whether `program` is on the PATH. Where it is not, says so in the words by which CTest counts
/// the test as skipped (`sunder_tests` in tests/CMakeLists.txt); the test then returns.
inline bool has_program(const std::string& program) {
  if (std::system(("command -v " + program + " > /dev/null 2>&1").c_str()) == 0) return true;
  WARN("skipped: " << program << " is not installed");
  return false;
}

}  // namespace sunder::test
