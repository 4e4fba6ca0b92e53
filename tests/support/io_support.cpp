// SPDX-License-Identifier: MIT
// Small meshes, folders and a VTU encoder for the tests of mesh files.
#include "tests/support/io_support.hpp"

#include <fmt/format.h>
#include <stdlib.h>
#include <zlib.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>

namespace sunder::test {

std::filesystem::path sample(std::string_view name) {
  return std::filesystem::path(SUNDER_IO_DATA) / name;
}

TetMesh two_tetrahedra() {
  TetMesh mesh;
  mesh.points = {
      {0, 0, 0}, {1.0 / 3, 0, 0}, {0, 0.1, 1e-17}, {0, -0.0, 0.7}, {-1e300, 5e-324, -2.0 / 7}};
  mesh.tetrahedra = {{0, 1, 2, 3}, {1, 0, 2, 4}};
  mesh.region = {2, 5};
  mesh.region_name = {{2, "body"}, {5, "foot of it"}};
  return mesh;
}

std::string summary(const std::vector<Finding>& findings) {
  std::string out;
  for (const Finding& f : findings) {
    out +=
        fmt::format("{}{} {} {}", out.empty() ? "" : ", ", to_string(f.severity), f.code, f.line);
  }
  return out;
}

FileMesh read_whole(const std::string& text, const std::string& name) {
  const Result<FileMesh> mesh = read_file_mesh(text, name);
  INFO(text << summary(mesh.findings));
  for (const Finding& f : mesh.findings) UNSCOPED_INFO(f.text);
  REQUIRE(mesh);
  return *mesh;
}

bool identical(const TetMesh& a, const TetMesh& b) {
  // memcmp: -0.0 and 0.0 are different numbers in a file.
  return a.points.size() == b.points.size() &&
         std::memcmp(a.points.data(), b.points.data(), a.points.size() * sizeof(Point)) == 0 &&
         a.tetrahedra == b.tetrahedra && a.region == b.region && a.region_name == b.region_name &&
         a.source_point_id == b.source_point_id &&
         a.source_tetrahedron_id == b.source_tetrahedron_id;
}

double volume(const TetMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.tetrahedra) {
    double e[3][3];
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) e[i][k] = mesh.points[t[i + 1]][k] - mesh.points[t[0]][k];
    }
    sum += std::abs(e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
                    e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
                    e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
           6;
  }
  return sum;
}

namespace {

std::string base64(const std::string& bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned bits = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      out += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
    }
  }
  return out;
}

template <class Value>
void put(std::string& bytes, Value value, std::endian order) {
  char raw[sizeof(Value)];
  std::memcpy(raw, &value, sizeof raw);
  if (order != std::endian::native) std::reverse(std::begin(raw), std::end(raw));
  bytes.append(raw, sizeof raw);
}

void put_word(std::string& bytes, std::size_t word, const VtuVariant& v) {
  v.header_bytes == 8 ? put<std::uint64_t>(bytes, word, v.order)
                      : put<std::uint32_t>(bytes, static_cast<std::uint32_t>(word), v.order);
}

std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  compress(reinterpret_cast<Bytef*>(out.data()), &size,
           reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  out.resize(size);
  return out;
}

/// Header and data; with zlib in blocks of 64 bytes, so that there are several.
std::pair<std::string, std::string> packed(const std::string& bytes, const VtuVariant& v) {
  std::string header, data;
  if (!v.zlib) {
    put_word(header, bytes.size(), v);
    return {header, bytes};
  }
  constexpr std::size_t block = 64;
  const std::size_t blocks = (bytes.size() + block - 1) / block;
  for (const std::size_t word : {blocks, block, bytes.size() % block}) put_word(header, word, v);
  for (std::size_t at = 0; at < bytes.size(); at += block) {
    const std::string piece = deflated(bytes.substr(at, block));
    put_word(header, piece.size(), v);
    data += piece;
  }
  return {header, data};
}

