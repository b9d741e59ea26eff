// Scales with round steps, hairlines, and lines of one pixel and a half.
#include "ui/desktop/panels/charts.h"

#include <algorithm>
#include <cmath>

#include "core/reading/figures.h"
#include "ui/desktop/look/buttons.h"
#include "ui/desktop/panels/inspector_quantity.h"

namespace bl::desktop {

namespace {

constexpr double kLeastShown = 1e-6;
constexpr int kMostSteps = 5;

// From data to a share of the height, and the places of its labels.
struct Scale {
  double low = 0, high = 1;
  bool is_log = false;
  std::vector<double> labels;

  double at(double value) const {
    if (is_log) return (std::log10(std::max(value, kLeastShown)) - std::log10(low)) / (std::log10(high) - std::log10(low));
    return (value - low) / (high - low);
  }
};

double round_step(double span, int most) {
  const double raw = span / most, decade = std::pow(10, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * decade >= raw) return factor * decade;
  return 10 * decade;
}

Scale scale_of(const Chart& chart, int most) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const Series& series : chart.series)
    for (const double value : series.values) {
      if (!std::isfinite(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  if (chart.mark > 0) low = std::min(low, chart.mark), high = std::max(high, chart.mark);
  Scale scale;
  scale.is_log = chart.is_log;
  if (!(low <= high)) return scale;
  if (chart.is_log) {
    const double first = std::floor(std::log10(std::max(low, kLeastShown))),
                 last = std::max(first + 1, std::ceil(std::log10(std::max(high, kLeastShown))));
    scale.low = std::pow(10, first);
    scale.high = std::pow(10, last);
    const int every = std::max(1, static_cast<int>(std::ceil((last - first) / most)));
    for (int k = 0; first + k <= last; k += every) scale.labels.push_back(std::pow(10, first + k));
    return scale;
  }
  // Not from zero where that would flatten the line: what changes is what matters here.
  if (low > 0 && low < 0.5 * high) low = 0;
  if (high - low < 1e-9 * std::max(1.0, std::abs(high))) high = low + std::max(1e-3, 0.02 * std::abs(low));
  const double step = round_step(high - low, most);
  scale.low = std::floor(low / step) * step;
  scale.high = std::ceil(high / step) * step;
  for (int k = 0; scale.low + k * step <= scale.high + 1e-9 * step; ++k) scale.labels.push_back(scale.low + k * step);
  return scale;
}

class Drawing {
 public:
  Drawing(const Theme& theme, const Chart& chart, ImVec2 at, ImVec2 size)
      : theme_(theme), chart_(chart), at_(at), small_(theme.fonts().small) {
    const float room = size.y - 3 * small_->FontSize;
    scale_ = scale_of(chart, std::clamp(static_cast<int>(room / (1.7f * small_->FontSize)), 1, kMostSteps));
    float widest = 0;
    for (const double label : scale_.labels) widest = std::max(widest, width_of(label_text(label)));
    left_ = std::round(at.x + widest + theme.px(8));
    right_ = at.x + size.x - theme.px(4);
    top_ = std::round(at.y + small_->FontSize + theme.px(8));
    bottom_ = std::round(at.y + size.y - small_->FontSize - theme.px(4));
  }

  void draw(const ImVec2 mouse, bool is_hovered) {
    const Colours& c = theme_.colours();
    draw_heading();
    for (const double label : scale_.labels) {
      const float y = std::round(y_of(label));
      list_.AddLine({left_, y}, {right_, y}, faded(c.line, 0.55f));
      const std::string text = label_text(label);
      write({left_ - theme_.px(6) - width_of(text), y - small_->FontSize / 2}, c.text_faint, text);
    }
    const std::size_t count = chart_.ticks.size();
    if (count < 2) {
      write({left_ + theme_.px(4), (top_ + bottom_) / 2 - small_->FontSize / 2}, c.text_faint,
            "the line begins with the second tick");
      return;
    }
    draw_mark();
    draw_bottom();
    list_.PushClipRect({left_, top_ - theme_.px(2)}, {right_ + 2, bottom_ + theme_.px(2)}, true);
    for (const Series& series : chart_.series) draw_line(series);
    list_.PopClipRect();
    if (is_hovered && mouse.x >= left_ && mouse.x <= right_) draw_readout(mouse);
  }

 private:
  std::string text_of(double value) const { return chart_number(chart_, value); }
  // Round steps need no decimals that are noughts.
  std::string label_text(double value) const {
    return chart_.is_share ? shown_number(100 * value, Unit::none) + "\xC2\xA0%" : shown_number(value, chart_.unit);
  }
  float width_of(const std::string& text) const { return small_->CalcTextSizeA(small_->FontSize, FLT_MAX, 0, text.c_str()).x; }
  void write(ImVec2 at, ImU32 colour, const std::string& text) {
    list_.AddText(small_, small_->FontSize, at, colour, text.c_str());
  }
  float y_of(double value) const {
    return bottom_ - static_cast<float>(std::clamp(scale_.at(value), -0.1, 1.1)) * (bottom_ - top_);
  }
  float x_of(std::size_t k) const {
    const double first = chart_.ticks.front(), span = std::max(1.0, chart_.ticks.back() - first);
    return left_ + static_cast<float>((chart_.ticks[k] - first) / span) * (right_ - left_);
  }

  void draw_heading() {
    const Colours& c = theme_.colours();
    write(at_, c.text_soft, chart_.title);
    float x = right_;
    for (std::size_t s = chart_.series.size(); s-- > 0;) {
      const Series& series = chart_.series[s];
      const std::string text = series.label + (series.values.empty() ? "" : " " + text_of(series.values.back()));
      x -= width_of(text);
      if (x < at_.x + width_of(chart_.title) + theme_.px(24)) break;
      write({x, at_.y}, c.text, text);
      x -= theme_.px(12);
      list_.AddLine({x, at_.y + small_->FontSize / 2}, {x + theme_.px(8), at_.y + small_->FontSize / 2}, series.colour,
                    theme_.px(2));
      x -= theme_.px(12);
    }
  }

  void draw_mark() {
    if (!(chart_.mark > 0)) return;
    const float y = std::round(y_of(chart_.mark));
    for (float x = left_; x < right_; x += theme_.px(7))
      list_.AddLine({x, y}, {std::min(right_, x + theme_.px(4)), y}, theme_.colours().good);
    const float above = y - small_->FontSize - 1;
    write({right_ - width_of(chart_.mark_label), above > top_ ? above : y + 1}, theme_.colours().good, chart_.mark_label);
  }

  void draw_bottom() {
    const Colours& c = theme_.colours();
    const std::string first = "tick " + reading::grouped(chart_.ticks.front()), last = reading::grouped(chart_.ticks.back());
    write({left_, bottom_ + theme_.px(3)}, c.text_faint, first);
    write({right_ - width_of(last), bottom_ + theme_.px(3)}, c.text_faint, last);
  }

  void draw_line(const Series& series) {
    std::vector<ImVec2> points;
    for (std::size_t k = 0; k < std::min(series.values.size(), chart_.ticks.size()); ++k)
      if (std::isfinite(series.values[k])) points.push_back({x_of(k), y_of(series.values[k])});
    list_.AddPolyline(points.data(), static_cast<int>(points.size()), series.colour, 0, theme_.px(1.5f));
    if (!points.empty()) list_.AddCircleFilled(points.back(), theme_.px(2.5f), series.colour);
  }

  void draw_readout(ImVec2 mouse) {
    const double span = chart_.ticks.back() - chart_.ticks.front();
    const double wanted = chart_.ticks.front() + span * static_cast<double>((mouse.x - left_) / (right_ - left_));
    const auto after = std::lower_bound(chart_.ticks.begin(), chart_.ticks.end(), wanted);
    const auto k = std::min(static_cast<std::size_t>(after - chart_.ticks.begin()), chart_.ticks.size() - 1);
    const float x = x_of(k);
    list_.AddLine({x, top_}, {x, bottom_}, theme_.colours().text_faint);
    std::string text = "tick " + reading::grouped(chart_.ticks[k]);
    for (const Series& series : chart_.series) {
      if (k >= series.values.size()) continue;
      list_.AddCircleFilled({x, y_of(series.values[k])}, theme_.px(3), series.colour);
      text += "\n" + series.label + "  " + text_of(series.values[k]);
    }
    // As wide as the longest text will be: a card that grows with each tick would be cut off for a frame.
    ImGui::BeginTooltip();
    ImGui::TextUnformatted(text.c_str());
    ImGui::Dummy({theme_.px(150), 0});
    ImGui::EndTooltip();
  }

  const Theme& theme_;
  const Chart& chart_;
  Scale scale_;
  ImVec2 at_;
  ImFont* small_;
  ImDrawList& list_ = *ImGui::GetWindowDrawList();
  float left_ = 0, right_ = 0, top_ = 0, bottom_ = 0;
};

}  // namespace

std::string chart_number(const Chart& chart, double value) {
  if (chart.is_share) return reading::percent(value);
  return reading::quantity(value, chart.unit);
}

void line_chart(const Theme& theme, const char* id, ImVec2 size, const Chart& chart) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  press_area(id, size);
  if (size.x < theme.px(80) || size.y < theme.px(40)) return;
  Drawing(theme, chart, at, size).draw(ImGui::GetIO().MousePos, ImGui::IsItemHovered());
}

void bar(const Theme& theme, ImVec2 from, ImVec2 to, double share, double mark, ImU32 colour) {
  const Colours& c = theme.colours();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float rounding = theme.px(2), width = to.x - from.x;
  list.AddRectFilled(from, to, c.sunken, rounding);
  const float end = from.x + static_cast<float>(std::clamp(share, 0.0, 1.0)) * width;
  if (end > from.x + 0.5f) list.AddRectFilled(from, {end, to.y}, colour, rounding);
  if (mark < 0) return;
  const float x = std::round(from.x + static_cast<float>(std::clamp(mark, 0.0, 1.0)) * width);
  list.AddLine({x, from.y - theme.px(2)}, {x, to.y + theme.px(2)}, c.text, theme.px(1.5f));
}

void spark_line(const Theme& theme, ImVec2 from, ImVec2 to, std::span<const double> values, ImU32 colour) {
  if (values.size() < 2) return;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double span = std::max(*high - *low, 1e-12);
  std::vector<ImVec2> points;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const float x = from.x + (to.x - from.x) * static_cast<float>(k) / static_cast<float>(values.size() - 1);
    points.push_back({x, to.y - static_cast<float>((values[k] - *low) / span) * (to.y - from.y)});
  }
  ImGui::GetWindowDrawList()->AddPolyline(points.data(), static_cast<int>(points.size()), colour, 0, theme.px(1.2f));
}

}  // namespace bl::desktop
