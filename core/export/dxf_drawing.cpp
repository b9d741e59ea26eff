// The sections of a DXF file in their order: header, classes, tables, blocks, entities, objects.
#include "core/export/dxf_drawing.h"

#include <algorithm>
#include <cstdio>

#include "core/base/text.h"

namespace bl::exporting {

namespace {

// Texts are of the code page 1252: what is beyond ASCII is written by its number.
std::string dxf_text(std::string_view utf8, bool& has_lost) {
  std::string out;
  for (std::size_t k = 0; k < utf8.size();) {
    const auto lead = static_cast<unsigned char>(utf8[k]);
    const std::size_t length = lead < 0x80 ? 1 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
    if (length == 1) {
      out += lead < 0x20 ? ' ' : utf8[k];
    } else if (length == 4 || k + length > utf8.size()) {
      out += '?';
      has_lost = true;
    } else {
      unsigned code = lead & (length == 2 ? 0x1fu : 0x0fu);
      for (std::size_t b = 1; b < length; ++b) code = (code << 6) | (static_cast<unsigned char>(utf8[k + b]) & 0x3fu);
      char escaped[16];
      std::snprintf(escaped, sizeof escaped, "\\U+%04X", code);
      out += escaped;
    }
    k += length;
  }
  return out;
}

// In texts of a drawing a caret begins a control code, and two percent signs do: both stand for themselves here.
std::string words_as_they_are(std::string_view text) {
  std::string out;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const bool is_pair = text[k] == '%' && ((k > 0 && text[k - 1] == '%') || text.substr(k + 1).starts_with('%'));
    if (is_pair) out += "%%%";
    else out += text[k];
    if (text[k] == '^') out += ' ';
  }
  return out;
}

class DxfGroups {
 public:
  DxfGroups& put(int code, std::string_view value) {
    text_.append(std::to_string(code)).append("\n").append(value).append("\n");
    return *this;
  }
  DxfGroups& put(int code, double value) {
    std::string number = shortest(value);
    if (number.find_first_of(".e") == std::string::npos) number += ".0";
    return put(code, std::string_view(number));
  }
  DxfGroups& put(int code, int value) { return put(code, std::string_view(std::to_string(value))); }
  DxfGroups& point(int code, const Point3& p) { return put(code, p.x).put(code + 10, p.y).put(code + 20, p.z); }
  DxfGroups& section(std::string_view name) { return put(0, "SECTION").put(2, name); }
  DxfGroups& end_section() { return put(0, "ENDSEC"); }
  const std::string& str() const { return text_; }

 private:
  std::string text_;
};

class DxfHandles {
 public:
  std::string next() {
    char digits[16];
    std::snprintf(digits, sizeof digits, "%X", last_++);
    return digits;
  }

 private:
  unsigned last_ = 0x20;
};

// Handles that other parts of the file refer to.
struct DxfRoots {
  std::string model, paper, model_layout, paper_layout, dictionary, groups, layouts;
};

struct DxfTables {
  DxfGroups& out;
  DxfHandles& handles;

  std::string open(const char* name, int count) {
    const std::string handle = handles.next();
    out.put(0, "TABLE").put(2, name).put(5, handle).put(330, "0").put(100, "AcDbSymbolTable").put(70, count);
    return handle;
  }
  DxfGroups& entry(const char* type, const std::string& table, const char* record, std::string_view name) {
    const bool is_style = std::string_view(type) == "DIMSTYLE";
    return out.put(0, type)
        .put(is_style ? 105 : 5, handles.next())
        .put(330, table)
        .put(100, "AcDbSymbolTableRecord")
        .put(100, record)
        .put(2, name)
        .put(70, 0);
  }
  void close() { out.put(0, "ENDTAB"); }

  void empty(const char* name) {
    open(name, 0);
    close();
  }