struct Encoder {
  const VtuVariant& v;
  std::string appended;

  template <class Value>
  std::string array(std::string_view name, std::string_view type, const std::vector<Value>& values,
                    int components) {
    std::string body, offset;
    if (v.format == "ascii") {
      for (const Value x : values) body += fmt::format("{} ", x);
    } else {
      std::string bytes;
      for (const Value x : values) put(bytes, x, v.order);
      const auto [header, data] = packed(bytes, v);
      const bool raw = v.format == "appended" && v.appended_encoding == "raw";
      const std::string code = raw            ? header + data
                               : v.one_stream ? base64(header + data)
                                              : base64(header) + base64(data);
      if (v.format == "appended") {
        offset = fmt::format(" offset=\"{}\"", appended.size());
        appended += code;
      } else {
        body = "\n  " + code + "\n";
      }
    }
    return fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" "
        "format=\"{}\"{}>{}</DataArray>\n",
        type, name, components, v.format, offset, body);
  }
};

}  // namespace

std::string to_string(const VtuVariant& v) {
  return fmt::format("{} {} {} UInt{} {} {}", v.format, v.appended_encoding,
                     v.zlib ? "zlib" : "plain", 8 * v.header_bytes,
                     v.order == std::endian::little ? "little" : "big",
                     v.one_stream ? "one stream" : "two streams");
}

std::string encode_vtu(const TetMesh& mesh, const VtuVariant& v) {
  std::vector<double> points;
  for (const Point& p : mesh.points) points.insert(points.end(), p.begin(), p.end());
  std::vector<std::int64_t> corners, offsets;
  for (const auto& t : mesh.tetrahedra) {
    corners.insert(corners.end(), t.begin(), t.end());
    offsets.push_back(static_cast<std::int64_t>(corners.size()));
  }
  const std::vector<std::uint8_t> types(mesh.tetrahedra.size(), 10);
  Encoder e{v, {}};
  std::string xml = fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
      "byte_order=\"{}Endian\"{}{}>\n<UnstructuredGrid>\n"
      "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
      v.order == std::endian::little ? "Little" : "Big",
      v.header_bytes == 8 ? " header_type=\"UInt64\"" : "",
      v.zlib ? " compressor=\"vtkZLibDataCompressor\"" : "", mesh.points.size(),
      mesh.tetrahedra.size());
  xml += "<CellData>\n" + e.array("region", "Int32", mesh.region, 1) + "</CellData>\n";
  xml += "<Points>\n" + e.array("Points", "Float64", points, 3) + "</Points>\n<Cells>\n";
  xml += e.array("connectivity", "Int64", corners, 1) + e.array("offsets", "Int64", offsets, 1) +
         e.array("types", "UInt8", types, 1) + "</Cells>\n</Piece>\n</UnstructuredGrid>\n";
  if (v.format == "appended") {
    xml += fmt::format("<AppendedData encoding=\"{}\">\n  _{}\n</AppendedData>\n",
                       v.appended_encoding, e.appended);
  }
  return xml + "</VTKFile>\n";
}

double in_sixteen_characters(double x) {
  for (int digits = 17; digits > 0; --digits) {
    for (const char* const format : {"%.*g", "%.*e"}) {
      char text[64];
      std::snprintf(text, sizeof text, format, format[3] == 'g' ? digits : digits - 1, x);
      const std::string all = text;
      const std::size_t e = all.find('e');
      const std::string mantissa = all.substr(0, e);
      std::size_t length = mantissa.size() + (mantissa.find('.') == std::string::npos ? 1 : 0);
      if (e != std::string::npos) {
        const std::string exponent = std::to_string(std::abs(std::stoi(all.substr(e + 1))));
        length += 1 + exponent.size();
      }
      if (length <= 16) return std::strtod(all.c_str(), nullptr);  // also too small for std::stod
    }
  }
  return x;
}

}  // namespace sunder::test
