// SPDX-License-Identifier: MIT
// Files of the archive, in the order of their names, and their checksums.
#include "apps/bench/suite/suite_export.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>

#include "apps/bench/suite/tar.hpp"
#include "apps/scene/words.hpp"
#include "apps/sunder/telling.hpp"
#include "topology/base/counted.hpp"
#include "topology/io/files/output_file.hpp"
#include "topology/io/files/printing.hpp"
#include "topology/suite/fixtures/fixture_json_write.hpp"
#include "topology/suite/judge/judge_truth.hpp"

namespace sunder {
namespace {

const std::string archive_folder = "sunder-suite/";

/// A file that the archive takes from the source tree unchanged.
struct Source {
  const char* in_tree;
  const char* in_archive;
  bool executable = false;
};
constexpr std::array<Source, 8> sources = {{
    {"apps/bench/suite/export/README.md", "README.md"},
    {"docs/reference/suite.md", "suite.md"},
    {"LICENSE", "LICENSE"},
    {"apps/bench/suite/export/judge.py", "judge.py", true},
    {"tests/topology/suite/adapters/minimal.py", "minimal.py", true},
    {"tests/topology/suite/adapters/minimal.cpp", "minimal.cpp"},
    {"tests/topology/suite/adapters/serve.hpp", "serve.hpp"},
    {"meshes/suite/fixture.schema.json", "fixtures/fixture.schema.json"},
}};

std::optional<std::string> bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(file), {});
}

std::string sha256(const std::string& bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
  unsigned size = 0;
  EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr);
  std::string text;
  for (unsigned i = 0; i < size; ++i) text += fmt::format("{:02x}", digest[i]);
  return text;
}

/// The list of checksums that `sha256sum --check` reads.
PackedFile checksums(const std::vector<PackedFile>& files) {
  PackedFile sums{.name = archive_folder + "SHA256SUMS", .bytes = {}};
  for (const PackedFile& f : files) {
    sums.bytes += fmt::format("{}  {}\n", sha256(f.bytes), f.name.substr(archive_folder.size()));
  }
  return sums;
}

std::string file_name(const suite::Fixture& fixture) {
  std::string name = fixture.name + ".json";
  std::replace(name.begin(), name.end(), '/', '.');
  return name;
}

}  // namespace

ExitCode export_suite(const std::vector<suite::Fixture>& fixtures,
                      const std::filesystem::path& archive) {
  std::vector<PackedFile> files;
  for (const Source& source : sources) {
    const std::filesystem::path path = std::filesystem::path(SUNDER_SOURCE_DIR) / source.in_tree;
    const std::optional<std::string> bytes = bytes_of(path);
    if (!bytes) {
      print(stderr,
            "sunder suite: {} cannot be read: --export needs the source tree that the "
            "program was built from\n",
            path.string());
      return ExitCode::bad_input;
    }
    files.push_back({archive_folder + source.in_archive, *bytes, source.executable});
  }
  for (const suite::Fixture& fixture : fixtures) {
    const suite::Truth truth = suite::truth_of(fixture);
    if (truth.checks.first) {
      const suite::Mismatch& m = *truth.checks.first;
      print(stderr,
            "sunder suite: {} is not true of its body: operation {}: {}: expected {}, "
            "union-find has {}; nothing was written\n",
            fixture.name, m.operation, m.what, m.expected, m.answered);
      return ExitCode::problems;
    }
    files.push_back(
        {archive_folder + "fixtures/" + file_name(fixture), suite::fixture_json(fixture, truth)});
  }
  std::sort(files.begin(), files.end(),
            [](const PackedFile& a, const PackedFile& b) { return a.name < b.name; });
  files.push_back(checksums(files));
  // `write_file` packs files with names that end in .gz.
  if (const auto failure = write_file(archive, tar_of(files))) {
    tell({*failure}, {});
    return ExitCode::not_written;
  }
  print("{}: {}\n", archive.string(), counted(fixtures.size(), "fixture"));
  return ExitCode::fine;
}

}  // namespace sunder
