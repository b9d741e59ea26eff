// The dialog that hands the proposal on to other programs, made from the declarations of the formats.
#include "ui/desktop/panels/export_dialog.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <imgui_stdlib.h>

#include "core/define/codec.h"
#include "core/export/read_proposal.h"
#include "core/graph/sums_of_now.h"
#include "core/reading/figures.h"
#include "ui/desktop/panels/dialogs.h"
#include "ui/desktop/panels/inspector_quantity.h"
#include "ui/desktop/panels/inspector_value.h"
#include "ui/desktop/view/drawn_form.h"

namespace bl::desktop {

namespace {

namespace paths = std::filesystem;

constexpr float kListWidth = 300, kOptionAt = 150, kPlaceAt = 80;

std::string key_of(const exporting::FormatDefinition& format, const std::string& part = "") {
  return "export/" + format.id + (part.empty() ? "" : "/" + part);
}

// "quarter.dxf, quarter.ifc"
std::string names_of(const std::vector<std::string>& files) {
  constexpr std::size_t kMost = 4;
  std::string text;
  for (std::size_t k = 0; k < std::min(kMost, files.size()); ++k) {
    const paths::path path(files[k]);
    const bool is_folder = !path.has_filename();
    text += (text.empty() ? "" : ", ") + (is_folder ? path.parent_path().filename().string() + "/" : path.filename().string());
  }
  return files.size() > kMost ? text + " and " + std::to_string(files.size() - kMost) + " more" : text;
}

}  // namespace

void ExportDialog::begin(const std::string& beside, const std::string& section) {
  asked_.clear();
  if (looked_at_.empty()) looked_at_ = exporting::all_formats().front().id;
  if (before_section_) {
    chosen_ = std::move(before_section_->formats);
    looked_at_ = std::move(before_section_->looked_at);
    options_ = std::move(before_section_->options);
    before_section_.reset();
  }
  if (!section.empty()) choose_section(section);
  follow_form();
  if (scene_ == beside && !folder_.empty()) return;  // the same scene again: what was chosen stays
  scene_ = beside;
  folder_ = paths::path(beside).parent_path().string();
  name_ = paths::path(beside).stem().string();
}

// What is exported measures what is seen: the form in which the 3D view draws volumes.
void ExportDialog::follow_form() {
  const std::string form = form_of(editor_->person.drawn_as).id;
  for (const exporting::FormatDefinition& format : exporting::all_formats())
    if (const PortDefinition* option = format.find_port("form"); option != nullptr)
      values_of(format)[static_cast<std::size_t>(option - format.ports.data())] = form;
}

// Every format that has an option for it gets the section; the first that can show it alone is chosen.
void ExportDialog::choose_section(const std::string& section) {
  before_section_ = Chosen{chosen_, looked_at_, options_};
  chosen_.clear();
  for (const exporting::FormatDefinition& format : exporting::all_formats()) {
    const PortDefinition *cut = format.find_port("section"), *level = format.find_port("level");
    if (cut == nullptr) continue;
    std::vector<Value>& values = values_of(format);
    values[static_cast<std::size_t>(cut - format.ports.data())] = section;
    if (level == nullptr) continue;
    values[static_cast<std::size_t>(level - format.ports.data())] = std::int64_t{-1};
    if (!chosen_.empty()) continue;
    chosen_.insert(format.id);
    looked_at_ = format.id;
  }
}

std::vector<Value>& ExportDialog::values_of(const exporting::FormatDefinition& format) {
  std::vector<Value>& values = options_[format.id];
  if (values.empty())
    for (const PortDefinition& option : format.ports) values.push_back(option.default_value);
  return values;
}

std::string ExportDialog::path_of(const exporting::FormatDefinition& format) const {
  const std::string path = (paths::path(folder_) / name_).string();
  return in_folders_.contains(format.id) ? path + "_" + format.id + "/" : path + format.ending;
}

void ExportDialog::draw() {
  const float foot = editor_->theme.px(172);
  ImGui::BeginChild("formats", {editor_->theme.px(kListWidth), -foot}, true);
  draw_formats();
  ImGui::EndChild();
  ImGui::SameLine();
  ImGui::BeginChild("options", {0, -foot}, true);
  draw_options();
  ImGui::EndChild();
  draw_place();
}

// One box for all of them: off where one is missing.
void ExportDialog::draw_all_formats() {
  const std::size_t count = exporting::all_formats().size();
  bool is_all = chosen_.size() == count;
  if (ImGui::Checkbox("All formats", &is_all)) {
    chosen_.clear();
    if (is_all)
      for (const exporting::FormatDefinition& format : exporting::all_formats()) chosen_.insert(format.id);
    asked_.clear();
  }
  note_place(*editor_, "export/all");
  ImGui::Separator();
}

void ExportDialog::draw_formats() {
  draw_all_formats();
  for (const exporting::FormatDefinition& format : exporting::all_formats()) {
    ImGui::PushID(format.id.c_str());
    bool is_chosen = chosen_.contains(format.id);
    if (ImGui::Checkbox("##chosen", &is_chosen)) {
      if (is_chosen) chosen_.insert(format.id);
      else chosen_.erase(format.id);
      looked_at_ = format.id;
      asked_.clear();
    }
    note_place(*editor_, key_of(format));
    ImGui::SameLine();
    const float ending = ImGui::CalcTextSize(format.ending.c_str()).x, room = ImGui::GetContentRegionAvail().x;
    ImGui::AlignTextToFramePadding();
    if (ImGui::Selectable(fitted(format.label, room - ending - editor_->theme.px(8)).c_str(), looked_at_ == format.id,
                          ImGuiSelectableFlags_DontClosePopups))
      looked_at_ = format.id;
    note_place(*editor_, key_of(format, "look"));
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    ImGui::GetWindowDrawList()->AddText(
        {high.x - ending - editor_->theme.px(4), (low.y + high.y - ImGui::GetTextLineHeight()) / 2},
        editor_->theme.colours().text_soft, format.ending.c_str());
    ImGui::PopID();
  }
}

void ExportDialog::draw_options() {
  const exporting::FormatDefinition* format = exporting::find_format(looked_at_);
  if (format == nullptr) return;
  const Theme& theme = editor_->theme;
  ImGui::PushFont(theme.fonts().strong);
  ImGui::TextUnformatted(format->label.c_str());
  ImGui::PopFont();
  ImGui::PushStyleColor(ImGuiCol_Text, theme.colours().text_soft);
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(format->doc.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
  ImGui::Dummy({0, theme.px(6)});
  std::vector<Value>& values = values_of(*format);
  const auto label = [&](const std::string& text, const std::string& doc, const std::string& facts) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(text.c_str());
    if (ImGui::IsItemHovered()) card(*editor_, text, doc, facts);
    ImGui::SameLine(theme.px(kOptionAt));
  };
  for (std::size_t k = 0; k < values.size(); ++k) {
    const PortDefinition& option = format->ports[k];
    label(label_of(option.id), option.doc, facts_of(option, option.unit));
    const Subject subject{key_of(*format, option.id),       &option, option.unit, values[k], false, false,
                          values[k] == option.default_value};
    const float width = std::min(theme.px(220), ImGui::GetContentRegionAvail().x);
    if (const auto change = value_field(*editor_, subject, width)) {
      const Value wanted = change->make(values[k]);
      if (auto fits = check_value(option, wanted, label_of(option.id)); fits) values[k] = wanted;
      else complain(*editor_, subject.key, fits.error().text());
    }
    draw_complaint(*editor_, subject.key, width);
  }
  if (format->may_fill_folder) {
    bool is_folder = in_folders_.contains(format->id);
    label("Several files", "One file for each part, in a folder of its own.", "");
    if (switch_field(*editor_, key_of(*format, "folder"), is_folder, false)) {
      if (is_folder) in_folders_.erase(format->id);
      else in_folders_.insert(format->id);
      asked_.clear();
    }
  }
}

void ExportDialog::draw_place() {
  const Theme& theme = editor_->theme;
  const std::string before = folder_ + "/" + name_;
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("Folder");
  ImGui::SameLine(theme.px(kPlaceAt));
  ImGui::SetNextItemWidth(-theme.px(120));
  ImGui::InputText("##folder", &folder_);
  note_place(*editor_, "export/folder");
  ImGui::SameLine();
  if (ImGui::Button("Choose ...##folder"))
    editor_->dialogs->choose(FileChooser::Purpose::choose_folder, "Export into a folder", {}, folder_,
                             [this](const std::string& folder) { folder_ = folder; });
  note_place(*editor_, "export/choose");
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("Name");
  ImGui::SameLine(theme.px(kPlaceAt));
  ImGui::SetNextItemWidth(-theme.px(120));
  ImGui::InputText("##name", &name_);
  note_place(*editor_, "export/name");
  if (folder_ + "/" + name_ != before) asked_.clear();
  std::vector<std::string> files;
  for (const exporting::Order& order : orders()) files.push_back(order.out);
  ImGui::PushStyleColor(ImGuiCol_Text, theme.colours().text_soft);
  ImGui::TextUnformatted(files.empty() ? "" : fitted("Writes " + names_of(files), ImGui::GetContentRegionAvail().x).c_str());
  ImGui::PopStyleColor();
}

std::string ExportDialog::missing() const {
  if (chosen_.empty()) return "Choose a format first.";
  if (folder_.empty()) return "Choose a folder first.";
  if (name_.empty() || name_.find('/') != std::string::npos) return "Type a name for the files, without strokes.";
  return "";
}

std::vector<exporting::Order> ExportDialog::orders() const {
  std::vector<exporting::Order> list;
  for (const exporting::FormatDefinition& format : exporting::all_formats()) {
    if (!chosen_.contains(format.id)) continue;
    exporting::Order& order = list.emplace_back();
    order.format = &format;
    order.out = path_of(format);
    order.is_folder = in_folders_.contains(format.id);
    if (const auto set = options_.find(format.id); set != options_.end()) order.options = set->second;
    else
      for (const PortDefinition& option : format.ports) order.options.push_back(option.default_value);
  }
  return list;
}

std::optional<std::vector<std::string>> ExportDialog::write(std::vector<std::string>& told) {
  const std::vector<exporting::Order> wanted = orders();
  const auto refuse = [&](const Error& error) {
    told.push_back(error.text());
    return std::nullopt;
  };
  for (const exporting::Order& order : wanted)
    if (auto may = exporting::may_write_order(order); !may) return refuse(may.error());
  const std::string& source = editor_->document->source();
  const State seen = with_sums_of_now(editor_->state());
  const auto proposal =
      exporting::read_proposal(seen, source.empty() ? editor_->document->name() : paths::path(source).filename().string());
  if (!proposal) return refuse(proposal.error());
  const char* page = std::getenv("BEHAVIOURLINKS_PAGE");
  const auto products = exporting::make_products(wanted, *proposal, page == nullptr ? "" : page);
  if (!products) return refuse(products.error());
  for (const Error& error : products->refused) told.push_back(error.text());
  if (products->files.empty()) return std::nullopt;
  const std::vector<std::string> replaced = exporting::replaced_by(*products);
  if (!replaced.empty() && replaced != asked_) {
    asked_ = replaced;
    told.push_back(names_of(replaced) + (replaced.size() == 1 ? " exists already." : " exist already.") +
                   " Press again to replace " + (replaced.size() == 1 ? "it." : "them."));
    return std::nullopt;
  }
  asked_.clear();
  if (auto made = exporting::make_folders(*products); !made) return refuse(made.error());
  std::vector<std::string> written;
  const auto done = exporting::write_products(*products, written);
  if (!done) {
    if (!written.empty()) told.push_back("Written before that: " + names_of(written) + ".");
    return refuse(done.error());
  }
  for (const exporting::Building& volume : proposal->shapeless)
    told.push_back("In tables only: " + volume.label + ": " + volume.why_shapeless);
  told.insert(told.end(), products->notes.begin(), products->notes.end());
  return written;
}

void Dialogs::show_export(const std::string& section) {
  told_.clear();
  export_->begin(place_to_save(*editor_), section);
  show(Kind::exporting);
}

void Dialogs::draw_export() {
  if (!begin("Export", 780, 660)) {
    if (memory_of(*editor_).typing.key.starts_with("export/")) memory_of(*editor_).typing = {};
    return;
  }
  // Who types into a field of an option leaves the field by Enter, not the dialog.
  const bool was_typing = !memory_of(*editor_).typing.key.empty();
  export_->draw();
  if (draw_foot("Export", "export/write", export_->missing()) && !was_typing) {
    told_.clear();
    const auto written = export_->write(told_);
    is_told_error_ = !written;
    if (written) {
      std::string where = std::filesystem::path(written->front()).parent_path().string();
      editor_->notify(NoticeKind::told, written->size() == 1
                                            ? "Exported " + written->front() + "."
                                            : "Exported " + reading::counted(written->size(), "file") + " into " + where + ".");
      for (const std::string& note : told_) editor_->notify(NoticeKind::warning, note);
      close();
    }
  }
  ImGui::EndPopup();
}

}  // namespace bl::desktop
