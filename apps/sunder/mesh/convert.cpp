// SPDX-License-Identifier: MIT
// `sunder convert`: reads the whole content of a mesh file, reports the parts that the new format
// cannot hold, writes.
#include "apps/sunder/mesh/convert.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "apps/scene/json_text.hpp"
#include "apps/scene/words.hpp"
#include "apps/sunder/mesh/convert/cell_counts.hpp"
#include "apps/sunder/mesh/convert/convert_crack.hpp"
#include "apps/sunder/mesh/convert/convert_scale.hpp"
#include "apps/sunder/mesh/formats_table.hpp"
#include "apps/sunder/telling.hpp"
#include "topology/base/counted.hpp"
#include "topology/io/files/output_file.hpp"
#include "topology/io/files/printing.hpp"
#include "topology/io/format_traits.hpp"
#include "topology/io/mesh_file.hpp"
#include "topology/mesh/kinds/move_cells.hpp"
#include "topology/mesh/kinds/second_order.hpp"
#include "topology/mesh/kinds/split_cells.hpp"
#include "topology/mesh/repair.hpp"

namespace sunder {
namespace {

constexpr const char* convert_footer = R"(
IN is recognised by its content, not by its name, and may be packed by gzip. TetGen's files are
recognised by name: give any of STEM.node, .ele, .face and .edge, which are read and written together.
IN - is standard input, OUT - is standard output and needs --to, and OUT.gz is packed.
OUT's ending or --to chooses the format. `sunder convert --formats` lists the formats, their endings,
versions and encodings (defaults first), and the contents that each can hold. Points and cells keep
their order. Numbers, regions, entities and data are kept where the format holds them. Names of
regions that it does not hold go to OUT.regions, which is read with OUT. All other losses are listed
first, as warnings.
Cells keep their kind where the format has it. --order 1 makes cells of second order linear. --split
cuts all cells into tetrahedra and triangles, after --merge-points and before the other repairs. It
adds no point, and cuts neighbours alike, each from its corner with the least row. --order 2 then puts
a node in the middle of each edge. Nothing is written where OUT's format would hold no cell at all.
Repairs run in the order of this list, and each reports its changes. A crack is opened after them,
without width. Points are copied exactly where the cut faces separate the tetrahedra around them. The
front of the crack stays joined (docs/reference/checks.md).

Exit codes: 0 written, 1 something would be lost and --strict was given (nothing is written),
2 usage, 3 the input cannot be read or repaired, 4 the output cannot be written.

Examples:
  sunder convert body.msh body.vtu
  sunder convert body.msh clean.msh --merge-points 1e-6 --drop-duplicates --fix-orientation
  sunder convert body.vtu body.msh --format-version 2.2 --binary --strict
  sunder convert body.msh body.inp --triangles drop
  gunzip -c body.msh.gz | sunder convert - - --to vtu > body.vtu
  sunder convert hexahedra.inp tetrahedra.msh --order 1 --split
  sunder convert mug.stl mug.off --units mm
  sunder convert body.msh cracked.vtu --crack-regions matrix,inclusion --crack-pairs pairs.csv
)";

struct ConvertArguments : Telling {
  std::filesystem::path in;
  std::filesystem::path out;
  std::string to;
  std::string version;
  std::optional<Encoding> encoding;
  bool zlib = false;
  bool strict = false;
  bool tetrahedra_only = false;
  /// "keep" or "drop".
  std::string triangles = "keep";
  /// 1: cells of second order become linear; 2: linear ones of second order; 0: they stay.
  int order = 0;
  bool split = false;
  ScaleOptions scale;
  Repairs repairs;
  CrackOptions crack;
};

struct Conversion {
  std::vector<Finding> findings;
  FileMesh mesh;
  bool is_read = false;
  bool is_repaired = true;
  bool is_written = false;
  /// Whether something is lost between the two files.
  bool has_losses = false;
  /// Whether that is why nothing is written.
  bool is_refused = false;
};

/// Data left out on reading are as lost as data that cannot be written: both are warnings.
bool is_loss(const Finding& finding) { return finding.severity == Severity::warning; }

Finding asked_for(std::string_view code, std::size_t count, std::string text) {
  return {.code = std::string(code),
          .severity = Severity::note,
          .count = count,
          .text = std::move(text),
          .remedy = "nothing to do: it was requested"};
}

void tell_split(const SplitCells& report, std::vector<Finding>& findings) {
  std::size_t cut = 0;
  for (const std::size_t n : report.cut) cut += n;
  std::array<std::size_t, cell_kinds> parts{};
  parts[index_of(CellKind::triangle)] = report.triangles;
  parts[index_of(CellKind::tetrahedron)] = report.tetrahedra;
  findings.push_back(asked_for(
      "split_cells", cut,
      cut == 0 ? std::string("all cells are simplices: none is split")
               : fmt::format("{} became {}{}", counts_text(report.cut), counts_text(parts),
                             report.numbers_added == 0
                                 ? ""
                                 : fmt::format("; {} behind the highest for them",
                                               counted(report.numbers_added, "number")))));
  const auto warn = [&](std::size_t count, std::string_view code, std::string text) {
    if (count == 0) return;
    findings.push_back({.code = std::string(code),
                        .severity = Severity::warning,
                        .count = count,
                        .text = std::move(text),
                        .remedy = "look at them: `sunder check` on the new mesh lists flat and "
                                  "folded tetrahedra"});
  };
  warn(report.concave_volumes, "concave_cells",
       fmt::format("{} {} concave or flat: parts are flat or turned inside out",
                   counted(report.concave_volumes, "volume cell"),
                   for_count(report.concave_volumes, "is", "are")));
  warn(report.concave_faces, "concave_faces",
       fmt::format("{} {} concave or flat: some triangles look the other way",
                   counted(report.concave_faces, "face"),
                   for_count(report.concave_faces, "is", "are")));
  warn(report.bent_polygons, "bent_polygons",
       fmt::format("{} {} not plane: the triangles are one of several surfaces through the "
                   "corners",
                   counted(report.bent_polygons, "polygon"),
                   for_count(report.bent_polygons, "is", "are")));
  warn(
      report.empty_parts, "empty_parts",
      fmt::format("{} of cells that repeat a corner {} left out",
                  counted(report.empty_parts, "part"), for_count(report.empty_parts, "is", "are")));
}

/// Makes cells linear, simplices, or of second order, as was asked for. Points are merged before:
/// parts of cells fit together where these have the same points.
void simplify(FileMesh& mesh, ConvertArguments& arguments, std::vector<Finding>& findings) {
  if (arguments.order == 0 && !arguments.split) return;
  if (arguments.repairs.merge_points) {
    findings.push_back(merge_points(mesh, *arguments.repairs.merge_points));
    arguments.repairs.merge_points.reset();
  }
  const std::vector<bool> used = used_points(mesh);
  if (arguments.order == 1) {
    std::array<std::size_t, cell_kinds> curved{};
    std::size_t sum = 0;
    for (const CellKind kind : all_cell_kinds) {
      if (linear_kind(kind) == kind) continue;
      curved[index_of(kind)] = rows_of(mesh, kind).count;
      sum += rows_of(mesh, kind).count;
    }
    make_linear(mesh);
    findings.push_back(asked_for("made_linear", sum,
                                 sum == 0 ? std::string("all cells are linear")
                                          : fmt::format("{} {} made linear", counts_text(curved),
                                                        for_count(sum, "is", "are"))));
  }
  if (arguments.split) tell_split(split_cells(mesh), findings);
  const std::size_t dropped = drop_points_out_of_use(mesh, used);
  if (dropped > 0) {
    findings.push_back(
        asked_for("dropped_unused", dropped,
                  fmt::format("{} that only cells of second order used {} dropped",
                              counted(dropped, "point"), for_count(dropped, "was", "were"))));
  }
  if (arguments.order == 2) {
    const std::size_t added = raise_order(mesh);
    findings.push_back(
        asked_for("made_second_order", added,
                  fmt::format("{} {} added in the middles of edges", counted(added, "point"),
                              for_count(added, "was", "were"))));
  }
}

/// Drops edges and faces of a body; an error where that would leave nothing of it.
Finding drop_shells_and_beams(FileMesh& mesh) {
  std::size_t dropped = 0, volumes = 0;
  for (const CellKind kind : all_cell_kinds) {
    const std::size_t n = rows_of(mesh, kind).count;
    const int dimension = traits_of(kind).dimension;
    if (dimension == 3) volumes += n;
    if (dimension == 1 || dimension == 2) dropped += n;
  }
  if (volumes == 0) {
    return {.code = "no_tetrahedron",
            .text = "--triangles drop would leave nothing: the file has no volume cell",
            .remedy = "leave --triangles out: a surface is its triangles"};
  }
  for (const CellKind kind : all_cell_kinds) {
    const int dimension = traits_of(kind).dimension;
    if (dimension == 1 || dimension == 2) drop_cells(mesh, kind);
  }
  mesh.region_name[1].clear();
  mesh.region_name[2].clear();
  return asked_for(
      "dropped_shells", dropped,
      dropped == 0
          ? std::string("there are no triangles and no edges: nothing was dropped")
          : fmt::format("{} {} dropped", counted(dropped, "face or edge", "faces and edges"),
                        for_count(dropped, "was", "were")));
}

Conversion convert(ConvertArguments arguments) {
  Conversion result;
  Stages stages(arguments);
  Result<FileMesh> mesh =
      read_file_mesh(arguments.in, {.tetrahedra_only = arguments.tetrahedra_only});
  result.findings = std::move(mesh.findings);
  if (!mesh) return result;
  result.is_read = true;
  stages.done(fmt::format("read {}", arguments.in.string()));
  result.mesh = std::move(*mesh);
  // A repair was asked for: the cells and points that it drops are no loss.
  result.has_losses = std::ranges::any_of(result.findings, is_loss);
  // Points alone are a mesh too, where the file has nothing else.
  const bool lost_cells =
      cell_count(result.mesh) > 0 || std::ranges::any_of(result.findings, [](const Finding& f) {
        return f.code == "skipped_cells" || f.code == "unsupported_cells" ||
               f.code == "unknown_cells";
      });
  if (auto scaled = scale_points(result.mesh, arguments.scale)) {
    result.findings.push_back(std::move(*scaled));
  }
  simplify(result.mesh, arguments, result.findings);
  if (arguments.triangles == "drop") result.findings.push_back(drop_shells_and_beams(result.mesh));
  std::ranges::move(repair(result.mesh, arguments.repairs), std::back_inserter(result.findings));
  NamedCrack crack;
  if (!has_error(result.findings)) crack = open_named_crack(result.mesh, arguments.crack);
  std::ranges::move(crack.findings, std::back_inserter(result.findings));
  if (has_error(result.findings)) {
    result.is_repaired = false;
    return result;
  }
  if (lost_cells && cell_count(result.mesh) == 0) {
    result.findings.push_back({.code = "nothing_left",
                               .text = "no cell is left to write",
                               .remedy = "look at the warnings and at what was to be left out",
                               .file = arguments.in.string()});
    return result;
  }
  stages.done("made the requested changes");
  WriteOptions options{
      .version = arguments.version, .encoding = arguments.encoding, .pack = arguments.zlib};
  options.format =
      arguments.to.empty() ? format_of_name(arguments.out) : format_called(arguments.to);
  if (arguments.strict && options.format) {
    std::vector<Finding> lost = lost_on_writing(result.mesh, options);
    result.has_losses = result.has_losses || !lost.empty();
    if (result.has_losses) {
      result.is_refused = true;
      std::ranges::move(lost, std::back_inserter(result.findings));
      return result;
    }
  }
  std::vector<Finding> written = write_file_mesh(arguments.out, result.mesh, options);
  if (!has_error(written) && !arguments.crack.pairs.empty()) {
    auto failure = write_file(arguments.crack.pairs, crack.pairs);
    if (failure) written.push_back(std::move(*failure));
  }
  result.is_written = !has_error(written);
  if (result.is_written) stages.done(fmt::format("wrote {}", arguments.out.string()));
  result.has_losses = result.has_losses || std::ranges::any_of(written, is_loss);
  std::ranges::move(written, std::back_inserter(result.findings));
  return result;
}

void print_conversion(const ConvertArguments& arguments, const Conversion& result) {
  if (arguments.json) {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    json["counts"] = result.is_read ? counts_json(result.mesh) : nlohmann::ordered_json{};
    json["written"] = result.is_written;
    json["lossless"] = result.is_written && !result.has_losses;
    json["findings"] = findings_json(result.findings);
    print_json(json, arguments.out == "-" ? stderr : stdout);
    return;
  }
  tell_beside(result.findings, arguments);
  const std::string words =
      result.is_written
          ? fmt::format("{}: written from {}{}\n", arguments.out.string(), counts_text(result.mesh),
                        result.has_losses ? "" : "; nothing is lost")
          : "nothing is written\n";
  // Where the mesh itself goes to standard output, words about it go to standard error.
  arguments.out == "-" ? remark(words, arguments) : print("{}", words);
}

ExitCode run_convert(const ConvertArguments& arguments) {
  const Conversion result = convert(arguments);
  print_conversion(arguments, result);
  if (!result.is_read || !result.is_repaired) return ExitCode::bad_input;
  if (result.is_written) return ExitCode::fine;
  const auto is_usage = [](const Finding& f) {
    return f.code == "unknown_format" || f.code == "unknown_version";
  };
  if (std::ranges::any_of(result.findings, is_usage)) return ExitCode::usage;
  const bool is_failure = has_error(result.findings) && !result.is_refused;
  return is_failure ? ExitCode::not_written : ExitCode::problems;
}

}  // namespace

