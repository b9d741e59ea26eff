// Single frames from the network: each is refused with a sentence, or read, written and read again as the same message.
#include <cstdint>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "core/wire/messages.h"
#include "core/wire/operations.h"
#include "tests/fuzz/require.h"

namespace {

using namespace bl;
using bl::fuzz::require;

template <class M>
void read_and_write(const Json& frame) {
  const auto message = wire::read_message<M>(frame);
  if (!message) return require(!message.error().message.empty(), "a refusal without a reason");
  const std::string line = wire::write_message(*message);
  const auto again = wire::read_frame(line);
  require(again.ok(), "a written message is no frame");
  const auto second = wire::read_message<M>(*again);
  require(second.ok(), "a written message is refused");
  require(wire::write_message(*second) == line, "a message changes when it is written and read");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto frame = wire::read_frame({reinterpret_cast<const char*>(data), size});
  if (!frame) {
    require(!frame.error().message.empty(), "a refusal without a reason");
    return 0;
  }
  // What is no operation is read by its name, as each part of a server does that takes it.
  const std::string t = (*frame)["t"];
  if (wire::is_operation(t)) (void)wire::read_operation(*frame, "run");
  if (t == "hello") read_and_write<wire::Hello>(*frame);
  if (t == "op") read_and_write<wire::Op>(*frame);
  if (t == "room") read_and_write<wire::RoomOp>(*frame);
  if (t == "undo") read_and_write<wire::UndoOp>(*frame);
  if (t == "redo") read_and_write<wire::RedoOp>(*frame);
  if (t == "rewind") read_and_write<wire::RewindOp>(*frame);
  if (t == "draft") read_and_write<wire::DraftOp>(*frame);
  if (t == "want") read_and_write<wire::Want>(*frame);
  if (t == "seen") read_and_write<wire::Seen>(*frame);
  if (t == "ping") read_and_write<wire::Ping>(*frame);
  if (t == "presence") read_and_write<wire::PresenceIn>(*frame);
  if (t == "resync") read_and_write<wire::Resync>(*frame);
  return 0;
}
