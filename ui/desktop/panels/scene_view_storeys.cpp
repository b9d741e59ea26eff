// In which form volumes are drawn, the slider that cuts the model above a storey, and the dimensions of the plan.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/base/text.h"
#include "core/geometry/cellar.h"
#include "core/geometry/plates_table.h"
#include "core/reading/figures.h"
#include "ui/desktop/look/buttons.h"
#include "ui/desktop/panels/inspector_cell.h"
#include "ui/desktop/panels/scene_view.h"

namespace bl::desktop {

namespace {

// In points: a step of the slider, its widest length as a share of the view, what scale and north take below it.
constexpr float kStoreyStep = 16, kSliderShare = 0.5f, kSliderFoot = 96, kSliderRight = 40;
// Seen from so straight above, a picture is a plan (cosine). Shorter sides have no room for a number [points].
constexpr double kFromAbove = 0.999;
constexpr float kShortestSide = 34, kDimensionGap = 13;
// Sides that bend less than this are one (sine).
constexpr double kStraight = 1e-5;
constexpr std::size_t kMostPlans = 12;

struct PlanSide {
  Point3 from, to;
};

// Straight sides of the ring with those that go on in one line joined; sides of arcs are left out.
std::vector<PlanSide> straight_sides(const geometry::PlateRing& ring) {
  std::vector<PlanSide> sides;
  const std::size_t count = ring.corners.size();
  bool last_goes_on = false;
  for (std::size_t k = 0; k < count; ++k) {
    if (ring.corners[k].is_arc) {
      last_goes_on = false;
      continue;
    }
    const Point3 &from = ring.corners[k].at, &to = ring.corners[(k + 1) % count].at;
    const Vector3 way = to - from;
    if (last_goes_on) {
      PlanSide& last = sides.back();
      const Vector3 before = last.to - last.from;
      const double bend = before.x * way.y - before.y * way.x;
      if (std::abs(bend) <= kStraight * norm(before) * norm(way) && dot(before, way) > 0) {
        last.to = to;
        continue;
      }
    }
    sides.push_back({from, to});
    last_goes_on = true;
  }
  // The first corner may lie within a side.
  if (sides.size() > 2 && !ring.corners.empty() && !ring.corners.back().is_arc && !ring.corners.front().is_arc) {
    PlanSide& first = sides.front();
    const Vector3 a = sides.back().to - sides.back().from, b = first.to - first.from;
    if (std::abs(a.x * b.y - a.y * b.x) <= kStraight * norm(a) * norm(b) && dot(a, b) > 0) {
      first.from = sides.back().from;
      sides.pop_back();
    }
  }
  return sides;
}

// The highest storey of a body of which so many are drawn.
struct PlanFloor {
  const geometry::PlateStack* stack = nullptr;
  int storey = 0;   ///< from 1, its lowest one
  double roof = 0;  ///< [m]
};

PlanFloor highest_floor(const geometry::StandingBody& body, int drawn) {
  PlanFloor floor{&body.stacks.front(), 0, body.stacks.front().bottom};
  for (const geometry::PlateStack& stack : body.stacks) {
    if (drawn <= 0) break;
    const int taken = std::min(drawn, stack.storeys);
    floor = {&stack, floor.storey + taken, stack.bottom + taken * stack.storey_height};
    drawn -= taken;
  }
  return floor;
}

}  // namespace

DrawnLook SceneView::drawn_look() const {
  // What is below the ground is drawn where it can be seen.
  const bool opens_ground = cellars_in_all_ > 0 && choices_.section.is_on && storeys_shown_ >= 0;
  return {form_of(editor_->person.drawn_as).form, storeys_shown_, opens_ground};
}

void SceneView::show_storeys(int count) {
  storeys_shown_ = count >= storeys_in_all_ || (count < 0 && cellars_in_all_ == 0) ? 0 : std::max(count, -cellars_in_all_);
}

// Steps go from the deepest cellar to the highest storey; there is nothing between the first of each.
void SceneView::show_step(int step) { show_storeys(step > 0 ? step : step - 1); }

int SceneView::step_shown() const {
  return storeys_shown_ == 0 ? storeys_in_all_ : storeys_shown_ > 0 ? storeys_shown_ : storeys_shown_ + 1;
}

void SceneView::step_storeys(int by) { show_step(std::max(lowest_step(), step_shown() + by)); }

void SceneView::follow_look() { facts_ = drawn_.of(whole_, drawn_look()); }

void SceneView::draw_forms_popup() {
  ImGui::SetNextWindowSizeConstraints({editor_->theme.px(300), 0}, {editor_->theme.px(440), editor_->theme.px(420)});
  if (!ImGui::BeginPopup("forms")) return;
  for (const FormChoice& choice : form_choices()) {
    if (list_entry(*editor_, choice.label, choice.doc, &choice == &form_of(editor_->person.drawn_as))) {
      draw_as(choice.id);
      ImGui::CloseCurrentPopup();
    }
    note_place(*editor_, std::string("view/forms/") + choice.id);
  }
  ImGui::EndPopup();
}

// What is written beside the slider; nothing where all is shown and nobody touches it.
std::string SceneView::storeys_text(bool is_touched) const {
  if (storeys_shown_ == 0) return is_touched ? "all storeys" : "";
  if (storeys_shown_ < 0) return "up to cellar " + std::to_string(-storeys_shown_) + " of " + std::to_string(cellars_in_all_);
  return "up to storey " + std::to_string(storeys_shown_) + " of " + std::to_string(storeys_in_all_);
}

// At the right above the north arrow: one step for each storey and each cellar, all of them at its top.
void SceneView::draw_storey_slider() {
  const int count = storeys_in_all_ - lowest_step() + 1;
  if (count < 2 || is_walking_) return;
  const Theme& theme = editor_->theme;
  const Colours& c = theme.colours();
  const auto all = static_cast<float>(count);
  const float bottom = at_.y + height() - strip_height() - theme.px(kSliderFoot);
  const float length = std::min(theme.px(kStoreyStep) * all, kSliderShare * height()),
              x = at_.x + width() - theme.px(kSliderRight);
  if (bottom - length < at_.y + theme.px(60)) return;
  const float wide = theme.px(22);
  ImGui::SetCursorScreenPos({x - wide / 2, bottom - length - theme.px(6)});
  press_area("storeys", {wide, length + theme.px(12)});
  const bool is_held = ImGui::IsItemActive(), is_hovered = ImGui::IsItemHovered();
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  storey_slider_ = {low.x, low.y, high.x, high.y};
  // The lower end is the ground where there are no cellars, else the deepest floor.
  const int foot = lowest_step() - 1;
  if (is_held) {
    const float share = (bottom - ImGui::GetIO().MousePos.y) / length;
    show_step(foot + std::max(1, static_cast<int>(std::lround(std::clamp(share, 0.0f, 1.0f) * all))));
  }
  const auto y_of = [&](int step) { return bottom - length * static_cast<float>(step - foot) / all; };
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled({x - wide / 2, low.y}, {x + wide / 2, high.y}, faded(c.sky, 0.75f), theme.px(6));
  list.AddLine({x, y_of(foot)}, {x, y_of(storeys_in_all_)}, faded(c.text_soft, 0.4f), theme.px(2));
  list.AddLine({x, y_of(foot)}, {x, y_of(step_shown())}, c.accent, theme.px(3));
  // Where storeys stand close, only every fifth or tenth has a line.
  const float step = length / all;
  const int every = step >= theme.px(5) ? 1 : step >= theme.px(1.5f) ? 5 : 10;
  for (int k = foot; k <= storeys_in_all_; ++k) {
    if (k % every != 0) continue;
    // That of the ground is the longest, where there is something below it.
    const bool is_ground = k == 0 && foot < 0;
    const float y = y_of(k), half = theme.px(is_ground ? 10.0f : k % 5 == 0 ? 6.0f : 3.5f);
    list.AddLine({x - half, y}, {x + half, y}, faded(c.text_soft, is_ground ? 1.0f : 0.7f), theme.px(is_ground ? 2.0f : 1.0f));
  }
  const float knob = y_of(step_shown());
  list.AddRectFilled({x - theme.px(9), knob - theme.px(4)}, {x + theme.px(9), knob + theme.px(4)},
                     is_held || is_hovered ? c.text : c.accent, theme.px(3));
  const std::string text = storeys_text(is_hovered || is_held);
  if (text.empty()) return;
  ImFont* font = theme.fonts().small;
  const ImVec2 extent = font->CalcTextSizeA(font->FontSize, 1e4f, 0, text.c_str());
  const ImVec2 at{x - wide / 2 - theme.px(8) - extent.x, knob - extent.y / 2};
  list.AddRectFilled({at.x - theme.px(4), at.y - theme.px(2)}, {at.x + extent.x + theme.px(4), at.y + extent.y + theme.px(2)},
                     faded(c.raised, 0.92f), theme.px(4));
  list.AddText(font, font->FontSize, at, c.text, text.c_str());
}

// Of the storeys below the ground those that are drawn in place of the volume; without storeys where it is drawn itself.
geometry::PlateStack SceneView::cellar_drawn(const geometry::StandingBody& body, std::uint32_t node) const {
  for (const CellarFacts& cellar : facts_->cellars)
    if (storeys_shown_ < 0 && cellar.node == node) {
      geometry::PlateStack stack = geometry::cellar_of(body, cellar.storeys, cellar.storey_height);
      stack.storeys = std::max(0, stack.storeys + storeys_shown_ + 1);
      return stack;
    }
  return geometry::cellar_of({}, 0, 1);
}

// Seen from above, the chosen standing volumes have the lengths of their sides: those of the highest storey that is drawn.
void SceneView::draw_dimensions() {
  dimensions_.clear();
  if (!choices_.camera.is_parallel || choices_.camera.forward().z > -kFromAbove) return;
  const Theme& theme = editor_->theme;
  const Colours& c = theme.colours();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  ImFont* font = theme.fonts().small;
  const auto write = [&](const ImVec2& middle, const std::string& text) {
    const ImVec2 extent = font->CalcTextSizeA(font->FontSize, 1e4f, 0, text.c_str());
    const ImVec2 at{std::round(middle.x - extent.x / 2), std::round(middle.y - extent.y / 2)};
    list.AddRectFilled({at.x - theme.px(3), at.y - theme.px(1)}, {at.x + extent.x + theme.px(3), at.y + extent.y + theme.px(1)},
                       faded(c.sky, 0.85f), theme.px(3));
    list.AddText(font, font->FontSize, at, c.text, text.c_str());
  };
  // A line beside the side, with a stroke at each end, and the length in its middle.
  const auto draw_side = [&](const PlanSide& side, double z) {
    const ImVec2 a = on_screen(seen({side.from.x, side.from.y, z})), b = on_screen(seen({side.to.x, side.to.y, z}));
    const float dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
    const double metres = std::hypot(side.to.x - side.from.x, side.to.y - side.from.y);
    dimensions_.push_back(metres);
    if (length < theme.px(kShortestSide)) return;
    // The inside lies to the left of a side, and the picture's y points down.
    const ImVec2 out{-dy / length, dx / length};
    const float gap = theme.px(kDimensionGap), stroke = theme.px(4);
    const ImVec2 p{a.x + gap * out.x, a.y + gap * out.y}, q{b.x + gap * out.x, b.y + gap * out.y};
    list.AddLine(p, q, c.text, theme.px(1));
    for (const ImVec2& end : {p, q})
      list.AddLine({end.x - stroke * out.x, end.y - stroke * out.y}, {end.x + stroke * out.x, end.y + stroke * out.y}, c.text,
                   theme.px(1));
    write({(p.x + q.x) / 2, (p.y + q.y) / 2}, fixed(metres, 2));
  };
  std::size_t drawn = 0;
  for (const std::string& id : editor_->picks.nodes) {
    const VolumeFacts* volume = facts_->volume_of(seen_index(id));
    if (volume == nullptr || ++drawn > kMostPlans) continue;
    const auto figures = reading::row_of<reading::FootprintFigures>(*facts_->state, volume->node);
    if (!figures || figures->plates.rows.empty()) continue;
    const geometry::StandingBody body = geometry::read_body(figures->plates);
    const geometry::PlateStack cellar = cellar_drawn(body, volume->node);
    const bool is_below = cellar.storeys > 0;
    const PlanFloor floor =
        is_below ? PlanFloor{&cellar, -storeys_shown_, cellar.top()}
                 : highest_floor(
                       body, storeys_shown_ == 0 ? storeys_of(*volume) : storeys_shown_ - storeys_below(*volume, facts_->ground));
    const geometry::PlateStack* stack = floor.stack;
    for (const geometry::PlateRing& ring : stack->outlines)
      for (const PlanSide& side : straight_sides(ring)) draw_side(side, floor.roof);
    for (const geometry::PlateRing& ring : stack->courtyards)
      for (const PlanSide& side : straight_sides(ring)) draw_side({side.to, side.from}, floor.roof);
    const bool is_round =
        std::any_of(stack->outlines.begin(), stack->outlines.end(), [](const auto& ring) { return ring.radius > 0; });
    const ImVec2 middle = on_screen(seen({body.centre.x, body.centre.y, floor.roof}));
    write({middle.x, middle.y + theme.px(30)}, (is_below ? "cellar " : "storey ") + std::to_string(floor.storey) + ": " +
                                                   reading::quantity(stack->area, Unit::square_metre) +
                                                   (is_round ? ", r " + fixed(stack->outlines.front().radius, 2) + " m" : ""));
  }
}

}  // namespace bl::desktop
