// Draws sheets by libharu in memory; its fonts are the fourteen that every reader has, for western letters.
#include "core/export/pdf_pages.h"

#include <hpdf.h>

#include <algorithm>
#include <array>
#include <memory>
#include <type_traits>

namespace bl::exporting {

namespace {

constexpr double kPoints = 72 / 25.4;  // per millimetre

// Both codes of PDF have the letters of western Europe at their numbers, and other signs from 0x80 on; 0: none.
using WesternSigns = std::array<unsigned, 33>;
// The code page 1252, of texts on pages.
constexpr WesternSigns kPageSigns = {0x20ac, 0,      0x201a, 0x0192, 0x201e, 0x2026, 0x2020, 0x2021, 0x02c6, 0x2030, 0x0160,
                                     0x2039, 0x0152, 0,      0x017d, 0,      0,      0x2018, 0x2019, 0x201c, 0x201d, 0x2022,
                                     0x2013, 0x2014, 0x02dc, 0x2122, 0x0161, 0x203a, 0x0153, 0,      0x017e, 0x0178, 0x00a0};
// PDFDocEncoding, of the properties of a file.
constexpr WesternSigns kPropertySigns = {0x2022, 0x2020, 0x2021, 0x2026, 0x2014, 0x2013, 0x0192, 0x2044, 0x2039, 0x203a, 0x2212,
                                         0x2030, 0x201e, 0x201c, 0x201d, 0x2018, 0x2019, 0x201a, 0x2122, 0xfb01, 0xfb02, 0x0141,
                                         0x0152, 0x0160, 0x0178, 0x017d, 0x0131, 0x0142, 0x0153, 0x0161, 0x017e, 0,      0x20ac};

std::string western(const std::string& utf8, const WesternSigns& signs, bool& has_lost) {
  std::string out;
  for (std::size_t k = 0; k < utf8.size();) {
    const auto lead = static_cast<unsigned char>(utf8[k]);
    const std::size_t length = lead < 0x80 ? 1 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
    unsigned code = length == 1 ? lead : lead & (length == 2 ? 0x1fu : length == 3 ? 0x0fu : 0x07u);
    for (std::size_t b = 1; b < length && k + b < utf8.size(); ++b)
      code = (code << 6) | (static_cast<unsigned char>(utf8[k + b]) & 0x3fu);
    k += length;
    const auto sign = code < 0x80 ? signs.end() : std::find(signs.begin(), signs.end(), code);
    if (sign != signs.end()) code = 0x80 + static_cast<unsigned>(sign - signs.begin());
    else if (code == 0x202f || code == 0x2009 || code == 0xa0) code = ' ';
    else if (code > 0xff || (code >= 0x80 && code < 0xa0)) code = '?', has_lost = true;
    out += code < 0x20 ? ' ' : static_cast<char>(code);
  }
  return out;
}

struct PdfDeath {
  void operator()(HPDF_Doc document) const { HPDF_Free(document); }
};
using PdfDocument = std::unique_ptr<std::remove_pointer_t<HPDF_Doc>, PdfDeath>;

// Its errors are asked for afterwards, so that nothing is thrown through code in C.
void pdf_stays_silent(HPDF_STATUS, HPDF_STATUS, void*) {}

class PdfPage {
 public:
  PdfPage(HPDF_Page page, HPDF_Font plain, HPDF_Font bold, double height, bool& has_lost)
      : page_(page), plain_(plain), bold_(bold), height_(height), has_lost_(has_lost) {}

  void draw(const PlanSheet& sheet) {
    for (const SheetGroup& group : sheet.groups) {
      HPDF_Page_GSave(page_);
      if (group.is_clipped) clip(sheet);
      for (const SheetShape& shape : group.shapes) draw(shape);
      for (const SheetText& text : group.texts) draw(text);
      HPDF_Page_GRestore(page_);
    }
  }

 private:
  static HPDF_REAL points(double millimetres) { return static_cast<HPDF_REAL>(millimetres * kPoints); }
  HPDF_REAL up(double y) const { return points(height_ - y); }

  void clip(const PlanSheet& sheet) {
    HPDF_Page_Rectangle(page_, points(sheet.window_low.x), up(sheet.window_high.y),
                        points(sheet.window_high.x - sheet.window_low.x), points(sheet.window_high.y - sheet.window_low.y));
    HPDF_Page_Clip(page_);
    HPDF_Page_EndPath(page_);
  }

