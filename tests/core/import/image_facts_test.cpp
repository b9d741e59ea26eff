// Facts of pictures: an EXIF block made here byte by byte, headers that are cut off anywhere, and a real photograph.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/base/random.h"
#include "core/import/image_facts.h"
#include "tests/support/photograph.h"
#include "tests/support/place/source_folder.h"

namespace bl::importing {
namespace {

using test::photograph;

TEST(ImageFacts, SaysWhereTheLowerPartIsMissing) {
  const std::string whole = photograph(), head = whole.substr(0, whole.size() - 2);
  const std::string scan = std::string("\xff\xda\x00\x08\x01\x01\x00\x00\x3f\x00", 10) + std::string(200, 'x');
  for (const auto& [bytes, is_cut] :
       {std::pair{whole, false}, {head, true}, {head + scan, true}, {head + scan + "\xff\xd9", false}}) {
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

// The photographer's part and the editor's, in letters of Latin-1; heights below the sea.
TEST(ImageFacts, RightsAndHeightsAreRead) {
  test::Photograph taken;
  taken.author = "Zo\xeb ";
  taken.copyright = std::string("(c) Zo\xeb 2024\0CC BY 4.0\0", 24);
  taken.altitude = -2.5;
  const auto facts = read_image_facts(photograph(taken));
  ASSERT_TRUE(facts.ok()) << facts.error().text();
  EXPECT_EQ(facts->author, "Zo\xc3\xab");
  EXPECT_EQ(facts->licence, "(c) Zo\xc3\xab 2024; CC BY 4.0");
  EXPECT_NEAR(facts->altitude.value_or(0), -2.5, 1e-9);
  const auto& notes = facts->notes;
  EXPECT_TRUE(
      std::any_of(notes.begin(), notes.end(), [](const std::string& n) { return n.find("Latin-1") != std::string::npos; }));
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
      bytes[static_cast<std::size_t>(random.uniform() * static_cast<double>(bytes.size()))] =
          static_cast<char>(random.below(256));
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
  const auto drawn = read_image_facts(bytes_of(std::filesystem::path(test::source_folder()) / "scenes/media/houses.png"));
  ASSERT_TRUE(drawn.ok());
  EXPECT_EQ(drawn->width, 160);
  EXPECT_EQ(drawn->height, 100);
  EXPECT_FALSE(drawn->latitude);
  // A photograph of a street, where published data lie beside the project.
  const auto path = std::filesystem::path(test::source_folder()) / "../shared/data/media/lund_street_01.jpg";
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
}  // namespace bl::importing
