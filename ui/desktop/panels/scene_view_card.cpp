// The card of the node nearest to the mouse, as in the paper's third figure; and the title of the beamer mode.
#include <algorithm>
#include <cmath>

#include "core/reading/figures.h"
#include "core/reading/storeys.h"
#include "ui/desktop/panels/scene_view.h"

namespace bl::desktop {

namespace {

constexpr float kReach = 70, kCardWidth = 250, kBarHeight = 7;
constexpr double kShareShown = 1.3;  // of the demand: what the whole bar stands for
constexpr std::size_t kMostPulls = 3;
constexpr double kLeastPull = 0.005;  // [m] a tick: less is no pull that anybody sees

// Lines of text with a bar among them, measured first and drawn then.
struct CardWriter {
  ImDrawList* list;  // nothing: only measures
  const Theme& theme;
  ImVec2 at;
  float width, y = 0;

  void text(ImFont* font, ImU32 colour, const std::string& what, float gap = 2) {
    const ImVec2 extent = font->CalcTextSizeA(font->FontSize, 1e4f, width, what.c_str());
    if (list != nullptr) list->AddText(font, font->FontSize, {at.x, at.y + y}, colour, what.c_str(), nullptr, width);
    y += extent.y + theme.px(gap);
  }
  void row(ImU32 soft, ImU32 strong, const std::string& name, const std::string& value) {
    ImFont* font = theme.fonts().small;
    const ImVec2 extent = font->CalcTextSizeA(font->FontSize, 1e4f, 0, value.c_str());
    if (list != nullptr) {
      list->AddText(font, font->FontSize, {at.x, at.y + y}, soft, name.c_str());
      list->AddText(font, font->FontSize, {at.x + width - extent.x, at.y + y}, strong, value.c_str());
    }
    y += font->FontSize + theme.px(3);
  }
};

// Figures of another form say which it is; those of the scene say it beside them.
void add_form_rows(CardWriter& card, const Colours& c, const DrawnShapes::FormFigures& figures, DrawnForm form) {
  const std::string how = reading::choice_of(form).measured;
  card.row(c.text_soft, c.text, "Volume " + how, reading::quantity(figures.volume, Unit::cubic_metre));
  card.row(c.text_soft, c.text, "Floor area " + how, reading::quantity(figures.floor_area, Unit::square_metre));
}

const char* start_text(bool is_playing) {
  return is_playing ? "The first tick is under way." : "Nothing has run yet: press P to run.";
}

// Why it has less than it wishes, or nothing.
void add_reasons(CardWriter& card, const Colours& c, const State& state, const VolumeFacts& volume, bool is_playing) {
  ImFont* font = card.theme.fonts().small;
  if (const std::string why = reading::why_lower(state, volume.node); !why.empty()) card.text(font, c.warning, why, 3);
  if (state.tick == 0) card.text(font, c.text_soft, start_text(is_playing), 1);
  else if (!volume.figures.reason.empty() && volume.figures.state != "alive") card.text(font, c.bad, volume.figures.reason, 3);
}

}  // namespace

std::vector<std::string> SceneView::pulls_on(std::uint32_t node) const {
  const State& state = *facts_->state;
  std::vector<std::pair<double, std::string>> found;
  for (std::size_t l = 0; l < state.links.size(); ++l)
    for (const Voice& voice : state.links[l].voices) {
      if (voice.target.node != node || state.plan->links[l].definition == nullptr || state.plan->links[l].is_muted) continue;
      const PortDefinition& port = state.plan->port(voice.target);
      const auto* change = std::get_if<Vector3>(&voice.value);
      const double size = change != nullptr ? norm(*change) : std::abs(as_number(voice.value));
      if (!(size > (change != nullptr ? kLeastPull : 0))) continue;
      // Changes of the place first: they are what is seen here.
      const std::string what = change != nullptr ? reading::quantity(size, port.unit) + " a tick"
                                                 : label_of(port.id) + " " + reading::quantity(as_number(voice.value), port.unit);
      found.emplace_back(change != nullptr ? 1e12 + size : size * voice.strength,
                         state.plan->links[l].definition->label + ": " + what);
    }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::string> lines;
  for (std::size_t k = 0; k < std::min(kMostPulls, found.size()); ++k) lines.push_back(found[k].second);
  if (found.size() > kMostPulls) lines.push_back("and " + std::to_string(found.size() - kMostPulls) + " more");
  return lines;
}

// The one under the mouse, or the one whose place is nearest to it; nothing where none is near.
const VolumeFacts* SceneView::nearest_volume() const {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const VolumeFacts* nearest = hit_ ? facts_->volume_of(hit_->node) : nullptr;
  float least = editor_->theme.px(kReach);
  const Lens lens(choices_.camera, width(), height());
  for (std::size_t row = 0; row < facts_->volumes.size() && !hit_; ++row) {
    const Seen at = lens.project(facts_->columns.position[row]);
    const ImVec2 p = on_screen(at);
    const float far = std::hypot(p.x - mouse.x, p.y - mouse.y);
    if (!at.is_in_front || far >= least) continue;
    least = far;
    nearest = &facts_->volumes[row];
  }
  const bool is_another = nearest != nullptr && !pointed_at_.empty() && pointed_at_ != nearest->id;
  return is_another ? nullptr : nearest;
}

void SceneView::draw_card() {
  if (!shows("card") || !is_hovered_ || drag_ != Drag::none || is_moving() || is_walking_ || hot_handle_ >= 0) return;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const Theme& theme = editor_->theme;
  const Colours& c = theme.colours();
  const VolumeFacts* nearest = nearest_volume();
  // What is chosen has its gizmo here, and all of its data in the inspector.
  if (nearest == nullptr || (editor_->picks.nodes.contains(nearest->id) && !editor_->is_beamer)) return;
  const VolumeFacts& volume = *nearest;
  const std::vector<std::string> pulls = pulls_on(volume.node);
  const double standing_share = volume.standing();
  const ImU32 standing = colour_of_account(theme, tone_of_account(volume, facts_->tolerance));
  const auto form = form_figures(volume.node);
  const auto write = [&](CardWriter& card) {
    card.text(theme.fonts().strong, c.text, volume.name, 1);
    card.text(theme.fonts().small, c.text_soft,
              label_of_use(volume.figures.use) + (volume.figures.state == "alive" ? "" : "  ·  " + volume.figures.state), 6);
    if (card.list != nullptr) {
      const ImVec2 low{card.at.x, card.at.y + card.y}, high{low.x + card.width, low.y + theme.px(kBarHeight)};
      const auto place = [&](double share) {
        return low.x + card.width * static_cast<float>(std::clamp(share / kShareShown, 0.0, 1.0));
      };
      card.list->AddRectFilled(low, high, c.sunken, theme.px(3));
      if (volume.asked > 0) {
        card.list->AddRectFilled(low, {place(volume.volume / volume.asked), high.y}, standing, theme.px(3));
        card.list->AddLine({place(1), low.y - theme.px(2)}, {place(1), high.y + theme.px(2)}, c.text, theme.px(1.5f));
      }
    }
    card.y += theme.px(kBarHeight + 6);
    card.row(c.text_soft, c.text, form ? "Volume as it is" : "Volume", reading::quantity(volume.volume, Unit::cubic_metre));
    card.row(c.text_soft, c.text, "Asked for", reading::quantity(volume.asked, Unit::cubic_metre));
    if (volume.withheld() > facts_->tolerance * volume.asked)
      card.row(c.text_soft, c.warning, "Limited to", reading::quantity(volume.limited, Unit::cubic_metre));
    card.row(c.text_soft, standing, standing_share < 0 ? "Short" : "Difference",
             volume.asked > 0 ? reading::signed_percent(standing_share) : "asks for nothing");
    card.row(c.text_soft, c.text, form ? "Floor area as it is" : "Floor area",
             reading::quantity(volume.floor_area, Unit::square_metre));
    if (form) add_form_rows(card, c, *form, drawn_look().form);
    add_reasons(card, c, *facts_->state, volume, editor_->moment->is_playing);
    if (volume.is_ball) card.text(theme.fonts().small, c.text_soft, "Shown as its ball: under this metric there is no mesh.", 3);
    if (pulls.empty()) return;
    card.y += theme.px(3);
    card.text(theme.fonts().small, c.text_faint, "Who pulls", 1);
    for (const std::string& line : pulls) card.text(theme.fonts().small, c.text_soft, line, 1);
  };
  const ImVec2 pad{theme.px(11), theme.px(9)};
  CardWriter measure{nullptr, theme, {}, theme.px(kCardWidth)};
  write(measure);
  const ImVec2 size{theme.px(kCardWidth) + 2 * pad.x, measure.y + 2 * pad.y};
  ImVec2 at{mouse.x + theme.px(22), mouse.y + theme.px(18)};
  if (at.x + size.x > at_.x + width()) at.x = mouse.x - theme.px(18) - size.x;
  at.x = std::max(at.x, at_.x);
  at.y = std::max(at_.y, std::min(at.y, at_.y + height() - size.y - theme.px(8)));
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled({at.x + 2, at.y + 3}, {at.x + size.x + 2, at.y + size.y + 3}, faded(0xff000000u, 0.25f), theme.px(7));
  list.AddRectFilled(at, {at.x + size.x, at.y + size.y}, faded(c.raised, 0.96f), theme.px(7));
  list.AddRect(at, {at.x + size.x, at.y + size.y}, c.line, theme.px(7));
  CardWriter card{&list, theme, {at.x + pad.x, at.y + pad.y}, theme.px(kCardWidth)};
  write(card);
}

// Beamer mode: a large title, the tick, and how the scene stands.
void SceneView::draw_title() {
  const Theme& theme = editor_->theme;
  const Colours& c = theme.colours();
  const State& state = *facts_->state;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float x = at_.x + theme.px(28);
  float y = at_.y + theme.px(22);
  const std::string title = state.plan->settings.title.empty() ? editor_->document->name() : state.plan->settings.title;
  list.AddText(theme.fonts().display, theme.fonts().display->FontSize, {x, y}, c.text, title.c_str());
  y += theme.fonts().display->FontSize * 1.3f;
  const bool is_settled = state.is_settled();
  const std::string standing = is_settled ? "settled, worst error " + reading::percent(state.largest_residual)
                                          : "negotiating, worst error " + reading::percent(state.largest_residual);
  list.AddText(theme.fonts().title, theme.fonts().title->FontSize, {x, y}, is_settled ? c.good : c.text_soft,
               ("tick " + reading::grouped(static_cast<double>(state.tick)) + "   " + standing).c_str());
  y += theme.fonts().title->FontSize * 1.3f;
  if (const std::string hidden = hidden_.text(*editor_); !hidden.empty())
    list.AddText(theme.fonts().body, theme.fonts().body->FontSize, {x, y}, c.text_soft, hidden.c_str());
  ImFont* font = theme.fonts().small;
  const std::string hint = "Esc or F1 leaves   ·   1 to 9 kept views   ·   P plays";
  const ImVec2 extent = font->CalcTextSizeA(font->FontSize, 1e4f, 0, hint.c_str());
  list.AddText(font, font->FontSize, {at_.x + width() - extent.x - theme.px(28), at_.y + theme.px(26)}, c.text_faint,
               hint.c_str());
}

}  // namespace bl::desktop
