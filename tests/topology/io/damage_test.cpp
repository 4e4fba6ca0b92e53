// SPDX-License-Identifier: MIT
// Damaged files of every kind: an answer or an error with words, never a crash or a hang.
#include <catch2/catch.hpp>
#include <random>

#include "tests/support/io_support.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

const char* const samples[] = {
    "gmsh_22.msh",     "gmsh_41.msh", "gmsh_41_all.msh", "gmsh_41_binary.msh", "gmsh_22_binary.msh",
    "gmsh_40.msh",     "gmsh.vtk",    "gmsh.mesh",       "meshio_ascii.vtu",   "meshio_plain.vtu",
    "meshio_zlib.vtu", "gmsh.stl",    "gmsh_binary.stl", "meshio.off",         "openscad.off",
    "meshio.obj",      "assimp.obj",  "meshio.ply",      "meshio_binary.ply",  "assimp_binary.ply"};

/// The same of surfaces, which are no bodies: the mesh with all that its file holds.
void check_surface(const std::string& bytes) {
  const Result<FileMesh> mesh = read_file_mesh(bytes, "damaged");
  REQUIRE(mesh.value.has_value() != has_error(mesh.findings));
  if (!mesh) return;
  for (const auto& t : mesh->triangles.corners) {
    for (const auto p : t) REQUIRE(p < mesh->points.size());
  }
}

/// A value that keeps its promise, or an error with its cause, place and remedy.
void check_answer(const Result<TetMesh>& mesh) {
  if (mesh) {
    CHECK_FALSE(has_error(mesh.findings));
    CHECK_FALSE(mesh->tetrahedra.empty());
    for (const auto& t : mesh->tetrahedra) {
      for (const auto p : t) REQUIRE(p < mesh->points.size());
    }
    REQUIRE((mesh->region.empty() || mesh->region.size() == mesh->tetrahedra.size()));
  } else {
    REQUIRE(has_error(mesh.findings));
  }
  for (const Finding& f : mesh.findings) {
    CHECK_FALSE(f.code.empty());
    CHECK_FALSE(f.text.empty());
    CHECK_FALSE(f.remedy.empty());
    CHECK(f.file == "damaged");
  }
}

}  // namespace

TEST_CASE("a file cut at any place is answered", "[io][damage]") {
  for (const char* name : samples) {
    const std::string whole = bytes_of(sample(name));
    for (std::size_t size = 0; size < whole.size(); size += 1 + size / 300) {
      INFO(name << " cut after " << size << " bytes");
      check_answer(read_mesh(whole.substr(0, size), "damaged"));
      check_surface(whole.substr(0, size));
    }
  }
  TetMesh body = two_tetrahedra();
  for (const bool zlib : {false, true}) {
    for (const char* encoding : {"raw", "base64"}) {
      const std::string whole = encode_vtu(body, {"appended", encoding, zlib, 8});
      for (std::size_t size = 0; size < whole.size(); ++size) {
        check_answer(read_mesh(whole.substr(0, size), "damaged"));
      }
    }
  }
}

TEST_CASE("a binary file cut at any place is answered", "[io][damage]") {
  const Folder folder;
  for (const char* name : {"body.meshb", "body.vtk"}) {
    REQUIRE_FALSE(has_error(write_mesh(folder.path() / name, two_tetrahedra())));
    const std::string whole = bytes_of(folder.path() / name);
    for (std::size_t size = 0; size < whole.size(); ++size) {
      INFO(name << " cut after " << size << " bytes");
      check_answer(read_mesh(whole.substr(0, size), "damaged"));
    }
  }
}

TEST_CASE("a file with bytes changed at random is answered", "[io][damage]") {
  const unsigned seed = Catch::rngSeed() != 0 ? Catch::rngSeed() : 20261121;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  const auto below = [&](std::size_t n) { return random() % n; };
  std::vector<std::string> files;
  for (const char* name : samples) files.push_back(bytes_of(sample(name)));
  files.push_back(encode_vtu(two_tetrahedra(), {"appended", "raw", true, 4}));
  files.push_back(encode_vtu(two_tetrahedra(), {"appended", "raw", false, 8}));
  constexpr const char* pieces[] = {"99999999999", "-1", "nan",        "$", "<",
                                    "\"",          "",   "4294967295", "\n"};
  for (int round = 0; round < 4000; ++round) {
    std::string file = files[below(files.size())];
    for (std::size_t n = 1 + below(3); n > 0; --n) {
      const std::size_t at = below(file.size());
      if (below(2) == 0) {
        file[at] = static_cast<char>(below(256));
      } else {
        file.replace(at, below(4), pieces[below(std::size(pieces))]);
      }
    }
    INFO("round " << round);
    check_answer(read_mesh(file, "damaged"));
    check_surface(file);
  }
}
