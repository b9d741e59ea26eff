// Words that look the same are the same, and nothing hides in them.
#include "core/base/words.h"

#include <gtest/gtest.h>

namespace bl {
namespace {

TEST(Words, AreComposed) {
  EXPECT_EQ(composed("Zoe\u0308"), "Zo\u00eb");
  EXPECT_EQ(composed("\u1112\u1161\u11ab"), "\ud55c") << "syllables of Hangul";
  EXPECT_EQ(composed("A\u030a\u0301"), "\u01fa");
  EXPECT_EQ(composed("\u212b"), "\u00c5") << "the sign of angstrom";
  for (const char* same : {"", "plain", "Zo\u00eb", "\ufb01t", "\U0001f333", "two\nlines"}) EXPECT_EQ(composed(same), same);
  EXPECT_EQ(composed("\xff\xfe\xc3\xa4"), "\xff\xfe\xc3\xa4") << "no UTF-8";
}

TEST(Words, OfPlaceEndWhatANameNames) {
  EXPECT_EQ(without_place("Flats above shops"), "Flats");
  EXPECT_EQ(without_place("flats_over_shops"), "flats");
  EXPECT_EQ(without_place("Shop 2 (below the flats)"), "Shop 2");
  EXPECT_EQ(without_place("Student housing ON top of a café"), "Student housing");
  EXPECT_EQ(without_place("caf\u00e9 beside offices with parking"), "caf\u00e9");
  for (const char* whole : {"", " ", "flats", "Over 55s housing", "on-street parking", "add-on housing", "drive-through with",
                            "overlook flats", "Flats 3 above", "above", "--"})
    EXPECT_EQ(without_place(whole), whole);
}

TEST(Words, AreHarmlessWithoutControlsAndMarksOfDirection) {
  for (const char* text : {"", "a\nb", "caf\u00e9", "\u05d0\u05d1", "\U0001f468\u200d\U0001f33e"})
    EXPECT_TRUE(is_harmless(text)) << text;
  for (const char* text :
       {"a\tb", "\x1b[2J", "\x7f", "a\u202eb", "\u2066", "\u200f", "\u061c", "\u0085", "\u2028", "\ufeff", "\xc0\x80"})
    EXPECT_FALSE(is_harmless(text)) << text;
}

}  // namespace
}  // namespace bl
