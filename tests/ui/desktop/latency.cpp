// Measures from outside how long the window takes from a movement of the mouse to the picture that shows it.
// Usage: desktop_latency X Y DX DY TIMES, with the mouse held at X Y: it jumps to and fro by DX DY, and the pixels around the
// second place are watched. Prints milliseconds, one line for each jump.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <thread>
#include <vector>

#include <X11/Xlib.h>
#include <X11/Xutil.h>

namespace {

using Clock = std::chrono::steady_clock;
constexpr int kReach = 8;              // pixels to each side that are watched
constexpr double kChangedShare = 0.2;  // of their bytes; text that ticks beside the mouse is less
constexpr auto kLongest = std::chrono::seconds(1);
constexpr int kGiveUp = 5;  // movements in all that nobody saw

class Root {
 public:
  explicit Root(Display* display) : display_(display), root_(DefaultRootWindow(display)) {}

  std::vector<char> look(int x, int y) const {
    XImage* image = XGetImage(display_, root_, x - kReach, y - kReach, 2 * kReach, 2 * kReach, AllPlanes, ZPixmap);
    if (image == nullptr) return {};
    std::vector<char> bytes(image->data, image->data + static_cast<std::size_t>(image->bytes_per_line) * 2 * kReach);
    XDestroyImage(image);
    return bytes;
  }

  void move(int x, int y) const {
    XWarpPointer(display_, None, root_, 0, 0, 0, 0, x, y);
    XFlush(display_);
  }

 private:
  Display* display_;
  Window root_;
};

bool is_other(const std::vector<char>& a, const std::vector<char>& b) {
  std::size_t different = 0;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) different += a[k] != b[k] ? 1 : 0;
  return static_cast<double>(different) > kChangedShare * static_cast<double>(a.size());
}

// Milliseconds until the place looks different; below 0 where it never does.
double wait_for_change(const Root& screen, int x, int y, const std::vector<char>& before, Clock::time_point begin) {
  while (Clock::now() - begin < kLongest) {
    if (is_other(before, screen.look(x, y))) return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
    std::this_thread::sleep_for(std::chrono::microseconds(300));
  }
  return -1;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 6) return 2;
  const int x = std::atoi(arguments[1]), y = std::atoi(arguments[2]), far_x = x + std::atoi(arguments[3]),
            far_y = y + std::atoi(arguments[4]), times = std::atoi(arguments[5]);
  Display* display = XOpenDisplay(nullptr);
  if (display == nullptr) return 1;
  const Root screen(display);
  // The watched place lies between the two ends, off the mouse itself, whose picture would be seen at once.
  const int seen_x = (x + far_x) / 2, seen_y = (y + far_y) / 2;
  std::mt19937 random(1);
  int lost = 0;
  for (int k = 0; k < times && lost < kGiveUp; ++k) {
    // Frames have a rhythm that the hand must not fall into.
    std::this_thread::sleep_for(std::chrono::milliseconds(250 + static_cast<long>(random() % 200)));
    const std::vector<char> before = screen.look(seen_x, seen_y);
    const auto begin = Clock::now();
    screen.move(k % 2 == 0 ? far_x : x, k % 2 == 0 ? far_y : y);
    const double ms = wait_for_change(screen, seen_x, seen_y, before, begin);
    if (ms < 0) ++lost;
    else std::printf("%.1f\n", ms);
  }
  XCloseDisplay(display);
  if (lost > 0) std::fprintf(stderr, "%d of %d movements were never seen\n", lost, times);
  return lost > 0 ? 1 : 0;
}
