// Files that a room makes for people: its minutes, and its plan in the formats of other programs.
#include <algorithm>
#include <filesystem>
#include <utility>

#include "core/define/registry.h"
#include "core/export/option_text.h"
#include "core/export/read_proposal.h"
#include "core/export/write_files.h"
#include "core/graph/sums_of_now.h"
#include "core/minutes/minutes.h"
#include "core/serve/room_host.h"

namespace bl::serve {

namespace {

struct StoredSession {
  journal::RoomRow room;
  journal::Loaded all;
};

Result<Errands::Made> minutes_of(const StoredSession& stored, const std::string& name, int zone, bool is_shared) {
  auto account = minutes::account_of(stored.room, stored.all, full_registry());
  if (!account) return account.error();
  account->zone = zone;
  // Who voted knew that the room stores it, and not that all others would read it at home.
  if (is_shared)
    for (minutes::Round& round : account->rounds) round.ballots.clear();
  auto files = minutes::files_of(*account);
  const auto found = std::find_if(files.begin(), files.end(), [&](const auto& file) { return file.first == name; });
  if (found == files.end()) return Error{ErrorCode::not_found, name, "is no file of these minutes"};
  return Errands::Made{name, std::move(found->second)};
}

Result<exporting::Order> order_of(const ExportWish& wish) {
  exporting::Order order{exporting::find_format(wish.format), "", false, {}};
  if (order.format == nullptr) return Error{ErrorCode::unknown_type, "format", "there is no format `" + wish.format + "`"};
  if (auto known = exporting::check_option_names({order.format}, wish.options); !known) return known.error();
  auto values = exporting::option_values(*order.format, wish.options);
  if (!values) return values.error();
  order.options = std::move(*values);
  order.out = "plan" + order.format->ending;
  return order;
}

Result<Errands::Made> export_of(const State& state, const std::string& file, const exporting::Order& order,
                                const std::string& page_folder) {
  const State seen = with_sums_of_now(state);
  auto proposal = exporting::read_proposal(seen, file);
  if (!proposal) return proposal.error();
  std::vector<std::string> notes;
  for (const exporting::Building& volume : proposal->shapeless)
    notes.push_back("In tables only: " + volume.label + ": " + volume.why_shapeless);
  auto products = exporting::make_products(std::span(&order, 1), std::move(*proposal), page_folder);
  if (!products) return products.error();
  if (!products->refused.empty()) return products->refused.front();
  notes.insert(notes.end(), products->notes.begin(), products->notes.end());
  return Errands::Made{order.out, std::move(products->files.front().content), std::move(notes)};
}

}  // namespace

void RoomHost::make_minutes(const std::string& file, int zone, bool is_shared, Errands::Done done) {
  const auto stored = std::make_shared<StoredSession>();
  // All who took part ask for it within seconds.
  errands_->begin(
      is_shared ? file + " " + std::to_string(zone) : "",
      [stored](journal::Journal& journal) -> Result<void> {
        auto all = journal.load();
        if (!all) return all.error();
        *stored = StoredSession{journal.room(), std::move(*all)};
        return {};
      },
      [stored, file, zone, is_shared] { return minutes_of(*stored, file, zone, is_shared); }, std::move(done));
}

void RoomHost::make_export(const ExportWish& wish, Errands::Done done) {
  auto order = order_of(wish);
  if (!order) return done(order.error());
  flush();  // nobody gets what could still be lost
  errands_->begin(
      "", [](journal::Journal&) { return Result<void>(); },
      [state = session_->coming_state(), file = std::filesystem::path(journal_path_).filename().string(),
       order = std::move(*order), folder = wish.page_folder] { return export_of(*state, file, order, folder); },
      std::move(done));
}

bool RoomHost::may_read_minutes(std::int64_t seat, const std::string& file) const {
  const room::Seat* const one = room_->state().seat(seat);
  const bool took_part = one != nullptr && !one->is_removed && !one->is_waiting && one->role != Role::viewer;
  return leads(seat) || (took_part && room_->state().shares_minutes && file == minutes::kMinutesPage);
}

bool RoomHost::may_export(std::int64_t seat) const {
  const room::Seat* const one = room_->state().seat(seat);
  return leads(seat) || (one != nullptr && !one->is_removed && one->role == Role::designer);
}

}  // namespace bl::serve
