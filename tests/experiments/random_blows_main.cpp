// SPDX-License-Identifier: MIT
// `random_blows [--certificate] [count] [first]`: blows round the energy that windows are opened
// by, or that the certificate of the rung rubble allows.
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "tests/experiments/cases/random_blows.hpp"

namespace {

int print_certificates(std::uint64_t first, std::uint64_t count) {
  const sunder::accuracy::CertificateCounts c = sunder::accuracy::run_certificates(first, count);
  std::printf(
      "blows,certified,certified and broke,refused,refused though nothing broke\n"
      "%llu,%llu,%llu,%llu,%llu\n",
      static_cast<unsigned long long>(c.blows), static_cast<unsigned long long>(c.certified),
      static_cast<unsigned long long>(c.missed), static_cast<unsigned long long>(c.refused),
      static_cast<unsigned long long>(c.needless));
  return c.missed == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  const bool certificate = argc > 1 && std::string_view(argv[1]) == "--certificate";
  if (certificate) {
    --argc;
    ++argv;
  }
  const std::uint64_t count = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 10000;
  const std::uint64_t first = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 0;
  if (certificate) return print_certificates(first, count);
  const sunder::accuracy::BlowCounts c = sunder::accuracy::run_blows(first, count);
  std::printf(
      "blows,broke,broke without a window,windows that broke nothing,no window where every blow "
      "opens one,spared by the pair,spared by the island\n%llu,%llu,%llu,%llu,%llu,%llu,%llu\n",
      static_cast<unsigned long long>(c.blows), static_cast<unsigned long long>(c.broke),
      static_cast<unsigned long long>(c.missed), static_cast<unsigned long long>(c.needless),
      static_cast<unsigned long long>(c.spared), static_cast<unsigned long long>(c.spared_by_pair),
      static_cast<unsigned long long>(c.spared_by_island));
  return c.missed == 0 ? 0 : 1;
}
