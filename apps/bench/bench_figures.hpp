// SPDX-License-Identifier: MIT
// The quantities that `sunder bench kernel` measures, by name, and the figures it collects.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sunder {

/// A group of quantities, as the table heads it.
struct BenchGroup {
  std::string_view title;
  /// How it was measured, for the table; may be empty.
  std::string_view note;
};

struct BenchQuantity {
  /// As in CSV and JSON.
  std::string_view name;
  std::string_view unit;
  /// As in the table.
  std::string_view text;
  /// Row of `kernel_groups()`.
  std::size_t group = 0;
  int decimals = 2;
};

std::span<const BenchGroup> kernel_groups();
/// In the order of the table.
std::span<const BenchQuantity> kernel_quantities();

/// "AMD EPYC, 2 cores"; as far as the system tells.
std::string machine_name();

/// One figure of one body.
struct BenchFigure {
  std::string body;
  std::size_t tetrahedra = 0;
  std::string quantity;
  double value = 0;
};

/// All figures of a run, with the machine, the number of runs and the seed.
struct KernelBench {
  std::string machine;
  int runs = 0;
  std::uint64_t seed = 0;
  std::vector<BenchFigure> figures;
};

/// The figure of a body; nothing where it was not measured.
std::optional<double> figure_of(const KernelBench& bench, std::string_view body,
                                std::string_view quantity);

/// Names of the bodies, in the order of measuring.
std::vector<std::string> bodies_of(const KernelBench& bench);

}  // namespace sunder