void add_convert_command(CLI::App& program, ExitCode& exit_code) {
  const auto arguments = std::make_shared<ConvertArguments>();
  CLI::App* command = program.add_subcommand("convert", "Convert a mesh file and list the losses");
  command->add_option("IN", arguments->in, "Mesh file to read")->type_name("FILE")->required();
  command->add_option("OUT", arguments->out, "Mesh file to write")->type_name("FILE")->required();
  command->add_option("--to", arguments->to, "Format to write; default: by OUT's ending")
      ->type_name("FORMAT")
      ->check(known_format);
  command
      ->add_option("--format-version", arguments->version,
                   "Version of the format; default: the first that --formats lists")
      ->type_name("VERSION");
  const auto ask_for = [=](Encoding encoding) { return [=] { arguments->encoding = encoding; }; };
  CLI::Option* text = command->add_flag_callback("--text", ask_for(Encoding::text), "Write text");
  CLI::Option* binary =
      command->add_flag_callback("--binary", ask_for(Encoding::binary), "Write binary data");
  command
      ->add_flag_callback("--base64", ask_for(Encoding::base64),
                          "Write binary data as base64 (VTU)")
      ->excludes(text)
      ->excludes(binary);
  binary->excludes(text);
  command->add_flag("--zlib", arguments->zlib, "Pack binary data or base64 by zlib (VTU)");
  command->add_flag("--strict", arguments->strict, "Write nothing if anything would be lost");
  command
      ->add_option(
          "--triangles", arguments->triangles,
          "keep (default), or drop: write only the tetrahedra of a body, for solvers that read its "
          "triangles as shells and its edges as beams. Vertex cells stay as sets of nodes")
      ->type_name("WHAT")
      ->check(CLI::IsMember({"keep", "drop"}));
  command->add_flag("--tetrahedra-only", arguments->tetrahedra_only,
                    "Leave out volume cells that are no tetrahedra");
  command
      ->add_option("--order", arguments->order,
                   "1: make cells of second order linear; points that only they use are dropped. "
                   "2: give linear cells a node in the middle of each edge")
      ->type_name("1|2")
      ->check(CLI::IsMember({1, 2}));
  add_scale_options(*command, arguments->scale);
  command->add_flag(
      "--split", arguments->split,
      "Cut hexahedra, prisms and pyramids into tetrahedra, and quadrilaterals and polygons "
      "into triangles, so that neighbours fit together");
  command
      ->add_option(
          "--merge-points", arguments->repairs.merge_points,
          "Repair: merge points within this distance; 0: those that coincide. Unit: that of "
          "OUT")
      ->type_name("DISTANCE")
      ->check(CLI::NonNegativeNumber);
  Repairs& repairs = arguments->repairs;
  command->add_flag("--drop-duplicates", repairs.drop_duplicates,
                    "Repair: keep the first of tetrahedra with the same points");
  command->add_flag("--split-nonmanifold", repairs.split_nonmanifold,
                    "Repair: copy points at which groups of tetrahedra only touch");
  command->add_flag("--largest-component", repairs.largest_component,
                    "Repair: keep the largest component");
  command->add_flag("--fix-orientation", repairs.fix_orientation,
                    "Repair: swap two points of inverted tetrahedra");
  command->add_flag("--drop-unused", repairs.drop_unused, "Repair: drop points that no cell uses");
  add_crack_options(*command, arguments->crack);
  add_telling_flags(*command, *arguments);
  command->add_flag("--json", arguments->json, "Print JSON instead of a table");
  command->add_flag_callback(
      "--formats",
      [] {
        print("{}", formats_table());
        throw CLI::Success();
      },
      "Print the contents that each format can hold, as a table, and end");
  command->footer(convert_footer);
  command->callback([=, &exit_code] { exit_code = run_convert(*arguments); });
}

}  // namespace sunder