  void viewport(const Point3& middle, double height) {
    const std::string table = open("VPORT", 1);
    entry("VPORT", table, "AcDbViewportTableRecord", "*Active");
    out.put(10, 0.0).put(20, 0.0).put(11, 1.0).put(21, 1.0).put(12, middle.x).put(22, middle.y).put(13, 0.0).put(23, 0.0);
    out.put(14, 1.0).put(24, 1.0).put(15, 1.0).put(25, 1.0).point(16, {0, 0, 1}).point(17, {0, 0, 0});
    out.put(40, height).put(41, 1.4).put(42, 50.0).put(43, 0.0).put(44, 0.0).put(50, 0.0).put(51, 0.0).put(71, 0).put(72, 100);
    out.put(73, 1).put(74, 3).put(75, 0).put(76, 0).put(77, 0).put(78, 0);
    close();
  }
  void line_types() {
    const std::string table = open("LTYPE", 3);
    for (const char* name : {"ByBlock", "ByLayer", "Continuous"}) {
      entry("LTYPE", table, "AcDbLinetypeTableRecord", name);
      out.put(3, std::string_view(name) == "Continuous" ? "Solid line" : "").put(72, 65).put(73, 0).put(40, 0.0);
    }
    close();
  }
  void layers(const std::map<std::string, int>& all) {
    const std::string table = open("LAYER", static_cast<int>(all.size()));
    for (const auto& [name, colour] : all)
      entry("LAYER", table, "AcDbLayerTableRecord", name).put(62, colour).put(6, "Continuous").put(370, -3);
    close();
  }
  void styles() {
    const std::string table = open("STYLE", 1);
    entry("STYLE", table, "AcDbTextStyleTableRecord", "Standard");
    out.put(40, 0.0).put(41, 1.0).put(50, 0.0).put(71, 0).put(42, 1.0).put(3, "txt").put(4, "");
    close();
  }
  void applications() {
    const std::string table = open("APPID", 1);
    entry("APPID", table, "AcDbRegAppTableRecord", "ACAD");
    close();
  }
  void dimension_styles() {
    const std::string table = open("DIMSTYLE", 1);
    out.put(100, "AcDbDimStyleTable").put(71, 1);
    entry("DIMSTYLE", table, "AcDbDimStyleTableRecord", "Standard");
    close();
  }
  void block_records(const DxfRoots& roots) {
    const std::string table = open("BLOCK_RECORD", 2);
    const auto add = [&](const char* name, const std::string& handle, const std::string& layout) {
      out.put(0, "BLOCK_RECORD").put(5, handle).put(330, table).put(100, "AcDbSymbolTableRecord");
      out.put(100, "AcDbBlockTableRecord").put(2, name).put(340, layout);
    };
    add("*Model_Space", roots.model, roots.model_layout);
    add("*Paper_Space", roots.paper, roots.paper_layout);
    close();
  }
};

void put_block(DxfGroups& out, DxfHandles& handles, const char* name, const std::string& record, bool is_paper) {
  const auto common = [&](const char* type) {
    out.put(0, type).put(5, handles.next()).put(330, record).put(100, "AcDbEntity");
    if (is_paper) out.put(67, 1);
    out.put(8, "0");
  };
  common("BLOCK");
  out.put(100, "AcDbBlockBegin").put(2, name).put(70, 0).point(10, {0, 0, 0}).put(3, name).put(1, "");
  common("ENDBLK");
  out.put(100, "AcDbBlockEnd");
}

void put_layout(DxfGroups& out, const DxfRoots& roots, bool is_model) {
  out.put(0, "LAYOUT").put(5, is_model ? roots.model_layout : roots.paper_layout).put(330, roots.layouts);
  out.put(100, "AcDbPlotSettings").put(1, "").put(2, "none_device").put(4, "A3").put(6, "");
  for (int code = 40; code <= 49; ++code) out.put(code, 0.0);
  out.put(140, 0.0).put(141, 0.0).put(142, 1.0).put(143, 1.0).put(70, is_model ? 1712 : 688).put(72, 1).put(73, 0).put(74, 5);
  out.put(7, "").put(75, 16).put(147, 1.0).put(148, 0.0).put(149, 0.0);
  out.put(100, "AcDbLayout").put(1, is_model ? "Model" : "Layout1").put(70, 1).put(71, is_model ? 0 : 1);
  out.put(10, 0.0).put(20, 0.0).put(11, 420.0).put(21, 297.0).point(12, {0, 0, 0}).point(14, {1e20, 1e20, 1e20});
  out.point(15, {-1e20, -1e20, -1e20}).put(146, 0.0).point(13, {0, 0, 0}).point(16, {1, 0, 0}).point(17, {0, 1, 0}).put(76, 0);
  out.put(330, is_model ? roots.model : roots.paper);
}

void put_objects(DxfGroups& out, const DxfRoots& roots) {
  out.section("OBJECTS");
  out.put(0, "DICTIONARY").put(5, roots.dictionary).put(330, "0").put(100, "AcDbDictionary").put(281, 1);
  out.put(3, "ACAD_GROUP").put(350, roots.groups).put(3, "ACAD_LAYOUT").put(350, roots.layouts);
  out.put(0, "DICTIONARY").put(5, roots.groups).put(330, roots.dictionary).put(100, "AcDbDictionary").put(281, 1);
  out.put(0, "DICTIONARY").put(5, roots.layouts).put(330, roots.dictionary).put(100, "AcDbDictionary").put(281, 1);
  out.put(3, "Layout1").put(350, roots.paper_layout).put(3, "Model").put(350, roots.model_layout);
  put_layout(out, roots, true);
  put_layout(out, roots, false);
  out.end_section();
}

}  // namespace

