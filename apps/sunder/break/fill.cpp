// SPDX-License-Identifier: MIT
#include "apps/sunder/break/fill.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <system_error>
#include <utility>

#include "apps/sunder/process/run_process.hpp"
#include "topology/base/counted.hpp"
#include "topology/base/elementary.hpp"
#include "topology/io/files/output_file.hpp"
#include "topology/io/mesh_file.hpp"
#include "topology/mesh/boundary_surface.hpp"
#include "topology/mesh/check.hpp"
#include "topology/mesh/repair.hpp"
#include "topology/mesh/surface/enclosure.hpp"
#include "topology/mesh/surface/repair/facing.hpp"

namespace sunder {
namespace {

namespace fs = std::filesystem;

/// A mesher is ended after it. Surfaces that it can fill take seconds.
constexpr std::chrono::seconds longest_wait{180};

/// Counts within this factor of the wanted one are taken.
constexpr double near_enough = 1.4;

/// Above this factor another mesher is tried too, and the nearer count taken.
constexpr double far_off = 2.5;

/// A surface in a folder, for one mesher.
struct Job {
  fs::path program, folder;
  /// Of the surface or, where it is not known, a guess.
  double volume;
};

double volume_of(const TetMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.tetrahedra) {
    std::array<std::array<double, 3>, 3> e{};
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        e[k][axis] = mesh.points[t[k + 1]][axis] - mesh.points[t[0]][axis];
      }
    }
    sum += (e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
            e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
            e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
           6;
  }
  return sum;
}

/// What a mesher wrote, positive and without what the simulation does not need; or why it cannot be
/// taken.
Result<TetMesh> taken(const fs::path& file, const ProcessEnd& end) {
  if (end.took_too_long) {
    return Finding{.code = "not_filled",
                   .text = fmt::format("it did not end within {} s", longest_wait.count())};
  }
  std::error_code none;
  if (end.exit_code != 0 || !fs::exists(file, none)) {
    std::string last = end.words.substr(0, end.words.find_last_not_of(" \n\r") + 1);
    last = last.substr(last.find_last_of('\n') + 1);
    return Finding{.code = "not_filled",
                   .text = last.empty() ? "it wrote no mesh" : fmt::format("it says: {}", last)};
  }
  Result<FileMesh> read = read_file_mesh(file, {.simplices = true});
  if (!read || read->tetrahedra.corners.empty()) {
    return Finding{.code = "not_filled", .text = "it wrote a mesh without tetrahedra"};
  }
  FileMesh plain;
  plain.points = std::move(read->points);
  plain.tetrahedra.corners = std::move(read->tetrahedra.corners);
  drop_unused_points(plain);
  fix_orientation(plain);
  TetMesh mesh = tet_mesh_of(std::move(plain));
  for (const Finding& f : check_mesh(mesh)) {
    if (f.severity == Severity::error) return Finding{.code = "not_filled", .text = f.text};
  }
  return mesh;
}

Result<TetMesh> run_tetgen(const Job& job, double tetrahedra) {
  // On average its tetrahedra have three tenths of the largest volume allowed.
  const std::string quality = fmt::format("-pQq1.4/10a{:.17g}", 3.3 * job.volume / tetrahedra);
  const ProcessEnd end =
      run_process(job.program, {quality, "surface.off"}, job.folder, longest_wait);
  return taken(job.folder / "surface.1.ele", end);
}

Result<TetMesh> run_gmsh(const Job& job, double tetrahedra) {
  const double edge = 1.1 * cube_root(6 * job.volume / tetrahedra);
  const std::string model = fmt::format(
      "Merge \"surface.msh\";\nClassifySurfaces{{0.7, 1, 1, 3.14159}};\nCreateGeometry;\n"
      "s() = Surface{{:}};\nSurface Loop(1) = {{s()}};\nVolume(1) = {{1}};\n"
      "Mesh.MeshSizeExtendFromBoundary = 0;\nMesh.MeshSizeMin = {0:.17g};\n"
      "Mesh.MeshSizeMax = {0:.17g};\n",
      edge);
  if (const auto fault = write_file(job.folder / "surface.geo", model)) return *fault;
  std::error_code none;
  fs::remove(job.folder / "filled.msh", none);
  const ProcessEnd end = run_process(
      job.program,
      {"-3", "-nt", "1", "-v", "1", "-format", "msh22", "-o", "filled.msh", "surface.geo"},
      job.folder, longest_wait);
  return taken(job.folder / "filled.msh", end);
}

