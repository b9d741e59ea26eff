// From the disk's thread to the room's, from there to a thread that makes the file, and back with it.
#include "core/serve/errands.h"

#include <utility>

namespace bl::serve {

Errands::Errands(journal::Writer& writer, OnOwnThread on_own_thread)
    : writer_(&writer), on_own_thread_(std::move(on_own_thread)) {}

Errands::~Errands() {
  is_alive_.reset();
  if (thread_.joinable()) thread_.join();
}

void Errands::begin(Read read, Work work, Done done) {
  if (is_busy_) return done(Error{ErrorCode::conflict, "", "a file is being made already: try again in a moment"});
  is_busy_ = true;
  // That nothing can be read for somebody's file is no failure of the room.
  auto failure = std::make_shared<Result<void>>();
  writer_->perform(
      [read = std::move(read), failure](journal::Journal& journal) -> Result<void> {
        *failure = read(journal);
        return {};
      },
      [this, work = std::move(work), done = std::move(done), failure, post = on_own_thread_,
       is_alive = std::weak_ptr<bool>(is_alive_)](const Result<void>& stored) {
        if (!stored) *failure = stored;
        post([this, work, done, failure, is_alive] {
          if (is_alive.expired()) return;
          if (*failure) work_beside(work, done);
          else end(done, failure->error());
        });
      });
}

void Errands::work_beside(Work work, const Done& done) {
  if (thread_.joinable()) thread_.join();  // of the file before, which is at its end
  thread_ = std::thread([this, work = std::move(work), done, post = on_own_thread_, is_alive = std::weak_ptr<bool>(is_alive_)] {
    auto made = std::make_shared<const Result<Made>>(work());
    post([this, done, made, is_alive] {
      if (!is_alive.expired()) end(done, *made);
    });
  });
}

void Errands::end(const Done& done, const Result<Made>& made) {
  is_busy_ = false;
  done(made);
}

}  // namespace bl::serve
