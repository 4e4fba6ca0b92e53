// SPDX-License-Identifier: GPL-3.0-or-later
// sunder-repair: a surface that crosses itself in, a closed one that does not out.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/sunder-mesh/repair/heal.hpp"
#include "topology/io/files/printing.hpp"
#include "topology/io/mesh_file.hpp"

namespace {

using namespace sunder;

constexpr int exit_bad_input = 3, exit_not_written = 4;

struct Arguments {
  std::string in, out;
  WrapSettings wrap;
  bool wrap_only = false;
};

void say(const std::vector<Finding>& findings) {
  for (const Finding& f : findings)
    print(stderr, "{}: {} [{}]\n  {}\n", to_string(f.severity), f.text, f.code, f.remedy);
}

Result<Surface> read(const std::string& path) {
  Result<FileMesh> mesh = read_file_mesh(path);
  Result<Surface> result;
  result.findings = std::move(mesh.findings);
  if (!mesh) return result;
  if (mesh->triangles.corners.empty()) {
    return Finding{.code = "no_faces",
                   .text = "the file has no triangles",
                   .remedy = "give a surface of triangles",
                   .file = path};
  }
  result.value = Surface{std::move(mesh->points), std::move(mesh->triangles.corners)};
  return result;
}

/// A union, else (where `alpha` allows it) a wrap.
Result<Healed> heal(const Surface& surface, const Arguments& a) {
  Result<Healed> healed;
  if (!a.wrap_only) healed = unite(surface);
  if (!healed && a.wrap.alpha > 0) {
    WrapSettings settings = a.wrap;
    if (!(settings.offset > 0)) settings.offset = settings.alpha / 10;
    Result<Healed> wrapped = wrap(surface, settings);
    for (Finding& f : healed.findings) f.severity = Severity::note;
    wrapped.findings.insert(wrapped.findings.begin(), healed.findings.begin(),
                            healed.findings.end());
    return wrapped;
  }
  return healed;
}

int run(const Arguments& a) {
  const Result<Surface> surface = read(a.in);
  say(surface.findings);
  if (!surface) return exit_bad_input;
  const Result<Healed> healed = heal(*surface, a);
  say(healed.findings);
  if (!healed) return exit_bad_input;
  FileMesh mesh;
  mesh.points = healed->surface.points;
  mesh.triangles.corners = healed->surface.triangles;
  const std::vector<Finding> unwritten = write_file_mesh(a.out, mesh);
  say(unwritten);
  if (has_error(unwritten)) return exit_not_written;
  const nlohmann::ordered_json answer = {{"method", healed->method},
                                         {"shells", healed->shells},
                                         {"crossing_shells", healed->crossings},
                                         {"triangles", mesh.triangles.corners.size()}};
  print(stdout, "{}\n", answer.dump());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program(
      "Joins overlapping shells of a surface, and cuts or wraps faces that cross each other",
      "sunder-repair");
  Arguments a;
  program.add_option("IN", a.in, "Surface of triangles: OFF, STL, OBJ, PLY")->required();
  program.add_option("OUT", a.out, "File to write")->required();
  program
      .add_option("--alpha", a.wrap.alpha,
                  "Where a union fails, wrap the surface: nothing narrower than this is seen")
      ->check(CLI::PositiveNumber);
  program
      .add_option("--offset", a.wrap.offset,
                  "Distance of a wrap from the surface (default: a tenth of --alpha)")
      ->check(CLI::PositiveNumber);
  program
      .add_option("--triangles", a.wrap.triangles,
                  "Triangles that a wrap is simplified to, as long as it does not cross itself")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  program.add_flag("--wrap", a.wrap_only, "Wrap without trying a union; needs --alpha")
      ->needs("--alpha");
  program.footer(
      "\nLengths are in the unit of the file. Prints one line of JSON.\n"
      "Exit codes: 0 done, 2 usage, 3 no such surface can be made, 4 not written.");
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return program.exit(e) == 0 ? 0 : 2;
  }
  try {
    return run(a);
  } catch (const std::exception& e) {
    print(stderr, "sunder-repair: {}\n", e.what());
    return exit_bad_input;
  }
}
