// Lines of TNTP files: `~` begins a comment, `<NAME> value` is metadata, everything else is rows.
#include "core/import/tntp_lines.h"

#include <algorithm>
#include <cctype>

#include "core/base/packed_kind.h"
#include "core/base/text.h"

namespace bl::importing {

namespace {

constexpr std::string_view kSeparators = " \t\r\f\v,;:";

std::string_view without_blanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\f\v");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\f\v") - first + 1);
}

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t first = line.find_first_not_of(kSeparators);
    if (first == std::string_view::npos) return fields;
    const std::size_t end = std::min(line.find_first_of(kSeparators, first), line.size());
    fields.push_back(line.substr(first, end - first));
    line.remove_prefix(end);
  }
}

std::string upper(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return result;
}

// "Free Flow Time (min)" and "free_flow_time" are one name. Names are parted by tabs; where there are none, by blanks.
std::vector<std::string> names_of(std::string_view line) {
  const char parting = line.find('\t') != std::string_view::npos ? '\t' : ' ';
  std::vector<std::string> names;
  while (!line.empty()) {
    const std::size_t end = std::min(line.find(parting), line.size());
    std::string name;
    for (const char c : line.substr(0, end)) {
      if (c == '(') break;
      if (std::isalnum(static_cast<unsigned char>(c)) != 0)
        name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    if (!name.empty()) names.push_back(std::move(name));
    line.remove_prefix(std::min(end + 1, line.size()));
  }
  return names;
}

bool is_noise(std::string_view line) {
  return std::any_of(line.begin(), line.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\r' && c != '\f' && c != '\v';
  });
}

Result<void> take_metadata(std::string_view line, int number, TntpText& out) {
  const std::size_t end = line.find('>');
  if (end == std::string_view::npos)
    return Error{ErrorCode::parse, tntp_line_place(number), "metadata begins with `<` and needs a `>` behind its name"};
  out.metadata.insert_or_assign(upper(without_blanks(line.substr(1, end - 1))),
                                std::string(without_blanks(line.substr(end + 1))));
  return {};
}

// A row of numbers; `Origin 3` and names of columns never end with `;`.
bool is_row(const TntpLine& line) { return parse_number(line.fields.front()).has_value(); }

}  // namespace

std::string tntp_line_place(int number) { return "line " + std::to_string(number); }

Result<TntpText> split_tntp(std::string_view text) {
  TntpText out;
  std::size_t rows = 0, open_rows = 0;  // all, and those that `;` does not end
  bool is_open = false;                 // the last one is among these
  if (auto packed = packed_refusal(text)) return *packed;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = without_blanks(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (is_noise(line)) return Error{ErrorCode::parse, tntp_line_place(number), "this is no text; choose a TNTP file (`.tntp`)"};
    if (line.starts_with("<")) {
      if (auto taken = take_metadata(line, number, out); !taken) return taken.error();
      continue;
    }
    if (const std::size_t comment = line.find('~'); comment != std::string_view::npos) {
      // The comment right before the rows names the columns.
      if (comment == 0 && out.lines.empty()) out.columns = names_of(line.substr(1));
      line = without_blanks(line.substr(0, comment));
    }
    if (auto fields = fields_of(line); !fields.empty()) {
      out.lines.push_back({number, std::move(fields), line});
      if (is_row(out.lines.back())) {
        is_open = !line.ends_with(';');
        open_rows += is_open ? 1 : 0;
        ++rows;
      }
    }
  }
  out.is_cut_off = is_open && open_rows == 1 && rows > 1 && is_row(out.lines.back());
  // Files of flows and places name their columns in a plain first row.
  if (!out.lines.empty() && !parse_number(out.lines.front().fields.front()) &&
      upper(out.lines.front().fields.front()) != "ORIGIN") {
    out.columns.clear();
    for (const std::string_view field : out.lines.front().fields)
      for (std::string& name : names_of(field)) out.columns.push_back(std::move(name));
    out.lines.erase(out.lines.begin());
  }
  return out;
}

Result<double> tntp_metadata_number(const TntpText& text, const std::string& name, double missing) {
  const auto it = text.metadata.find(name);
  if (it == text.metadata.end() || it->second.empty()) return missing;
  const auto fields = fields_of(it->second);
  const auto number = fields.empty() ? std::nullopt : parse_number(fields.front());
  if (!number)
    return Error{ErrorCode::parse, "<" + name + ">", "expects a number behind it, not `" + it->second.substr(0, 40) + "`"};
  return *number;
}

}  // namespace bl::importing
