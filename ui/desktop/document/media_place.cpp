// Planes on the ground, upright, and across a camera's line of sight.
#include "ui/desktop/document/media_place.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bl::desktop {

namespace {

constexpr double kTicksPerSecond = 30;

}  // namespace

MediaPlace place_of(const MediaStance& stance) {
  const double turn = stance.azimuth * std::numbers::pi / 180, rise = stance.tilt * std::numbers::pi / 180;
  const Vector3 ahead{std::sin(turn), std::cos(turn), 0}, right{ahead.y, -ahead.x, 0}, up{0, 0, 1};
  if (stance.placement == "ground")
    return {stance.position - 0.5 * stance.width * right - 0.5 * stance.height * ahead, stance.width * right,
            stance.height * ahead};
  if (stance.placement != "camera")
    // Who looks at it looks against its azimuth, and has left and right the other way round.
    return {stance.position + 0.5 * stance.width * right, -stance.width * right, stance.height * up};
  const Vector3 sight = std::cos(rise) * ahead + std::sin(rise) * up, top = cross(right, sight);
  return {stance.position + stance.distance * sight - 0.5 * stance.width * right - 0.5 * stance.height * top,
          stance.width * right, stance.height * top};
}

std::string frame_file(const std::string& file, std::int64_t tick, double rate, std::int64_t frames) {
  const std::size_t begin = file.find('#');
  if (begin == std::string::npos) return file;
  std::size_t end = begin;
  while (end < file.size() && file[end] == '#') ++end;
  const double gone = std::floor(static_cast<double>(std::max<std::int64_t>(0, tick)) * rate / kTicksPerSecond);
  const std::int64_t count = std::max<std::int64_t>(1, frames),
                     frame = static_cast<std::int64_t>(std::fmod(gone, static_cast<double>(count))) + 1;
  std::string number = std::to_string(frame);
  number.insert(0, std::max(end - begin, number.size()) - number.size(), '0');
  return file.substr(0, begin) + number + file.substr(end);
}

}  // namespace bl::desktop
