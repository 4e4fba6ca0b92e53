// SPDX-License-Identifier: MIT
// Surfaces as text, for tests of `sunder break`.
#pragma once

#include <string>

namespace sunder::test {

/// A cube of 12 triangles from 0 to 1; `open`: without two of them.
inline std::string cube_off(bool open = false) {
  std::string text = open ? "OFF\n8 10 0\n" : "OFF\n8 12 0\n";
  text += "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n";
  text +=
      "3 0 2 1\n3 0 3 2\n3 4 5 6\n3 4 6 7\n3 0 1 5\n3 0 5 4\n3 1 2 6\n3 1 6 5\n3 2 3 7\n3 2 7 6\n";
  if (!open) text += "3 3 0 4\n3 3 4 7\n";
  return text;
}

/// Two tetrahedra of faces that go through each other.
inline std::string crossing_off() {
  return "OFF\n8 8 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0.2 0.2 -0.5\n1.2 0.2 -0.5\n0.2 1.2 -0.5\n0.2 "
         "0.2 "
         "0.5\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n3 4 6 5\n3 4 5 7\n3 5 6 7\n3 4 7 6\n";
}

}  // namespace sunder::test