Result<TetMesh> run_sunder_mesh(const Job& job, double tetrahedra) {
  const ProcessEnd end = run_process(
      job.program,
      {"surface.off", "-o", "filled.msh", "--tetrahedra", fmt::format("{:.0f}", tetrahedra)},
      job.folder, longest_wait);
  return taken(job.folder / "filled.msh", end);
}

struct Mesher {
  const char* name;
  Result<TetMesh> (*run)(const Job&, double tetrahedra);
};
constexpr std::array<Mesher, 3> meshers = {
    {{"tetgen", run_tetgen}, {"gmsh", run_gmsh}, {"sunder-mesh", run_sunder_mesh}}};

double off_by(const TetMesh& mesh, double wanted) {
  const double ratio = static_cast<double>(mesh.tetrahedra.size()) / wanted;
  return std::max(ratio, 1 / ratio);
}

/// Runs a mesher until it comes near the number, three times at most; the nearest counts.
Result<TetMesh> come_near(const Mesher& mesher, Job job, double wanted) {
  Result<TetMesh> best;
  double asked = wanted;
  for (int attempt = 0; attempt < 3; ++attempt) {
    Result<TetMesh> mesh = mesher.run(job, asked);
    if (!mesh) return best ? best : mesh;
    const double count = static_cast<double>(mesh->tetrahedra.size());
    job.volume = volume_of(*mesh);
    if (!best || off_by(*mesh, wanted) < off_by(*best, wanted)) best = std::move(mesh);
    if (off_by(*best, wanted) <= near_enough) break;
    asked *= wanted / count;
  }
  return best;
}

/// Meshers in the order in which they are tried.
std::vector<const Mesher*> in_order(const Thing& thing, double tetrahedra,
                                    const std::string& wanted) {
  std::vector<const Mesher*> order;
  for (const Mesher& m : meshers) {
    if (wanted.empty() || wanted == m.name) order.push_back(&m);
  }
  const double triangles = static_cast<double>(thing.surface.triangles.corners.size());
  if (2 * triangles > tetrahedra && order.size() > 1)
    std::rotate(order.begin(), order.begin() + 1, order.end());
  return order;
}

Finding no_mesher(const std::string& wanted) {
  return {.code = "no_mesher",
          .text = wanted.empty()
                      ? std::string("no mesher is installed that fills a surface with tetrahedra")
                      : fmt::format("the mesher {} is not in the folders of PATH", wanted),
          .remedy =
              "install one (Debian: apt-get install tetgen, or gmsh), or give a mesh of "
              "tetrahedra"};
}

double box_volume(const Thing& thing) {
  const double side = longest_side(thing);
  return side * side * side / 10;
}

/// Whether a shell of the surface looks inward.
bool has_cavity(const Thing& thing) {
  const std::vector<Triangle>& triangles = thing.surface.triangles.corners;
  const std::vector<std::uint32_t> root = shells_of(triangles);
  std::map<std::uint32_t, std::vector<Triangle>> shells;
  for (std::size_t t = 0; t < triangles.size(); ++t) shells[root[t]].push_back(triangles[t]);
  return std::ranges::any_of(shells, [&](const auto& shell) {
    return enclosed_volume(thing.surface.points, shell.second) < 0;
  });
}

/// Leaves tetrahedra out that lie in cavities, which meshers fill.
void hollow_out(TetMesh& mesh, const Thing& thing) {
  const Enclosure enclosure(thing.surface.points, thing.surface.triangles.corners);
  FileMesh left;
  left.points = std::move(mesh.points);
  for (const auto& t : mesh.tetrahedra) {
    Point middle{};
    for (const std::uint32_t corner : t) {
      for (std::size_t k = 0; k < 3; ++k) middle[k] += left.points[corner][k] / 4;
    }
    if (enclosure.holds(middle)) left.tetrahedra.corners.push_back(t);
  }
  drop_unused_points(left);
  mesh = tet_mesh_of(std::move(left));
}

