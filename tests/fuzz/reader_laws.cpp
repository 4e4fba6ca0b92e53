// SPDX-License-Identifier: MIT
// The promises, one function each.
#include "reader_laws.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <vector>

#include "topology/io/face_list.hpp"
#include "topology/io/files/gzip.hpp"
#include "topology/io/format_traits.hpp"
#include "topology/io/formats.hpp"
#include "topology/io/mesh_file.hpp"
#include "topology/io/regions/region_names.hpp"
#include "topology/io/text/scan.hpp"

namespace sunder::test {
namespace {

struct MemoryLaw {
  bool ends = false;
  double largest_share = 0;
};
MemoryLaw memory_law;

/// Empty, or that the work took too much memory for so many bytes.
template <class Work>
std::string excess_memory(std::size_t bytes, Work work) {
  const std::size_t bound = memory_times * bytes + memory_allowance;
  memory_law.ends ? begin_counting(bound, memory_times + 1) : begin_counting();
  work();
  const MemoryCount count = end_counting();
  const std::size_t whole = bound + (memory_times + 1) * count.unfolded;
  const double share = static_cast<double>(count.peak) / static_cast<double>(whole);
  memory_law.largest_share = std::max(memory_law.largest_share, share);
  if (share <= 1) return {};
  return fmt::format("{} bytes of memory for a file of {} ({} unfolded): {} are the bound",
                     count.peak, bytes, count.unfolded, whole);
}

/// Findings that a user can do something with, on a line that the file has.
std::string bad_finding(const std::vector<Finding>& findings, std::string_view bytes) {
  const auto lines = static_cast<std::size_t>(std::ranges::count(bytes, '\n')) + 1;
  for (const Finding& f : findings) {
    const bool is_code = std::ranges::all_of(f.code, [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
    });
    if (f.code.empty() || !is_code) return fmt::format("a finding has the code '{}'", f.code);
    if (f.text.empty()) return fmt::format("{} has no text", f.code);
    if (f.remedy.empty()) return fmt::format("{} has no remedy", f.code);
    if (f.count == 0) return fmt::format("{} has no count", f.code);
    if (f.ids.size() > Finding::max_ids) return fmt::format("{} has too many ids", f.code);
    if (f.line > lines) return fmt::format("{} is on line {} of {}", f.code, f.line, lines);
    if (f.text.size() > 4000) return fmt::format("{} has {} bytes of text", f.code, f.text.size());
    const auto is_control = [](char c) { return static_cast<unsigned char>(c) < ' '; };
    if (std::ranges::any_of(f.text, is_control)) return fmt::format("control bytes in {}", f.text);
  }
  return {};
}

template <class Column>
bool is_whole(const Column& column, std::size_t rows) {
  return column.empty() || column.size() == rows;
}

std::string bad_columns(const std::vector<DataColumn>& columns, std::size_t rows,
                        std::string_view of) {
  for (const DataColumn& c : columns) {
    const std::size_t n = std::visit([](const auto& v) { return v.size(); }, c.values);
    const bool is_long = c.components > 0 && n / c.components == rows && n % c.components == 0;
    if (!is_long) {
      return fmt::format("data '{}' of {} {} hold {} numbers in {} components", c.name, rows, of, n,
                         c.components);
    }
    const bool is_real = c.type == NumberType::float64 || c.type == NumberType::float32;
    if (is_real != (c.values.index() == 0)) return fmt::format("data '{}' of a wrong type", c.name);
  }
  return {};
}

/// The promises of read_file_mesh about its value.
std::string bad_mesh(const FileMesh& mesh) {
  const std::size_t n = mesh.points.size();
  for (const Point& p : mesh.points) {
    for (const double x : p) {
      if (!std::isfinite(x)) return "a coordinate is not finite";
    }
  }
  if (!is_whole(mesh.source_point_id, n)) return "numbers of points of a wrong length";
  if (!is_whole(mesh.point_region, n)) return "regions of points of a wrong length";
  std::string bad = bad_columns(mesh.point_data, n, "points");
  for (const CellKind kind : all_cell_kinds) {
    const CellRows rows = rows_of(mesh, kind);
    const CellColumns& cells = columns_of(mesh, kind);
    for (std::size_t i = 0; i < rows.count; ++i) {
      const auto nodes = rows[i];
      if (kind == CellKind::polygon && nodes.size() < 5) bad = "a polygon of few corners";
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        if (nodes[k] >= n) bad = fmt::format("a node {} of {} points", nodes[k], n);
        if (linear_kind(kind) != CellKind::tetrahedron || k > 3) continue;
        for (std::size_t j = 0; j < k; ++j) {
          if (nodes[j] == nodes[k]) bad = "a tetrahedron repeats a corner";
        }
      }
    }
    if (!is_whole(cells.region, rows.count) || !is_whole(cells.entity, rows.count) ||
        !is_whole(cells.source_id, rows.count)) {
      bad = fmt::format("labels or numbers of {} of a wrong length", traits_of(kind).plural);
    }
    if (bad.empty()) bad = bad_columns(cells.data, rows.count, "cells");
  }
  return bad;
}

bool is_same(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (a != a && b != b);
}

bool are_same(const std::vector<DataColumn>& a, const std::vector<DataColumn>& b) {
  return std::ranges::equal(a, b, [](const DataColumn& x, const DataColumn& y) {
    if (x.name != y.name || x.components != y.components || x.type != y.type) return false;
    if (x.values.index() != y.values.index()) return false;
    if (x.values.index() == 1) return x.values == y.values;
    return std::ranges::equal(std::get<0>(x.values), std::get<0>(y.values), is_same);
  });
}

/// The first part of `a` that is not in `b`; `all`: not only points and corners of tetrahedra.
std::string difference(const FileMesh& a, const FileMesh& b, bool all) {
  const bool same_points =
      std::ranges::equal(a.points, b.points, [](const Point& p, const Point& q) {
        return is_same(p[0], q[0]) && is_same(p[1], q[1]) && is_same(p[2], q[2]);
      });
  if (!same_points) return "points";
  if (a.tetrahedra.corners != b.tetrahedra.corners) return "tetrahedra";
  if (!all) return {};
  if (a.source_point_id != b.source_point_id) return "numbers of points";
  if (a.point_region != b.point_region) return "regions of points";
  if (!are_same(a.point_data, b.point_data)) return "data of points";
  if (a.region_name != b.region_name) return "names";
  std::string found;
  for (const CellKind kind : all_cell_kinds) {
    const CellColumns &x = columns_of(a, kind), &y = columns_of(b, kind);
    const std::string_view what = traits_of(kind).plural;
    const CellRows p = rows_of(a, kind), q = rows_of(b, kind);
    bool same = p.count == q.count;
    for (std::size_t i = 0; same && i < p.count; ++i) same = std::ranges::equal(p[i], q[i]);
    if (!same) found = fmt::format("nodes of {}", what);
    if (x.region != y.region) found = fmt::format("regions of {}", what);
    if (x.entity != y.entity) found = fmt::format("entities of {}", what);
    if (x.source_id != y.source_id) found = fmt::format("numbers of {}", what);
    if (!are_same(x.data, y.data)) found = fmt::format("data of {}", what);
  }
  return found;
}

/// Every version and encoding that a format is written in.
std::vector<WriteOptions> ways_to_write(const FormatTraits& t) {
  std::vector<WriteOptions> ways;
  std::vector<std::string> versions(t.versions.begin(), t.versions.end());
  if (versions.empty()) versions.emplace_back();
  for (const std::string& version : versions) {
    for (const Encoding encoding : t.encodings) {
      const bool is_msh_1 = t.format == MeshFormat::msh && version == "1";
      if (is_msh_1 && encoding != Encoding::text) continue;
      ways.push_back({t.format, version, encoding});
      if (t.packs && encoding != Encoding::text)
        ways.push_back({t.format, version, encoding, true});
    }
  }
  return ways;
}

/// A folder in memory, gone at the end.
struct Folder {
  std::filesystem::path path =
      std::filesystem::path("/dev/shm") / fmt::format("sunder-fuzz-{}", getpid());
  Folder() { std::filesystem::create_directories(path); }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
};

const std::filesystem::path& empty_folder() {
  static const Folder folder;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path)) {
    std::filesystem::remove(entry.path());
  }
  return folder.path;
}

