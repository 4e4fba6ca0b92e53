// SPDX-License-Identifier: MIT
// `sunder refine`: the command line, and which tetrahedra it makes finer.
#include "apps/sunder/mesh/refine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <optional>

#include "apps/scene/words.hpp"
#include "apps/sunder/mesh/divided_mesh.hpp"
#include "apps/sunder/mesh/near_crack.hpp"
#include "topology/base/counted.hpp"
#include "topology/cells/refine.hpp"
#include "topology/kernel/plane_side.hpp"
#include "topology/mesh/crack.hpp"

namespace sunder {
namespace {

constexpr const char* refine_footer = R"(
Each level divides every chosen tetrahedron into eight (red refinement, Bey 1995) and its neighbours
into two or four so that faces fit. Tetrahedra divided to fit are never divided again, so shapes do not
get worse with levels. Without --region, --plane and --crack all tetrahedra are chosen. With several
of them, those that any chooses. The choice is made again on each level.
Triangles, edges, regions, entities and data are kept. Points on edges get values between those of
the ends (whole numbers: of the nearer end). Parts get the values of their parent, with --share by
volume. Old points keep their rows, and both sides of a crack are divided alike.

Exit codes: 0 written, 2 usage (also a choice of no tetrahedron), 3 the mesh cannot be read or has no map, 4 OUT not written.

Examples:
  sunder refine body.msh fine.msh
  sunder refine body.msh fine.vtu --region inclusion --levels 2
  sunder refine body.msh fine.msh --plane 1,0,0,0.5 --within 0.02 --levels 3
  sunder refine cracked.vtu fine.vtu --crack --within 0.01
)";

struct RefineArguments : DivideArguments {
  std::size_t levels = 1;
  std::vector<std::string> regions;
  std::string plane;
  bool crack = false;
  double within = 0;
};

/// Whether the tetrahedron comes nearer to the plane than `within`, m, or meets it.
WantedCells near_plane(const PlaneThrough& plane, double within) {
  const double length =
      std::sqrt(plane.normal[0] * plane.normal[0] + plane.normal[1] * plane.normal[1] +
                plane.normal[2] * plane.normal[2]);
  return [=](const VolumeMap& map, TetId t, TetId) {
    double low = INFINITY, high = -INFINITY;
    for (const VertexId v : map.corners(t)) {
      const Point& x = map.point(v);
      double d = 0;
      for (std::size_t i = 0; i < 3; ++i) d += plane.normal[i] * (x[i] - plane.at[i]) / length;
      low = std::min(low, d), high = std::max(high, d);
    }
    return low <= within && high >= -within;
  };
}

/// The choices of the arguments; none chooses all.
Result<std::vector<WantedCells>> choices(const RefineArguments& arguments,
                                         const DividedMesh& body) {
  std::vector<WantedCells> wanted;
  if (!arguments.plane.empty()) {
    const std::vector<double> x = *numbers_of(arguments.plane, 4);
    const auto plane = read_plane({{x[0], x[1], x[2]}, x[3]});
    if (!plane) {
      return Finding{.code = "not_a_direction",
                     .text = "the plane's normal is zero or a number of it is not finite",
                     .remedy = "give a normal of three finite numbers, not all zero"};
    }
    wanted.push_back(near_plane(*plane, arguments.within));
  }
  if (arguments.crack) {
    auto crack = std::make_shared<CrackFaces>(crack_faces(body.map, arguments.within));
    if (crack->triangles.empty()) {
      return Finding{.code = "no_crack",
                     .text = "no two boundary faces of the mesh lie on each other",
                     .remedy =
                         "open a crack first, for example sunder convert FILE NEW --crack-plane "
                         "1,0,0,D, or leave --crack out"};
    }
    wanted.emplace_back([crack, within = arguments.within](const VolumeMap& map, TetId t, TetId) {
      return is_near(*crack, map, t, within);
    });
  }
  if (!arguments.regions.empty()) {
    std::set<std::int32_t> numbers;
    for (const std::string& word : arguments.regions) {
      const Result<std::int32_t> number = region_called(body.mesh, word);
      if (!number) return number.findings.front();
      numbers.insert(*number);
    }
    const std::vector<std::int32_t> labels = label_of(body.mesh.tetrahedra);
    wanted.emplace_back([labels, numbers](const VolumeMap&, TetId, TetId of) {
      return numbers.contains(labels[of.index()]);
    });
  }
  return wanted;
}

/// The counts of each level, as lines and as JSON.
void tell(const std::vector<RefinedLevel>& levels, const DividedFile& file, std::string& lines,
          nlohmann::ordered_json& json) {
  json["levels"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const RefinedLevel& level = levels[i];
    lines += fmt::format("level {}: {} into eight, {} divided to fit, {}\n", i + 1,
                         counted_tetrahedra(level.red), level.green,
                         counted(level.edit.vertices.size(), "new vertex", "new vertices"));
    json["levels"].push_back(
        {{"red", level.red}, {"green", level.green}, {"new_vertices", level.edit.vertices.size()}});
  }
  if (file.numbers_added > 0) {
    lines += fmt::format("{} behind the file's highest for new points and cells\n",
                         counted(file.numbers_added, "number"));
  }
  json["numbers_added"] = file.numbers_added;
}

Finding too_many(std::size_t levels) {
  return {.code = "too_many_tetrahedra",
          .text = fmt::format("the levels make more than {} tetrahedra", most_refined),
          .remedy = levels == 0
                        ? std::string("each level of all makes eight times as many: give fewer")
                        : fmt::format("{} {} within that", counted(levels, "level"),
                                      for_count(levels, "is", "are"))};
}

ExitCode run_refine(const RefineArguments& arguments) {
  Stages stages(arguments);
  Result<DividedMesh> body = read_to_divide(arguments.in, arguments.kernel);
  if (!body) return refuse(arguments, body.findings, ExitCode::bad_input);
  stages.done(fmt::format("read {} and built its map", arguments.in.string()));
  const auto shared = shared_columns(arguments, body->mesh);
  if (!shared) return refuse(arguments, shared.findings, ExitCode::usage);
  const auto wanted = choices(arguments, *body);
  if (!wanted) return refuse(arguments, wanted.findings, ExitCode::usage);
  const double uniform = std::pow(8.0, static_cast<double>(arguments.levels));
  if (wanted->empty() &&
      uniform * static_cast<double>(body->map.tetrahedra()) > static_cast<double>(most_refined)) {
    return refuse(arguments, {too_many(0)}, ExitCode::usage);
  }
  const std::vector<RefinedLevel> levels =
      refine(body->map, arguments.levels, [&](const VolumeMap& map, TetId t, TetId of) {
        return wanted->empty() || std::ranges::any_of(*wanted, [&](const auto& is_wanted) {
                 return is_wanted(map, t, of);
               });
      });
  if (levels.size() < arguments.levels)
    return refuse(arguments, {too_many(levels.size())}, ExitCode::usage);
  if (std::ranges::none_of(levels, [](const RefinedLevel& l) { return l.red > 0; })) {
    return refuse(
        arguments,
        {{.code = "nothing_chosen",
          .text = "no tetrahedron is near what was named",
          .remedy = "`sunder check` prints the size of the body; give another plane, or a larger "
                    "--within"}},
        ExitCode::usage);
  }
  std::vector<CellEdit> edits;
  for (const RefinedLevel& level : levels) edits.push_back(level.edit);
  const DividedFile file = divide_file(body->mesh, body->map, edits, *shared);
  std::string lines;
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  tell(levels, file, lines, json);
  stages.done("divided the tetrahedra");
  return finish(arguments, *body, lines, json);
}

std::string check_distance(const std::string& word) {
  const auto number = numbers_of(word, 1);
  return number && number->front() >= 0 && std::isfinite(number->front())
             ? ""
             : "'" + word + "' is no distance: a number of metres, 0 or more";
}

}  // namespace

