// A room begins with a scene, or goes on from its session file.
#include <algorithm>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "core/file/file_io.h"
#include "core/file/scene_file.h"
#include "core/serve/room_frames.h"
#include "core/serve/room_host.h"
#include "core/session/session.h"

namespace bl::serve {

namespace {

constexpr std::int64_t kInviteSeat = 0;  // the row of tokens that holds the key of all invitations

// What makes the keys of a renewal others than those before it. The first ones have none, as in files of earlier programs.
std::string mark_of(std::int64_t renewals) { return renewals == 0 ? "" : " " + std::to_string(renewals); }

Result<Scene> usable_scene(const std::string& text, const std::string& place) {
  SceneReading reading = read_scene(text, full_registry());
  if (!reading.is_usable()) return reading.first_error().within(place);
  for (const Problem& problem : check_scene(reading.scene, full_registry()))
    if (problem.is_error) return problem.error.within(place);
  return std::move(reading.scene);
}

}  // namespace

Result<std::unique_ptr<RoomHost>> RoomHost::open(const std::string& journal_path, const std::string& code,
                                                 const std::string& scene_path, RoomHostOptions options) {
  std::unique_ptr<RoomHost> host(new RoomHost(code, std::move(options)));
  host->journal_path_ = journal_path;
  const journal::Journal::Options how{.opened_at = host->options_.wall_time()};
  const bool is_there = std::filesystem::exists(journal_path);
  Result<std::unique_ptr<journal::Journal>> journal = Error{};
  if (is_there) {
    journal = journal::Journal::open(journal_path, full_registry(), how);
  } else {
    const auto text = read_file(scene_path);
    if (!text) return text.error();
    const auto scene = usable_scene(*text, scene_path);
    if (!scene) return scene.error();
    const std::string title = settings_of(*scene).title;
    journal::RoomRow row{.code = code, .title = title.empty() ? std::filesystem::path(scene_path).stem().string() : title};
    row.scene = *text;
    row.created = host->options_.wall_time();
    journal = journal::Journal::create(journal_path, row, full_registry(), how);
  }
  if (!journal) return journal.error();
  auto loaded = (*journal)->load();
  if (!loaded) return loaded.error();
  host->code_ = (*journal)->room().code;
  host->title_ = (*journal)->room().title;
  if (host->options_.takes_over) {
    journal::RoomRow row = (*journal)->room();
    ++row.epoch;
    if (auto changed = (*journal)->change_room(row); !changed) return changed.error();
  }
  host->epoch_ = (*journal)->room().epoch;
  host::Clock* clock = host->options_.clock;
  host->writer_ = std::make_unique<journal::Writer>(
      std::move(*journal), journal::Writer::Clock{[clock] { return clock->now(); },
                                                  [clock](std::condition_variable& wake, std::unique_lock<std::mutex>& lock,
                                                          double until) { clock->wait(wake, lock, until); }});
  host->followers_ = std::make_unique<Followers>(*host->writer_, host->options_.on_own_thread, *clock);
  host->errands_ = std::make_unique<Errands>(*host->writer_, host->options_.on_own_thread);
  if (auto begun = host->begin(*loaded); !begun) return begun.error();
  host->flush();
  return host;
}

Result<void> RoomHost::begin(const journal::Loaded& loaded) {
  beginning_ = loaded.room.scene;
  base_ = loaded.room.base;
  kept_.clear();
  unstored_.clear();
  stored_ = loaded.scenarios;
  const auto scene = usable_scene(beginning_, "the scene of the session file");
  if (!scene) return scene.error();
  const auto state = state_after(loaded, *scene);
  if (!state) return state.error();
  const auto history = [&](Ledger& ledger) -> Result<void> {
    room_ = std::make_unique<room::Room>(ledger, room::RoomOptions{options_.allowances, options_.random,
                                                                   [this](const std::string& id) { return kept_state(id); }});
    for (const room::EntryRecord& record : loaded.room.stored.entries)
      if (auto done = room_->replay(record); !done) return done.error().within("entry " + std::to_string(record.entry.seq));
    room_->restore(loaded.room.stored);
    return {};
  };
  host::LiveSessionOptions how{.author = {"room", AuthorKind::program}, .origin = "room", .threads = 1, .clock = options_.clock};
  auto session = host::LiveSession::go_on(full_registry(), *scene, base_, history, &*state, how);
  if (!session) return session.error();
  session_ = std::move(*session);
  stored_seq_ = session_->last_seq();
  snapshot_seq_ = loaded.snapshot ? loaded.snapshot->seq : base_;
  last_snapshot_ = options_.clock->now();
  session_->let_rest(true);
  make_invites(loaded.room.stored.tokens);
  say([&](room::Now now) {
    for (const auto& [number, seat] : std::map(room_->state().seats))
      if (seat.is_here) room_->note_presence(number, false, now);
  });
  devices_.reset();
  brought_ = -1;
  follow_devices();
  watch_ticks();
  follow_pace();
  return {};
}

// The ticks since the newest snapshot are taken again, with what was said in them.
Result<SavedState> RoomHost::state_after(const journal::Loaded& loaded, const Scene& beginning) {
  Scene scene = beginning;
  std::optional<SavedState> saved;
  std::int64_t seq = loaded.room.base;
  const auto text = loaded.snapshot ? journal::unpack(loaded.snapshot->scene) : Result<std::string>(loaded.room.scene);
  if (!text) return text.error();
  SceneReading reading = read_scene(*text, full_registry());
  if (loaded.snapshot) {
    scene = std::move(reading.scene);
    seq = loaded.snapshot->seq;
  }
  saved = std::move(reading.state);
  auto session = Session::start(full_registry(), scene, saved ? &*saved : nullptr, 1);
  if (!session) return session.error();
  const auto run_to = [&](std::int64_t tick) {
    while ((*session)->state()->tick < tick) (*session)->tick();
  };
  std::int64_t last_return = base_;
  for (const room::EntryRecord& record : loaded.room.stored.entries) {
    if (record.entry.is_return()) last_return = record.entry.seq;
    if (record.entry.seq <= seq) continue;
    run_to(record.entry.tick);
    if (!record.entry.is_command()) {
      if (auto done = follow_return(**session, record.entry); !done)
        return done.error().within("entry " + std::to_string(record.entry.seq));
      continue;
    }
    // Undo marks of gestures before the snapshot are not known here; what counts is what the entry does to the scene.
    LogEntry entry = record.entry;
    entry.undoes = entry.redoes = 0;
    entry.is_abandoned = false;
    entry.source = {};
    if (auto done = (*session)->submit({.command = entry.command, .author = entry.author}); !done)
      return done.error().within("entry " + std::to_string(entry.seq));
  }
  // Ticks before the last return were higher, and are no more.
  for (const journal::HashRow& row : loaded.hashes)
    if (row.seq >= last_return) run_to(row.tick);
  // The tick that reads the last entry is taken as well, so that it cannot read what will be said from now on.
  for (const room::EntryRecord& record : loaded.room.stored.entries)
    if (record.entry.seq > last_return && record.entry.is_command()) run_to(record.entry.tick + 1);
  return save(*(*session)->coming_state());
}

// Scenarios keep the state of their moment, and restarts go back to it.
Result<void> RoomHost::follow_return(Session& session, const LogEntry& entry) {
  if (entry.event) {
    const auto content = entry.event->read();
    if (!content) return content.error();
    if ((**content).value("event", "") != "save_scenario") return {};
    session.keep_moment(entry.seq);
    kept_[(**content)["arguments"].value("id", "")] = session.coming_state();
    return {};
  }
  if (!entry.restarts_from) return {};
  const auto stored =
      std::find_if(stored_.begin(), stored_.end(), [&](const auto& one) { return one.second.seq == *entry.restarts_from; });
  if (!session.has_moment(*entry.restarts_from) && stored != stored_.end()) {
    auto state = state_of(stored->second);
    if (!state) return state.error();
    session.keep_moment(*entry.restarts_from, std::move(*state));
  }
  LogEntry back = entry;
  back.seq = 0;  // entries are numbered anew here
  back.source = {};
  back.state_hash.clear();  // a room goes on also where another version of the program gives other hashes
  return session.replay(back);
}

// --- Keys -----------------------------------------------------------------------------------------------------------

// All keys follow from one, which is stored: whoever was invited before a crash is invited after it.
void RoomHost::make_invites(const std::vector<room::TokenRecord>& tokens) {
  invite_secret_.clear();
  for (const room::TokenRecord& token : tokens)
    if (token.seat == kInviteSeat) invite_secret_ = token.hash;
  if (invite_secret_.empty()) {
    invite_secret_ = room::hex_of(options_.random(32));
    room::Record record;
    record.tokens.push_back({kInviteSeat, invite_secret_});
    writer_->submit(std::move(record), [](const Result<void>&) {});
  }
  renewals_ = room_->state().key_renewals;
  invites_ = invites_after(renewals_);
  follow_key_ = room::keyed_digest_of(invite_secret_, "follow" + mark_of(renewals_), 32);
}

std::map<std::string, std::string> RoomHost::invites_after(std::int64_t renewals) const {
  std::map<std::string, std::string> invites;
  for (const Role role :
       {Role::facilitator, Role::designer, Role::stakeholder, Role::participant, Role::viewer, Role::recorder}) {
    const std::string name(kRoleNames[static_cast<std::size_t>(role)]);
    invites[name] = room::keyed_digest_of(invite_secret_, name + mark_of(renewals), 16);
  }
  return invites;
}

bool RoomHost::was_invite(std::string_view invite) const {
  for (std::int64_t renewals = 0; renewals < renewals_; ++renewals)
    for (const auto& [role, key] : invites_after(renewals))
      if (room::is_same_secret(key, invite)) return true;
  return false;
}

// Old keys are void at once. The new ones are told when the renewal is stored: a crash before would take it back. A laptop that
// follows by the old key is sent away, because it has no seat that could be taken from it.
void RoomHost::follow_renewals() {
  if (renewals_ == room_->state().key_renewals) return;
  make_invites({{kInviteSeat, invite_secret_}});
  tellings_.push_back([this, is_alive = std::weak_ptr<bool>(is_alive_)] {
    options_.on_own_thread([this, is_alive] {  // afterwards: sending somebody away lets others be told
      if (is_alive.expired()) return;
      followers_->send_away_by_key("the facilitator has renewed the keys");
      if (options_.keys_renewed) options_.keys_renewed(*this);
    });
  });
}

// --- Other laptops --------------------------------------------------------------------------------------------------

// A laptop gets all that this one has, so it comes in by a facilitator's key only.
bool RoomHost::greet_follower(const std::shared_ptr<Guest>& guest, const wire::Hello& hello) {
  const bool is_lead = leads(room_->seat_of_token(hello.token));
  if (!is_lead && !room::is_same_secret(follow_key_, hello.token)) {
    guest->close(CloseCode::no_seat, "a room is followed by the token that its server has printed, or by a facilitator's");
    return false;
  }
  followers_->add(guest, !is_lead);
  return true;
}

// Pages that are here already learn where else the room may be.
void RoomHost::hear_follower(Guest& guest, std::string_view frame) {
  const auto known = followers_->addresses();
  followers_->hear(guest, frame);
  if (followers_->addresses() == known) return;
  const auto notice = frame_of_message(wire::Say{"addresses", JsonValue::of({{"addresses", addresses()}})});
  for (auto& [key, visitor] : visitors_)
    if (visitor.is_welcome && visitor.kind != "desktop") visitor.guest->send(notice);
}

std::vector<std::string> RoomHost::addresses() const {
  std::vector<std::string> all = options_.addresses;
  for (const std::string& address : followers_->addresses())
    if (std::find(all.begin(), all.end(), address) == all.end()) all.push_back(address);
  return all;
}

RoomHost::~RoomHost() { close(); }

// A room that goes on takes this tick in any case (state_after). With it the last hash is that of all that was said, so that a
// replay compares the end as well, and tells it from a crash.
void RoomHost::take_last_tick() {
  if (session_->moment()->seq >= session_->last_seq()) return;
  session_->make_ticks_wait(false);
  session_->step(1);
  session_->settle();
}

void RoomHost::close() {
  if (!is_alive_) return;
  for (auto& [key, visitor] : visitors_) visitor.guest->close(CloseCode::draining, "the room is being closed");
  visitors_.clear();
  if (followers_) followers_->close();
  if (session_ && writer_ && problem_.empty()) {
    take_last_tick();
    store_hash();
  }
  is_alive_.reset();
  session_.reset();
  followers_.reset();
  errands_.reset();
  writer_.reset();  // stores what waits
}

}  // namespace bl::serve
