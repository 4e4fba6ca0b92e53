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
  CHECK(here.run({"help", "bench"}).out == here.run({"bench", "--help"}).out);
  CHECK(help.find("(not built)") == std::string::npos);

  std::filesystem::copy_file(SUNDER_PROGRAM, here.path("sunder"));
  const auto alone = [&](const std::string& words) {
    const std::string command =
        here.path("sunder") + " " + words + " >" + here.path("out") + " 2>" + here.path("err");
    return WEXITSTATUS(std::system(command.c_str()));
  };
  CHECK(alone("bench kernel") == 2);
  CHECK(bytes_of(here.path("err")).find("--target sunder-bench") != std::string::npos);
  CHECK(alone("--help") == 0);
  const std::string lists = bytes_of(here.path("out"));
  for (const char* command : {"suite", "bench", "chart"}) {
    CHECK(
        std::regex_search(lists, std::regex("\n +" + std::string(command) + " [^\n]*(not built)")));
  }
  CHECK(alone("suit") == 2);
  CHECK(bytes_of(here.path("err")).find("did you mean suite?") != std::string::npos);
}

TEST_CASE("the help lists every command under its group", "[apps][command_line]") {
  const Workplace here;
  const std::string help = here.run({"--help"}).out;
  INFO(help);
  std::size_t place = 0;
  for (const char* word : {"\nSimulate:",
                           " demo ",
                           " run ",
                           " static ",
                           " modes ",
                           "\nLook:",
                           " view ",
                           " render ",
                           " export ",
                           " fragments ",
                           "\nMeshes:",
                           " check ",
                           " convert ",
                           " split ",
                           " cut ",
                           " refine ",
                           "\nKernels and measurements:",
                           " suite ",
                           " bench ",
                           " chart ",
                           "\nShell:",
                           " completion ",
                           " man "}) {
    INFO(word);
    place = help.find(word, place);
    REQUIRE(place != std::string::npos);
  }
  // Purposes are in the imperative: "Break", not "Breaks".
  const std::regex third_person("\n  [a-z]+ +[A-Z][a-z]+s ");
  CHECK_FALSE(std::regex_search(help, third_person));
}

TEST_CASE("help COMMAND and --help COMMAND are COMMAND --help", "[apps][command_line]") {
  const Workplace here;
  const std::string help = here.run({"run", "--help"}).out;
  for (const char* word : {"help", "--help", "-h"}) {
    const Outcome o = here.run({word, "run"});
    CHECK(o.exit_code == 0);
    CHECK(o.out == help);
  }
  CHECK(here.run({"help"}).out == here.run({"--help"}).out);
  CHECK(here.run({"help", "rnu"}).exit_code == 2);
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

TEST_CASE("an option that may be repeated takes one value per use: a file may follow it",
          "[apps][command_line]") {
  const Workplace here;
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"run", "--set", "duration=0.001", "--set", "output.frames=1", "--quiet", "-o",
            here.path("out"), "--set", "output.checkpoint.minutes=0",
            SUNDER_SCENES "/charts/monolith.json"},
           {"refine", "--region", "1", "--region", "1", sample_mesh("cube.msh"),
            here.path("a.msh")}}) {
    const Outcome outcome = here.run(words);
    INFO(words[0] << ": " << outcome.text());
    CHECK(outcome.exit_code == 0);
  }
}

TEST_CASE("mistyped commands and options get the nearest name", "[apps][command_line]") {
  const Workplace here;
  const Outcome command = here.run({"chekc", "x.msh"});
  CHECK(command.exit_code == 2);
  CHECK(command.out.empty());
  CHECK(command.err.find("did you mean check?") != std::string::npos);
  const Outcome option = here.run({"split", "x.msh", "--plane=1,0,0,0", "--orcale=exact"});
  CHECK(option.exit_code == 2);
  CHECK(option.err.find("there is no option --orcale; did you mean --oracle?") !=
        std::string::npos);
  CHECK(here.run({"check", "x.msh", "--zzzzzzzz"}).err.find("did you mean") == std::string::npos);
  const auto meant = [&](const std::vector<std::string>& words, const std::string& name) {
    const Outcome o = here.run(words);
    INFO(o.err);
    CHECK(o.exit_code == 2);
    CHECK(o.out.empty());
    CHECK(o.err.find("did you mean " + name + "?") != std::string::npos);
  };
  meant({"rnu"}, "run");
  meant({"rnu", "--help"}, "run");
  meant({"help", "rnu"}, "run");
  meant({"-h", "rnu"}, "run");
  meant({"run", "--pgn"}, "--png");
  meant({"run", "scene.json", "--pgn", "6"}, "--png");
  meant({"run", "scene.json", "-png", "6"}, "--png");
  meant({"--versoin"}, "--version");
  meant({"suit"}, "suite");
  meant({"bench", "kernl"}, "kernel");
  meant({"bench", "kernel", "--quik"}, "--quick");
  meant({"suite", "--juint", "x.xml"}, "--junit");
  meant({"man", "rnu"}, "run");
  meant({here.write("some.json", "{}")}, "`sunder run " + here.path("some.json") + "`");
  const Outcome nothing = here.run({});
  CHECK(nothing.exit_code == 2);
  CHECK(nothing.out.empty());
  CHECK(nothing.err == here.run({"--help"}).out + "\n");
}

