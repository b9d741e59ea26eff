// Volumes in a plan are filled by triangles, around their courtyards. Everything else is lines.
#include "ui/desktop/panels/plan_picture.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include <nlohmann/json.hpp>

#include "core/define/json_text.h"
#include "core/geometry/polygon_triangles.h"

namespace bl::desktop {

namespace {

constexpr std::array kPlanKinds = {"boundary", "plot", "street", "building", "volume"};  // what lies on top comes last
constexpr float kLeastWidth = 150, kHighest = 220;                                       // of a plan [points]
constexpr double kMargin = 0.03;                                                         // of the larger side

std::string plan_text(const Json& json, const char* key) {
  return json.is_object() && json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : std::string();
}

// Two numbers with a blank between them; moves `at` behind them.
std::optional<PlanPoint> plan_point(const char*& at, const char* end) {
  PlanPoint point;
  for (double* number : {&point.x, &point.y}) {
    while (at != end && *at == ' ') ++at;
    const auto [stop, fault] = std::from_chars(at, end, *number);
    if (fault != std::errc() || !std::isfinite(*number)) return std::nullopt;
    at = stop;
  }
  return point;
}

struct PlanBox {
  double left = std::numeric_limits<double>::infinity(), top = left, right = -left, bottom = -left;
  void add(const PlanPicture& picture) {
    for (const auto& [id, shape] : picture)
      for (const PlanLine& line : shape.lines)
        for (const PlanPoint& point : line.points) {
          left = std::min(left, point.x), right = std::max(right, point.x);
          top = std::min(top, point.y), bottom = std::max(bottom, point.y);
        }
  }
  void widen(double by) { left -= by, right += by, top -= by, bottom += by; }
  double width() const { return right - left; }
  double height() const { return bottom - top; }
};

struct PlanFrame {
  PlanBox box;
  float scale = 1;  // pixels of a metre
};

void draw_plan_shape(const Theme& theme, const PlanShape& shape, const PlanFrame& frame, ImVec2 corner, bool is_marked) {
  const Colours& c = theme.colours();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const bool is_volume = shape.kind == "volume";
  const auto place = [&](const PlanPoint& point) {
    return ImVec2{corner.x + static_cast<float>(point.x - frame.box.left) * frame.scale,
                  corner.y + static_cast<float>(point.y - frame.box.top) * frame.scale};
  };
  // Without smoothing, which would leave hairs between triangles.
  const ImDrawListFlags flags = list.Flags;
  list.Flags &= ~ImDrawListFlags_AntiAliasedFill;
  for (std::size_t k = 0; k + 2 < shape.triangles.size(); k += 3)
    list.AddTriangleFilled(place(shape.triangles[k]), place(shape.triangles[k + 1]), place(shape.triangles[k + 2]),
                           colour_of_text(shape.fill, c.text_faint));
  list.Flags = flags;
  for (const PlanLine& line : shape.lines) {
    std::vector<ImVec2> points;
    for (const PlanPoint& point : line.points) points.push_back(place(point));
    const int count = static_cast<int>(points.size());
    const ImU32 colour = is_marked ? c.text : is_volume ? c.text_soft : c.text_faint;
    list.AddPolyline(points.data(), count, colour, line.is_closed ? ImDrawFlags_Closed : 0, theme.px(is_marked ? 3 : 1));
  }
}

void draw_one_plan(const Theme& theme, const char* title, const PlanPicture& picture, const PlanFrame& frame,
                   const std::set<std::string>& marked) {
  ImGui::BeginGroup();
  ImGui::TextUnformatted(title);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  for (const char* kind : kPlanKinds)
    for (const auto& [id, shape] : picture)
      if (shape.kind == kind) draw_plan_shape(theme, shape, frame, corner, marked.contains(id));
  ImGui::Dummy({static_cast<float>(frame.box.width()) * frame.scale, static_cast<float>(frame.box.height()) * frame.scale});
  ImGui::EndGroup();
}

}  // namespace

std::vector<PlanLine> lines_of_path(const std::string& path) {
  std::vector<PlanLine> lines;
  const char *at = path.data(), *end = at + path.size();
  while (at != end) {
    const char letter = *at++;
    if (letter == 'z' && !lines.empty()) {
      lines.back().is_closed = true;
      continue;
    }
    const auto point = letter == 'M' || letter == 'l' ? plan_point(at, end) : std::nullopt;
    if (!point || (letter == 'l' && lines.empty())) return lines;
    if (letter == 'M') {
      lines.push_back({{*point}, false});
      continue;
    }
    const PlanPoint last = lines.back().points.back();
    lines.back().points.push_back({last.x + point->x, last.y + point->y});
  }
  return lines;
}

std::vector<PlanPoint> filled(const std::vector<PlanLine>& lines) {
  std::vector<std::vector<geometry::Ring>> parts;
  bool turns_left = false;
  for (const PlanLine& line : lines) {
    geometry::Ring ring;
    for (const PlanPoint& point : line.points) ring.push_back({point.x, point.y, 0});
    if (!line.is_closed || ring.size() < 3) continue;
    const bool is_left = geometry::signed_area(ring) > 0;
    if (parts.empty()) turns_left = is_left;
    if (parts.empty() || is_left == turns_left) parts.emplace_back();
    parts.back().push_back(std::move(ring));
  }
  std::vector<PlanPoint> corners;
  for (const std::vector<geometry::Ring>& rings : parts) {
    geometry::Ring all;
    for (const geometry::Ring& ring : rings) all.insert(all.end(), ring.begin(), ring.end());
    for (const auto& triangle : geometry::polygon_triangles(rings))
      for (const std::uint32_t corner : triangle) corners.push_back({all[corner].x, all[corner].y});
  }
  return corners;
}

PlanPicture plan_in(const std::map<std::string, JsonValue>& view, const std::string& begin) {
  PlanPicture picture;
  const std::string start = begin + "n/";
  for (auto one = view.lower_bound(start); one != view.end() && one->first.starts_with(start); ++one) {
    const auto json = one->second.read();
    if (!json) continue;
    PlanShape shape{plan_text(**json, "kind"), plan_text(**json, "fill"), lines_of_path(plan_text(**json, "d"))};
    if (shape.kind == "volume") shape.triangles = filled(shape.lines);
    picture[one->first.substr(start.size())] = std::move(shape);
  }
  return picture;
}

std::set<std::string> differing_volumes(const PlanPicture& one, const PlanPicture& other) {
  std::set<std::string> differing;
  const auto compare = [&differing](const PlanPicture& from, const PlanPicture& to) {
    for (const auto& [id, shape] : from) {
      if (shape.kind != "volume") continue;
      const auto same = to.find(id);
      if (same == to.end() || same->second.lines != shape.lines) differing.insert(id);
    }
  };
  compare(one, other);
  compare(other, one);
  return differing;
}

void draw_two_plans(const Theme& theme, const PlanPicture& now, const PlanPicture& with) {
  PlanFrame frame;
  frame.box.add(now);
  frame.box.add(with);
  const double larger = std::max(frame.box.width(), frame.box.height());
  if (!std::isfinite(larger) || larger <= 0) return;
  frame.box.widen(kMargin * larger);
  const float whole = ImGui::GetContentRegionAvail().x, gap = ImGui::GetStyle().ItemSpacing.x;
  const bool is_beside = whole >= 2 * theme.px(kLeastWidth) + gap;
  const float width = is_beside ? (whole - gap) / 2 : whole;
  frame.scale =
      std::min(width / static_cast<float>(frame.box.width()), theme.px(kHighest) / static_cast<float>(frame.box.height()));
  if (frame.scale <= 0) return;
  const std::set<std::string> marked = differing_volumes(now, with);
  draw_one_plan(theme, "Now", now, frame, marked);
  if (is_beside) ImGui::SameLine();
  draw_one_plan(theme, "With it", with, frame, marked);
}

}  // namespace bl::desktop