/// The way is chosen by the bytes, so that a file is always judged alike.
std::size_t hash_of(std::string_view bytes) {
  std::uint64_t hash = 14695981039346656037U;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211U;
  return hash ^ hash >> 32;
}

/// Written in its own format and read back: equal, or the losses were announced.
std::string bad_round_trip(const FileMesh& mesh, const FormatTraits& t, std::size_t choice) {
  const std::vector<WriteOptions> ways = ways_to_write(t);
  if (ways.empty()) return {};
  const WriteOptions& way = ways[choice % ways.size()];
  const std::string words =
      fmt::format("{} {} {}", t.name, way.version, static_cast<int>(*way.encoding));
  const auto path = empty_folder() / ("mesh" + std::string(t.extensions[0]));
  const std::vector<Finding> findings = write_file_mesh(path, mesh, way);
  const auto tells = [&](std::string_view code) {
    return std::ranges::find(findings, code, &Finding::code) != findings.end();
  };
  if (tells("number_out_of_range")) return {};  // binary STL has floats
  if (tells("nothing_left")) return {};
  if (has_error(findings)) return fmt::format("not written as {}: {}", words, findings[0].text);
  const Result<FileMesh> back = read_file_mesh(path);
  if (!back) return fmt::format("not read back as {}: {}", words, back.findings[0].text);
  if (tells("points_renumbered") || tells("coordinates_rounded")) return {};  // STL has no points
  const bool nothing_lost =
      std::ranges::all_of(findings, [](const Finding& f) { return f.severity == Severity::note; });
  const std::string lost = difference(mesh, *back, nothing_lost);
  return lost.empty() ? lost : fmt::format("{} do not come back from {}", lost, words);
}

constexpr std::string_view mark = "@@@ ";