TEST_CASE("a full device is an error", "[apps][command_line]") {
  const Workplace here;
  for (const std::string& words : {std::string("--help"), "check " + sample_mesh("cube.msh"),
                                   "convert " + sample_mesh("cube.msh") + " - --to vtk"}) {
    const std::string command =
        std::string(SUNDER_PROGRAM) + " " + words + " >/dev/full 2>" + here.path("err");
    INFO(words);
    CHECK(WEXITSTATUS(std::system(command.c_str())) == 4);
    CHECK(bytes_of(here.path("err")).find("No space left on device") != std::string::npos);
  }
}

TEST_CASE("meshes come from standard input, go to standard output, and are packed",
          "[apps][command_line]") {
  const Workplace here;
  const std::string mesh = sample_mesh("cube.msh"), program = SUNDER_PROGRAM;
  REQUIRE(here.run({"convert", mesh, here.path("plain.vtu")}).exit_code == 0);
  const std::string through = program + " convert - - --to vtu <" + mesh + " 2>" +
                              here.path("words") + " >" + here.path("piped.vtu");
  CHECK(WEXITSTATUS(std::system(through.c_str())) == 0);
  CHECK(bytes_of(here.path("piped.vtu")) == bytes_of(here.path("plain.vtu")));
  CHECK(bytes_of(here.path("words")).find("written from 27 points") != std::string::npos);
  CHECK(bytes_of(here.path("words")).find("names_lost") != std::string::npos);

  REQUIRE(here.run({"convert", mesh, here.path("a.vtu.gz")}).exit_code == 0);
  const std::string unpack = "gunzip -c " + here.path("a.vtu.gz") + " >" + here.path("a.vtu");
  CHECK(WEXITSTATUS(std::system(unpack.c_str())) == 0);
  CHECK(bytes_of(here.path("a.vtu")) == bytes_of(here.path("plain.vtu")));
  CHECK(here.run({"check", here.path("a.vtu.gz")}).exit_code == 0);
  CHECK(here.run({"convert", mesh, here.path("a.node.gz")}).exit_code == 2);
}

TEST_CASE("several meshes are checked one after the other", "[apps][command_line]") {
  const Workplace here;
  const std::string cube = sample_mesh("cube.msh"), none = here.path("none.msh");
  const nlohmann::json all = here.run({"check", cube, none, cube, "--json"}).json();
  REQUIRE(all.size() == 3);
  CHECK(all[0]["valid"] == true);
  CHECK(all[1]["file"] == none);
  CHECK(all[1]["valid"] == false);
  CHECK(all[2]["counts"] == all[0]["counts"]);
  CHECK(here.run({"check", cube, none}).exit_code == 3);
  CHECK(here.run({"check", cube, cube, "--write-findings", here.path("f.vtu")}).exit_code == 2);
}

TEST_CASE("refusals are an object where JSON is asked for", "[apps][command_line]") {
  const Workplace here;
  const std::string none = here.path("none");
  for (const std::vector<std::string>& words : {std::vector<std::string>{"run", none},
                                                {"run", "--resume", none},
                                                {"static", none},
                                                {"modes", none},
                                                {"fragments", none},
                                                {"check", none},
                                                {"convert", none, "x.vtu"},
                                                {"split", none, "--plane", "1,0,0,0"},
                                                {"refine", none, "x.vtu"},
                                                {"cut", none, "x.vtu", "--plane", "1,0,0,0"}}) {
    std::vector<std::string> all = words;
    all.push_back("--json");
    const Outcome o = here.run(all);
    INFO(words[0]);
    CHECK(o.exit_code == 3);
    const nlohmann::json json = o.json();
    REQUIRE(json.contains("findings"));
    CHECK(json["findings"][0]["severity"] == "error");
  }
}

TEST_CASE("shells complete and man reads what the command line has", "[apps][command_line]") {
  const Workplace here;
  for (const char* shell : {"bash", "zsh", "fish"}) {
    const Outcome script = here.run({"completion", shell});
    CHECK(script.exit_code == 0);
    INFO(shell);
    for (const char* word : {"refine", "oracle", "exact", "paper", "resume"}) {
      CHECK(script.out.find(word) != std::string::npos);
    }
    // Where the shell is here, it has to understand it.
    const std::string path = here.write(shell, script.out);
    const std::string known =
        std::string("command -v ") + shell + " >/dev/null || exit 0; " + shell + " -n " + path;
    CHECK(WEXITSTATUS(std::system(known.c_str())) == 0);
  }
  const std::string page = here.run({"completion", "bash"}).out;
  const std::string script = here.write("b", page);
  const auto completed = [&](const std::string& words) {
    const std::string asks = "bash -c 'source " + script + "; COMP_WORDS=(sunder " + words +
                             "); COMP_CWORD=3; _sunder; echo ${COMPREPLY[@]}' >" +
                             here.path("answer");
    CHECK(std::system(asks.c_str()) == 0);
    return bytes_of(here.path("answer"));
  };
  CHECK(completed("split --oracle p") == "paper\n");
  CHECK(completed("fragments --by \"\"") == "volume size mass\n");
  CHECK(completed("convert --order \"\"") == "1 2\n");
  CHECK(completed("convert --triangles \"\"") == "keep drop\n");
  CHECK(completed("render --show d") == "deformed\n");
  const Outcome man = here.run({"man", "run"});
  CHECK(man.out.starts_with(".TH sunder\\-run 1"));
  CHECK(man.out.find("Exit codes") != std::string::npos);
  CHECK(here.run({"man"}).out.find("\n.B refine\n") != std::string::npos);
  CHECK(here.run({"man", "nothing"}).exit_code == 2);
  CHECK(here.run({"completion", "csh"}).exit_code == 2);
}
