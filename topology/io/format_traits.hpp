// SPDX-License-Identifier: MIT
// The formats of mesh files, how to recognize them, and the contents that each can carry.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string_view>

#include "topology/io/mesh_file.hpp"

namespace sunder {

/// The contents of a FileMesh that a format can hold besides points, and our use of it.
struct FormatTraits {
  MeshFormat format;
  /// As messages name it.
  std::string_view name;
  /// Endings of its files' names with their dots, the usual one first; `--to` names formats by
  /// them, without the dot.
  std::span<const std::string_view> extensions;
  /// The ending among them that means binary, where there is one.
  std::string_view binary_extension = {};
  /// How it can be written, the usual way first.
  std::span<const Encoding> encodings;
  /// Whether arrays can be packed by zlib inside the file.
  bool packs = false;
  /// Versions that can be written, the usual one first; empty where there is but one.
  std::span<const std::string_view> versions = {};
  /// The kinds of cells that can stand in it.
  KindSet cells = 0;
  bool holds_regions = true;
  bool holds_region_names = false;
  /// Regions are words there, such as sets: their numbers and full names go into a list (see
  /// named_regions.hpp).
  bool regions_are_words = false;
  bool holds_entities = false;
  bool holds_point_regions = false;
  bool holds_point_ids = false;
  bool holds_cell_ids = false;
  /// The lowest dimension of cells with numbers in the format.
  int cell_ids_from = 0;
  bool holds_point_data = false;
  bool holds_cell_data = false;
  /// The lowest dimension of cells with data in the format.
  int cell_data_from = 0;
  /// Whether columns keep the type of their numbers.
  bool holds_number_types = false;
};

/// Every format, one row each.
std::span<const FormatTraits> format_traits();

/// The row of one format.
const FormatTraits& traits_of(MeshFormat format);

/// The format that `bytes` begin like, whatever the file is called; none when no format does.
std::optional<MeshFormat> format_of_content(std::string_view bytes);

/// The format usual for a name's ending (upper case too, and before .gz); none for others.
std::optional<MeshFormat> format_of_name(const std::filesystem::path& name);

/// Whether a name has the ending of a format's binary files, such as .meshb.
bool is_binary_name(const std::filesystem::path& name);

}  // namespace sunder
