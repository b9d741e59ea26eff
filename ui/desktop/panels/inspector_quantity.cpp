// A small calculator that keeps account of dimensions, and the texts of numbers.
#include "ui/desktop/panels/inspector_quantity.h"

#include <cctype>
#include <cmath>

#include "core/base/text.h"
#include "core/reading/figures.h"

namespace bl::desktop {

namespace {

struct Quantity {
  double value = 0;
  Dimension dimension;
  bool is_plain = true;  ///< written without a unit: fits beside any
};

Dimension combined(const Dimension& a, const Dimension& b, int sign) {
  const auto add = [&](std::int8_t x, std::int8_t y) { return static_cast<std::int8_t>(x + sign * y); };
  return {add(a.length, b.length), add(a.time, b.time), add(a.angle, b.angle), add(a.money, b.money)};
}

std::string words_of(const Dimension& dimension) {
  for (const UnitInfo& row : unit_table())
    if (row.dimension == dimension && row.scale == 1)
      return dimension == Dimension{} ? "a plain number" : "in " + std::string(row.name) + "s";
  return "of an unknown unit";
}

// Rates are counted by the hour and times in seconds: only as long as nothing turns one into the other.
constexpr double kSecondsPerHour = 3600;
double in_seconds(const Quantity& q) {
  return q.dimension == info(Unit::per_hour).dimension ? q.value / kSecondsPerHour : q.value;
}

Quantity product_of(const Quantity& a, const Quantity& b, int sign) {
  Quantity result{0, combined(a.dimension, b.dimension, sign), a.is_plain && b.is_plain};
  const bool is_scaled = result.dimension == a.dimension || (sign > 0 && result.dimension == b.dimension);
  const double x = is_scaled ? a.value : in_seconds(a), y = is_scaled ? b.value : in_seconds(b);
  result.value = sign > 0 ? x * y : x / y;
  if (!is_scaled && result.dimension == info(Unit::per_hour).dimension) result.value *= kSecondsPerHour;
  return result;
}

class Calculator {
 public:
  explicit Calculator(std::string_view text) : text_(text) {}

  Result<Quantity> whole() {
    auto result = sum();
    if (!result) return result;
    skip();
    if (at_ < text_.size()) return unread();
    return result;
  }

 private:
  // How deep brackets and signs are nested: one thing beside another is no deeper.
  struct Level {
    explicit Level(int& counted) : depth(counted) { ++depth; }
    ~Level() { --depth; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;
    int& depth;
  };

  void skip() {
    while (at_ < text_.size() && (text_[at_] == ' ' || is_narrow_space(at_))) at_ += text_[at_] == ' ' ? 1 : 3;
  }
  bool is_narrow_space(std::size_t at) const { return text_.substr(at).starts_with("\xE2\x80\xAF"); }
  bool takes(char sign) {
    skip();
    if (at_ >= text_.size() || text_[at_] != sign) return false;
    ++at_;
    return true;
  }
  Error unread() const {
    const std::string rest(text_.substr(at_));
    if (rest.starts_with(",")) return {ErrorCode::parse, "", "decimals are written with a point, as in 7.5"};
    if (rest.empty()) return {ErrorCode::parse, "", "a number is missing at the end"};
    return {ErrorCode::parse, "",
            "`" + rest + "` is no number or unit that is known; write something like 12 m, 0.4 ha or 1200*1.5"};
  }

  Result<Quantity> sum() {
    auto left = product();
    while (left) {
      const bool is_plus = takes('+'), is_minus = !is_plus && takes('-');
      if (!is_plus && !is_minus) break;
      auto right = product();
      if (!right) return right;
      if (!left->is_plain && !right->is_plain && !(left->dimension == right->dimension))
        return Error{ErrorCode::wrong_unit, "",
                     "one part of the sum is " + words_of(left->dimension) + ", another " + words_of(right->dimension)};
      left->value += is_plus ? right->value : -right->value;
      if (left->is_plain) left->dimension = right->dimension;
      left->is_plain = left->is_plain && right->is_plain;
    }
    return left;
  }

