// The address of a room, typed or pasted.
#include <imgui_stdlib.h>

#include "core/guest/joining.h"
#include "ui/desktop/panels/dialogs.h"
#include "ui/desktop/panels/inspector_cell.h"

namespace bl::desktop {

void Dialogs::ask_join() {
  told_.clear();
  guard([this] {
    if (address_.empty() && !editor_->person.recent_rooms.empty()) address_ = editor_->person.recent_rooms.front();
    show(Kind::join);
  });
}

void Dialogs::draw_join() {
  if (!begin("Join a room", 560, 220)) return;
  const Theme& theme = editor_->theme;
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(
      "The address stands beside the QR code of the room: room://HOST:PORT/CODE#k=KEY, or the page's own address with its key.");
  ImGui::PopTextWrapPos();
  ImGui::Dummy({0, theme.px(4)});
  if (is_fresh_) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1);
  ImGui::InputTextWithHint("##address", "room://192.168.1.20:8080/BKRT#k=...", &address_);
  note_place(*editor_, "join/address");
  const auto room = guest::room_named(address_);
  if (draw_foot("Join", "join/join", room ? "" : room.error().text()) && editor_->join(address_)) close();
  ImGui::EndPopup();
}

}  // namespace bl::desktop
