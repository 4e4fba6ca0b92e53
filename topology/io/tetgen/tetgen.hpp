// SPDX-License-Identifier: MIT
// Internal to topology/io: TetGen's files, STEM.node, STEM.ele, STEM.face and STEM.edge.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>

#include "topology/io/formats.hpp"

namespace sunder::io {

/// Never: the files are numbers alone, and only their names show their contents.
bool is_tetgen(std::string_view text);

/// Whether a text may be one of TetGen's files, once its name says so: it begins with a number or
/// with a comment (#).
bool is_numbers(std::string_view text);

/// The path without the ending of one of TetGen's files (and .gz behind it); whole where it has
/// none.
std::filesystem::path tetgen_stem(const std::filesystem::path& path);

/// Reads the mesh that one of its files is named of: STEM.node is needed, the others are read where
/// they are there. Points are numbered one after the other, from any number. Throws ReadFailure.
Draft read_tetgen(const FileSource& source);

/// Whether a mesh is written with second-order cells: TetGen's files have one order, so where it
/// has edges, triangles or tetrahedra of both the first is written.
bool is_tetgen_curved(const FileMesh& mesh);

/// Writes STEM.ele, STEM.face and STEM.edge, then STEM.node, numbered from 1. Without triangles
/// (edges) STEM.face (STEM.edge) is only written, empty, where one of an earlier mesh is there:
/// it would be read as part of this one. Leaves each file whole; where one cannot be written those
/// before it are new. Errors: cannot_write.
std::optional<Finding> write_tetgen(const std::filesystem::path& path, const FileMesh& mesh,
                                    const FileEncoding& encoding);

/// For each node as TetGen lists it, its place in our order; empty where the two are the same.
std::span<const std::uint8_t> tetgen_order(CellKind kind);

/// How data columns are named in a comment, for both sides: bytes that would end a name are %XX.
/// `escape_first` writes the first byte so in any case.
std::string escaped_name(std::string_view name, bool escape_first);

/// The name that `escaped_name` made the text of.
std::string unescaped_name(std::string_view text);

/// Names of an .ele file's first attribute by which it is the region of the tetrahedra.
bool is_tetgen_region(std::string_view name);

}  // namespace sunder::io
