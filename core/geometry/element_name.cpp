// Names of elements: their order and their text.
#include "core/geometry/element_name.h"

#include <algorithm>
#include <charconv>

namespace bl::geometry {

namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

bool read_label(std::string_view text, ElementLabel& label) {
  text = trimmed(text);
  const bool is_side = !text.empty() && text.front() == '#';
  if (is_side) text.remove_prefix(1);
  std::uint32_t number = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (code != std::errc{} || end != text.data() + text.size()) return false;
  label = is_side ? ElementLabel::side(number) : ElementLabel::site(number);
  return true;
}

}  // namespace

ElementName::ElementName(std::span<const ElementLabel> labels) {
  if (labels.size() <= kInside) {
    // The common case, without memory of its own.
    std::copy(labels.begin(), labels.end(), first_.begin());
    const auto begin = first_.begin(), end = begin + static_cast<std::ptrdiff_t>(labels.size());
    std::sort(begin, end);
    const auto last = std::unique(begin, end);
    std::fill(last, first_.end(), ElementLabel{});
    size_ = static_cast<std::uint32_t>(last - begin);
    return;
  }
  std::vector<ElementLabel> all(labels.begin(), labels.end());
  assign(all);
}

ElementName::ElementName(std::initializer_list<ElementLabel> labels)
    : ElementName(std::span<const ElementLabel>(labels.begin(), labels.size())) {}

void ElementName::assign(std::vector<ElementLabel>& labels) {
  std::sort(labels.begin(), labels.end());
  labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
  size_ = static_cast<std::uint32_t>(labels.size());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (i < kInside) {
      first_[i] = labels[i];
    } else {
      rest_.push_back(labels[i]);
    }
  }
}

bool ElementName::contains(ElementLabel label) const {
  for (std::size_t i = 0; i < size_; ++i) {
    if ((*this)[i] == label) return true;
  }
  return false;
}

std::vector<std::uint32_t> ElementName::sites() const {
  std::vector<std::uint32_t> sites;
  for (std::size_t i = 0; i < size_ && !(*this)[i].is_side(); ++i) sites.push_back((*this)[i].number());
  return sites;
}

std::string ElementName::text() const {
  std::string text = "{";
  for (std::size_t i = 0; i < size_; ++i) {
    if (i > 0) text += ',';
    if ((*this)[i].is_side()) text += '#';
    text += std::to_string((*this)[i].number());
  }
  return text + "}";
}

std::strong_ordering ElementName::compare_rest(const ElementName& other) const { return rest_ <=> other.rest_; }

Result<ElementName> ElementName::parse(std::string_view text) {
  const auto refused = [&](const std::string& what) {
    return Error{ErrorCode::parse, "", "`" + std::string(text.substr(0, 60)) + "` is no name of an element: " + what};
  };
  std::string_view inside = trimmed(text);
  if (inside.size() < 2 || inside.front() != '{' || inside.back() != '}') {
    return refused("expects labels in braces, such as {3,7,#2}");
  }
  inside = inside.substr(1, inside.size() - 2);
  std::vector<ElementLabel> labels;
  while (true) {
    const std::size_t comma = inside.find(',');
    ElementLabel label;
    if (!read_label(inside.substr(0, comma), label)) return refused("a label is the number of a site, or # and that of a side");
    labels.push_back(label);
    if (comma == std::string_view::npos) break;
    inside.remove_prefix(comma + 1);
  }
  ElementName name{std::span<const ElementLabel>(labels)};
  if (name.size() != labels.size()) return refused("a label occurs twice");
  return name;
}

}  // namespace bl::geometry
