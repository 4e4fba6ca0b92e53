// SPDX-License-Identifier: MIT
// The sizes of the pieces of a run: laws fitted to them and to the mesh's own elements.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "apps/sunder/fragments/size_laws.hpp"
#include "topology/base/finding.hpp"

namespace sunder {

/// The measure of a piece's size.
enum class SizeMeasure { volume, size, mass };
inline constexpr std::array<std::string_view, 3> size_measure_names = {"volume", "size", "mass"};
inline constexpr std::array<std::string_view, 3> size_measure_units = {"m^3", "m", "kg"};

/// The columns of fragments.csv that sizes are made of, a row a piece.
struct PieceColumns {
  std::vector<double> mass, volume, tetrahedra;
};

/// Reads a table of fragments, its columns in any order.
/// Errors: cannot_open; bad_table (a column or a number missing, not above 0), with the line.
Result<PieceColumns> read_fragments(const std::filesystem::path& csv);

/// Rest volumes of the elements of mesh files, m^3. Errors: those of `read_mesh`.
Result<std::vector<double>> element_volumes(std::span<const std::filesystem::path> meshes);

/// Laws fitted to one sample.
struct SampleLaws {
  /// Exponential, Weibull, lognormal on the whole sample; empty below `fewest_for_fit` values.
  std::vector<FittedLaw> whole;
  /// The power law where it fits best, then the others on the same values; empty where there is no
  /// such place.
  std::vector<FittedLaw> tail;
  /// Values of the tail; Vuong's number of the power law against each of the others on it.
  std::size_t tail_values = 0;
  std::vector<double> against;
};
SampleLaws fit_laws(std::span<const double> ascending);

/// The sizes of the pieces of a run, and of the elements of its mesh as a control.
struct FragmentSizes {
  SizeMeasure measure = SizeMeasure::volume;
  std::vector<double> pieces, elements;  ///< ascending; elements empty: not known
  SampleLaws laws, control;
  std::size_t single_tetrahedra = 0;
  /// Part of the volume that single tetrahedra have, and of the largest piece.
  double single_part = 0, largest_part = 0;
  /// Pieces larger than the largest element, and the power law that fits them best where there are
  /// `fewest_for_fit`: only they can tell of more than the mesh.
  std::size_t beyond_elements = 0;
  std::optional<FittedLaw> beyond;
  /// Of all pieces, and of those that are single tetrahedra, from the elements.
  SampleDistance from_elements, singles_from_elements;
};

/// Sizes of pieces and, where `elements` (m^3) are known, of elements: mass by the mean density of
/// all pieces, size as the cube root of the volume. Needs: at least one piece.
FragmentSizes measure_fragments(const PieceColumns& pieces, std::span<const double> elements,
                                SizeMeasure measure);

}  // namespace sunder
