// SPDX-License-Identifier: MIT
// A box of tetrahedra written and read in every format, version and encoding, with times.
#include "apps/bench/bench_formats.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/bench/clock.hpp"
#include "apps/scene/json_text.hpp"
#include "apps/scene/words.hpp"
#include "apps/sunder/telling.hpp"
#include "topology/io/files/output_file.hpp"
#include "topology/io/files/printing.hpp"
#include "topology/io/format_traits.hpp"
#include "topology/io/mesh_file.hpp"

namespace sunder {
namespace {

constexpr const char* formats_footer = R"(
The body is a box of 6 N^3 tetrahedra with two regions and coordinates of 17 digits. Surfaces are
those of its boundary. Times are medians over the runs, in milliseconds on the wall. Writing
is write_file_mesh from memory to a whole file, not flushed to the disk. Reading is read_file_mesh.

Exit codes: 0 done, 2 usage, 4 a file was not written or not read again.

Examples:
  sunder bench formats
  sunder bench formats --cells 20 --runs 9 --keep /tmp/box --json
)";

struct Settings : Telling {
  std::uint32_t cells = 41;
  int runs = 5;
  std::filesystem::path keep;
};

/// The corners of a cube's tetrahedron: from one end of a diagonal to the other, one axis a step.
std::array<std::uint32_t, 4> path_corners(std::uint32_t first, std::array<std::uint32_t, 3> steps) {
  const std::uint32_t second = first + steps[0], third = second + steps[1];
  return {first, second, third, third + steps[2]};
}

/// 6 `cells`^3 tetrahedra; region 1 below half the height, 2 above.
FileMesh box(std::uint32_t cells) {
  FileMesh mesh;
  const std::uint32_t side = cells + 1;
  for (std::uint32_t i = 0; i < side; ++i) {
    for (std::uint32_t j = 0; j < side; ++j) {
      for (std::uint32_t k = 0; k < side; ++k) mesh.points.push_back({i / 3., j / 7., k / 9.});
    }
  }
  const std::array<std::uint32_t, 3> e{side * side, side, 1};
  for (std::uint32_t i = 0; i < cells; ++i) {
    for (std::uint32_t j = 0; j < cells; ++j) {
      for (std::uint32_t k = 0; k < cells; ++k) {
        const std::uint32_t first = i * e[0] + j * e[1] + k;
        auto& all = mesh.tetrahedra.corners;
        for (int a = 0; a < 3; ++a) {
          const std::uint32_t x = e[a], y = e[(a + 1) % 3], z = e[(a + 2) % 3];
          all.push_back(path_corners(first, {x, y, z}));
          all.push_back(path_corners(first, {y, x, z}));
          std::swap(all.back()[2], all.back()[3]);  // the mirror image, turned outward again
        }
        mesh.tetrahedra.region.insert(mesh.tetrahedra.region.end(), 6, 2 * i < cells ? 1 : 2);
      }
    }
  }
  return mesh;
}

struct Row {
  const FormatTraits* format;
  std::string version;
  Encoding encoding;
  bool pack;
  std::string file;
  std::uintmax_t bytes = 0;
  double write_ms = 0;
  double read_ms = 0;
};

std::string_view encoding_word(Encoding e) {
  constexpr std::string_view words[] = {"text", "binary", "base64"};
  return words[static_cast<std::size_t>(e)];
}

std::vector<Row> all_rows() {
  std::vector<Row> rows;
  for (const FormatTraits& t : format_traits()) {
    std::vector<std::string> versions(t.versions.begin(), t.versions.end());
    if (versions.empty()) versions.emplace_back();
    for (const std::string& version : versions) {
      for (const Encoding e : t.encodings) {
        if (t.format == MeshFormat::msh && version == "1" && e != Encoding::text) continue;
        for (const bool pack : {false, true}) {
          if (pack && (!t.packs || e == Encoding::text)) continue;
          const std::string file = fmt::format("{}{}{}{}", encoding_word(e), pack ? "_zlib" : "",
                                               version, t.extensions[0]);
          rows.push_back({&t, version, e, pack, file});
        }
      }
    }
  }
  return rows;
}

/// Fills a row's figures. Gives the findings of a write or read that failed, else none.
std::vector<Finding> measure(Row& row, const FileMesh& mesh, const Settings& settings) {
  const std::filesystem::path path = settings.keep / row.file;
  std::vector<double> write_us, read_us;
  for (int run = 0; run < settings.runs; ++run) {
    const double begin = wall_us();
    std::vector<Finding> findings =
        write_file_mesh(path, mesh, {row.format->format, row.version, row.encoding, row.pack});
    const double written = wall_us();
    if (has_error(findings)) return findings;
    const Result<FileMesh> back = read_file_mesh(path);
    const double read = wall_us();
    if (!back) return back.findings;
    write_us.push_back(written - begin);
    read_us.push_back(read - written);
  }
  // A mesh may be several files: TetGen's have one stem.
  row.bytes = 0;
  for (const std::string_view extension : row.format->extensions) {
    std::filesystem::path file = path;
    std::error_code is_absent;
    const auto bytes = std::filesystem::file_size(file.replace_extension(extension), is_absent);
    if (!is_absent) row.bytes += bytes;
  }
  row.write_ms = median(write_us) / 1000;
  row.read_ms = median(read_us) / 1000;
  return {};
}

void print_rows(const FileMesh& mesh, const std::vector<Row>& rows, bool as_json) {
  if (as_json) {
    nlohmann::ordered_json json{{"tetrahedra", mesh.tetrahedra.corners.size()},
                                {"points", mesh.points.size()},
                                {"formats", nlohmann::ordered_json::array()}};
    for (const Row& row : rows) {
      json["formats"].push_back({{"format", row.format->name},
                                 {"version", row.version},
                                 {"encoding", encoding_word(row.encoding)},
                                 {"zlib", row.pack},
                                 {"file", row.file},
                                 {"bytes", row.bytes},
                                 {"write_ms", row.write_ms},
                                 {"read_ms", row.read_ms}});
    }
    print_json(json);
    return;
  }
  print("{} tetrahedra, {} points\n", mesh.tetrahedra.corners.size(), mesh.points.size());
  print("{:<10} {:>7} {:<12} {:>8} {:>9} {:>8}\n", "format", "version", "encoding", "MB",
        "write ms", "read ms");
  for (const Row& row : rows) {
    print("{:<10} {:>7} {:<12} {:>8.1f} {:>9.1f} {:>8.1f}\n", row.format->name, row.version,
          fmt::format("{}{}", encoding_word(row.encoding), row.pack ? ", zlib" : ""),
          1e-6 * static_cast<double>(row.bytes), row.write_ms, row.read_ms);
  }
}

ExitCode run_formats_bench(Settings settings) {
  const bool is_kept = !settings.keep.empty();
  std::error_code failure;
  if (!is_kept) {
    settings.keep = std::filesystem::temp_directory_path() /
                    fmt::format("sunder-formats-{}", static_cast<long>(getpid()));
  }
  if (const std::optional<Finding> finding = make_folder(settings.keep)) {
    tell_beside({*finding}, settings);
    return ExitCode::not_written;
  }
  const FileMesh mesh = box(settings.cells);
  std::vector<Row> rows = all_rows();
  std::vector<Finding> findings;
  for (Row& row : rows) {
    remark(row.file + " ...\n", settings);
    findings = measure(row, mesh, settings);
    if (!findings.empty()) break;
  }
  if (!is_kept) std::filesystem::remove_all(settings.keep, failure);
  tell_beside(findings, settings);
  if (!findings.empty()) return ExitCode::not_written;
  print_rows(mesh, rows, settings.json);
  return ExitCode::fine;
}

}  // namespace

void add_formats_command(CLI::App& bench, ExitCode& exit_code) {
  const auto settings = std::make_shared<Settings>();
  CLI::App* command =
      bench.add_subcommand("formats", "How fast each mesh format is written and read");
  command->add_option("--cells", settings->cells, "Cubes along the box's edge (default 41)")
      ->type_name("N")
      ->check(CLI::Range(1, 400).description(""));
  command->add_option("--runs", settings->runs, "Runs to take medians over (default 5)")
      ->type_name("N")
      ->check(CLI::Range(1, 1000).description(""));
  command->add_option("--keep", settings->keep, "Leave the files in this folder")
      ->type_name("FOLDER");
  add_quiet_flag(*command, *settings);
  command->add_flag("--json", settings->json, "Print JSON instead of the table");
  command->footer(formats_footer);
  command->callback([=, &exit_code] { exit_code = run_formats_bench(*settings); });
}

}  // namespace sunder
