// SPDX-License-Identifier: MIT
// write_run_seeds FOLDER: for each target among a run's inputs, a folder with a right input.
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "run_laws.hpp"

using namespace sunder::test;

int main(int argc, char** argv) {
  if (argc != 2) {
    std::puts("usage: write_run_seeds FOLDER");
    return 2;
  }
  for (const FuzzTarget& target : run_targets()) {
    const auto folder = std::filesystem::path(argv[1]) / target.name;
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "right", std::ios::binary) << seed_of(target);
  }
}
