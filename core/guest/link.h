// A connection to the server of a room, without what connects.
#pragma once

#include <string>
#include <vector>

namespace bl::guest {

struct Heard {
  enum class What { opened, frame, closed };
  What what = What::frame;
  std::string text = {};  ///< the frame, or why the connection has ended
  int code = 0;           ///< of the end, as WebSocket has it
};

/// One attempt to connect: it opens or closes, and once closed it stays closed.
class Link {
 public:
  virtual ~Link() = default;
  /// Before it has opened, and after it has closed, nothing is sent.
  virtual void send(std::string frame) = 0;
  /// What has happened since the last call.
  virtual std::vector<Heard> take() = 0;
  /// Would take() give anything?
  virtual bool has_news() const = 0;
};

}  // namespace bl::guest
