// SPDX-License-Identifier: MIT
// `sunder bench kernel` from outside: its counts obey closed forms, its files can be read.
#include <stdlib.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "tests/support/outside.hpp"
#include "tests/support/program.hpp"

using namespace sunder::test;
using nlohmann::json;

namespace {

using Figures = std::map<std::string, std::map<std::string, double>>;

Figures figures_of(const json& answer) {
  Figures figures;
  for (const json& f : answer["figures"]) figures[f["body"]][f["quantity"]] = f["value"];
  return figures;
}

/// PATH without anything in it, until the end of the scope.
struct NoPrograms {
  std::string before = getenv("PATH");
  NoPrograms() { setenv("PATH", "/nonexistent", 1); }
  ~NoPrograms() { setenv("PATH", before.c_str(), 1); }
};

}  // namespace

TEST_CASE("the quick kernel bench tells counts that can be checked", "[apps][bench]") {
  const Workplace here;
  const Outcome outcome = here.run(
      {"bench", "kernel", "--quick", "--runs", "1", "--json", "--csv", here.path("k.csv")});
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  const json answer = outcome.json();
  const Figures figures = figures_of(answer);
  REQUIRE(figures.size() == 4);
  CHECK(answer["runs"] == 1);
  for (const auto& [body, of] : figures) {
    INFO(body);
    const double tetrahedra = std::stod(body.substr(body.find(' ')));
    for (const std::string when : {"bytes_intact", "bytes_shattered"}) {
      double sum = 0;
      for (const char* part : {"darts", "attributes", "adjacency", "handles", "vertex_columns"}) {
        sum += of.at(when + "_" + part);
      }
      CHECK(of.at(when) == Approx(sum).epsilon(1e-12));
    }
    CHECK(of.at("bytes_intact") < of.at("bytes_shattered"));
    for (const std::string order : {"given", "paper"}) {
      const auto oracle = [&](const char* name) { return of.at("oracle_" + order + "_" + name); };
      // One body falls into single tetrahedra: so many separations, each with a yes of its own.
      CHECK(oracle("faces_yes") - oracle("faces_false") == tetrahedra - 1);
      // A false yes cuts a handle; all that there were are cut in the end.
      CHECK(oracle("faces_false") >= of.at("oracle_betti_1"));
      CHECK(oracle("fans_yes") >= oracle("fans_parting"));
      CHECK(oracle("fan_efficiency") ==
            Approx(100 * oracle("fans_parting") / oracle("fans_yes")).epsilon(1e-12));
    }
    for (const std::string prefix : {"search_kept_visited_", "search_parted_visited_"}) {
      CHECK(of.at(prefix + "walk") >= of.at(prefix + "dirty_counter"));
      CHECK(of.at(prefix + "dirty_counter") >= of.at(prefix + "oracle"));
      CHECK(of.at(prefix + "oracle") >= of.at(prefix + "exact"));
    }
    for (const auto& [quantity, value] : of) {
      INFO(quantity);
      CHECK(value >= 0);
    }
  }
  CHECK(figures.at("cube 384").at("quiet_visited") == figures.at("cube 6000").at("quiet_visited"));

  std::ifstream csv(here.path("k.csv"));
  std::string line;
  std::getline(csv, line);
  CHECK(line == "# sunder bench kernel on " + answer["machine"].get<std::string>());
  std::getline(csv, line);
  std::getline(csv, line);
  CHECK(line == "body,tetrahedra,quantity,unit,value");
  std::size_t rows = 0;
  while (std::getline(csv, line)) {
    std::istringstream fields(line);
    std::string body, count, quantity, unit, value;
    std::getline(fields, body, ',');
    std::getline(fields, count, ',');
    std::getline(fields, quantity, ',');
    std::getline(fields, unit, ',');
    std::getline(fields, value);
    CHECK(body.substr(body.find(' ') + 1) == count);
    CHECK(figures.at(body).at(quantity) == Approx(std::stod(value)).epsilon(1e-5).margin(1e-9));
    CHECK_FALSE(unit.empty());
    ++rows;
  }
  CHECK(rows == answer["figures"].size());
}

TEST_CASE("the kernel's times are drawn", "[apps][bench]") {
  if (!has_program("gnuplot")) return;
  const Workplace here;
  const Outcome outcome =
      here.run({"bench", "kernel", "--quick", "--runs", "1", "--plot", here.path("k.png")});
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  std::ifstream png(here.path("k.png"), std::ios::binary);
  std::string head(8, ' ');
  png.read(head.data(), 8);
  CHECK(head == "\x89PNG\r\n\x1a\n");
}

TEST_CASE("without gnuplot the figures are there and the package is named", "[apps][bench]") {
  const Workplace here;
  const NoPrograms nothing_installed;
  const Outcome outcome =
      here.run({"bench", "kernel", "--quick", "--runs", "1", "--plot", here.path("k.png")});
  CHECK(outcome.exit_code == 4);
  CHECK(outcome.err.find("gnuplot_missing") != std::string::npos);
  CHECK(outcome.err.find("apt-get install gnuplot-nox") != std::string::npos);
  CHECK(outcome.out.find("CGAL's managed unsew<3>") != std::string::npos);
  CHECK(outcome.out.find("94.1") != std::string::npos);
  CHECK(here.names().empty());
}

TEST_CASE("bench asked wrongly is a usage error", "[apps][bench]") {
  const Workplace here;
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"bench"},
                                                    {"bench", "nothing"},
                                                    {"bench", "kernel", "--runs", "0"}}) {
    CHECK(here.run(arguments).exit_code == 2);
  }
}
