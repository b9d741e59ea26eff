// A photograph made byte by byte: a JPEG without a picture, with an EXIF block as cameras write it.
#pragma once

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>

namespace bl::test {

inline std::string number(std::uint32_t value, int bytes) {
  std::string out;
  for (int k = bytes - 1; k >= 0; --k) out += static_cast<char>(value >> (8 * k) & 0xff);
  return out;
}

// Directories of EXIF, big-endian: entries with values of more than four bytes behind them.
struct Directory {
  std::string entries, far;
  std::uint32_t begin, count = 0, size;
  Directory(std::uint32_t at, std::uint32_t number_of_entries) : begin(at), size(number_of_entries) {}
  std::uint32_t room() const { return begin + 2 + 12 * size + 4; }
  void add(std::uint32_t tag, std::uint32_t kind, std::uint32_t components, std::string value) {
    entries += number(tag, 2) + number(kind, 2) + number(components, 4);
    if (value.size() <= 4) {
      value.resize(4, '\0');
      entries += value;
    } else {
      entries += number(room() + static_cast<std::uint32_t>(far.size()), 4);
      far += value;
    }
    ++count;
  }
  std::string bytes() const { return number(count, 2) + entries + number(0, 4) + far; }
};

inline std::string rationals(std::initializer_list<std::pair<int, int>> values) {
  std::string out;
  for (const auto& [top, bottom] : values) out += number(static_cast<std::uint32_t>(top), 4) + number(static_cast<std::uint32_t>(bottom), 4);
  return out;
}

/// What it says of itself: by default 33° 30' 18" S, 18° 15' E.
struct Photograph {
  std::string author = "Ada", copyright = std::string("CC BY 4.0\0", 10);
  std::optional<double> altitude;  ///< [m], to the tenth
};

inline std::string photograph(const Photograph& taken = {}) {
  Directory gps(400, taken.altitude ? 8 : 6);
  gps.add(1, 2, 2, std::string("S\0", 2));
  gps.add(2, 5, 3, rationals({{33, 1}, {30, 1}, {1800, 100}}));
  gps.add(3, 2, 2, std::string("E\0", 2));
  gps.add(4, 5, 3, rationals({{18, 1}, {15, 1}, {0, 1}}));
  if (taken.altitude) {
    gps.add(5, 1, 1, std::string(1, *taken.altitude < 0 ? '\1' : '\0'));
    gps.add(6, 5, 1, rationals({{static_cast<int>(std::lround(10 * std::abs(*taken.altitude))), 10}}));
  }
  gps.add(16, 2, 2, std::string("T\0", 2));
  gps.add(17, 5, 1, rationals({{2715, 10}}));
  Directory exif(200, 2);
  exif.add(0x9003, 2, 20, std::string("2024:05:17 08:09:10\0", 20));
  exif.add(0xa405, 3, 1, number(36, 2));
  Directory first(8, 5);
  first.add(0x0112, 3, 1, number(6, 2));
  first.add(0x013b, 2, static_cast<std::uint32_t>(taken.author.size() + 1), taken.author + std::string(1, '\0'));
  first.add(0x8298, 2, static_cast<std::uint32_t>(taken.copyright.size()), taken.copyright);
  first.add(0x8769, 4, 1, number(200, 4));
  first.add(0x8825, 4, 1, number(400, 4));
  std::string block = "MM" + number(42, 2) + number(8, 4) + first.bytes();
  block.resize(200, '\0');
  block += exif.bytes();
  block.resize(400, '\0');
  block = std::string("Exif\0\0", 6) + block + gps.bytes();
  const std::string frame = std::string("\x08", 1) + number(300, 2) + number(400, 2) + std::string("\x01\x01\x11\x00", 4);
  return "\xff\xd8\xff\xe1" + number(static_cast<std::uint32_t>(block.size() + 2), 2) + block + "\xff\xc0" +
         number(static_cast<std::uint32_t>(frame.size() + 2), 2) + frame + "\xff\xd9";
}

}  // namespace bl::test
