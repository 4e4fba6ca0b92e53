// SPDX-License-Identifier: MIT
// Programs of others: found, run, ended.
#include "apps/sunder/process/run_process.hpp"

#include <catch2/catch.hpp>
#include <cstdlib>

using namespace sunder;

TEST_CASE("programs are found in the folders of PATH alone", "[break]") {
  CHECK(find_program("sh"));
  CHECK_FALSE(find_program("no_such_program_of_anybody"));
  const std::string before = std::getenv("PATH");
  setenv("PATH", "", 1);
  CHECK_FALSE(find_program("sh"));
  setenv("PATH", "/nonexistent::/bin", 1);
  CHECK(find_program("sh"));
  setenv("PATH", before.c_str(), 1);
}

TEST_CASE("a program runs in its folder, and its end is known", "[break]") {
  std::filesystem::path kept;
  {
    const TemporaryFolder folder;
    kept = folder.path();
    REQUIRE(std::filesystem::is_directory(kept));
    const auto sh = *find_program("sh");
    const std::chrono::seconds limit{20};
    const ProcessEnd fine =
        run_process(sh, {"-c", "pwd; echo \"$0\" >named; cat", "a b;c"}, kept, limit);
    CHECK(fine.exit_code == 0);
    CHECK_FALSE(fine.took_too_long);
    CHECK(fine.words.find(kept.filename().string()) != std::string::npos);
    CHECK(std::filesystem::exists(kept / "named"));
    const ProcessEnd bad = run_process(sh, {"-c", "echo trouble >&2; exit 3"}, kept, limit);
    CHECK(bad.exit_code == 3);
    CHECK(bad.words == "trouble\n");
    CHECK_FALSE(run_process(sh, {"-c", "kill -9 $$"}, kept, limit).exit_code);
    const ProcessEnd late = run_process(sh, {"-c", "exec sleep 60"}, kept, std::chrono::seconds{1});
    CHECK(late.took_too_long);
    CHECK_FALSE(late.exit_code);
    CHECK(run_process("/nonexistent/program", {}, kept, limit).exit_code == 127);
  }
  CHECK_FALSE(std::filesystem::exists(kept));
}
