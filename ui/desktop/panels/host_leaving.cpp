// The dialog that opens a room, as one of the window's; and the question what becomes of the room when the window leaves it.
#include <nlohmann/json.hpp>

#include "core/guest/room_guest.h"
#include "core/reading/figures.h"
#include "ui/desktop/look/buttons.h"
#include "ui/desktop/panels/dialogs.h"
#include "ui/desktop/panels/host_dialog.h"
#include "ui/desktop/panels/inspector_cell.h"

namespace bl::desktop {

namespace {

constexpr double kLongEnd = 15;  // after this people are told that it takes long [s]

std::size_t others_in(const Workbench& editor) {
  const guest::RoomGuest* room = editor.document ? editor.document->room() : nullptr;
  std::size_t others = 0;
  if (room != nullptr)
    for (const auto& [seat, person] : room->people().seats) others += person.is_here && seat != room->seat() ? 1 : 0;
  return others;
}

}  // namespace

void Dialogs::show_host() {
  host_->begin();
  show(Kind::host);
}

void Dialogs::draw_host() {
  if (!begin("Host a session", 860, 620)) {
    if (kind_ != Kind::host) host_->stop();
    return;
  }
  const bool is_over = host_->draw(!is_fresh_ && !chooser_.is_open());
  if (const auto path = chooser_.draw(*editor_)) {
    const auto chosen = chosen_;
    chosen(*path);
  }
  if (is_over) close();
  ImGui::EndPopup();
}

void Dialogs::ask_leave(std::function<void()> then) {
  then_ = std::move(then);
  end_asked_at_ = -1;
  show(Kind::leave);
}

void Dialogs::draw_leave() {
  if (!begin("The room is open", 560, 220)) return;
  const Theme& theme = editor_->theme;
  Hosting* hosting = editor_->hosting.get();  // watch_hosting drops one that has ended
  if (hosting == nullptr) {
    close();
    if (auto then = std::exchange(then_, nullptr)) then();
    return ImGui::EndPopup();
  }
  ImGui::PushTextWrapPos(0);
  const std::size_t others = others_in(*editor_);
  const std::string who =
      others == 0 ? "Nobody else is in it." : reading::counted(others, "other") + (others == 1 ? " is" : " are") + " in it.";
  ImGui::TextUnformatted(("Room " + hosting->code() + " runs on this computer. " + who).c_str());
  ImGui::TextUnformatted("End it: everybody is told, everything is stored, and the session file can be opened again later.");
  ImGui::TextUnformatted(("Leave it open: people go on without this window. File, Join a room leads back to it. To end it "
                          "without a window: kill -INT " +
                          std::to_string(hosting->number()))
                             .c_str());
  if (end_asked_at_ >= 0) {
    editor_->wake_at(editor_->now + 0.1);
    ImGui::TextUnformatted(editor_->now - end_asked_at_ < kLongEnd
                               ? "The room is being closed ..."
                               : "This takes long: the disk is slow. Leave it open, and it goes on ending by itself.");
  }
  ImGui::PopTextWrapPos();
  ImGui::Dummy({0, theme.px(8)});
  ImGui::BeginDisabled(end_asked_at_ >= 0);
  if (chief_button(theme, "End the session", {theme.px(150), 0})) {
    end_asked_at_ = editor_->now;
    hosting->end();
  }
  ImGui::EndDisabled();
  note_place(*editor_, "leave/end");
  ImGui::SameLine();
  const bool is_left = ImGui::Button("Leave it open", {theme.px(150), 0});
  note_place(*editor_, "leave/open");
  ImGui::SameLine();
  ImGui::BeginDisabled(end_asked_at_ >= 0);
  if (ImGui::Button("Cancel", {theme.px(110), 0})) {
    then_ = nullptr;
    close();
  }
  ImGui::EndDisabled();
  note_place(*editor_, "leave/cancel");
  if (is_left) {
    editor_->hosting.reset();
    close();
    if (auto then = std::exchange(then_, nullptr)) then();
  }
  ImGui::EndPopup();
}

}  // namespace bl::desktop