/// Errors of volume and distance, after cavities are left out.
void measure(Filled& filled, const Thing& thing) {
  const auto volume_error = [&] { return volume_of(filled.mesh) / thing.volume - 1; };
  if (thing.volume > 0) {
    filled.volume_error = volume_error();
    if (filled.volume_error > 1e-3 && has_cavity(thing)) {
      hollow_out(filled.mesh, thing);
      filled.volume_error = volume_error();
    }
  }
  FileMesh body;
  body.points = filled.mesh.points;
  body.tetrahedra.corners = filled.mesh.tetrahedra;
  const FileMesh skin = boundary_surface(body).mesh;
  filled.gap = gap_between(thing.surface.points, thing.surface.triangles.corners, skin.points,
                           skin.triangles.corners);
}

/// Notes and the error of a filled surface.
std::vector<Finding> judged(const Filled& filled, double wanted) {
  std::vector<Finding> findings;
  if (std::abs(filled.volume_error) > 0.05) {
    findings.push_back(
        {.code = "wrong_volume",
         .text = fmt::format("{} filled {:.1f} % more or less volume than the surface encloses",
                             filled.mesher, 100 * std::abs(filled.volume_error)),
         .remedy = "take more --tetrahedra for thin walls, another --mesher, or give a mesh of "
                   "tetrahedra"});
  }
  const auto count = filled.mesh.tetrahedra.size();
  if (static_cast<double>(count) > 2 * wanted) {
    findings.push_back({.code = "many_cells",
                        .severity = Severity::note,
                        .text = fmt::format("the triangles of the surface need {}, and {:.0f} were "
                                            "asked for",
                                            counted(count, "tetrahedron", "tetrahedra"), wanted),
                        .remedy = "give a surface of fewer triangles for a faster run, or install "
                                  "gmsh, which makes triangles of its own"});
  }
  return findings;
}

/// The mesh that a mesher made of a surface, measured and judged.
Result<Filled> filled_by(const Mesher& mesher, const Job& job, const Thing& thing,
                         double tetrahedra) {
  Result<TetMesh> mesh = come_near(mesher, job, tetrahedra);
  if (!mesh) return mesh.findings.front();
  Result<Filled> filled = Filled{std::move(*mesh), mesher.name};
  measure(*filled, thing);
  std::vector<Finding> findings = judged(*filled, tetrahedra);
  if (has_error(findings)) return findings.front();
  filled.findings = std::move(findings);
  return filled;
}

}  // namespace

std::vector<std::string> known_meshers() {
  std::vector<std::string> names;
  for (const Mesher& m : meshers) names.emplace_back(m.name);
  return names;
}

Result<Filled> fill(const Thing& thing, double tetrahedra, const std::string& wanted) {
  const TemporaryFolder folder;
  if (folder.path().empty()) {
    return Finding{.code = "cannot_write",
                   .text = "no folder for the mesher can be made in the folder for temporary files",
                   .remedy = "set TMPDIR to a folder that can be written"};
  }
  for (const char* name : {"surface.off", "surface.msh"}) {
    Result<Filled> failed;
    failed.findings = write_file_mesh(folder.path() / name, thing.surface);
    if (has_error(failed.findings)) return failed;
  }
  const double volume = thing.volume > 0 ? thing.volume : box_volume(thing);
  std::vector<std::string> reasons;
  Result<Filled> best;
  for (const Mesher* mesher : in_order(thing, tetrahedra, wanted)) {
    const auto program = find_program(mesher->name);
    if (!program) continue;
    Result<Filled> filled =
        filled_by(*mesher, {*program, folder.path(), volume}, thing, tetrahedra);
    if (!filled) {
      reasons.push_back(fmt::format("{}: {}", mesher->name, filled.findings.front().text));
      continue;
    }
    if (!best || off_by(filled->mesh, tetrahedra) < off_by(best->mesh, tetrahedra)) {
      best = std::move(filled);
    }
    if (off_by(best->mesh, tetrahedra) <= far_off) return best;
  }
  if (best) return best;
  if (reasons.empty()) return no_mesher(wanted);
  return Finding{.code = "not_filled",
                 .text = fmt::format("the surface cannot be filled; {}", fmt::join(reasons, "; ")),
                 .remedy =
                     "cavities, walls without thickness and slivers stop meshers: simplify "
                     "the surface (in Blender by the modifier Remesh), install another mesher "
                     "(Debian: tetgen, gmsh), or give a mesh of tetrahedra"};
}

}  // namespace sunder
