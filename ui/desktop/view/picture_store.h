// Pictures of files, read and decoded on a thread of their own, so that no frame waits for them.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace bl::desktop {

struct DecodedPicture {
  enum class Standing { waiting, ready, failed };
  Standing standing = Standing::waiting;
  int width = 0, height = 0;
  std::vector<std::uint8_t> pixels;  ///< RGBA, from the upper left corner, as they are stored
  std::string reason;                ///< why it failed, a sentence
};

class PictureStore {
 public:
  PictureStore();
  ~PictureStore();
  PictureStore(const PictureStore&) = delete;
  PictureStore& operator=(const PictureStore&) = delete;

  /// What is known of the file now; asks for it where nobody has before. What failed is tried again when it is asked for after
  /// `forget`.
  std::shared_ptr<const DecodedPicture> find(const std::string& path);
  /// Files that came in since the last call.
  bool has_news();
  /// Are files still to come in, or news of them to be taken?
  bool is_waiting() const;
  /// Until nothing is asked for any more. For stills and tests.
  void wait();
  /// Everything that is not among `kept`.
  void keep_only(const std::vector<std::string>& kept);

  /// Pictures are made smaller until neither side is longer.
  static constexpr int kLongest = 2048;

 private:
  struct Worker;
  std::unique_ptr<Worker> worker_;
};

/// Reads and decodes one file.
DecodedPicture decode_picture(const std::string& path);

}  // namespace bl::desktop