/// A mesh of several files is one input: behind the first each begins with a line "@@@ .ending".
io::FileSource source_of(std::string_view bytes, std::string_view extension) {
  io::FileSource source;
  source.text = bytes.substr(0, bytes.find(mark));
  source.name = "fuzz" + std::string(extension);
  source.other_file = [bytes](const std::string& name) -> Result<std::string> {
    const std::string begin =
        std::string(mark) + name.substr(std::min(name.rfind('.'), name.size()));
    const std::size_t at = bytes.find(begin + '\n');
    if (at == std::string_view::npos) {
      return Finding{.code = "missing_file", .text = "no such file", .remedy = "name another"};
    }
    const std::string_view rest = bytes.substr(at + begin.size() + 1);
    return std::string(rest.substr(0, rest.find(mark)));
  };
  return source;
}

std::string broken_law_of_format(const FuzzTarget& target, std::string_view bytes) {
  const FormatTraits& t = format_traits()[static_cast<std::size_t>(target.format)];
  const std::size_t hash = hash_of(bytes);
  const io::FileSource source = source_of(bytes, t.extensions[0]);
  Result<FileMesh> mesh;
  std::string bad = excess_memory(
      bytes.size(), [&] { mesh = io::read_format(t.format, source, {(hash >> 20) % 2 == 1}); });
  if (bad.empty()) bad = bad_finding(mesh.findings, bytes);
  if (!bad.empty()) return bad;
  if (bool(mesh) == has_error(mesh.findings)) return "an error and a value, or neither";
  if (!mesh) return {};
  bad = bad_mesh(*mesh);
  return bad.empty() ? bad_round_trip(*mesh, t, hash) : bad;
}

/// The way in that users take: gzip, content, format.
std::string broken_law_of_any(const FuzzTarget&, std::string_view bytes) {
  Result<FileMesh> mesh;
  std::string bad = excess_memory(bytes.size(), [&] { mesh = read_file_mesh(bytes, "any"); });
  for (const Finding& f : mesh.findings) {
    if (f.file != "any") bad = fmt::format("{} names no file", f.code);
  }
  if (bad.empty()) bad = bad_finding(mesh.findings, io::is_gzip(bytes) ? "" : bytes);
  if (!bad.empty()) return bad;
  if (bool(mesh) == has_error(mesh.findings)) return "an error and a value, or neither";
  return mesh ? bad_mesh(*mesh) : bad;
}

std::string broken_law_of_gzip(const FuzzTarget&, std::string_view bytes) {
  std::string out;
  std::vector<Finding> findings;
  const std::string bad = excess_memory(bytes.size(), [&] {
    try {
      out = io::unpacked(bytes);
    } catch (io::ReadFailure& failure) {
      findings.push_back(std::move(failure.finding));
    }
  });
  return bad.empty() ? bad_finding(findings, bytes) : bad;
}

/// Names that were read are written and read back.
std::string broken_law_of_regions(const FuzzTarget&, std::string_view bytes) {
  FileMesh mesh;
  std::vector<Finding> findings;
  const std::string bad = excess_memory(bytes.size(), [&] {
    try {
      mesh.region_name = io::read_region_names(bytes);
    } catch (io::ReadFailure& failure) {
      findings.push_back(std::move(failure.finding));
    }
  });
  if (!bad.empty()) return bad;
  if (!findings.empty()) return bad_finding(findings, bytes);
  const auto path = empty_folder() / "a.regions";
  if (io::write_region_names(path, mesh)) return "the names are not written";
  std::ifstream in(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  FileMesh back;
  try {
    back.region_name = io::read_region_names(text);
  } catch (io::ReadFailure& failure) {
    return fmt::format("the names are not read back: {}", failure.finding.text);
  }
  return back.region_name == mesh.region_name ? "" : "the names do not come back";
}

std::string broken_law_of_faces(const FuzzTarget&, std::string_view bytes) {
  const auto path = empty_folder() / "faces.txt";
  std::ofstream(path, std::ios::binary)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  const auto faces = read_face_list(path);
  if (bool(faces) == has_error(faces.findings)) return "an error and a value, or neither";
  return bad_finding(faces.findings, bytes);
}

std::vector<FuzzTarget> all_targets() {
  std::vector<FuzzTarget> all;
  for (const FormatTraits& t : format_traits()) {
    all.push_back({std::string(t.extensions[0].substr(1)), broken_law_of_format,
                   static_cast<int>(&t - format_traits().data())});
  }
  all.push_back({"any", broken_law_of_any});
  all.push_back({"gzip", broken_law_of_gzip});
  all.push_back({"regions", broken_law_of_regions});
  all.push_back({"faces", broken_law_of_faces});
  return all;
}

}  // namespace

std::span<const FuzzTarget> fuzz_targets() {
  static const std::vector<FuzzTarget> targets = all_targets();
  return targets;
}

const FuzzTarget* find_target(std::string_view name) {
  const auto found = std::ranges::find(fuzz_targets(), name, &FuzzTarget::name);
  return found == fuzz_targets().end() ? nullptr : &*found;
}

void end_at_memory_bound(bool yes) { memory_law.ends = yes; }

double largest_memory_share() { return memory_law.largest_share; }

}  // namespace sunder::test
