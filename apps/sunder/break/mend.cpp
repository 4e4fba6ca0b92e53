// SPDX-License-Identifier: MIT
// Repairs of this program first, then those of sunder-repair.
#include "apps/sunder/break/mend.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "apps/sunder/process/run_process.hpp"
#include "topology/base/counted.hpp"
#include "topology/io/mesh_file.hpp"
#include "topology/mesh/box_tree.hpp"
#include "topology/mesh/surface/repair/surface_repair.hpp"
#include "topology/mesh/surface/surface_gap.hpp"

namespace sunder {
namespace {

namespace fs = std::filesystem;

/// A union that takes longer gives way to a wrap, which is given as long.
constexpr std::chrono::seconds longest_repair{90};

/// A wrap sees nothing narrower than this share of the longest side.
constexpr double wrap_share = 1.0 / 80;

Finding refused(const char* code, std::string text, std::string remedy) {
  return {.code = code, .text = std::move(text), .remedy = std::move(remedy)};
}

const Finding* finding_of(const SurfaceCheck& check, std::string_view code) {
  const auto found = std::ranges::find(check.findings, code, &Finding::code);
  return found == check.findings.end() ? nullptr : &*found;
}

std::string place_words(const Point& p) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", p[0], p[1], p[2]);
}

/// Where the first cell or edge of a finding is.
std::string place_of(const FileMesh& surface, const Finding& f, bool are_faces) {
  if (f.ids.empty()) return {};
  const auto id = static_cast<std::size_t>(f.ids[0]);
  const std::size_t row = are_faces ? surface.triangles.corners[id][0] : id;
  return " at " + place_words(surface.points[row]);
}

constexpr const char* unrepaired = "; leave out --repair none for a repair";

Finding open_surface(const FileMesh& surface, const SurfaceCheck& check, const SurfaceRepair& tried,
                     Mending mending) {
  const Finding* open = finding_of(check, "open_edge");
  const std::string place = tried.wide_holes > 0 ? " at " + place_words(tried.place_left)
                            : open != nullptr    ? place_of(surface, *open, false)
                                                 : std::string();
  return refused(
      "open_surface",
      fmt::format(
          "the surface is open: {} of one face only{}",
          counted(check.boundary_edges, "edge", "edges"),
          tried.wide_holes > 0
              ? fmt::format(", {} left, wider than three tenths of the object or of no simple "
                            "rim, the widest {:.3g}{}",
                            counted(tried.wide_holes, "hole"), tried.widest_left, place)
              : place),
      fmt::format(
          "close its holes, in Blender by Mesh > Clean Up > Fill Holes; give a sheet a "
          "thickness, in Blender by the modifier Solidify{}",
          mending == Mending::none ? unrepaired : "; or have it wrapped as it is: --repair wrap"));
}

/// Why a surface encloses no solid; none where it does.
std::optional<Finding> fault_of(const FileMesh& surface, const SurfaceCheck& check,
                                const SurfaceRepair& tried, Mending mending) {
  const std::string again = mending == Mending::none ? unrepaired : "";
  if (check.triangles == 0) {
    return refused("no_faces", "the file has neither tetrahedra nor faces with an area",
                   "give a closed surface (STL, OBJ, PLY, OFF) or a mesh of tetrahedra");
  }
  if (check.boundary_edges > 0) return open_surface(surface, check, tried, mending);
  if (const Finding* thick = finding_of(check, "nonmanifold_edge")) {
    return refused(
        "nonmanifold_surface",
        fmt::format("three faces or more meet at {}{}", counted(thick->count, "edge", "edges"),
                    place_of(surface, *thick, false)),
        "remove inner walls and doubled faces, in Blender by the modifier Remesh" + again);
  }
  if (check.crosses_itself == true) {
    const Finding* crossing = finding_of(check, "self_intersection");
    return refused(
        "self_intersection",
        fmt::format("the surface crosses itself: {} of faces go through each other{}",
                    counted(crossing->count, "pair", "pairs"), place_of(surface, *crossing, true)),
        "join the parts into one surface, in Blender by the modifier Boolean or Remesh, "
        "in OpenSCAD by union()" +
            again);
  }
  if (!check.volume || std::abs(*check.volume) > 0) return std::nullopt;
  return refused("no_volume", "the surface encloses no volume", "give the object a thickness");
}

/// The program sunder-repair, in the folder of this program or in PATH.
std::optional<fs::path> find_repairer() {
  std::error_code none;
  const fs::path own = own_program().parent_path() / "sunder-repair";
  if (fs::is_regular_file(own, none)) return own;
  return find_program("sunder-repair");
}

/// A surface by sunder-repair, and the words for its work.
struct Healed {
  FileMesh surface;
  std::string words;
};

std::string words_of(const std::string& printed, double alpha) {
  const nlohmann::json answer =
      nlohmann::json::parse(printed.substr(printed.rfind('{', printed.size())), nullptr, false);
  if (answer.is_discarded() || !answer.contains("method")) return "repaired by sunder-repair";
  if (answer["method"] == "wrap") {
    return fmt::format("wrapped into one surface, in which nothing narrower than {:.3g} shows",
                       alpha);
  }
  const auto shells = answer.value("shells", std::size_t{1});
  const auto crossed = answer.value("crossing_shells", std::size_t{0});
  std::string words;
  if (shells > 1) words = fmt::format("{} joined", counted(shells, "closed shell"));
  if (crossed > 0) {
    words += fmt::format("{}crossings of {} cut away", words.empty() ? "" : ", ",
                         counted(crossed, "shell"));
  }
  return words.empty() ? "cleaned" : words;
}

double longest_side(const FileMesh& surface) {
  if (surface.points.empty()) return 0;
  BoundingBox box{surface.points[0], surface.points[0]};
  for (const Point& p : surface.points) extend(box, p);
  return longest_side(box);
}

Result<Healed> heal(const FileMesh& surface, bool wrap_only) {
  const auto program = find_repairer();
  if (!program) {
    return refused("no_repairer", "sunder-repair, which joins and wraps surfaces, is not built",
                   "cmake --build build/release --target sunder-repair");
  }
  const TemporaryFolder folder;
  std::vector<Finding> unwritten = write_file_mesh(folder.path() / "faulty.off", surface);
  if (has_error(unwritten)) return unwritten.front();
  const double alpha = wrap_share * longest_side(surface);
  std::vector<std::string> words = {"faulty.off", "healed.off", "--alpha",
                                    fmt::format("{:.9g}", alpha)};
  if (wrap_only) words.emplace_back("--wrap");
  const ProcessEnd end = run_process(*program, words, folder.path(), longest_repair);
  if (end.took_too_long && !wrap_only) return heal(surface, true);
  Result<FileMesh> mesh;
  if (end.exit_code == 0) mesh = read_file_mesh(folder.path() / "healed.off");
  if (!mesh) {
    return refused("not_repaired",
                   end.took_too_long
                       ? fmt::format("it did not end within {} s", longest_repair.count())
                       : end.words,
                   "repair it in a mesh editor");
  }
  return Healed{std::move(*mesh), words_of(end.words, alpha)};
}

/// The volume of a closed surface, without sign; 0 where it is not known.
double volume_of(const SurfaceCheck& check) { return check.volume ? std::abs(*check.volume) : 0; }

/// All that was done to a surface, with the way it moved.
Finding repaired(const FileMesh& before, const FileMesh& after, double old_volume,
                 double new_volume, const std::vector<std::string>& words) {
  const SurfaceGap gap =
      gap_between(before.points, before.triangles.corners, after.points, after.triangles.corners);
  std::string text = fmt::format(
      "repaired the surface: {}; it moved by {:.2g} at most in the "
      "file's unit, {:.2g} % of the longest side",
      fmt::join(words, ", "), gap.largest, 100 * gap.largest / longest_side(before));
  if (old_volume > 0 && new_volume > 0) {
    text += fmt::format(", volume {:+.2g} %", 100 * (new_volume / old_volume - 1));
  }
  return {.code = "repaired",
          .severity = Severity::note,
          .text = std::move(text),
          .remedy = "look at the pictures; --repair none refuses faulty surfaces"};
}

std::optional<Finding> several_parts(std::size_t parts) {
  if (parts < 2) return std::nullopt;
  return Finding{
      .code = "several_parts",
      .severity = Severity::note,
      .text = fmt::format("the surface has {} that do not touch", counted(parts, "closed part")),
      .remedy =
          "nothing, if it is meant so: inner ones are cavities where they look "
          "inward"};
}

/// A surface on its way to one that bounds a body.
struct Patient {
  FileMesh surface;
  Mending mending;
  SurfaceCheck check = {};
  SurfaceRepair tried = {};
  std::vector<std::string> words = {};  ///< for the repairs so far
  std::optional<Finding> fault = {};