  Result<Quantity> product() {
    auto left = factor();
    while (left) {
      const bool is_times = takes('*'), is_over = !is_times && takes('/');
      if (!is_times && !is_over) break;
      auto right = factor();
      if (!right) return right;
      *left = product_of(*left, *right, is_times ? 1 : -1);
    }
    return left;
  }

  Result<Quantity> factor() {
    const Level level(depth_);
    if (depth_ > 64) return Error{ErrorCode::parse, "", "there are too many brackets"};
    if (takes('-')) {
      auto inner = factor();
      if (inner) inner->value = -inner->value;
      return inner;
    }
    if (takes('(')) {
      auto inner = sum();
      if (inner && !takes(')')) return Error{ErrorCode::parse, "", "a bracket is not closed"};
      return inner;
    }
    skip();
    const auto number = read_number();
    if (!number) return unread();
    Quantity quantity{*number, {}, true};
    skip();
    if (const UnitInfo* unit = read_unit()) quantity = {*number * unit->scale, unit->dimension, unit->unit == Unit::none};
    return quantity;
  }

  // Groups of three may stand apart, as numbers are shown: "12 480".
  std::optional<double> read_number() {
    std::string digits;
    std::size_t at = at_;
    const auto is_digit = [&](std::size_t i) {
      return i < text_.size() && std::isdigit(static_cast<unsigned char>(text_[i])) != 0;
    };
    while (at < text_.size()) {
      const std::size_t space = text_[at] == ' ' ? 1 : is_narrow_space(at) ? 3 : 0;
      if (space > 0) {
        const std::size_t next = at + space;
        const bool is_group = is_digit(at - (at > 0 ? 1 : 0)) && is_digit(next) && is_digit(next + 1) && is_digit(next + 2) &&
                              !is_digit(next + 3) && digits.find('.') == std::string::npos && !digits.empty();
        if (!is_group) break;
        at = next;
        continue;
      }
      const bool is_exponent =
          (text_[at] == 'e' || text_[at] == 'E') &&
          (is_digit(at + 1) || (at + 2 < text_.size() && (text_[at + 1] == '-' || text_[at + 1] == '+') && is_digit(at + 2)));
      if (is_exponent) {
        digits += text_[at++];
        digits += text_[at++];
        continue;
      }
      if (!is_digit(at) && text_[at] != '.') break;
      digits += text_[at++];
    }
    const auto number = parse_number(digits);
    if (number) at_ = at;
    return number;
  }

