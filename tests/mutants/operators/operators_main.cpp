// SPDX-License-Identifier: MIT
// The tests of topology and every fixture of the suite as test cases of one program, which lists
// the mutants that each of them reaches (`SUNDER_REACHED`: a file to write to), or with `--serve`
// answers about one mutant after the other.
#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <map>
#include <sstream>

#include "sunder_fault.hpp"
#include "tests/topology/cells/random_cells.hpp"
#include "topology/suite/fixtures/fixture.hpp"
#include "topology/suite/judge/judge.hpp"
#include "topology/suite/random/random_run.hpp"

namespace {

using namespace sunder::suite;

/// A function that runs as a test case made at the program's start.
class Made : public Catch::ITestInvoker {
 public:
  explicit Made(std::function<void()> run) : run_(std::move(run)) {}
  void invoke() const override { run_(); }

 private:
  std::function<void()> run_;
};

void add_case(const std::string& name, std::function<void()> run) {
  Catch::getMutableRegistryHub().registerTest(Catch::makeTestCase(
      new Made(std::move(run)), "", {name, "[suite]"}, CATCH_INTERNAL_LINEINFO));
}

void judge_on(const Fixture& fixture, JudgedKernel kernel) {
  const Verdict verdict = judge(fixture, kernel);
  if (verdict.mismatch) {
    FAIL(verdict.mismatch->what << ": " << verdict.mismatch->answered << ", not "
                                << verdict.mismatch->expected);
  }
}

void tear(const std::function<JudgedKernel()>& kernel) {
  for (const FamilyReport& family : run_random({.fans = 150, .seed = 20261124}, kernel).families) {
    if (family.failure) FAIL(family.name << ": " << family.failure->first.what);
  }
}

void add_suite(const std::vector<Fixture>& fixtures) {
  for (const Fixture& fixture : fixtures) {
    add_case("fixture " + fixture.name + " on sunder",
             [&fixture] { judge_on(fixture, volume_map_kernel()); });
    add_case("fixture " + fixture.name + " on dense",
             [&fixture] { judge_on(fixture, dense_map_kernel()); });
  }
  add_case("random fans on sunder", [] { tear(volume_map_kernel); });
  add_case("random fans on dense", [] { tear(dense_map_kernel); });
  // The long run of the tests asks the same for ten seconds.
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    add_case("some random operations on cells, " + std::to_string(seed), [seed] {
      const auto run = sunder::test::random_cells(30, seed);
      if (!run.failure.empty()) FAIL(run.failure);
    });
  }
}

/// Writes the faults that each case has reached, at its end, and its time.
class Reached : public Catch::TestEventListenerBase {
 public:
  using TestEventListenerBase::TestEventListenerBase;

  void testCaseStarting(const Catch::TestCaseInfo&) override {
    if (path_ == nullptr) return;
    std::memset(sunder_reached_faults, 0, sizeof sunder_reached_faults);
    begin_ = std::clock();  // of the processor: others may be at work
  }

  void testCaseEnded(const Catch::TestCaseStats& stats) override {
    if (path_ == nullptr) return;
    const double taken = static_cast<double>(std::clock() - begin_) / CLOCKS_PER_SEC;
    std::FILE* out = std::fopen(path_, "a");
    std::fprintf(out, "%s\t%.6f\t", stats.testInfo.name.c_str(), taken);
    for (std::size_t n = 0; n < sizeof sunder_reached_faults; ++n) {
      if (sunder_reached_faults[n] != 0) std::fprintf(out, "%zu ", n);
    }
    std::fprintf(out, "\n");
    std::fclose(out);
  }

 private:
  const char* path_ = std::getenv("SUNDER_REACHED");
  std::clock_t begin_ = 0;
};
CATCH_REGISTER_LISTENER(Reached)

/// A case to run and the seconds of processor time after which its process ends.
struct Asked {
  const Catch::TestCase* test;
  double limit;
};

void set_timer(__itimer_which_t which, double seconds) {
  itimerval timer{};
  timer.it_value.tv_sec = static_cast<time_t>(seconds);
  timer.it_value.tv_usec = static_cast<suseconds_t>((seconds - std::floor(seconds)) * 1e6);
  setitimer(which, &timer, nullptr);
}

/// In a process of its own: the cases in their order until one fails; `at` says which is at work.
int run_cases(const std::vector<Asked>& cases, int* at) {
  const int nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, STDOUT_FILENO), dup2(nowhere, STDERR_FILENO);
  Catch::ConfigData data;
  data.abortAfter = 1;
  data.reporterName = "compact";
  const auto config = std::make_shared<Catch::Config>(data);
  Catch::RunContext context(config, Catch::makeReporter(config));
  for (std::size_t i = 0; i < cases.size(); ++i) {
    *at = static_cast<int>(i);
    set_timer(ITIMER_PROF, cases[i].limit);
    set_timer(ITIMER_REAL, 60 + 20 * cases[i].limit);  // for cases that wait for ever
    if (!context.runTest(*cases[i].test).assertions.allOk()) return 1;
  }
  return 0;
}

/// Mutants, as of SUNDER_FAULT, are asked for by lines: a number, then names of cases with their
/// limits, all between tabs. The answer to each is a line: `passed`, or which case failed (from 0),
/// and its exit code or signal as the shell has it.
int serve() {
  const auto config = std::make_shared<Catch::Config>(Catch::ConfigData{});
  std::map<std::string, const Catch::TestCase*> by_name;
  for (const auto& test : Catch::getAllTestCasesSorted(*config)) by_name[test.name] = &test;
  auto* at = static_cast<int*>(
      mmap(nullptr, sizeof(int), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  for (std::string line; std::getline(std::cin, line);) {
    std::istringstream in(line);
    std::string number, name, limit;
    std::getline(in, number, '\t');
    std::vector<Asked> cases;
    while (std::getline(in, name, '\t') && std::getline(in, limit, '\t')) {
      cases.push_back({by_name.at(name), std::stod(limit)});
    }
    const pid_t child = fork();
    if (child == 0) {
      sunder_chosen_fault = std::stoi(number);
      _exit(run_cases(cases, at));
    }
    int status = 0;
    waitpid(child, &status, 0);
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    if (code == 0) {
      std::printf("passed\n");
    } else {
      std::printf("%d\t%d\n", *at, code);
    }
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<Fixture> fixtures = read_fixture_folder(SUNDER_MESHES "/suite").value.value();
  add_suite(fixtures);
  if (argc == 2 && std::string(argv[1]) == "--serve") return serve();
  return Catch::Session().run(argc, argv);
}
