// SPDX-License-Identifier: MIT
// Internal to topology/io: the input of a reader, and the way from each format to its code.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "topology/io/draft.hpp"
#include "topology/io/mesh_file.hpp"

namespace sunder::io {

/// A file as a reader meets it.
struct FileSource {
  /// Its bytes, unpacked, without a byte-order mark.
  std::string_view text;
  /// Its name, without folders.
  std::string name;
  /// The bytes of another file of the same mesh by its name relative to this file's folder,
  /// unpacked (`NAME.gz` too). Errors: missing_file, cannot_open, outside_folder, bad_gzip. Always
  /// there; where only bytes are known every file is missing.
  std::function<Result<std::string>(const std::string& name)> other_file;
};

/// The text of another file of the mesh, without a byte-order mark; none where there is no such
/// file. Throws ReadFailure: the errors of `other_file` but missing_file.
std::optional<std::string> other_text(const FileSource& source, const std::string& name);

/// Calls `work`, which reads the other file `name`: findings and failures name it meanwhile.
void in_file(Draft& draft, const std::string& name, std::string_view text,
             const std::function<void()>& work);

/// How a file is to be written, every choice made.
struct FileEncoding {
  std::string_view version;
  Encoding encoding = Encoding::text;
  bool pack = false;

  bool is_binary() const { return encoding == Encoding::binary; }
};

/// How each format is known and read, besides its traits.
struct FormatCode {
  /// Whether a file's first bytes are those of this format. `text` is the whole file.
  bool (*is_like)(std::string_view text);
  /// Throws ReadFailure.
  Draft (*read)(const FileSource& source);
};
const FormatCode& code_of(MeshFormat format);

/// Writes a file of a format. Errors: cannot_write, number_out_of_range.
std::optional<Finding> write_format(MeshFormat format, const std::filesystem::path& path,
                                    const FileMesh& mesh, const FileEncoding& encoding);

/// Reads a file of a known format, as `read_file_mesh` does once it knows the format. Throws
/// nothing; findings name no file but other files of the mesh.
Result<FileMesh> read_format(MeshFormat format, const FileSource& source,
                             const ReadOptions& options);

}  // namespace sunder::io
