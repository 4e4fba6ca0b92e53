// SPDX-License-Identifier: MIT
// `sunder bench paper` from outside: every table has its rows, and CSV and Markdown say the same.
#include <catch2/catch.hpp>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/program.hpp"

using namespace sunder::test;

namespace {

std::vector<std::string> split(const std::string& line, char at) {
  std::vector<std::string> cells;
  std::string cell;
  for (std::istringstream in(line); std::getline(in, cell, at);) cells.push_back(cell);
  if (line.ends_with(at)) cells.emplace_back();
  return cells;
}

/// Value by "scene mode quantity".
std::map<std::string, double> read_csv(const std::string& path) {
  std::map<std::string, double> values;
  std::ifstream file(path);
  std::size_t row = 0;
  for (std::string line; std::getline(file, line); ++row) {
    if (row < 2) CHECK(line.starts_with("# "));
    if (row == 2) CHECK(line == "table,scene,mode,quantity,unit,value");
    if (row <= 2) continue;
    const std::vector<std::string> cells = split(line, ',');
    INFO(line);
    REQUIRE(cells.size() == 6);
    CHECK(values.emplace(cells[1] + ' ' + cells[2] + ' ' + cells[3], std::stod(cells[5])).second);
  }
  return values;
}

/// Rows of the Markdown table under a heading that begins so; the first is its head.
std::vector<std::vector<std::string>> read_markdown(const std::string& path,
                                                    const std::string& heading) {
  std::vector<std::vector<std::string>> rows;
  std::ifstream file(path);
  bool inside = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("## ")) inside = line.starts_with("## " + heading);
    if (!inside || !line.starts_with("| ") || line.starts_with("| ---")) continue;
    std::vector<std::string> cells;
    for (const std::string& cell : split(line, '|')) {
      if (cell.size() >= 2) cells.push_back(cell.substr(1, cell.size() - 2));
    }
    rows.push_back(std::move(cells));
  }
  return rows;
}

}  // namespace

TEST_CASE("the paper's tables are all there, ours beside, the same in text, CSV and Markdown",
          "[apps][bench][paper]") {
  const Workplace here;
  const Outcome outcome = here.run(
      {"bench", "paper", "--quick", "--csv", here.path("p.csv"), "--markdown", here.path("p.md")});
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  const std::map<std::string, double> csv = read_csv(here.path("p.csv"));
  const auto table = [&](const char* heading) { return read_markdown(here.path("p.md"), heading); };
  // Heads; then three scenes with the paper's line and one a mode.
  CHECK(table("Table 1").size() == 1 + 3 * 2);
  CHECK(table("Table 2").size() == 1 + 3 * 6);
  CHECK(table("Table 3").size() == 1 + 3 * 3);
  CHECK(table("Table 4").size() == 1 + 3 * 3);
  CHECK(table("Work").size() == 1 + 3 * 2);
  CHECK(table("Steps with").size() == 1 + 3 * 5);
  CHECK(table("Threshold").size() == 1 + 3);
  CHECK(table("Claims").size() == 1 + 20);

  // The paper's own.
  CHECK(csv.at("bunny paper fracture_max") == 1320);
  CHECK(csv.at("monolith paper predictions") == 119);
  // Ours: figures of every mode, and related figures agree.
  for (const char* mode :
       {"paper_mode", "broyden_mass", "broyden_factor", "one_solve", "defaults"}) {
    for (const std::string scene : {"monolith", "block", "bunny"}) {
      const auto value = [&](const char* quantity) {
        return csv.at(scene + ' ' + mode + ' ' + quantity);
      };
      INFO(scene << ' ' << mode);
      for (const std::string column : {"corotational", "model", "fracture"}) {
        CHECK(value((column + "_av").c_str()) > 0);
        CHECK(value((column + "_max").c_str()) >= value((column + "_av").c_str()));
      }
      CHECK(value("creations") <= value("fractures"));
      CHECK(value("pieces") == 1 + value("components_created"));
    }
  }
  CHECK(csv.at("monolith paper_mode fractures") > 0);
  CHECK(csv.at("monolith paper_mode missed") == 0);

  // Markdown rounds the CSV's values, and the text has the same cells.
  const auto rows = table("Table 2");
  REQUIRE(rows[0].size() == 10);
  const double average = csv.at("monolith paper_mode model_av");
  CHECK(std::stod(rows[2][4]) == Approx(average).epsilon(0.006));
  CHECK(rows[1][9] == "-");
  const auto counts = table("Table 3");
  CHECK(std::stod(counts[2][3]) == csv.at("monolith paper_mode fractures"));
  for (const auto& heading : {"Table 1", "Table 3", "Claims"}) {
    for (const auto& row : table(heading)) {
      for (const std::string& cell : row) CHECK(outcome.out.find(cell) != std::string::npos);
    }
  }
}

TEST_CASE("the bench of the paper refuses what is no folder of scenes", "[apps][bench][paper]") {
  const Workplace here;
  const Outcome outcome = here.run({"bench", "paper", "--scenes", here.path("nowhere")});
  CHECK(outcome.exit_code == 3);
  CHECK(outcome.err.find("monolith.json") != std::string::npos);
  CHECK(here.run({"bench", "paper", "--runs", "0"}).exit_code == 2);
}
