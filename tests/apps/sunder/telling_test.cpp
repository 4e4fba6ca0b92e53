// SPDX-License-Identifier: MIT
// --quiet, --verbose and colours: the messages on standard error.
#include "apps/sunder/telling.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <regex>

#include "tests/support/program.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// A terminal that nobody looks at.
class Terminal {
 public:
  Terminal() : master_(posix_openpt(O_RDWR | O_NOCTTY)) {
    REQUIRE(master_ >= 0);
    REQUIRE(grantpt(master_) == 0);
    REQUIRE(unlockpt(master_) == 0);
    descriptor_ = open(ptsname(master_), O_RDWR | O_NOCTTY);
    REQUIRE(descriptor_ >= 0);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  ~Terminal() {
    close(descriptor_);
    close(master_);
  }
  int descriptor() const { return descriptor_; }
  std::string name() const { return ptsname(master_); }
  /// The text written there, up to a buffer's length.
  std::string text() const {
    std::string bytes(4000, '\0');
    const ssize_t n = read(master_, bytes.data(), bytes.size());
    bytes.resize(n > 0 ? static_cast<std::size_t>(n) : 0);
    return bytes;
  }

 private:
  int master_, descriptor_ = -1;
};

/// The program's exit code, standard error on the terminal.
int run_on(const Terminal& terminal, const std::string& settings, const std::string& words) {
  const std::string command =
      settings + " '" SUNDER_PROGRAM "' " + words + " >/dev/null 2>" + terminal.name();
  return std::system(command.c_str());
}

constexpr const char* red = "\033[1;31merror:\033[0m";

}  // namespace

TEST_CASE("colours are for terminals that are not dumb, unless NO_COLOR is set",
          "[apps][telling]") {
  const Terminal terminal;
  const int file = open("/dev/null", O_WRONLY);
  setenv("TERM", "xterm", 1);
  unsetenv("NO_COLOR");
  CHECK(shows_colours(terminal.descriptor()));
  CHECK_FALSE(shows_colours(file));
  setenv("NO_COLOR", "", 1);
  CHECK(shows_colours(terminal.descriptor()));
  setenv("NO_COLOR", "0", 1);
  CHECK_FALSE(shows_colours(terminal.descriptor()));
  CHECK(is_terminal(terminal.descriptor()));
  unsetenv("NO_COLOR");
  for (const char* kind : {"dumb", ""}) {
    setenv("TERM", kind, 1);
    CHECK_FALSE(shows_colours(terminal.descriptor()));
    CHECK_FALSE(is_terminal(terminal.descriptor()));
  }
  unsetenv("TERM");
  CHECK_FALSE(is_terminal(terminal.descriptor()));
  close(file);
}

TEST_CASE("the word error is red on a terminal and plain elsewhere", "[apps][telling]") {
  const Workplace here;
  const std::string words = "convert '" + here.path("none.msh") + "' x.vtu";
  const auto said = [&](const std::string& settings) {
    const Terminal terminal;
    run_on(terminal, settings, words);
    return terminal.text();
  };
  CHECK(said("env -u NO_COLOR TERM=xterm").find(red) != std::string::npos);
  for (const char* settings : {"NO_COLOR=1 TERM=xterm", "env -u NO_COLOR TERM=dumb"}) {
    const std::string text = said(settings);
    CHECK(text.find("error: ") != std::string::npos);
    CHECK(text.find('\033') == std::string::npos);
  }
  CHECK(here.run({"convert", here.path("none.msh"), "x.vtu"}).err.find('\033') ==
        std::string::npos);
}

TEST_CASE("quiet leaves errors and the result, and nothing else", "[apps][telling]") {
  const Workplace here;
  const std::string cube = sample_mesh("cube.msh"), out = here.path("a.vtu");
  const Outcome usual = here.run({"convert", cube, out});
  CHECK(usual.err.find("note: ") != std::string::npos);
  const Outcome quiet = here.run({"convert", cube, out, "--quiet"});
  CHECK(quiet.exit_code == 0);
  CHECK(quiet.err.empty());
  CHECK(quiet.out == usual.out);
  CHECK(here.run({"convert", cube, "-", "--to", "vtu", "--quiet"}).err.empty());
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"refine", cube, out},
           {"cut", cube, out, "--plane", "1,0,0,0.5", "--exact"},
           {"split", sample_mesh("two_tets.msh"), "--plane", "0,0,1,0", "-o", out},
           {"run", SUNDER_SCENES "/bar.json", "-o", here.path("run"), "--force", "--set",
            "duration=0.001"}}) {
    INFO(words[0]);
    CHECK_FALSE(here.run(words).err.empty());
    std::vector<std::string> more = words;
    more.emplace_back("--quiet");
    const Outcome o = here.run(more);
    CHECK(o.exit_code == 0);
    CHECK(o.err.empty());
    CHECK_FALSE(o.out.empty());
  }
  const Outcome refused = here.run({"static", here.path("none.json"), "--quiet"});
  CHECK(refused.exit_code == 3);
  CHECK(refused.err.find("error: ") != std::string::npos);
}

