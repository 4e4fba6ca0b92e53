// SPDX-License-Identifier: MIT
// Shared by the tests of mesh files: small meshes, folders of their own, a VTU encoder.
#pragma once

#include <bit>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/folder.hpp"
#include "topology/io/mesh_file.hpp"

namespace sunder::test {

/// A file of tests/topology/io/data.
std::filesystem::path sample(std::string_view name);

/// Two tetrahedra on one face, regions 2 and 5, coordinates that need all 17 digits.
TetMesh two_tetrahedra();

/// Severity, code and line of every finding: "error wrong_count 12".
std::string summary(const std::vector<Finding>& findings);

/// The mesh in the text of a file called `name`; fails the test where it cannot be read.
FileMesh read_whole(const std::string& text, const std::string& name);

/// Equal in every bit and in every list.
bool identical(const TetMesh& a, const TetMesh& b);

/// Sum of |volumes|, m^3.
double volume(const TetMesh& mesh);

/// How a VTU file is to be encoded.
struct VtuVariant {
  std::string format = "ascii";  // "ascii", "binary", "appended"
  std::string appended_encoding = "raw";
  bool zlib = false;
  int header_bytes = 4;
  std::endian order = std::endian::little;
  /// base64 of header and data as one stream (meshio) or as two (VTK's compressed data).
  bool one_stream = true;
};

std::string to_string(const VtuVariant& variant);

/// A whole VTU file of `mesh`, by code that shares nothing with the library's.
std::string encode_vtu(const TetMesh& mesh, const VtuVariant& variant);

/// The number with as many digits as Nastran's sixteen characters hold: a point always, no e.
double in_sixteen_characters(double x);

}  // namespace sunder::test
