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

void Errands::begin(const std::string& name, Read read, Work work, Done done) {
  if (name.empty() && !line_.empty())
    return done(Error{ErrorCode::conflict, "", "a file is being made already: try again in a moment"});
  for (Errand& other : line_)
    if (!name.empty() && other.name == name) return other.done.push_back(std::move(done));
  line_.push_back({name, std::move(read), std::move(work), {std::move(done)}});
  if (line_.size() == 1) start();
}

void Errands::start() {
  // That nothing can be read for somebody's file is no failure of the room.
  auto failure = std::make_shared<Result<void>>();
  writer_->perform(
      [read = line_.front().read, failure](journal::Journal& journal) -> Result<void> {
        *failure = read(journal);
        return {};
      },
      [this, failure, post = on_own_thread_, is_alive = std::weak_ptr<bool>(is_alive_)](const Result<void>& stored) {
        if (!stored) *failure = stored;
        post([this, failure, is_alive] {
          if (is_alive.expired()) return;
          if (*failure) work_beside();
          else end(failure->error());
        });
      });
}

void Errands::work_beside() {
  if (thread_.joinable()) thread_.join();  // of the file before, which is at its end
  thread_ = std::thread([this, work = line_.front().work, post = on_own_thread_, is_alive = std::weak_ptr<bool>(is_alive_)] {
    auto made = std::make_shared<const Result<Made>>(work());
    post([this, made, is_alive] {
      if (!is_alive.expired()) end(*made);
    });
  });
}

void Errands::end(const Result<Made>& made) {
  const Errand errand = std::move(line_.front());
  line_.pop_front();
  if (!line_.empty()) start();
  for (const Done& done : errand.done) done(made);
}

}  // namespace bl::serve