  // The longest symbol that fits and does not go on as a word: "m/s" before "m".
  const UnitInfo* read_unit() {
    const UnitInfo* best = nullptr;
    std::size_t length = 0;
    for (const UnitInfo& row : unit_table())
      for (const std::string_view symbol : {row.symbol, row.pretty}) {
        if (symbol.size() <= length || !text_.substr(at_).starts_with(symbol)) continue;
        const std::size_t next = at_ + symbol.size();
        if (next < text_.size() && std::isalnum(static_cast<unsigned char>(text_[next])) != 0) continue;
        best = &row;
        length = symbol.size();
      }
    at_ += length;
    return best;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

}  // namespace

bool is_relative(std::string_view text) {
  text = trimmed(text);
  if (text.empty()) return false;
  return text.front() == '+' || text.front() == '*' || text.front() == '/' || (text.front() == '-' && text.back() == '%');
}

Result<double> typed_number(std::string_view text, Unit unit, double now) {
  text = trimmed(text);
  if (text.empty()) return Error{ErrorCode::parse, "", "a number is missing"};
  const bool is_change = is_relative(text),
             is_share = is_change && text.back() == '%' && (text.front() == '+' || text.front() == '-');
  const char sign = text.front();
  if (is_change) text.remove_prefix(1);
  if (is_share) text.remove_suffix(1);
  auto quantity = Calculator(text).whole();
  if (!quantity) return quantity.error();
  if (!std::isfinite(quantity->value)) return Error{ErrorCode::not_finite, "", "the result is not a finite number"};
  if (is_share) return now * (1 + (sign == '+' ? 0.01 : -0.01) * quantity->value);
  if (is_change && sign != '+') {
    if (!quantity->is_plain && !(quantity->dimension == Dimension{}))
      return Error{ErrorCode::wrong_unit, "", "a factor has no unit: write *1.5 or /2"};
    const double result = sign == '*' ? now * quantity->value : now / quantity->value;
    if (!std::isfinite(result)) return Error{ErrorCode::not_finite, "", "the result is not a finite number"};
    return result;
  }
  if (!quantity->is_plain && !(quantity->dimension == info(unit).dimension))
    return Error{ErrorCode::wrong_unit, "", "this is " + words_of(quantity->dimension) + "; wanted is " + unit_in_words(unit)};
  return is_change ? now + quantity->value : quantity->value;
}

std::string shown_number(double value, Unit unit) {
  const UnitInfo& handy = reading::handy_unit(value, unit);
  const bool is_scaled = handy.scale != info(unit).scale;
  value /= handy.scale / info(unit).scale;
  const double size = std::abs(value);
  std::string text;
  if (size > 0 && (size < 1e-6 || size >= 1e12)) {
    text = shortest(value);
  } else {
    const int most = is_scaled ? 3 : size >= 1 ? std::max(0, 8 - static_cast<int>(std::log10(size))) : 8;
    int decimals = 0;
    for (double scale = 1; decimals < most && std::abs(std::round(value * scale) / scale - value) > 1e-9 * size; scale *= 10)
      ++decimals;
    text = reading::grouped(value, decimals);
  }
  const std::string symbol(handy.pretty);
  return symbol.empty() ? text : text + "\xC2\xA0" + symbol;
}

std::string typed_form(double value, Unit unit) {
  const std::string symbol(info(unit).symbol);
  return shortest(value) + (symbol.empty() || info(unit).pretty.empty() ? "" : " " + symbol);
}

std::string unit_in_words(Unit unit) {
  if (info(unit).dimension == Dimension{}) return "a plain number";
  return "a quantity in " + std::string(info(unit).name) + "s (" + std::string(info(unit).pretty) + ")";
}

std::string facts_of(const PortDefinition& port, Unit unit) {
  std::string text;
  const bool is_number = port.kind == ValueKind::number || port.kind == ValueKind::integer;
  const auto line = [&](const std::string& name, const std::string& value) {
    text += (text.empty() ? "" : "\n") + name + "  " + value;
  };
  if (is_number || port.kind == ValueKind::point || port.kind == ValueKind::points)
    if (info(unit).unit != Unit::none)
      line("unit", std::string(info(unit).name) + (info(unit).pretty.empty() ? "" : " (" + std::string(info(unit).pretty) + ")"));
  if (is_number && !port.is_computed) {
    const double by_default = as_number(port.default_value);
    line("default", (means_none(port, by_default) ? kNoneWord : shown_number(by_default, unit)) +
                        (port.of_scene == OfScene::unless_set ? ", or the scene's setting" : ""));
    const bool has_low = std::isfinite(port.hard_minimum), has_high = std::isfinite(port.hard_maximum);
    if (has_low && has_high)
      line("range", shown_number(port.hard_minimum, unit) + " to " + shown_number(port.hard_maximum, unit));
    else if (has_low) line("range", "at least " + shown_number(port.hard_minimum, unit));
    else if (has_high) line("range", "at most " + shown_number(port.hard_maximum, unit));
    text += "\n\ndrag to change (Shift fine, Ctrl coarse, Esc back), click to type: 12 m, 0.4 ha, 1200*1.5, +10%";
  }
  return text;
}

}  // namespace bl::desktop