std::string DxfDrawing::layer_name(std::string_view text) {
  std::string name;
  for (const char c : text) {
    if ((static_cast<unsigned char>(c) & 0xc0u) == 0x80) continue;  // within a letter of several bytes
    const bool is_small = c >= 'a' && c <= 'z', is_plain = (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
    name += is_small ? static_cast<char>(c - 'a' + 'A') : is_plain ? c : '_';
  }
  return name.empty() ? "_" : name;
}

void DxfDrawing::reach(const Point3& p) {
  low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y), std::min(low_.z, p.z)};
  high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y), std::max(high_.z, p.z)};
}

void DxfDrawing::layer(const std::string& name, int colour) { layers_.emplace(name, colour); }

void DxfDrawing::polyline(const std::string& layer, const std::vector<Corner>& corners, bool is_closed, double elevation) {
  if (corners.size() < 2) return;
  DxfGroups body;
  body.put(100, "AcDbPolyline").put(90, static_cast<int>(corners.size())).put(70, is_closed ? 1 : 0).put(38, elevation);
  for (const Corner& corner : corners) {
    body.put(10, corner.at.x).put(20, corner.at.y);
    if (corner.bulge != 0) body.put(42, corner.bulge);
    reach({corner.at.x, corner.at.y, elevation});
  }
  entities_.push_back({"LWPOLYLINE", layer, body.str()});
}

void DxfDrawing::line(const std::string& layer, const Point3& from, const Point3& to) {
  DxfGroups body;
  body.put(100, "AcDbLine").point(10, from).point(11, to);
  reach(from), reach(to);
  entities_.push_back({"LINE", layer, body.str()});
}

void DxfDrawing::text(const std::string& layer, const Point3& at, double height, std::string_view words, bool is_centred) {
  DxfGroups body;
  body.put(100, "AcDbText")
      .point(10, at)
      .put(40, height)
      .put(1, dxf_text(words_as_they_are(words), has_lost_letters_))
      .put(7, "Standard");
  if (is_centred) body.put(72, 1).point(11, at);
  body.put(100, "AcDbText");
  if (is_centred) body.put(73, 2);
  reach(at);
  entities_.push_back({"TEXT", layer, body.str()});
}

std::string DxfDrawing::str(const std::string& comment) const {
  DxfHandles handles;
  DxfRoots roots;
  for (std::string* root :
       {&roots.model, &roots.paper, &roots.model_layout, &roots.paper_layout, &roots.dictionary, &roots.groups, &roots.layouts})
    *root = handles.next();
  const bool is_empty = entities_.empty();
  const Point3 low = is_empty ? Point3{} : low_, high = is_empty ? Point3{1, 1, 0} : high_;
  DxfGroups rest;
  rest.section("CLASSES").end_section().section("TABLES");
  DxfTables tables{rest, handles};
  tables.viewport(0.5 * (low + high), std::max({1.0, high.y - low.y, high.x - low.x}) * 1.1);
  tables.line_types();
  tables.layers(layers_);
  tables.styles();
  for (const char* name : {"VIEW", "UCS"}) tables.empty(name);
  tables.applications();
  tables.dimension_styles();
  tables.block_records(roots);
  rest.end_section().section("BLOCKS");
  put_block(rest, handles, "*Model_Space", roots.model, false);
  put_block(rest, handles, "*Paper_Space", roots.paper, true);
  rest.end_section().section("ENTITIES");
  std::string entities;
  for (const Entity& entity : entities_) {
    DxfGroups head;
    head.put(0, entity.type).put(5, handles.next()).put(330, roots.model).put(100, "AcDbEntity").put(8, entity.layer);
    entities += head.str() + entity.body;
  }
  DxfGroups tail, header;
  tail.end_section();
  put_objects(tail, roots);
  tail.put(0, "EOF");
  bool ignored = false;
  header.put(999, dxf_text(comment, ignored)).section("HEADER");
  header.put(9, "$ACADVER").put(1, "AC1015").put(9, "$DWGCODEPAGE").put(3, "ANSI_1252").put(9, "$INSBASE").point(10, {0, 0, 0});
  header.put(9, "$EXTMIN").point(10, low).put(9, "$EXTMAX").point(10, high).put(9, "$LUNITS").put(70, 2);
  header.put(9, "$INSUNITS").put(70, 6).put(9, "$MEASUREMENT").put(70, 1).put(9, "$HANDSEED").put(5, handles.next());
  header.end_section();
  return header.str() + rest.str() + entities + tail.str();
}

}  // namespace bl::exporting
