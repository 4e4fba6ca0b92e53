// SPDX-License-Identifier: MIT
// The tests of topology and every fixture of the suite as test cases of one program, which tells
// which mutants each of them asks for (`SUNDER_REACHED`: a file to write to).
#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>

#include <sys/time.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <sstream>

#include "sunder_fault.hpp"
#include "topology/suite/fixtures/fixture.hpp"
#include "topology/suite/judge/judge.hpp"
#include "topology/suite/random/random_run.hpp"

namespace {

using namespace sunder::suite;

/// What a test case that is made when the program starts runs.
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
}

/// Says which case begins, as its fault may end the process; and what it has asked for at its end.
class Reached : public Catch::TestEventListenerBase {
 public:
  using TestEventListenerBase::TestEventListenerBase;

  void testCaseStarting(const Catch::TestCaseInfo& info) override {
    std::printf("case: %s\n", info.name.c_str());
    std::fflush(stdout);
    std::memset(sunder_reached_faults, 0, sizeof sunder_reached_faults);
    begin_ = std::clock();  // of the processor: others may be at work
  }

  void testCaseEnded(const Catch::TestCaseStats& stats) override {
    const char* path = std::getenv("SUNDER_REACHED");
    if (path == nullptr) return;
    const double taken = static_cast<double>(std::clock() - begin_) / CLOCKS_PER_SEC;
    std::FILE* out = std::fopen(path, "a");
    std::fprintf(out, "%s\t%.6f\t", stats.testInfo.name.c_str(), taken);
    for (std::size_t n = 0; n < sizeof sunder_reached_faults; ++n) {
      if (sunder_reached_faults[n] != 0) std::fprintf(out, "%zu ", n);
    }
    std::fprintf(out, "\n");
    std::fclose(out);
  }

 private:
  std::clock_t begin_ = 0;
};
CATCH_REGISTER_LISTENER(Reached)

/// All fixtures, or those of the files that SUNDER_FIXTURES names: reading all takes longer than
/// most runs do.
std::vector<Fixture> fixtures_wanted() {
  const std::filesystem::path folder = SUNDER_MESHES "/suite";
  const char* wanted = std::getenv("SUNDER_FIXTURES");
  if (wanted == nullptr) return read_fixture_folder(folder).value.value();
  std::vector<Fixture> fixtures;
  std::istringstream names(wanted);
  for (std::string name; names >> name;) {
    const auto read = read_fixtures(folder / (name + ".json"));
    fixtures.insert(fixtures.end(), read.value.value().begin(), read.value.value().end());
  }
  return fixtures;
}

/// Ends the process after so many seconds of processor time as SUNDER_SECONDS says.
void limit_time() {
  const char* wanted = std::getenv("SUNDER_SECONDS");
  if (wanted == nullptr) return;
  const double seconds = std::atof(wanted);
  itimerval timer{};
  timer.it_value.tv_sec = static_cast<time_t>(seconds);
  timer.it_value.tv_usec = static_cast<suseconds_t>((seconds - std::floor(seconds)) * 1e6);
  setitimer(ITIMER_PROF, &timer, nullptr);
}

}  // namespace

int main(int argc, char** argv) {
  limit_time();
  const std::vector<Fixture> fixtures = fixtures_wanted();
  add_suite(fixtures);
  return Catch::Session().run(argc, argv);
}
