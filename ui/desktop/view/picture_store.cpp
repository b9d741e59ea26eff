// A queue of paths and one thread that empties it.
#include "ui/desktop/view/picture_store.h"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <new>
#include <thread>

#include <stb/stb_image.h>

#include "core/file/file_io.h"

namespace bl::desktop {

namespace {

constexpr std::int64_t kMostPixels = 120'000'000;
constexpr std::uintmax_t kMostBytes = 1u << 30;

// Every two by two pixels become one.
void halve(DecodedPicture& picture) {
  const int w = std::max(1, picture.width / 2), h = std::max(1, picture.height / 2);
  std::vector<std::uint8_t> out(4 * static_cast<std::size_t>(w) * static_cast<std::size_t>(h));
  const auto at = [&](int x, int y, int c) {
    const int left = std::min(x, picture.width - 1), top = std::min(y, picture.height - 1);
    return static_cast<int>(picture.pixels[4 * (static_cast<std::size_t>(top) * static_cast<std::size_t>(picture.width) +
                                                static_cast<std::size_t>(left)) +
                                           static_cast<std::size_t>(c)]);
  };
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x)
      for (int c = 0; c < 4; ++c)
        out[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(w) + static_cast<std::size_t>(x)) +
            static_cast<std::size_t>(c)] =
            static_cast<std::uint8_t>(
                (at(2 * x, 2 * y, c) + at(2 * x + 1, 2 * y, c) + at(2 * x, 2 * y + 1, c) + at(2 * x + 1, 2 * y + 1, c) + 2) / 4);
  picture.pixels = std::move(out);
  picture.width = w;
  picture.height = h;
}

DecodedPicture decode_where_there_is_room(const std::string& path) {
  DecodedPicture picture;
  picture.standing = DecodedPicture::Standing::failed;
  const auto bytes = read_plain_file(path, kMostBytes);
  if (!bytes) {
    picture.reason = bytes.error().message;
    return picture;
  }
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes->data());
  const int size = static_cast<int>(std::min<std::size_t>(bytes->size(), 0x7fffffff));
  int width = 0, height = 0, channels = 0;
  if (stbi_info_from_memory(data, size, &width, &height, &channels) == 0) {
    picture.reason = "it is no picture that can be read: use a JPEG or PNG file";
    return picture;
  }
  if (static_cast<std::int64_t>(width) * height > kMostPixels) {
    picture.reason = "it has more than 120 million pixels: make it smaller";
    return picture;
  }
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
      stbi_load_from_memory(data, size, &width, &height, &channels, 4), stbi_image_free);
  if (!pixels) {
    picture.reason = "it is damaged or cut off: copy it again";
    return picture;
  }
  picture.width = width;
  picture.height = height;
  picture.pixels.assign(pixels.get(), pixels.get() + 4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  while (std::max(picture.width, picture.height) > PictureStore::kLongest) halve(picture);
  picture.standing = DecodedPicture::Standing::ready;
  return picture;
}

}  // namespace

DecodedPicture decode_picture(const std::string& path) {
  try {
    return decode_where_there_is_room(path);
  } catch (const std::bad_alloc&) {
    DecodedPicture none;
    none.standing = DecodedPicture::Standing::failed;
    none.reason = "memory ran out while it was read: make the picture smaller, or give the program more memory";
    return none;
  }
}

struct PictureStore::Worker {
  std::mutex mutex;
  std::condition_variable wanted, done;
  std::deque<std::string> queue;
  std::map<std::string, std::shared_ptr<const DecodedPicture>> pictures;
  bool is_ending = false, is_busy = false, has_news = false;
  std::thread thread;

  void work() {
    std::unique_lock lock(mutex);
    for (;;) {
      wanted.wait(lock, [&] { return is_ending || !queue.empty(); });
      if (is_ending) return;
      const std::string path = queue.front();
      queue.pop_front();
      is_busy = true;
      lock.unlock();
      auto picture = std::make_shared<const DecodedPicture>(decode_picture(path));
      lock.lock();
      if (const auto found = pictures.find(path); found != pictures.end()) found->second = std::move(picture);
      is_busy = false;
      has_news = true;
      done.notify_all();
    }
  }
};

PictureStore::PictureStore() : worker_(std::make_unique<Worker>()) {
  worker_->thread = std::thread([worker = worker_.get()] { worker->work(); });
}

PictureStore::~PictureStore() {
  {
    const std::scoped_lock lock(worker_->mutex);
    worker_->is_ending = true;
  }
  worker_->wanted.notify_all();
  worker_->thread.join();
}

std::shared_ptr<const DecodedPicture> PictureStore::find(const std::string& path) {
  const std::scoped_lock lock(worker_->mutex);
  const auto [entry, is_new] = worker_->pictures.emplace(path, nullptr);
  if (is_new) {
    entry->second = std::make_shared<const DecodedPicture>();
    worker_->queue.push_back(path);
    worker_->wanted.notify_one();
  }
  return entry->second;
}

bool PictureStore::has_news() {
  const std::scoped_lock lock(worker_->mutex);
  return std::exchange(worker_->has_news, false);
}

bool PictureStore::is_waiting() const {
  const std::scoped_lock lock(worker_->mutex);
  return worker_->has_news || worker_->is_busy || !worker_->queue.empty();
}

void PictureStore::wait() {
  std::unique_lock lock(worker_->mutex);
  worker_->done.wait(lock, [&] { return worker_->queue.empty() && !worker_->is_busy; });
}

void PictureStore::keep_only(const std::vector<std::string>& kept) {
  const std::scoped_lock lock(worker_->mutex);
  std::erase_if(worker_->pictures,
                [&](const auto& entry) { return std::find(kept.begin(), kept.end(), entry.first) == kept.end(); });
}

}  // namespace bl::desktop
