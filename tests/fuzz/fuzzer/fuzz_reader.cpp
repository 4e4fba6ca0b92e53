// SPDX-License-Identifier: MIT
// libFuzzer's way into one reader, named by --target=NAME.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "reader_laws.hpp"

using namespace sunder::test;

namespace {

const FuzzTarget* target = nullptr;

void report_memory() { std::fprintf(stderr, "memory_share %.3f\n", largest_memory_share()); }

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  constexpr std::string_view option = "--target=";
  for (int i = 1; i < *argc; ++i) {
    const std::string_view word = (*argv)[i];
    if (word.starts_with(option)) target = find_target(word.substr(option.size()));
  }
  if (target == nullptr) {
    for (const FuzzTarget& t : fuzz_targets()) std::printf("%s\n", t.name.c_str());
    std::exit(2);
  }
  end_at_memory_bound(true);
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
