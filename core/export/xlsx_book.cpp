// The parts of a workbook as texts in a zip archive; without dates, so that the same tables are the same bytes.
#include "core/export/xlsx_book.h"

#include "core/base/text.h"
#include "core/drawing/markup.h"
#include "core/export/zip_archive.h"

namespace bl::exporting {

namespace {

constexpr const char* kXmlHead = "<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"yes\"?>\n";
constexpr const char* kSheetSpace = "http://schemas.openxmlformats.org/spreadsheetml/2006/main";
constexpr const char* kRelationSpace = "http://schemas.openxmlformats.org/officeDocument/2006/relationships";
constexpr const char* kPackageSpace = "http://schemas.openxmlformats.org/package/2006/relationships";

// In the order of XlsxStyle.
constexpr const char* kStyles =
    "<styleSheet xmlns=\"http://schemas.openxmlformats.org/spreadsheetml/2006/main\"><numFmts count=\"1\"><numFmt "
    "numFmtId=\"164\" formatCode=\"#,##0.00\"/></numFmts><fonts count=\"2\"><font><sz "
    "val=\"11\"/><name val=\"Calibri\"/></font><font><b/><sz val=\"11\"/><name val=\"Calibri\"/></font></fonts><fills "
    "count=\"2\"><fill><patternFill patternType=\"none\"/></fill><fill><patternFill "
    "patternType=\"gray125\"/></fill></fills><borders "
    "count=\"1\"><border><left/><right/><top/><bottom/><diagonal/></border></borders><cellStyleXfs count=\"1\"><xf "
    "numFmtId=\"0\" "
    "fontId=\"0\" fillId=\"0\" borderId=\"0\"/></cellStyleXfs><cellXfs count=\"4\"><xf numFmtId=\"0\" fontId=\"0\" fillId=\"0\" "
    "borderId=\"0\" xfId=\"0\"/><xf numFmtId=\"0\" fontId=\"1\" fillId=\"0\" borderId=\"0\" xfId=\"0\" applyFont=\"1\"/><xf "
    "numFmtId=\"164\" fontId=\"0\" fillId=\"0\" borderId=\"0\" xfId=\"0\" applyNumberFormat=\"1\"/><xf numFmtId=\"10\" "
    "fontId=\"0\" fillId=\"0\" "
    "borderId=\"0\" xfId=\"0\" applyNumberFormat=\"1\"/></cellXfs><cellStyles count=\"1\"><cellStyle name=\"Normal\" xfId=\"0\" "
    "builtinId=\"0\"/></cellStyles></styleSheet>";

void add_cell(const XlsxCell& cell, const std::string& place, drawing::Markup& out) {
  const std::string style = std::to_string(static_cast<int>(cell.style));
  if (cell.kind == XlsxCell::Kind::empty) return;
  if (cell.kind == XlsxCell::Kind::text) {
    out.open("c", {{"r", place}, {"s", style}, {"t", "inlineStr"}}).open("is");
    out.element("t", cell.text, {{"xml:space", "preserve"}}).close().close();
    return;
  }
  out.open("c", {{"r", place}, {"s", style}});
  if (!cell.formula.empty()) out.element("f", cell.formula);
  out.element("v", shortest(cell.number)).close();
}

std::string sheet_text(const XlsxSheet& sheet) {
  drawing::Markup out;
  out.open("worksheet", {{"xmlns", kSheetSpace}});
  out.open("sheetViews").open("sheetView", {{"workbookViewId", "0"}});
  out.leaf("pane", {{"ySplit", "1"}, {"topLeftCell", "A2"}, {"activePane", "bottomLeft"}, {"state", "frozen"}}).close().close();
  if (!sheet.widths.empty()) {
    out.open("cols");
    for (std::size_t k = 0; k < sheet.widths.size(); ++k)
      out.leaf("col", {{"min", std::to_string(k + 1)},
                       {"max", std::to_string(k + 1)},
                       {"width", shortest(sheet.widths[k])},
                       {"customWidth", "1"}});
    out.close();
  }
  out.open("sheetData");
  for (std::size_t row = 0; row < sheet.rows.size(); ++row) {
    const std::string number = std::to_string(row + 1);
    out.open("row", {{"r", number}});
    for (std::size_t column = 0; column < sheet.rows[row].size(); ++column)
      add_cell(sheet.rows[row][column], column_name(column) + number, out);
    out.close();
  }
  out.close().close();
  return kXmlHead + out.str();
}

std::string types_text(std::size_t sheets) {
  drawing::Markup out;
  const std::string base = "application/vnd.openxmlformats-officedocument.spreadsheetml.";
  out.open("Types", {{"xmlns", "http://schemas.openxmlformats.org/package/2006/content-types"}});
  out.leaf("Default", {{"Extension", "rels"}, {"ContentType", "application/vnd.openxmlformats-package.relationships+xml"}});
  out.leaf("Default", {{"Extension", "xml"}, {"ContentType", "application/xml"}});
  out.leaf("Override", {{"PartName", "/xl/workbook.xml"}, {"ContentType", base + "sheet.main+xml"}});
  out.leaf("Override", {{"PartName", "/xl/styles.xml"}, {"ContentType", base + "styles+xml"}});
  out.leaf("Override",
           {{"PartName", "/docProps/core.xml"}, {"ContentType", "application/vnd.openxmlformats-package.core-properties+xml"}});
  for (std::size_t k = 1; k <= sheets; ++k)
    out.leaf("Override",
             {{"PartName", "/xl/worksheets/sheet" + std::to_string(k) + ".xml"}, {"ContentType", base + "worksheet+xml"}});
  out.close();
  return kXmlHead + out.str();
}

std::string book_text(const std::vector<XlsxSheet>& sheets) {
  drawing::Markup out;
  out.open("workbook", {{"xmlns", kSheetSpace}, {"xmlns:r", kRelationSpace}}).open("sheets");
  for (std::size_t k = 0; k < sheets.size(); ++k)
    out.leaf("sheet", {{"name", sheets[k].name}, {"sheetId", std::to_string(k + 1)}, {"r:id", "rId" + std::to_string(k + 1)}});
  out.close().close();
  return kXmlHead + out.str();
}

std::string relations_text(const std::vector<std::pair<std::string, std::string>>& parts) {
  drawing::Markup out;
  out.open("Relationships", {{"xmlns", kPackageSpace}});
  for (std::size_t k = 0; k < parts.size(); ++k)
    out.leaf("Relationship", {{"Id", "rId" + std::to_string(k + 1)}, {"Type", parts[k].first}, {"Target", parts[k].second}});
  out.close();
  return kXmlHead + out.str();
}

std::string properties_text(const std::string& title, const std::string& about) {
  drawing::Markup out;
  out.open("cp:coreProperties", {{"xmlns:cp", "http://schemas.openxmlformats.org/package/2006/metadata/core-properties"},
                                 {"xmlns:dc", "http://purl.org/dc/elements/1.1/"}});
  out.element("dc:title", title).element("dc:creator", "BehaviourLinks").element("dc:description", about).close();
  return kXmlHead + out.str();
}

}  // namespace

std::string column_name(std::size_t column) {
  std::string name;
  for (std::size_t rest = column + 1; rest > 0; rest = (rest - 1) / 26)
    name.insert(name.begin(), static_cast<char>('A' + (rest - 1) % 26));
  return name;
}

Result<std::string> xlsx_book(const std::vector<XlsxSheet>& sheets, const std::string& title, const std::string& about) {
  const std::string relation = kRelationSpace;
  std::vector<std::pair<std::string, std::string>> parts;
  for (std::size_t k = 1; k <= sheets.size(); ++k)
    parts.emplace_back(relation + "/worksheet", "worksheets/sheet" + std::to_string(k) + ".xml");
  parts.emplace_back(relation + "/styles", "styles.xml");
  std::vector<std::pair<std::string, std::string>> files = {
      {"[Content_Types].xml", types_text(sheets.size())},
      {"_rels/.rels", relations_text({{relation + "/officeDocument", "xl/workbook.xml"},
                                      {"http://schemas.openxmlformats.org/package/2006/relationships/metadata/core-properties",
                                       "docProps/core.xml"}})},
      {"docProps/core.xml", properties_text(title, about)},
      {"xl/workbook.xml", book_text(sheets)},
      {"xl/_rels/workbook.xml.rels", relations_text(parts)},
      {"xl/styles.xml", std::string(kXmlHead) + kStyles}};
  for (std::size_t k = 0; k < sheets.size(); ++k)
    files.emplace_back("xl/worksheets/sheet" + std::to_string(k + 1) + ".xml", sheet_text(sheets[k]));
  return zip_archive(files, kXlsxEnd);
}

}  // namespace bl::exporting
