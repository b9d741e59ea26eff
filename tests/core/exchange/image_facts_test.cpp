// Facts of pictures: an EXIF block made here byte by byte, headers that are cut off anywhere, and a real photograph.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/base/random.h"
#include "core/exchange/image_facts.h"

namespace bl {
namespace {

std::string number(std::uint32_t value, int bytes) {
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

std::string rationals(std::initializer_list<std::pair<int, int>> values) {
  std::string out;
  for (const auto& [top, bottom] : values) out += number(static_cast<std::uint32_t>(top), 4) + number(static_cast<std::uint32_t>(bottom), 4);
  return out;
}

std::string photograph() {
  Directory gps(400, 6);
  gps.add(1, 2, 2, std::string("S\0", 2));
  gps.add(2, 5, 3, rationals({{33, 1}, {30, 1}, {1800, 100}}));
  gps.add(3, 2, 2, std::string("E\0", 2));
  gps.add(4, 5, 3, rationals({{18, 1}, {15, 1}, {0, 1}}));
  gps.add(16, 2, 2, std::string("T\0", 2));
  gps.add(17, 5, 1, rationals({{2715, 10}}));
  Directory exif(200, 2);
  exif.add(0x9003, 2, 20, std::string("2024:05:17 08:09:10\0", 20));
  exif.add(0xa405, 3, 1, number(36, 2));
  Directory first(8, 5);
  first.add(0x0112, 3, 1, number(6, 2));
  first.add(0x013b, 2, 4, std::string("Ada\0", 4));
  first.add(0x8298, 2, 10, std::string("CC BY 4.0\0", 10));
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

TEST(ImageFacts, SaysWhereTheLowerPartIsMissing) {
  const std::string whole = photograph(), head = whole.substr(0, whole.size() - 2);
  const std::string scan = std::string("\xff\xda\x00\x08\x01\x01\x00\x00\x3f\x00", 10) + std::string(200, 'x');
  for (const auto& [bytes, is_cut] : {std::pair{whole, false}, {head, true}, {head + scan, true}, {head + scan + "\xff\xd9", false}}) {
    const auto facts = read_image_facts(bytes);
    ASSERT_TRUE(facts.ok()) << facts.error().text();
    const bool is_said = std::any_of(facts->notes.begin(), facts->notes.end(),
                                     [](const std::string& note) { return note.find("cut off") != std::string::npos; });
    EXPECT_EQ(is_said, is_cut) << bytes.size();
  }
}

TEST(ImageFacts, ReadsWhatCamerasWrite) {
  const auto facts = read_image_facts(photograph());
  ASSERT_TRUE(facts.ok()) << facts.error().text();
  EXPECT_EQ(facts->width, 400);
  EXPECT_EQ(facts->height, 300);
  EXPECT_EQ(facts->orientation, 6);
  EXPECT_EQ(facts->seen_width(), 300);
  EXPECT_EQ(facts->taken, "2024-05-17T08:09:10");
  EXPECT_EQ(facts->author, "Ada");
  EXPECT_EQ(facts->licence, "CC BY 4.0");
  ASSERT_TRUE(facts->latitude && facts->longitude && facts->bearing && facts->field_of_view);
  EXPECT_NEAR(*facts->latitude, -33.505, 1e-9);
  EXPECT_NEAR(*facts->longitude, 18.25, 1e-9);
  EXPECT_NEAR(*facts->bearing, 271.5, 1e-9);
  // 36 mm on film, upright: three fifths of the diagonal across.
  EXPECT_NEAR(*facts->field_of_view, 2 * std::atan(0.5 * 0.6 * 43.2666153 / 36) * 180 / 3.14159265358979, 1e-6);
}

TEST(ImageFacts, CutOffAnywhereItIsAnErrorOrLess) {
  const std::string whole = photograph();
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const auto facts = read_image_facts(whole.substr(0, length));
    if (length < whole.size() - 6) { EXPECT_FALSE(facts.ok()) << length; }
  }
  EXPECT_NE(read_image_facts("GIF89a").error().message.find("JPEG or PNG"), std::string::npos);
}

TEST(ImageFacts, DamagedBytesNeverBreakIt) {
  Random random(5);
  for (int k = 0; k < 3000; ++k) {
    std::string bytes = photograph();
    for (int i = 0; i < 4; ++i)
      bytes[static_cast<std::size_t>(random.uniform() * static_cast<double>(bytes.size()))] = static_cast<char>(random.below(256));
    const auto facts = read_image_facts(bytes);
    if (!facts) continue;
    EXPECT_TRUE(facts->orientation >= 1 && facts->orientation <= 8);
    EXPECT_TRUE(!facts->latitude || std::abs(*facts->latitude) <= 90);
    EXPECT_EQ(facts->latitude.has_value(), facts->longitude.has_value());
  }
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(ImageFacts, OfFilesAsTheyLieOnADisk) {
  const auto drawn = read_image_facts(bytes_of(std::filesystem::path(BL_SOURCE_DIR) / "scenes/media/houses.png"));
  ASSERT_TRUE(drawn.ok());
  EXPECT_EQ(drawn->width, 160);
  EXPECT_EQ(drawn->height, 100);
  EXPECT_FALSE(drawn->latitude);
  // A photograph of a street, where published data lie beside the project.
  const auto path = std::filesystem::path(BL_SOURCE_DIR) / "../shared/data/media/lund_street_01.jpg";
  if (!std::filesystem::exists(path)) return;
  const auto facts = read_image_facts(bytes_of(path));
  ASSERT_TRUE(facts.ok()) << facts.error().text();
  EXPECT_EQ(facts->width, 1024);
  EXPECT_EQ(facts->height, 768);
  EXPECT_NEAR(facts->latitude.value_or(0), 55.69817, 1e-5);
  EXPECT_NEAR(facts->longitude.value_or(0), 13.19539, 1e-5);
  EXPECT_NEAR(facts->bearing.value_or(0), 179.2156, 1e-9) << "from the record in its description";
  EXPECT_EQ(facts->note, "");
}

}  // namespace
}  // namespace bl
