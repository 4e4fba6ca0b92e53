// SPDX-License-Identifier: MIT
// The writer of each format. A source of its own: programs that only read link none of it.
#include <fmt/format.h>

#include "topology/base/counted.hpp"
#include "topology/io/abaqus/abaqus.hpp"
#include "topology/io/files/output_file.hpp"
#include "topology/io/formats.hpp"
#include "topology/io/medit/medit.hpp"
#include "topology/io/msh/msh.hpp"
#include "topology/io/nastran/nastran.hpp"
#include "topology/io/ovm/ovm.hpp"
#include "topology/io/surface/obj.hpp"
#include "topology/io/surface/off.hpp"
#include "topology/io/surface/ply.hpp"
#include "topology/io/surface/stl.hpp"
#include "topology/io/tetgen/tetgen.hpp"
#include "topology/io/unv/unv.hpp"
#include "topology/io/vtk/vtk.hpp"
#include "topology/io/vtu/vtu_read.hpp"

namespace sunder {
namespace {

using io::FileEncoding;

int msh_version(std::string_view version) {
  if (version == "1") return 10;
  return version == "2.2" ? 22 : version == "4.0" ? 40 : 41;
}

std::optional<Finding> write_stl(const std::filesystem::path& path, const FileMesh& mesh,
                                 const FileEncoding& how) {
  const std::size_t too_big = how.is_binary() ? io::stl_points(mesh, true).too_big : 0;
  if (too_big == 0) return write_file(path, io::write_stl(mesh, how.is_binary()));
  return Finding{.code = "number_out_of_range",
                 .count = too_big,
                 .text = fmt::format("{} coordinates beyond 3.4e38: binary STL has floats",
                                     counted(too_big, "point has", "points have")),
                 .remedy = "write text (--text), which keeps every digit"};
}

}  // namespace

std::optional<Finding> io::write_format(MeshFormat format, const std::filesystem::path& path,
                                        const FileMesh& mesh, const FileEncoding& how) {
  const bool is_binary = how.is_binary();
  switch (format) {
    case MeshFormat::msh:
      return write_file(path, write_msh(mesh, msh_version(how.version), is_binary));
    case MeshFormat::medit:
      return write_file(path, write_medit(mesh, is_binary));
    case MeshFormat::vtu:
      return write_vtu(path, mesh, how);
    case MeshFormat::vtk:
      return write_file(path, write_vtk(mesh, how.version == "5.1" ? 51 : 42, is_binary));
    case MeshFormat::tetgen:
      return write_tetgen(path, mesh, how);
    case MeshFormat::abaqus:
      return write_file(path, write_abaqus(mesh));
    case MeshFormat::nastran:
      return write_file(path, write_nastran(mesh));
    case MeshFormat::unv:
      return write_file(path, write_unv(mesh));
    case MeshFormat::ovm:
      return write_file(path, write_ovm(mesh));
    case MeshFormat::ply:
      return write_file(path, write_ply(mesh, is_binary));
    case MeshFormat::off:
      return write_file(path, write_off(mesh));
    case MeshFormat::obj:
      return write_file(path, write_obj(mesh));
    case MeshFormat::stl:
      return sunder::write_stl(path, mesh, how);
    case MeshFormat::vtp:
      return write_vtp(path, mesh, how);
  }
  return std::nullopt;
}

}  // namespace sunder
