// Bytes as text, and back.
#include "core/wire/base64.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace bl::wire {
namespace {

TEST(Base64, GivesTheTextsOfTheStandard) {
  const std::pair<const char*, const char*> known[] = {{"", ""},
                                                       {"f", "Zg=="},
                                                       {"fo", "Zm8="},
                                                       {"foo", "Zm9v"},
                                                       {"foob", "Zm9vYg=="},
                                                       {"fooba", "Zm9vYmE="},
                                                       {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : known) {
    EXPECT_EQ(base64_of(bytes), text);
    EXPECT_EQ(*bytes_of_base64(text), bytes);
  }
}

TEST(Base64, LawOfThereAndBackAndNothingElseIsRead) {
  Random random(5);
  for (int k = 0; k < 500; ++k) {
    std::string bytes;
    for (std::uint64_t n = random.below(40); n > 0; --n) bytes += static_cast<char>(random.below(256));
    const std::string text = base64_of(bytes);
    const auto back = bytes_of_base64(text);
    ASSERT_TRUE(back.ok());
    EXPECT_EQ(*back, bytes);
    if (text.empty()) continue;
    std::string wrong = text;
    wrong[random.below(wrong.size())] = static_cast<char>(random.below(256));
    // Whatever is read is what would be written of it.
    const auto read = bytes_of_base64(wrong);
    EXPECT_EQ(read ? base64_of(*read) : wrong, wrong);
  }
  for (const char* wrong : {"Zg", "Zg=", "Zh==", "=g==", "Zg==Zg==", "Zm9", "Zm 9"})
    EXPECT_FALSE(bytes_of_base64(wrong).ok()) << wrong;
}

}  // namespace
}  // namespace bl::wire
