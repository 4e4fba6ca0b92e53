// SPDX-License-Identifier: MIT
// Reading meshes in a build without files, zlib and Expat, as for WebAssembly: refusals with that
// reason. Meshes come from memory there, unpacked, in the other formats.
#include "topology/io/files/gzip.hpp"
#include "topology/io/files/output_file.hpp"
#include "topology/io/nastran/nastran.hpp"
#include "topology/io/text/scan.hpp"
#include "topology/io/unv/unv.hpp"
#include "topology/io/vtk/vtk_polydata.hpp"
#include "topology/io/vtu/vtu_read.hpp"

namespace sunder {

bool io::is_gzip(std::string_view bytes) { return bytes.substr(0, 2) == "\x1f\x8b"; }

std::string io::unpacked(std::string_view) {
  throw ReadFailure{{.code = "bad_gzip",
                     .text = "the file is packed, and this build of Sunder has no zlib",
                     .remedy = "unpack it first: gunzip FILE"}};
}

bool io::is_vtu(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  return begin != std::string_view::npos && text.substr(begin, 5) == "<?xml";
}

io::Draft io::read_vtu(std::string_view) {
  throw ReadFailure{{.code = "unsupported_format",
                     .text = "this build of Sunder reads no VTU: it has no XML parser",
                     .remedy = "convert it: sunder convert FILE NEW.msh"}};
}

io::Draft io::read_polydata(VtkReader&&) {
  throw ReadFailure{{.code = "unsupported_format",
                     .text = "this build of Sunder reads no PolyData",
                     .remedy = "convert it: sunder convert FILE NEW.msh"}};
}

// The same applies to these formats, which such a build does not even recognize.
bool io::is_vtp(std::string_view) { return false; }
bool io::is_nastran(std::string_view) { return false; }
bool io::is_unv(std::string_view) { return false; }
io::Draft io::read_nastran(const FileSource&) { return {}; }
io::Draft io::read_unv(std::string_view) { return {}; }

bool file_exists(const std::filesystem::path&) { return false; }

}  // namespace sunder
