// What is stored goes from the disk's thread to the room's, from there to the thread that folds it, and the file comes back.
#include "core/serve/minutes_maker.h"

#include <algorithm>
#include <utility>

#include "core/define/registry.h"
#include "core/minutes/minutes.h"

namespace bl::serve {

struct StoredSession {
  journal::RoomRow room;
  journal::Loaded all;
};

namespace {

Result<std::string> file_of(const StoredSession& stored, const std::string& name, int zone) {
  auto account = minutes::account_of(stored.room, stored.all, full_registry());
  if (!account) return account.error();
  account->zone = zone;
  auto files = minutes::files_of(*account);
  const auto found = std::find_if(files.begin(), files.end(), [&](const auto& file) { return file.first == name; });
  if (found == files.end()) return Error{ErrorCode::not_found, name, "is no file of these minutes"};
  return std::move(found->second);
}

}  // namespace

MinutesMaker::MinutesMaker(journal::Writer& writer, OnOwnThread on_own_thread)
    : writer_(&writer), on_own_thread_(std::move(on_own_thread)) {}

MinutesMaker::~MinutesMaker() {
  is_alive_.reset();
  if (thread_.joinable()) thread_.join();
}

void MinutesMaker::make(const std::string& file, int zone, Done done) {
  if (is_busy_) return done(Error{ErrorCode::conflict, "minutes", "are being made already: try again in a moment"});
  is_busy_ = true;
  auto stored = std::make_shared<Result<StoredSession>>(Error{});
  writer_->perform(
      [stored](journal::Journal& journal) -> Result<void> {
        auto all = journal.load();
        if (all) *stored = StoredSession{journal.room(), std::move(*all)};
        else *stored = all.error();
        return {};  // that minutes fail is no failure of the room
      },
      [this, wish = Wish{file, zone}, done = std::move(done), stored, post = on_own_thread_,
       is_alive = std::weak_ptr<bool>(is_alive_)](const Result<void>& read) {
        if (!read) *stored = read.error();
        post([this, wish, done, stored, is_alive] {
          if (!is_alive.expired()) begin(wish, done, stored);
        });
      });
}

void MinutesMaker::begin(const Wish& wish, const Done& done, const std::shared_ptr<const Result<StoredSession>>& stored) {
  if (!*stored) return end(done, stored->error());
  if (thread_.joinable()) thread_.join();  // of the minutes before, which are at their end
  thread_ = std::thread([this, wish, done, stored, post = on_own_thread_, is_alive = std::weak_ptr<bool>(is_alive_)] {
    auto made = std::make_shared<const Result<std::string>>(file_of(**stored, wish.file, wish.zone));
    post([this, done, made, is_alive] {
      if (!is_alive.expired()) end(done, *made);
    });
  });
}

void MinutesMaker::end(const Done& done, const Result<std::string>& made) {
  is_busy_ = false;
  done(made);
}

}  // namespace bl::serve