  void look() {
    check = check_surface(surface);
    fault = fault_of(surface, check, tried, mending);
  }
};

/// Small faults, by this program.
void repair_small(Patient& p) {
  const bool is_turned = p.check.is_closed && !p.check.is_oriented;
  if (p.mending == Mending::none || p.check.triangles == 0 || !(p.fault || is_turned)) return;
  p.tried = repair_surface(p.surface, small_hole * longest_side(p.surface));
  p.words = repair_words(p.tried);
  p.look();
}

/// Crossings, and with `wrap` holes, by sunder-repair.
void heal_rest(Patient& p) {
  if (!p.fault || p.mending == Mending::none || p.check.triangles == 0) return;
  const bool crosses =
      p.fault->code == "self_intersection" || p.fault->code == "nonmanifold_surface";
  if (!crosses && p.mending != Mending::wrap) return;
  Result<Healed> healed = heal(p.surface, !crosses);
  if (!healed) {
    p.fault->remedy += fmt::format("; {}: {}", healed.findings[0].text, healed.findings[0].remedy);
    return;
  }
  p.surface = std::move(healed->surface);
  p.words.push_back(std::move(healed->words));
  p.look();
}

}  // namespace

Result<Mended> mend(FileMesh surface, Mending mending) {
  Result<Mended> result;
  const FileMesh before = surface;
  Patient patient{std::move(surface), mending};
  patient.look();
  const double old_volume = volume_of(patient.check);
  repair_small(patient);
  heal_rest(patient);
  if (patient.fault) {
    result.findings.push_back(std::move(*patient.fault));
    return result;
  }
  const double volume = volume_of(patient.check);
  if (!patient.words.empty()) {
    result.findings.push_back(repaired(before, patient.surface, old_volume, volume, patient.words));
  }
  if (auto parts = several_parts(patient.check.components)) {
    result.findings.push_back(std::move(*parts));
  }
  result.value = Mended{std::move(patient.surface), volume};
  return result;
}

Result<Mended> wrapped(const FileMesh& surface) {
  Result<Healed> healed = heal(surface, true);
  if (!healed) return healed.findings.front();
  const SurfaceCheck check = check_surface(healed->surface);
  if (auto fault = fault_of(healed->surface, check, {}, Mending::wrap)) return *fault;
  const double old_volume = volume_of(check_surface(surface)), volume = volume_of(check);
  Result<Mended> result;
  result.findings.push_back(
      repaired(surface, healed->surface, old_volume, volume, {healed->words}));
  result.value = Mended{std::move(healed->surface), volume};
  return result;
}

}  // namespace sunder
