// SPDX-License-Identifier: MIT
// Internal to topology/io: Abaqus' input files (.inp), which CalculiX and others share.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "topology/io/formats.hpp"
#include "topology/io/msh/msh.hpp"

namespace sunder::io {

/// Whether a file begins like Abaqus' input: behind blank lines and comments (**) with * and a
/// letter.
bool is_abaqus(std::string_view text);

/// Reads nodes, elements and sets of a file and of those it includes. Throws ReadFailure.
Draft read_abaqus(const FileSource& source);

/// For each node as Abaqus lists it, its place in our order; empty where the two are the same.
std::span<const std::uint8_t> abaqus_order(CellKind kind);

/// Which numbers the file can hold: positive ones, each once; of elements all or none.
HeldNumbers abaqus_holds(const FileMesh& mesh);

/// The text of a file: *NODE, *ELEMENT of one type a kind with a set for each region, *NSET for
/// vertices. Numbers keep every bit; those below 1 that need more than the 20 characters that
/// CalculiX reads are written without exponent, so that the first 20 are a number too.
std::string write_abaqus(const FileMesh& mesh);

}  // namespace sunder::io