void add_refine_command(CLI::App& program, ExitCode& exit_code) {
  const auto arguments = std::make_shared<RefineArguments>();
  CLI::App* command =
      program.add_subcommand("refine", "Make the tetrahedra of a mesh finer, all or some");
  add_divide_arguments(*command, *arguments);
  command->add_option("--levels", arguments->levels, "Number of refinements (default 1)")
      ->type_name("N")
      ->check(CLI::Range(1, 12));
  command
      ->add_option("--region", arguments->regions,
                   "Refine tetrahedra of this region, by number or name; may be repeated")
      ->type_name("R");
  CLI::Option* plane =
      command
          ->add_option(
              "--plane", arguments->plane,
              "Refine tetrahedra that the plane NX x + NY y + NZ z = D meets or nearly meets")
          ->type_name("NX,NY,NZ,D")
          ->check(CLI::Validator(check_plane, "", "plane"));
  CLI::Option* crack =
      command->add_flag("--crack", arguments->crack,
                        "Refine tetrahedra at cracks: boundary faces that lie on each other");
  command
      ->add_option("--within", arguments->within,
                   "Distance to the plane or crack that still counts, m (default 0: only those "
                   "that meet it)")
      ->type_name("DISTANCE")
      ->check(CLI::Validator(check_distance, "", "distance"))
      ->check(CLI::Validator(
          [plane, crack](const std::string&) {
            return plane->count() + crack->count() > 0
                       ? std::string()
                       : "there is nothing to be near to: give --plane or --crack first";
          },
          "", "near"));
  command->footer(refine_footer);
  command->callback([=, &exit_code] { exit_code = run_refine(*arguments); });
}

}  // namespace sunder