  void draw(const SheetShape& shape) {
    const auto part = [](double share) { return static_cast<HPDF_REAL>(share); };
    HPDF_Page_SetRGBFill(page_, part(shape.fill.red), part(shape.fill.green), part(shape.fill.blue));
    HPDF_Page_SetRGBStroke(page_, part(shape.stroke.red), part(shape.stroke.green), part(shape.stroke.blue));
    HPDF_Page_SetLineWidth(page_, points(shape.width));
    const HPDF_UINT16 dashes[] = {8, 4};
    HPDF_Page_SetDash(page_, shape.is_dashed ? dashes : nullptr, shape.is_dashed ? 2 : 0, 0);
    bool is_empty = true;
    for (const std::vector<SheetPoint>& line : shape.lines) {
      if (line.size() < 2) continue;
      is_empty = false;
      HPDF_Page_MoveTo(page_, points(line.front().x), up(line.front().y));
      for (std::size_t k = 1; k < line.size(); ++k) HPDF_Page_LineTo(page_, points(line[k].x), up(line[k].y));
      if (shape.is_closed) HPDF_Page_ClosePath(page_);
    }
    if (is_empty) return;
    if (shape.is_filled && shape.is_stroked) HPDF_Page_EofillStroke(page_);
    else if (shape.is_filled) HPDF_Page_Eofill(page_);
    else HPDF_Page_Stroke(page_);
  }

  void draw(const SheetText& text) {
    const std::string words = western(text.words, kPageSigns, has_lost_);
    HPDF_Page_SetRGBFill(page_, 0.13f, 0.15f, 0.19f);
    HPDF_Page_SetFontAndSize(page_, text.is_bold ? bold_ : plain_, points(text.size));
    const HPDF_REAL width = HPDF_Page_TextWidth(page_, words.c_str());
    const HPDF_REAL back = text.anchor == SheetAnchor::start ? 0 : text.anchor == SheetAnchor::middle ? width / 2 : width;
    HPDF_Page_BeginText(page_);
    HPDF_Page_TextOut(page_, points(text.at.x) - back, up(text.at.y), words.c_str());
    HPDF_Page_EndText(page_);
  }

  HPDF_Page page_;
  HPDF_Font plain_, bold_;
  double height_;
  bool& has_lost_;
};

Error pdf_failure(HPDF_Doc document) {
  return {ErrorCode::internal, "pdf", "the library of PDF files failed with error " + std::to_string(HPDF_GetError(document))};
}

}  // namespace

Result<PdfBook> pdf_pages(const std::vector<PlanSheet>& sheets, const std::string& title, const std::string& about) {
  const PdfDocument document(HPDF_New(pdf_stays_silent, nullptr));
  if (document == nullptr) return Error{ErrorCode::internal, "pdf", "there is no memory for a PDF file"};
  PdfBook book;
  HPDF_SetCompressionMode(document.get(), HPDF_COMP_ALL);
  bool ignored = false;
  HPDF_SetInfoAttr(document.get(), HPDF_INFO_TITLE, western(title, kPropertySigns, ignored).c_str());
  HPDF_SetInfoAttr(document.get(), HPDF_INFO_CREATOR, "BehaviourLinks");
  HPDF_SetInfoAttr(document.get(), HPDF_INFO_SUBJECT, western(about, kPropertySigns, ignored).c_str());
  const HPDF_Font plain = HPDF_GetFont(document.get(), "Helvetica", "WinAnsiEncoding"),
                  bold = HPDF_GetFont(document.get(), "Helvetica-Bold", "WinAnsiEncoding");
  for (const PlanSheet& sheet : sheets) {
    const HPDF_Page page = HPDF_AddPage(document.get());
    if (page == nullptr) return pdf_failure(document.get());
    HPDF_Page_SetWidth(page, static_cast<HPDF_REAL>(sheet.width * kPoints));
    HPDF_Page_SetHeight(page, static_cast<HPDF_REAL>(sheet.height * kPoints));
    PdfPage(page, plain, bold, sheet.height, book.lost_letters).draw(sheet);
  }
  if (HPDF_GetError(document.get()) != HPDF_OK || HPDF_SaveToStream(document.get()) != HPDF_OK)
    return pdf_failure(document.get());
  HPDF_ResetStream(document.get());
  book.bytes.resize(HPDF_GetStreamSize(document.get()));
  auto size = static_cast<HPDF_UINT32>(book.bytes.size());
  HPDF_ReadFromStream(document.get(), reinterpret_cast<HPDF_BYTE*>(book.bytes.data()), &size);
  if (size != book.bytes.size() || book.bytes.empty()) return pdf_failure(document.get());
  return book;
}

}  // namespace bl::exporting
