// Statistics: the run over time, every volume's demand against its volume, the programme, and what a tick costs.
#include <algorithm>
#include <cmath>

#include "core/reading/figures.h"
#include "core/reading/storeys.h"
#include "core/reading/views/solver.h"
#include "ui/desktop/look/buttons.h"
#include "ui/desktop/panels/canvas/canvas.h"
#include "ui/desktop/panels/charts.h"
#include "ui/desktop/panels/inspector_cell.h"
#include "ui/desktop/panels/panels.h"
#include "ui/desktop/panels/scene_view.h"
#include "ui/desktop/panels/statistics_record.h"
#include "ui/desktop/view/colouring.h"

namespace bl::desktop {

namespace {

// In the form that the 3D view draws volumes in, an account has the volume and the floor area of that form; what is asked for
// stays.
bool is_in_another_form(const Workbench& editor) {
  return editor.view != nullptr && editor.view->drawn_look().form != DrawnForm::as_is;
}
void take_form(const Workbench& editor, std::uint32_t node, reading::Account& account) {
  if (editor.view == nullptr) return;
  if (const auto figures = editor.view->form_figures(node))
    account.volume = figures->volume, account.floor_area = figures->floor_area;
}
// "as slabs": which form a figure measures.
std::string form_words(const Workbench& editor) {
  return reading::choice_of(editor.view == nullptr ? DrawnForm::as_is : editor.view->drawn_look().form).measured;
}

void column_title(Workbench& editor, const std::string& text) { small_text(editor, text, editor.theme.colours().text_soft, -1); }

// A number over time without axes: its name, its last value, and the shape of it.
void draw_spark(Workbench& editor, const Chart& chart, ImVec2 at, ImVec2 size) {
  const Theme& theme = editor.theme;
  const Colours& c = theme.colours();
  const Series& series = chart.series.front();
  ImGui::SetCursorScreenPos(at);
  ImGui::Dummy(size);
  const bool is_hovered = ImGui::IsItemHovered();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  ImFont* small = theme.fonts().small;
  const float line = small->FontSize + theme.px(2);
  list.AddText(small, small->FontSize, at, c.text_soft, chart.title.c_str());
  if (series.values.empty()) return;
  list.AddText({at.x, at.y + line}, c.text, chart_number(chart, series.values.back()).c_str());
  const float top = at.y + line + ImGui::GetFontSize() + theme.px(5), bottom = at.y + size.y - theme.px(3);
  if (bottom > top + 4) spark_line(theme, {at.x, top}, {at.x + size.x, bottom}, series.values, series.colour);
  if (!is_hovered || series.values.size() < 2) return;
  const float share = std::clamp((ImGui::GetIO().MousePos.x - at.x) / size.x, 0.0f, 1.0f);
  const auto k = static_cast<std::size_t>(std::lround(share * static_cast<float>(series.values.size() - 1)));
  ImGui::SetTooltip("tick %s\n%s", reading::grouped(chart.ticks[k]).c_str(), chart_number(chart, series.values[k]).c_str());
}

void draw_run(Workbench& editor, const RunRecord& record, ImVec2 size) {
  const Colours& c = editor.theme.colours();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float gap = editor.theme.px(16);
  const double tolerance = editor.state().plan->settings.tolerance;
  Chart error{"Error", Unit::ratio, true, true, record.tick, {}, tolerance, "tolerance"};
  error.series = {{"mean", c.text_faint, record.mean}, {"worst", c.accent, record.worst}};
  const Chart volume{"Total volume", Unit::cubic_metre, false, false, record.tick, {{"", c.good, record.volume}}, 0, ""};
  const Chart move{"Largest move in a tick", Unit::metre, false, false, record.tick, {{"", c.warning, record.move}}, 0, ""};
  const float half = (size.y - gap) / 2;
  if (size.y > editor.theme.px(250)) {
    const float each = (size.x - gap) / 2;
    line_chart(editor.theme, "error", {size.x, half}, error);
    ImGui::SetCursorScreenPos({at.x, at.y + half + gap});
    line_chart(editor.theme, "volume", {each, half}, volume);
    ImGui::SetCursorScreenPos({at.x + each + gap, at.y + half + gap});
    line_chart(editor.theme, "move", {each, half}, move);
    return;
  }
  const float wide = std::floor(0.68f * size.x), narrow = size.x - wide - gap;
  line_chart(editor.theme, "error", {wide, size.y}, error);
  draw_spark(editor, volume, {at.x + wide + gap, at.y}, {narrow, half});
  draw_spark(editor, move, {at.x + wide + gap, at.y + half + gap}, {narrow, half});
}

void draw_orders(Workbench& editor, RunRecord& record) {
  const Theme& theme = editor.theme;
  column_title(editor, "Demand and volume " + form_words(editor) + ", by");
  constexpr std::pair<VolumeOrder, const char*> kOrders[] = {
      {VolumeOrder::error, "error"}, {VolumeOrder::name, "name"}, {VolumeOrder::use, "use"}, {VolumeOrder::size, "size"}};
  for (const auto& [order, word] : kOrders) {
    ImGui::SameLine(0, theme.px(8));
    ImGui::PushFont(theme.fonts().small);
    const ImVec2 at = ImGui::GetCursorScreenPos(), extent = ImGui::CalcTextSize(word);
    if (press_area(word, extent)) {
      record.order = order;
      record.is_order_stale = true;
    }
    note_place(editor, std::string("order/") + word);
    const bool is_on = record.order == order;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddText(at,
                 is_on                    ? theme.colours().accent
                 : ImGui::IsItemHovered() ? theme.colours().text
                                          : theme.colours().text_faint,
                 word);
    ImGui::PopFont();
  }
}

void draw_volume(Workbench& editor, const reading::VolumeRow& row, int index, float height, double largest, double tolerance,
                 ImU32 colour_of_its_use) {
  const Theme& theme = editor.theme;
  const Colours& c = theme.colours();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, name_width = std::min(theme.px(160), 0.4f * width), number = theme.px(64);
  ImGui::PushID(index);
  // On the press, not the release: rows may change places in between.
  const bool is_activated = press_area("##volume", {width, height});
  const bool is_pressed = ImGui::IsItemClicked() || (is_activated && !ImGui::IsMouseReleased(0));
  ImGui::PopID();
  note_place(editor, "volume/" + row.id);
  const bool is_hovered = ImGui::IsItemHovered();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (is_hovered || editor.picks.nodes.contains(row.id))
    list.AddRectFilled(at, {at.x + width, at.y + height}, faded(c.accent, is_hovered ? 0.12f : 0.07f), theme.px(3));
  ImFont* small = theme.fonts().small;
  const float y = at.y + (height - small->FontSize) / 2, middle = at.y + height / 2;
  list.AddCircleFilled({at.x + theme.px(7), middle}, theme.px(3.5f), colour_of_its_use);
  ImGui::PushFont(small);
  list.AddText(small, small->FontSize, {at.x + theme.px(16), y}, c.text, fitted(row.name, name_width - theme.px(20)).c_str());
  const AccountTone tone = tone_of_account(row, tolerance);
  const bool is_met = tone == AccountTone::met;
  const std::string off = row.asked > 0 ? reading::signed_percent(row.standing()) : std::string("asks for none");
  list.AddText({at.x + width - ImGui::CalcTextSize(off.c_str()).x - theme.px(4), y},
               is_met ? c.text_faint : colour_of_account(theme, tone), off.c_str());
  ImGui::PopFont();
  const double most = std::max(largest, 1e-9);
  const ImU32 colour = is_met ? mixed(c.good, c.panel, 0.25f) : colour_of_account(theme, tone);
  bar(theme, {at.x + name_width, middle - theme.px(4)}, {at.x + width - number, middle + theme.px(4)}, row.volume / most,
      row.asked / most, colour);
  if (is_hovered) {
    editor.picks.hovered_node = row.id;
    std::string text = "has " + reading::quantity(row.volume, Unit::cubic_metre) + " of " +
                       reading::quantity(row.asked, Unit::cubic_metre) + " asked for";
    if (row.withheld() > tolerance * row.asked) text += "\nlimited to " + reading::quantity(row.limited, Unit::cubic_metre);
    text += "\nfloor area " + reading::quantity(row.floor_area, Unit::square_metre);
    card(editor, row.name, text,
         row.use + (row.use.empty() ? "" : ", ") + row.figures.state +
             (row.figures.reason.empty() ? "" : ": " + row.figures.reason));
  }
  if (!is_pressed) return;
  if (ImGui::GetIO().KeyShift) editor.picks.nodes.insert(row.id);
  else editor.picks.only_node(row.id);
  if (!ImGui::IsMouseDoubleClicked(0)) return;
  if (editor.canvas != nullptr) editor.canvas->fit(false);
  if (editor.view != nullptr) editor.view->fit(false);
}

void draw_volumes(Workbench& editor, RunRecord& record) {
  draw_orders(editor, record);
  const reading::ReportModel& model = record.figures(editor);
  const std::vector<std::size_t>& order = record.ordered(editor);
  if (order.empty()) return small_text(editor, "There are no volumes in this scene.", editor.theme.colours().text_faint);
  double largest = 0;
  for (const reading::VolumeRow& row : model.volumes) largest = std::max({largest, row.asked, row.volume});
  ImGui::BeginChild("volumes", {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
  const float height = std::round(ImGui::GetFontSize() + editor.theme.px(5));
  const UseNumbers numbers(editor.state().plan->scene);
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(order.size()), height);
  while (clipper.Step())
    for (int row = clipper.DisplayStart; row < clipper.DisplayEnd; ++row) {
      const reading::VolumeRow& volume = model.volumes[order[static_cast<std::size_t>(row)]];
      const ImU32 colour = colour_of_use(editor.theme, numbers.tone(volume.use));
      if (!is_in_another_form(editor)) {
        draw_volume(editor, volume, row, height, largest, model.accounts.tolerance, colour);
        continue;
      }
      reading::VolumeRow formed = volume;
      take_form(editor, editor.index_of(volume.id), formed);
      draw_volume(editor, formed, row, height, largest, model.accounts.tolerance, colour);
    }
  ImGui::PopStyleVar();
  ImGui::EndChild();
}

// Why uses have less than was asked for: the storeys that their volumes lack and who takes them, else what limits take away. Made
// once for each state whose figures are shown.
const std::string& why_less(const Workbench& editor, RunRecord& record, const reading::UseAccount& use) {
  const reading::Accounts& accounts = record.figures(editor).accounts;
  if (record.why_revision != record.figures_revision()) {
    record.why_revision = record.figures_revision();
    record.why.clear();
    std::map<std::string, std::size_t> more;
    for (const reading::VolumeAccount& volume : accounts.volumes) {
      if (volume.node >= editor.state().plan->nodes.size()) continue;
      const std::string why = reading::why_lower(editor.state(), volume.node);
      if (why.empty()) continue;
      const auto [at, is_first] = record.why.emplace(volume.use, editor.state().plan->nodes[volume.node].name + ": " + why);
      more[volume.use] += is_first ? 0 : 1;
    }
    for (auto& [name, why] : record.why)
      if (more[name] > 0) why += ", and " + std::to_string(more[name]) + " more";
    for (const reading::UseAccount& one : accounts.uses) {
      const double withheld = one.asked_area - one.limited_area;
      if (withheld > accounts.tolerance * one.asked_area)
        record.why.emplace(one.use, "limits take " + reading::quantity(withheld, Unit::square_metre) + " of what was asked for");
    }
  }
  return record.why[use.use];
}

// One line of the programme [m²].
struct AmountLine {
  std::string name;
  double area = 0, asked = 0;
  bool is_short = false;
  std::string why;         // there is not what was wanted
  std::string asked_what;  // "floor area asked for"
  std::string more;        // on its card
};

// What is wanted as the mark, what there is as the bar, and below why it is not what was wanted.
void draw_amount(Workbench& editor, const AmountLine& use, ImU32 colour, double largest) {
  const Theme& theme = editor.theme;
  const Colours& c = theme.colours();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, line = theme.fonts().small->FontSize;
  const float height = std::round(line + theme.px(14) + (use.why.empty() ? 0 : line + theme.px(2)));
  ImGui::Dummy({width, height});
  ImFont* small = theme.fonts().small;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  ImGui::PushFont(small);
  const std::string amount =
      reading::quantity(use.area, Unit::square_metre) + (use.asked > 0 ? "  " + reading::difference_of(use.area, use.asked) : "");
  const float amount_width = ImGui::CalcTextSize(amount.c_str()).x;
  list.AddText({at.x, at.y}, c.text, fitted(use.name, width - amount_width - theme.px(12)).c_str());
  list.AddText({at.x + width - amount_width, at.y}, use.is_short ? c.warning : c.text_soft, amount.c_str());
  ImGui::PopFont();
  const float y = at.y + small->FontSize + theme.px(4);
  bar(theme, {at.x, y}, {at.x + width, y + theme.px(5)}, use.area / std::max(largest, 1e-9), use.asked / std::max(largest, 1e-9),
      colour);
  note_place(editor, "use/" + use.name);
  if (!use.why.empty()) {
    ImGui::PushFont(small);
    list.AddText({at.x, y + theme.px(8)}, theme.colours().warning, fitted(use.why, width).c_str());
    ImGui::PopFont();
    note_place(editor, "use/" + use.name + "/why");
  }
  if (!ImGui::IsItemHovered()) return;
  card(editor, use.name,
       reading::quantity(use.area, Unit::square_metre) + " of " + reading::quantity(use.asked, Unit::square_metre) + " " +
           use.asked_what,
       use.more + (use.why.empty() ? "" : "\n" + use.why));
}

void draw_use(Workbench& editor, const reading::UseAccount& use, ImU32 colour, double largest, double tolerance,
              const std::string& why) {
  draw_amount(editor,
              {use.use.empty() ? "without a use" : use.use, use.floor_area, use.asked_area, use.is_short(tolerance), why,
               "floor area asked for",
               reading::counted(use.volumes, "volume") + ", " + reading::quantity(use.volume, Unit::cubic_metre) +
                   (use.is_in_programme ? "" : "\nnot in any programme: the demands of its volumes count")},
              colour, largest);
}

// Ground that is asked for and kept open, below the uses that have volumes.
void draw_open_space(Workbench& editor, const reading::Accounts& accounts, const UseNumbers& numbers) {
  if (accounts.open.empty()) return;
  ImGui::Separator();
  column_title(editor, "Open space by use");
  double largest = 0;
  for (const reading::OpenAccount& open : accounts.open) largest = std::max({largest, open.area, open.asked});
  for (const reading::OpenAccount& open : accounts.open)
    draw_amount(
        editor,
        {open.use, open.area, open.asked, open.is_short(accounts.tolerance), why_short(open, accounts.tolerance),
         "of ground asked for as open space", open.is_in_programme ? "no volume, and no floor area" : "not in any programme"},
        colour_of_use(editor.theme, numbers.tone(open.use)), largest);
}

// Sums over the same volumes, in the form that is drawn.
reading::Accounts accounts_in_form(const Workbench& editor, const reading::Accounts& given) {
  reading::Accounts accounts = given;
  const auto clear = [](reading::Account& account) { account.volume = account.floor_area = 0; };
  clear(accounts.all);
  std::for_each(accounts.uses.begin(), accounts.uses.end(), clear);
  for (reading::VolumeAccount& volume : accounts.volumes) {
    take_form(editor, volume.node, volume);
    const auto use = std::find_if(accounts.uses.begin(), accounts.uses.end(),
                                  [&](const reading::UseAccount& one) { return one.use == volume.use; });
    for (reading::Account* sum : {static_cast<reading::Account*>(&accounts.all),
                                  use == accounts.uses.end() ? nullptr : static_cast<reading::Account*>(&*use)}) {
      if (sum == nullptr) continue;
      sum->volume += volume.volume;
      sum->floor_area += volume.floor_area;
    }
  }
  return accounts;
}

void draw_programme(Workbench& editor, RunRecord& record) {
  const reading::ReportModel& model = record.figures(editor);
  column_title(editor, "Floor area by use, " + form_words(editor));
  ImGui::BeginChild("uses", {0, 0});
  const bool is_formed = is_in_another_form(editor);
  const reading::Accounts of_form = is_formed ? accounts_in_form(editor, model.accounts) : reading::Accounts{};
  const reading::Accounts& accounts = is_formed ? of_form : model.accounts;
  double largest = 0;
  for (const reading::UseAccount& use : accounts.uses) largest = std::max({largest, use.floor_area, use.asked_area});
  const UseNumbers numbers(editor.state().plan->scene);
  for (const reading::UseAccount& use : accounts.uses)
    draw_use(editor, use, colour_of_use(editor.theme, numbers.tone(use.use)), largest, accounts.tolerance,
             why_less(editor, record, use));
  if (!accounts.uses.empty()) {
    reading::UseAccount total = accounts.all;
    total.use = "all uses";
    total.is_in_programme = true;
    ImGui::Separator();
    draw_use(editor, total, editor.theme.colours().text_faint, std::max(total.floor_area, total.asked_area), accounts.tolerance,
             "");
  }
  draw_open_space(editor, accounts, numbers);
  ImGui::EndChild();
}

void fact(Workbench& editor, const std::string& name, const std::string& value) {
  const Theme& theme = editor.theme;
  ImFont* small = theme.fonts().small;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x,
              value_width = small->CalcTextSizeA(small->FontSize, FLT_MAX, 0, value.c_str()).x;
  ImGui::Dummy({width, small->FontSize + theme.px(3)});
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddText(small, small->FontSize, at, theme.colours().text_soft, name.c_str());
  list.AddText(small, small->FontSize, {at.x + width - value_width, at.y}, theme.colours().text, value.c_str());
}

std::string bytes_text(double bytes) {
  if (bytes < 1024)
    return reading::grouped(bytes) +
           "\xC2\xA0"
           "B";
  if (bytes < 1024 * 1024) return reading::grouped(bytes / 1024, 1) + "\xC2\xA0kB";
  return reading::grouped(bytes / 1024 / 1024, 1) + "\xC2\xA0MB";
}

void draw_engine(Workbench& editor, const RunRecord& record) {
  const State& state = editor.state();
  const host::Moment& moment = *editor.moment;
  column_title(editor, "Boundary and engine");
  ImGui::BeginChild("engine", {0, 0});
  for (const auto& [n, solver] : reading::rows<reading::SolverFigures>(state)) {
    const double fill = solver.fill;
    fact(editor, "fill, " + state.plan->nodes[n].name, reading::percent(fill));
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, thick = editor.theme.px(5);
    ImGui::Dummy({width, thick + editor.theme.px(2)});
    bar(editor.theme, at, {at.x + width, at.y + thick}, fill, -1,
        fill > 0.98 ? editor.theme.colours().warning : editor.theme.colours().accent);
  }
  fact(editor, "a tick", reading::duration(moment.tick_seconds));
  fact(editor, "ticks/s", reading::readable(moment.rate) + " of " + reading::readable(moment.wanted_rate));
  fact(editor, "pictures/s", reading::readable(record.frame_rate));
  fact(editor, "to the GPU, a tick", bytes_text(record.bytes.empty() ? 0 : record.bytes.back()));
  ImGui::EndChild();
}

}  // namespace

void draw_statistics(Workbench& editor) {
  if (!editor.document) return;
  RunRecord& record = *memory_of(editor).record;
  // Narrower than this the columns cannot be read: then the whole scrolls sideways.
  const float least = editor.theme.px(900);
  const bool is_narrow = ImGui::GetContentRegionAvail().x < least;
  if (is_narrow) ImGui::SetNextWindowContentSize({least, 0});
  ImGui::BeginChild("statistics", {0, 0}, false, is_narrow ? ImGuiWindowFlags_HorizontalScrollbar : ImGuiWindowFlags_None);
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const float gap = editor.theme.px(22), width = std::max(room.x, least) - 3 * gap;
  const float shares[] = {0.38f, 0.27f, 0.20f, 0.15f};
  const auto column = [&](const char* id, float share, auto draw) {
    ImGui::BeginChild(id, {std::floor(share * width), room.y}, false, ImGuiWindowFlags_NoScrollbar);
    draw();
    ImGui::EndChild();
  };
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {editor.theme.px(8), editor.theme.px(4)});
  column("run", shares[0], [&] { draw_run(editor, record, ImGui::GetContentRegionAvail()); });
  ImGui::SameLine(0, gap);
  column("demands", shares[1], [&] { draw_volumes(editor, record); });
  ImGui::SameLine(0, gap);
  column("programme", shares[2], [&] { draw_programme(editor, record); });
  ImGui::SameLine(0, gap);
  column("facts", shares[3], [&] { draw_engine(editor, record); });
  ImGui::PopStyleVar();
  ImGui::EndChild();
}

}  // namespace bl::desktop
