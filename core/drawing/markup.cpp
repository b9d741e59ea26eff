// Escaping by the rules of XML 1.0, and paths whose rounded points never drift.
#include "core/drawing/markup.h"

#include <cmath>
#include <cstdlib>

#include "core/base/text.h"

namespace bl::drawing {

namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

// Length of the sound UTF-8 sequence that starts at `at` and holds a character that XML allows, or 0.
std::size_t character_length(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned lead = byte(at);
  if (lead < 0x80) return lead >= 0x20 || lead == '\t' || lead == '\n' || lead == '\r' ? 1 : 0;
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || at + length > text.size()) return 0;
  unsigned code = lead & (0xFFu >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(at + i) & 0xC0u) != 0x80u) return 0;
    code = (code << 6) | (byte(at + i) & 0x3Fu);
  }
  const unsigned least = length == 2 ? 0x80u : length == 3 ? 0x800u : 0x10000u;
  const bool is_allowed =
      code >= least && code <= 0x10FFFF && !(code >= 0xD800 && code <= 0xDFFF) && code != 0xFFFE && code != 0xFFFF;
  return is_allowed ? length : 0;
}

}  // namespace

std::string escape_xml(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = character_length(text, i);
    switch (text[i]) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      case '\'': out += "&#39;"; break;
      default: out += length == 0 ? kReplacement : text.substr(i, length);
    }
    i += length == 0 ? 1 : length;
  }
  return out;
}

std::string pixels(double value) {
  std::string text = fixed(value, 1);
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text;
}

void PathText::number(std::int64_t tenths, bool after_letter) {
  if (tenths >= 0 && !after_letter) text_ += ' ';
  if (tenths < 0) text_ += '-';
  const std::int64_t size = std::abs(tenths);
  if (size >= 10 || size == 0) text_ += std::to_string(size / 10);
  if (size % 10 != 0) text_.append(".").append(std::to_string(size % 10));
}

void PathText::step(char letter, std::int64_t x, std::int64_t y) {
  // Pairs after an `m` are relative lines (after an `M` absolute ones), so that only a change of letter needs to be written.
  const bool is_new = letter != letter_;
  if (is_new) text_ += letter;
  number(x, is_new);
  number(y, false);
  letter_ = letter == 'm' ? 'l' : letter;
}

void PathText::move(Pixel to) {
  const std::int64_t x = std::llround(to.x * 10), y = std::llround(to.y * 10);
  // The first `m` of a path counts from the origin.
  step('m', x - x_, y - y_);
  x_ = start_x_ = x;
  y_ = start_y_ = y;
}

void PathText::line(Pixel to) {
  const std::int64_t x = std::llround(to.x * 10), y = std::llround(to.y * 10);
  if (x == x_ && y == y_) return;
  step('l', x - x_, y - y_);
  x_ = x;
  y_ = y;
}

void PathText::close() {
  text_ += 'z';
  letter_ = 'z';
  x_ = start_x_;
  y_ = start_y_;
}

void PathText::polyline(const std::vector<Pixel>& points, bool is_closed) {
  if (points.size() < 2) return;
  move(points.front());
  for (std::size_t i = 1; i < points.size(); ++i) line(points[i]);
  if (is_closed) close();
}

void Markup::start(std::string_view tag, Attributes attributes) {
  out_.append("<").append(tag);
  for (const auto& [name, value] : attributes) out_.append(" ").append(name).append("=\"").append(escape_xml(value)).append("\"");
}

Markup& Markup::open(std::string_view tag, Attributes attributes) {
  start(tag, attributes);
  out_ += '>';
  open_.emplace_back(tag);
  return *this;
}

Markup& Markup::close() {
  out_.append("</").append(open_.back()).append(">\n");
  open_.pop_back();
  return *this;
}

Markup& Markup::leaf(std::string_view tag, Attributes attributes) {
  start(tag, attributes);
  out_ += "/>\n";
  return *this;
}

Markup& Markup::element(std::string_view tag, std::string_view content, Attributes attributes) {
  return open(tag, attributes).text(content).close();
}

Markup& Markup::text(std::string_view content) {
  out_ += escape_xml(content);
  return *this;
}

Markup& Markup::raw(std::string_view markup) {
  out_ += markup;
  return *this;
}

Markup& Markup::path(const PathText& path, Attributes attributes) {
  if (path.empty()) return *this;
  start("path", attributes);
  out_.append(" d=\"").append(path.text()).append("\"/>\n");
  return *this;
}

}  // namespace bl::drawing
