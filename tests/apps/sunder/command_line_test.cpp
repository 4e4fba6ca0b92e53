// SPDX-License-Identifier: MIT
// The command line: help, version, mistakes and their exit codes.
#include <sys/wait.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>

#include "tests/support/program.hpp"

using namespace sunder::test;

TEST_CASE("help and version end with 0 and stand on stdout", "[apps][command_line]") {
  const Workplace here;
  const Outcome version = here.run({"--version"});
  CHECK(version.exit_code == 0);
  CHECK(std::regex_match(version.out, std::regex("sunder \\d+\\.\\d+\\.\\d+\n")));
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"},
                                                    {"check", "--help"},
                                                    {"split", "--help"},
                                                    {"static", "--help"},
                                                    {"modes", "--help"},
                                                    {"run", "-h"}}) {
    const Outcome help = here.run(arguments);
    CHECK(help.exit_code == 0);
    CHECK(help.err.empty());
    CHECK(help.out.size() > 200);
  }
}

TEST_CASE("commands of sunder-bench are started, and say so where it is not there",
          "[apps][command_line]") {
  const Workplace here;
  const std::string help = here.run({"--help"}).out;
  for (const char* command : {"suite", "bench", "chart"}) {
    const Outcome outcome = here.run({command, "--help"});
    CHECK(outcome.exit_code == 0);
    const std::string purpose = outcome.out.substr(0, outcome.out.find('\n'));
    CHECK(help.find(purpose) != std::string::npos);
    CHECK(here.run({command, "--nothing-such"}).exit_code == 2);
  }
  std::filesystem::copy_file(SUNDER_PROGRAM, here.path("sunder"));
  const std::string command = here.path("sunder") + " bench kernel 2>" + here.path("err");
  CHECK(WEXITSTATUS(std::system(command.c_str())) == 2);
  std::ifstream err(here.path("err"));
  const std::string said{std::istreambuf_iterator<char>(err), {}};
  CHECK(said.find("--target sunder-bench") != std::string::npos);
}

TEST_CASE("the help of check and split gives units, exit codes and examples",
          "[apps][command_line]") {
  const Workplace here;
  for (const char* command : {"check", "split"}) {
    const std::string help = here.run({command, "--help"}).out;
    CHECK(help.find("metres") != std::string::npos);
    CHECK(help.find("Exit codes: 0") != std::string::npos);
    CHECK(help.find("Examples:\n") != std::string::npos);
  }
}

TEST_CASE("every option that the help names is there", "[apps][command_line]") {
  const Workplace here;
  const std::regex option("--[a-z][a-z-]+");
  for (const char* command : {"check", "split", "run", "static", "modes"}) {
    const std::string help = here.run({command, "--help"}).out;
    std::set<std::string> names;
    for (std::sregex_iterator i(help.begin(), help.end(), option), end; i != end; ++i) {
      names.insert(i->str());
    }
    CHECK(names.size() >= 2);
    for (const std::string& name : names) {
      // A value too many, or a missing one: but never an option that is not known.
      const Outcome outcome = here.run({command, name});
      INFO(command << " " << name << ": " << outcome.err);
      CHECK(outcome.err.find("not expected") == std::string::npos);
    }
  }
}

TEST_CASE("the examples in the help of split run", "[apps][command_line]") {
  const Workplace here;
  const std::string help = here.run({"split", "--help"}).out;
  for (const char* example :
       {"meshes/two_tets.msh --plane 0,0,1,0", "meshes/cube.msh --fan 13,1,0,0"}) {
    CHECK(help.find(example) != std::string::npos);
  }
  CHECK(here.run({"split", sample_mesh("two_tets.msh"), "--plane", "0,0,1,0"}).exit_code == 0);
  const Outcome fan = here.run({"split", sample_mesh("cube.msh"), "--fan", "13,1,0,0", "--json"});
  CHECK(fan.exit_code == 0);
  CHECK(fan.json()["splits"].size() > 0);
}

TEST_CASE("mistakes on the command line end with 2 and are told on stderr",
          "[apps][command_line]") {
  const Workplace here;
  const std::string cube = sample_mesh("cube.msh");
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {},
           {"brake", cube},
           {"check"},
           {"check", cube, "--jason"},
           {"check", cube, cube},
           {"static"},
           {"modes"},
           {"modes", cube, "--count", "0"},
           {"modes", cube, "--count", "few"},
           {"split", cube},
           {"split", cube, "--fan"},
           {"split", cube, "--fan", "13,1,0"},
           {"split", cube, "--fan", "13,1,0,x"},
           {"split", cube, "--fan", "1.5,1,0,0"},
           {"split", cube, "--fan", "-1,1,0,0"},
           {"split", cube, "--fan", "130,1,0,0"},
           {"split", cube, "--fan", "13,0,0,0"},
           {"split", cube, "--fan", "13,nan,0,0"},
           {"split", cube, "--plane", "1,0,0"},
           {"split", cube, "--plane", "1,0,0,0,0"},
           {"split", cube, "--plane", "0,0,0,1"},
           {"split", cube, "--plane", "1,0,0,inf"},
           {"split", cube, "--plane", "1,0,0,1", "--fan", "13,1,0,0"},
           {"split", cube, "--plane", "1,0,0,1", "--order", "reversed"}}) {
    const Outcome outcome = here.run(arguments);
    INFO(outcome.err);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.out.empty());
    CHECK(outcome.err.size() > 20);
  }
}
