// SPDX-License-Identifier: MIT
// libFuzzer's way into one target, named by --target=NAME.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "fuzzed.hpp"

using namespace sunder::test;

namespace {

const FuzzTarget* target = nullptr;

void report_memory() { std::fprintf(stderr, "memory_share %.3f\n", fuzzed_memory_share()); }

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  constexpr std::string_view option = "--target=";
  const auto targets = fuzzed_targets();
  for (int i = 1; i < *argc; ++i) {
    const std::string_view word = (*argv)[i];
    if (!word.starts_with(option)) continue;
    const auto named = std::ranges::find(targets, word.substr(option.size()), &FuzzTarget::name);
    if (named != targets.end()) target = &*named;
  }
  if (target == nullptr) {
    for (const FuzzTarget& t : targets) std::printf("%s\n", t.name.c_str());
    std::exit(2);
  }
  std::atexit(report_memory);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string broken =
      target->broken_law(*target, {reinterpret_cast<const char*>(data), size});
  if (broken.empty()) return 0;
  std::fprintf(stderr, "broken promise of %s: %s\n", target->name.c_str(), broken.c_str());
  std::abort();
}
