// SPDX-License-Identifier: MIT
// Grids of cells, laid out twice.
#include "apps/bench/paper/bench_paper_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "apps/bench/paper/bench_paper_claims.hpp"
#include "apps/bench/paper/bench_paper_tables.hpp"

namespace sunder {
namespace {

struct Grid {
  std::string title;
  std::string note;  ///< below the title; may be empty
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
};

/// A column of figures.
struct Column {
  std::string_view quantity;
  std::string head;
  std::string (*format)(double);
};

std::string count(double value) { return fmt::format("{:.0f}", value); }
std::string percent(double value) { return fmt::format("{:.1f}%", 100 * value); }
std::string digits(double value) {
  return value >= 100 ? count(value) : fmt::format("{:.3g}", value);
}

using ModeFilter = bool (*)(std::string_view);

/// A line a scene and mode: the paper's first.
Grid grid_of(const PaperBench& bench, const std::vector<Column>& columns, ModeFilter shown) {
  Grid grid;
  grid.head = {"Scenarios", ""};
  for (const Column& column : columns) grid.head.push_back(column.head);
  for (const PaperScene& scene : paper_scenes()) {
    const auto add = [&](std::string_view mode, std::string_view text) {
      std::vector<std::string> row = {std::string(scene.title), std::string(text)};
      bool any = false;
      for (const Column& column : columns) {
        const std::optional<double> value = figure_of(bench, scene.name, mode, column.quantity);
        row.push_back(value ? column.format(*value) : "-");
        any = any || value;
      }
      if (any || mode != theirs) grid.rows.push_back(std::move(row));
    };
    add(theirs, "paper");
    for (const PaperMode& mode : paper_modes()) {
      if (shown(mode.name)) add(mode.name, mode.text);
    }
  }
  return grid;
}

bool paper_mode(std::string_view mode) { return mode == paper_modes().front().name; }
bool both(std::string_view mode) { return paper_mode(mode) || mode == paper_modes().back().name; }
bool every(std::string_view) { return true; }

Grid table_1(const PaperBench& bench) {
  Grid grid = grid_of(bench, {{"tetrahedra", "#Tetras", count}, {"vertices", "#Vertices", count}},
                      paper_mode);
  grid.title = "Table 1: scenarios and their characteristics";
  return grid;
}

Grid table_2(const PaperBench& bench) {
  Grid grid = grid_of(bench,
                      {{"corotational_av", "Corotational av.", digits},
                       {"corotational_max", "max.", digits},
                       {"model_av", "Our method av.", digits},
                       {"model_max", "max.", digits},
                       {"fracture_av", "With fractures av.", digits},
                       {"fracture_max", "max.", digits},
                       {"steps", "Steps", count},
                       {"given_up", "Given up", percent}},
                      every);
  grid.title = "Table 2: times of a step, ms, collision included";
  grid.note =
      "Given up: steps without fractures in which iterations did not converge, and the "
      "factor took over.";
  return grid;
}

Grid table_3(const PaperBench& bench) {
  Grid grid = grid_of(bench,
                      {{"gershgorin_efficiency", "Gershgorin efficiency", percent},
                       {"fractures", "#fractures", count},
                       {"creations", "#CC creations", count},
                       {"creation_ratio", "ratio", percent},
                       {"predictions", "#new CC predictions", count},
                       {"prediction_ratio", "ratio", percent},
                       {"oracle_efficiency", "efficiency", percent},
                       {"face_predictions", "faces that predicted", count},
                       {"components_created", "components created", count}},
                      both);
  grid.title = "Table 3: efficiency of Gershgorin's test and of the split-vertex oracle";
  grid.note = "Counts are fans that split a face; the last two columns are ours alone.";
  return grid;
}

Grid table_4(const PaperBench& bench) {
  Grid grid = grid_of(bench,
                      {{"walk_new", "Without oracle, new CC", digits},
                       {"walk_none", "no new CC", digits},
                       {"oracle_new", "With oracle, new CC", digits},
                       {"oracle_none", "no new CC", digits},
                       {"dirty_new", "Dirty counter, new CC", digits},
                       {"dirty_none", "no new CC", digits},
                       {"exact_new", "Lockstep, new CC", digits},
                       {"exact_none", "no new CC", digits}},
                      both);
  grid.title = "Table 4: times of a rupture (a fan), ms";
  grid.note =
      "Ours: plane, faces, rows, components and strengths of one fan; means over the fans "
      "of the run, cut again.";
  return grid;
}

Grid met_table(const PaperBench& bench) {
  Grid grid = grid_of(bench,
                      {{"walk_new_met", "Without oracle, new CC", count},
                       {"walk_none_met", "no new CC", count},
                       {"oracle_new_met", "With oracle, new CC", count},
                       {"oracle_none_met", "no new CC", count},
                       {"exact_new_met", "Lockstep, new CC", count},
                       {"exact_none_met", "no new CC", count}},
                      both);
  grid.title = "Work of a rupture: tetrahedra met by splits, search and strengths";
  return grid;
}

Grid largest_steps(const PaperBench& bench) {
  Grid grid = grid_of(bench,
                      {{"fracture_median", "median, ms", digits},
                       {"fracture_max", "max., ms", digits},
                       {"fracture_max_step", "at step", count},
                       {"first_break", "first fans", count},
                       {"breaking_steps", "steps with fans", count},
                       {"phases", "phases", count},
                       {"max_in_phase", "place in its phase", count},
                       {"phase_length", "of", count},
                       {"later_near_max", "later above 0.9 max.", count},
                       {"fracture_share", "fracture's share", percent}},
                      every);
  std::erase_if(grid.rows, [](const auto& row) { return row[1] == "paper"; });
  grid.title = "Steps with fractures: where the largest lies";
  grid.note =
      "A phase ends where ten steps in a row have no fan. Share: of the fracture process in "
      "the steps with fans.";
  return grid;
}

Grid test_table(const PaperBench& bench) {
  Grid grid = grid_of(bench,
                      {{"test_eigenvalues", "eigenvalues", digits},
                       {"test_gershgorin", "bound, eigenvalues", digits},
                       {"test_exact", "minors", digits},
                       {"test_chain", "bound, minors", digits},
                       {"test_bound", "bound alone", digits}},
                      paper_mode);
  grid.title = "Threshold tests, ns a vertex";
  return grid;
}

Grid claim_table(const PaperBench& bench) {
  Grid grid{"Claims of section 5",
            "Ours in the paper's mode, linearised implicit Euler; \"-\": no figure.",
            {"Claim"},
            {}};
  for (const char* whose : {"paper", "ours"}) {
    for (const PaperScene& scene : paper_scenes()) {
      grid.head.push_back(fmt::format("{}, {}", scene.name, whose));
    }
  }
  grid.head.emplace_back("verdict");
  for (const PaperClaim& claim : paper_claims(bench)) {
    std::vector<std::string> row = {claim.text};
    row.insert(row.end(), claim.paper.begin(), claim.paper.end());
    row.insert(row.end(), claim.ours.begin(), claim.ours.end());
    row.push_back(claim.verdict);
    grid.rows.push_back(std::move(row));
  }
  return grid;
}

std::vector<Grid> grids(const PaperBench& bench) {
  return {table_1(bench),   table_2(bench),       table_3(bench),    table_4(bench),
          met_table(bench), largest_steps(bench), test_table(bench), claim_table(bench)};
}

std::string heading(const PaperBench& bench) {
  std::string out = fmt::format("{}; ", bench.machine);
  out += bench.runs > 1 ? fmt::format("medians of {} runs of everything", bench.runs) : "one run";
  out += bench.quick ? "; --quick: the beginnings of the scenes\n"
                     : "; parts of the scenes as the column of steps says\n";
  return out;
}

void append_aligned(std::string& out, const Grid& grid) {
  std::vector<std::size_t> width;
  for (const std::string& cell : grid.head) width.push_back(cell.size());
  for (const auto& row : grid.rows) {
    for (std::size_t k = 0; k < row.size(); ++k) width[k] = std::max(width[k], row[k].size());
  }
  const auto line = [&](const std::vector<std::string>& cells) {
    std::string text;
    for (std::size_t k = 0; k < cells.size(); ++k) {
      // Names to the left, figures to the right.
      const bool left = k == 0 || grid.head[k].empty();
      text += left ? fmt::format("{:<{}}", cells[k], width[k])
                   : fmt::format("  {:>{}}", cells[k], width[k]);
      if (left && k == 0) text += "  ";
    }
    text.erase(text.find_last_not_of(' ') + 1);
    out += text + '\n';
  };
  out += fmt::format("\n{}\n", grid.title);
  if (!grid.note.empty()) out += grid.note + '\n';
  line(grid.head);
  for (const auto& row : grid.rows) line(row);
}

void append_markdown(std::string& out, const Grid& grid) {
  const auto line = [&](const std::vector<std::string>& cells) {
    for (const std::string& cell : cells) out += "| " + cell + " ";
    out += "|\n";
  };
  out += fmt::format("\n## {}\n\n", grid.title);
  if (!grid.note.empty()) out += grid.note + "\n\n";
  line(grid.head);
  line(std::vector<std::string>(grid.head.size(), "---"));
  for (const auto& row : grid.rows) line(row);
}

void append_notes(std::string& out, const PaperBench& bench, const char* bullet) {
  if (bench.notes.empty()) return;
  out += "\nRuns that ended early:\n";
  if (*bullet != ' ') out += '\n';
  for (const std::string& note : bench.notes) out += fmt::format("{} {}\n", bullet, note);
}

}  // namespace

std::string paper_text(const PaperBench& bench) {
  std::string out = heading(bench);
  for (const Grid& grid : grids(bench)) append_aligned(out, grid);
  append_notes(out, bench, " ");
  return out;
}

std::string paper_markdown(const PaperBench& bench) {
  std::string out = "# The paper's tables, and ours\n\n" + heading(bench);
  for (const Grid& grid : grids(bench)) append_markdown(out, grid);
  append_notes(out, bench, "-");
  return out;
}

std::string paper_csv(const PaperBench& bench) {
  std::string out = fmt::format("# sunder bench paper on {}\n# {} runs{}\n", bench.machine,
                                bench.runs, bench.quick ? ", quick" : "");
  out += "table,scene,mode,quantity,unit,value\n";
  for (const PaperQuantity& q : paper_quantities()) {
    for (const PaperFigure& f : bench.figures) {
      if (f.quantity != q.name) continue;
      fmt::format_to(std::back_inserter(out), "{},{},{},{},{},{:.6g}\n", q.table, f.scene, f.mode,
                     q.name, q.unit, f.value);
    }
  }
  return out;
}

}  // namespace sunder