TEST_CASE("verbose tells each stage with its time and leaves the result as it is",
          "[apps][telling]") {
  const Workplace here;
  const std::string cube = sample_mesh("cube.msh"), run = here.path("run");
  const std::regex stage(" *\\d+\\.\\d{3} s  [a-z]");
  REQUIRE(here.run({"run", SUNDER_SCENES "/charts/monolith.json", "-o", run, "--quiet", "--set",
                    "duration=0.02"})
              .exit_code == 0);
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"check", cube},
           {"convert", cube, here.path("a.vtu")},
           {"refine", cube, here.path("b.vtu")},
           {"cut", cube, here.path("c.vtu"), "--plane", "1,0,0,0.5", "--exact"},
           {"split", cube, "--plane", "1,0,0,1"},
           {"fragments", run},
           {"export", run, here.path("a.glb")},
           {"export", run, here.path("a.msh")}}) {
    INFO(words[0]);
    const Outcome usual = here.run(words);
    CHECK_FALSE(std::regex_search(usual.err, stage));
    std::vector<std::string> more = words;
    more.emplace_back("--verbose");
    const Outcome o = here.run(more);
    INFO(o.err);
    CHECK(o.exit_code == usual.exit_code);
    CHECK(o.out == usual.out);
    CHECK(std::regex_search(o.err, stage));
  }
  const Outcome both = here.run({"check", cube, "--verbose", "--quiet"});
  CHECK(both.exit_code == 2);  // a check has nothing to be quiet about
  CHECK(here.run({"convert", cube, "x.vtu", "--verbose", "--quiet"}).exit_code == 2);
}

TEST_CASE("help, manual pages and completions name the options of what tells something",
          "[apps][telling]") {
  const Workplace here;
  const std::string quiet = "--quiet", verbose = "--verbose";
  const std::string completion = here.run({"completion", "fish"}).out;
  const auto names = [&](const std::string& command, const std::string& option) {
    const bool helps = here.run({command, "--help"}).out.find(option) != std::string::npos;
    if (command != "chart") {
      CHECK(helps == (here.run({"man", command}).out.find("\\-\\-" + option.substr(2)) !=
                      std::string::npos));
      CHECK(helps == (completion.find("__fish_seen_subcommand_from " + command + "' -l " +
                                      option.substr(2)) != std::string::npos));
    }
    return helps;
  };
  for (const char* command : {"run", "demo", "static", "modes", "export", "render", "convert",
                              "split", "cut", "refine"}) {
    INFO(command);
    CHECK(names(command, quiet));
    CHECK(names(command, verbose));
  }
  for (const char* command : {"check", "fragments"}) {
    INFO(command);
    CHECK_FALSE(names(command, quiet));
    CHECK(names(command, verbose));
  }
  CHECK(here.run({"--help"}).out.find("NO_COLOR") != std::string::npos);
  CHECK(here.run({"man"}).out.find("NO_COLOR") != std::string::npos);
  CHECK(names("chart", quiet));
  CHECK_FALSE(names("chart", verbose));
#if defined(SUNDER_HAS_VIEW)
  CHECK(names("view", quiet));
  CHECK_FALSE(names("view", verbose));
#endif
  for (const char* bench : {"kernel", "step", "methods", "paper", "threshold", "formats"}) {
    CHECK(here.run({"bench", bench, "--help"}).out.find(quiet) != std::string::npos);
  }
  CHECK(here.run({"suite", "--quiet"}).exit_code == 2);  // of --random
  CHECK_FALSE(names("completion", quiet));
  CHECK_FALSE(names("man", quiet));
}
