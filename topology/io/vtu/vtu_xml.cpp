// SPDX-License-Identifier: MIT
// VTU's tags through expat: a stream parser, because raw appended data are no XML and must not be
// reached; arrays are remembered by their place in the file and never copied.
#include "topology/io/vtu/vtu_xml.hpp"

#include <expat.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <set>

#include "topology/base/limits.hpp"
#include "topology/io/text/scan.hpp"

namespace sunder::io {
namespace {

struct VtuParser {
  XML_Parser xml = nullptr;
  VtuDocument document;
  /// Names of the open elements.
  std::vector<std::string> open;
  /// Names of elements and attributes that came; expat keeps every new one.
  std::set<std::string, std::less<>> names;
  /// The array that is still open.
  VtuArray* array = nullptr;
  bool stopped_at_appended = false;
  std::string appended_encoding;
  /// expat is C: exceptions of a handler are carried over it here.
  std::optional<Finding> failure;
};

using Attributes = const XML_Char**;

/// Lists of cells of PolyData, in the order of PolyList.
constexpr std::array<std::string_view, 4> poly_tags = {"Verts", "Lines", "Polys", "Strips"};

std::optional<std::string_view> attribute(Attributes attributes, std::string_view name) {
  for (; *attributes != nullptr; attributes += 2) {
    if (attributes[0] == name) return attributes[1];
  }
  return std::nullopt;
}

std::size_t place(const VtuParser& p) {
  return static_cast<std::size_t>(XML_GetCurrentByteIndex(p.xml));
}

[[noreturn]] void fail_tag(const VtuParser& p, std::string_view code, std::string text,
                           std::string remedy) {
  fail(p.document.layout.text, place(p),
       {.code = std::string(code), .text = std::move(text), .remedy = std::move(remedy)});
}

/// An attribute that is a count; `otherwise` where it is not there, an error without that.
std::size_t count_attribute(const VtuParser& p, Attributes attributes, std::string_view name,
                            std::optional<std::size_t> otherwise = std::nullopt) {
  const auto value = attribute(attributes, name);
  if (!value && otherwise) return *otherwise;
  std::size_t count = 0;
  Scanner words{value.value_or("")};
  const std::string_view word = next_word(words);
  const auto [end, reason] = std::from_chars(word.data(), word.data() + word.size(), count);
  if (!value || reason != std::errc{} || end != word.data() + word.size()) {
    fail_tag(
        p, "bad_attribute",
        fmt::format("{}={} of {} is no count", name, in_quotes(value.value_or("")), p.open.back()),
        "write the attribute as a number from 0 up");
  }
  return count;
}

void start_file(VtuParser& p, Attributes attributes) {
  VtuLayout& layout = p.document.layout;
  const std::string_view type = attribute(attributes, "type").value_or("");
  p.document.is_polydata = type == "PolyData";
  if (type != "UnstructuredGrid" && !p.document.is_polydata) {
    fail_tag(p, "unknown_format", fmt::format("a VTK file of type {} is not read", in_quotes(type)),
             "save it as an unstructured grid (.vtu), or as PolyData (.vtp)");
  }
  const std::string_view order = attribute(attributes, "byte_order").value_or("LittleEndian");
  if (order != "LittleEndian" && order != "BigEndian") {
    fail_tag(p, "bad_attribute", fmt::format("byte_order={} is not known", in_quotes(order)),
             "write LittleEndian or BigEndian");
  }
  layout.byte_order = order == "BigEndian" ? std::endian::big : std::endian::little;
  const std::string_view header = attribute(attributes, "header_type").value_or("UInt32");
  if (header != "UInt32" && header != "UInt64") {
    fail_tag(p, "bad_attribute", fmt::format("header_type={} is not known", in_quotes(header)),
             "write UInt32 or UInt64");
  }
  layout.header_bytes = header == "UInt64" ? 8 : 4;
  const std::string_view compressor = attribute(attributes, "compressor").value_or("");
  if (!compressor.empty() && compressor != "vtkZLibDataCompressor") {
    fail_tag(p, "unsupported_compressor",
             fmt::format("data packed by {} are not read", in_quotes(compressor)),
             "save the file with zlib compression, or with none");
  }
  layout.is_compressed = !compressor.empty();
}

/// Both counts are attributes: nothing is allocated by them before they are found plausible.
void start_piece(VtuParser& p, Attributes attributes) {
  VtuPiece piece{.at = place(p)};
  piece.points = count_attribute(p, attributes, "NumberOfPoints");
  const std::size_t most = p.document.layout.text.size() * most_unfolding;
  const auto check = [&](std::size_t count, std::string_view what) {
    if (count <= most) return;
    fail_tag(p, "count_too_big",
             fmt::format("{} {} are announced, more than {} bytes can hold", count, what,
                         p.document.layout.text.size()),
             "correct the count; if it is right, the file was cut short");
  };
  check(piece.points, "points");
  if (p.document.is_polydata) {
    std::array<std::size_t, poly_tags.size()> counts{};
    for (std::size_t i = 0; i < counts.size(); ++i) {
      counts[i] = count_attribute(p, attributes, fmt::format("NumberOf{}", poly_tags[i]), 0);
      check(counts[i], "cells");
      piece.cells += counts[i];
    }
    if (piece.cells > 0) piece.poly_cells.assign(counts.begin(), counts.end());
  } else {
    piece.cells = count_attribute(p, attributes, "NumberOfCells");
    check(piece.cells, "cells");
  }
  p.document.pieces.push_back(std::move(piece));
}

std::list<VtuArray>* arrays_of(VtuPiece& piece, std::string_view parent) {
  if (parent == "Points") return &piece.point_arrays;
  if (parent == "Cells") return &piece.cell_arrays;
  if (std::ranges::find(poly_tags, parent) != poly_tags.end()) return &piece.cell_arrays;
  if (parent == "PointData") return &piece.point_data;
  if (parent == "CellData") return &piece.cell_data;
  return nullptr;
}

/// The content passed over, each kind and name once: a file has as many tags as bytes.
void skip_content(VtuParser& p, std::string_view kind, std::string_view name) {
  constexpr std::size_t most = 64;
  const auto is_same = [&](const VtuSkipped& s) { return s.kind == kind && s.name == name; };
  if (std::ranges::any_of(p.document.skipped, is_same)) return;
  if (p.document.skipped.size() >= most) return;
  p.document.skipped.push_back({std::string(kind), std::string(name), place(p)});
}

/// A tag that is neither read nor known to hold no data of the mesh.
void skip_unknown(VtuParser& p, std::string_view name) {
  constexpr std::string_view known[] = {
      "VTKFile",  "UnstructuredGrid", "PolyData",  "Piece",       "Points", "Cells", "PointData",
      "CellData", "FieldData",        "DataArray", "Array",       "Verts",  "Lines", "Polys",
      "Strips",   "InformationKey",   "Value",     "AppendedData"};
  if (std::ranges::find(known, name) == std::end(known)) skip_content(p, "tags", name);
}

/// Whether the array that opens is read. Others are of the whole grid, or of an unknown part of it.
std::list<VtuArray>* place_of_array(VtuParser& p, Attributes attributes) {
  const std::string_view name = attribute(attributes, "Name").value_or("");
  const std::string_view parent =
      p.open.size() < 2 ? std::string_view{} : p.open[p.open.size() - 2];
  const bool in_piece = p.open.size() >= 3 && p.open[p.open.size() - 3] == "Piece";
  std::list<VtuArray>* const arrays = in_piece && !p.document.pieces.empty()
                                          ? arrays_of(p.document.pieces.back(), parent)
                                          : nullptr;
  if (arrays == nullptr) {
    const bool is_of_grid = parent == "FieldData";
    skip_content(p, is_of_grid ? "field data of the grid" : "arrays outside of the grid", name);
  }
  return arrays;
}

void start_array(VtuParser& p, Attributes attributes) {
  std::list<VtuArray>* const arrays = place_of_array(p, attributes);
  if (arrays == nullptr) return;
  VtuArray array{.at = place(p)};
  const auto* const list = std::ranges::find(poly_tags, p.open[p.open.size() - 2]);
  if (list != poly_tags.end())
    array.poly_list = static_cast<std::uint8_t>(list - poly_tags.begin());
  array.name = attribute(attributes, "Name").value_or("");
  const auto type = attribute(attributes, "type");
  if (!type) {
    fail_tag(p, "bad_attribute", fmt::format("array {} has no type", in_quotes(array.name)),
             "write its type, such as type=\"Float64\"");
  }
  array.type = *type;
  array.components = count_attribute(p, attributes, "NumberOfComponents", 1);
  const std::string_view format = attribute(attributes, "format").value_or("ascii");
  array.is_ascii = format == "ascii";
  array.is_appended = format == "appended";
  if (!array.is_ascii && !array.is_appended && format != "binary") {
    fail_tag(p, "bad_attribute", fmt::format("format={} is not known", in_quotes(format)),
             "write ascii, binary or appended");
  }
  if (attribute(attributes, "ComponentName0")) skip_content(p, "names of components", array.name);
  if (array.is_appended) array.offset = count_attribute(p, attributes, "offset");
  const std::size_t begin = array.at + static_cast<std::size_t>(XML_GetCurrentByteCount(p.xml));
  array.content = p.document.layout.text.substr(begin, 0);
  arrays->push_back(std::move(array));
  p.array = &arrays->back();
}

/// A VTU file stays far below these bounds; a hostile one would fill memory with tags.
void bound_tags(VtuParser& p, std::string_view name, Attributes attributes) {
  const std::size_t deepest = limits().xml_levels;
  constexpr std::size_t most_names = 1024;
  if (p.open.size() >= deepest) {
    fail_tag(p, "bad_xml", fmt::format("tags are nested more than {} deep", deepest),
             "this is no VTU file: its tags are nested five deep");
  }
  const auto know = [&p](std::string_view word) {
    if (p.names.find(word) == p.names.end()) p.names.emplace(word);
  };
  know(name);
  for (; *attributes != nullptr; attributes += 2) know(attributes[0]);
  if (p.names.size() > most_names) {
    fail_tag(p, "bad_xml", fmt::format("more than {} names of tags and attributes", most_names),
             "this is no VTU file: it has a few dozen");
  }
}

/// The text of an array ends here.
void end_array(VtuParser& p) {
  if (p.array == nullptr) return;
  const char* const begin = p.array->content.data();
  const char* const end = p.document.layout.text.data() + place(p);
  // An empty tag <DataArray ... /> ends where it starts.
  p.array->content = std::string_view(begin, end > begin ? end - begin : 0);
  p.array = nullptr;
}

void start_element(VtuParser& p, std::string_view name, Attributes attributes) {
  bound_tags(p, name, attributes);
  end_array(p);  // VTK puts <InformationKey> behind the numbers
  p.open.emplace_back(name);
  if (p.open.size() == 1 && name != "VTKFile") {
    fail_tag(p, "unknown_format", "the document is XML, but no VTKFile",
             "give a .vtu or .vtp file");
  }
  if (name == "VTKFile") return start_file(p, attributes);
  if (name == "Piece") return start_piece(p, attributes);
  // VTK's tag for arrays of strings is Array.
  if (name == "DataArray" || name == "Array") return start_array(p, attributes);
  if (name == "AppendedData") {
    p.appended_encoding = attribute(attributes, "encoding").value_or("base64");
    p.stopped_at_appended = true;
    const std::size_t end = place(p) + static_cast<std::size_t>(XML_GetCurrentByteCount(p.xml));
    p.document.layout.appended = p.document.layout.text.substr(end);
    XML_StopParser(p.xml, XML_FALSE);
  }
  skip_unknown(p, name);
}

void end_element(VtuParser& p) {
  p.open.pop_back();
  end_array(p);
}

template <class Work>
void guarded(VtuParser& p, Work work) {
  if (p.failure || p.stopped_at_appended) return;
  try {
    work();
  } catch (ReadFailure& failure) {
    p.failure = std::move(failure.finding);
    XML_StopParser(p.xml, XML_FALSE);
  }
}

void XMLCALL on_start(void* parser, const XML_Char* name, Attributes attributes) {
  auto& p = *static_cast<VtuParser*>(parser);
  guarded(p, [&] { start_element(p, name, attributes); });
}

void XMLCALL on_end(void* parser, const XML_Char*) {
  auto& p = *static_cast<VtuParser*>(parser);
  guarded(p, [&] { end_element(p); });
}

/// A document type could define entities: no VTU file needs one.
void XMLCALL on_doctype(void* parser, const XML_Char*, const XML_Char*, const XML_Char*, int) {
  auto& p = *static_cast<VtuParser*>(parser);
  guarded(p, [&] {
    fail_tag(p, "bad_xml", "a document type definition is not accepted", "delete <!DOCTYPE ...>");
  });
}

void find_appended(VtuParser& p) {
  VtuLayout& layout = p.document.layout;
  const std::size_t start = layout.appended.find_first_not_of(" \t\r\n");
  if (start == std::string_view::npos || layout.appended[start] != '_') {
    fail(layout.text, layout.text.size() - layout.appended.size(),
         {.code = start == std::string_view::npos ? "truncated_file" : "bad_xml",
          .text = "the appended data do not begin with an underscore",
          .remedy = "the file is damaged: copy or write it again"});
  }
  layout.appended.remove_prefix(start + 1);
  if (p.appended_encoding != "raw" && p.appended_encoding != "base64") {
    fail(layout.text, layout.text.size() - layout.appended.size(),
         {.code = "bad_attribute",
          .text = fmt::format("encoding={} of AppendedData is not known",
                              in_quotes(p.appended_encoding)),
          .remedy = "write raw or base64"});
  }
  layout.appended_encoding = p.appended_encoding == "raw" ? VtuEncoding::raw : VtuEncoding::base64;
}

[[noreturn]] void fail_xml(const VtuParser& p) {
  const std::string_view text = p.document.layout.text;
  const XML_Error error = XML_GetErrorCode(p.xml);
  const bool cut = error == XML_ERROR_NO_ELEMENTS || error == XML_ERROR_UNCLOSED_TOKEN ||
                   error == XML_ERROR_PARTIAL_CHAR || error == XML_ERROR_UNCLOSED_CDATA_SECTION;
  fail(text, std::min(place(p), text.size()),
       {.code = cut ? "truncated_file" : "bad_xml",
        .text = fmt::format("{} at byte {}: {}", cut ? "the XML ends too early" : "no valid XML",
                            place(p), XML_ErrorString(error)),
        .remedy = "the file is damaged: copy or write it again"});
}

}  // namespace

VtuDocument parse_vtu(std::string_view text) {
  VtuParser p;
  p.document.layout.text = text;
  const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> owner(
      XML_ParserCreate(nullptr), &XML_ParserFree);
  p.xml = owner.get();
  XML_SetUserData(p.xml, &p);
  XML_SetElementHandler(p.xml, on_start, on_end);
  XML_SetStartDoctypeDeclHandler(p.xml, on_doctype);
  // In parts, so that expat's buffer for an unfinished tag is bounded.
  constexpr std::size_t chunk = std::size_t{1} << 16;
  for (std::size_t at = 0; at < text.size(); at += chunk) {
    const std::size_t size = std::min(chunk, text.size() - at);
    const bool last = at + size == text.size();
    const XML_Status status = XML_Parse(p.xml, text.data() + at, static_cast<int>(size), last);
    if (p.failure) throw ReadFailure{std::move(*p.failure)};
    if (p.stopped_at_appended) break;
    if (status != XML_STATUS_OK) fail_xml(p);
    if (at + size - std::min(place(p), at) > 2 * chunk) {
      fail_tag(p, "bad_xml", fmt::format("a tag or comment has more than {} bytes", chunk),
               "the file is damaged: copy or write it again");
    }
  }
  if (p.stopped_at_appended) find_appended(p);
  return std::move(p.document);
}

}  // namespace sunder::io
