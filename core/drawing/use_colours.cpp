// Colours of land-use plans: housing yellow, shops red, offices blue, industry brown, parking grey, open space green. They were
// chosen so that people with protanopia or deuteranopia tell any two of them apart: at least 9.5 apart in CIE L*a*b* as these see
// them (Machado and others 2009), and 25 as others do. The tests measure it. Streets are paler than all uses, and no use.
#include "core/drawing/use_colours.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/base/hash.h"
#include "core/base/words.h"

namespace bl::drawing {

namespace {

constexpr Colour of_hex(unsigned hex) {
  return {static_cast<double>(hex >> 16) / 255, static_cast<double>((hex >> 8) & 0xff) / 255,
          static_cast<double>(hex & 0xff) / 255};
}

struct KnownUse {
  UseColour shown;
  std::string_view words;  // in the singular, with a blank on either side
  GroundCover cover = GroundCover::none;
};

constexpr std::array<KnownUse, 13> kKnownUses = {{
    {{of_hex(0xf0dd8c), 51},
     " housing home house townhouse flat apartment dwelling residence residential living wohnen wonen logement "},
    {{of_hex(0x6792dd), 150}, " office workplace workspace coworking administration business "},
    {{of_hex(0xdd5070), 10}, " shop shopping retail store supermarket market commerce commercial restaurant cafe café bar pub "},
    {{of_hex(0xdda648), 40}, " hotel hostel lodging guesthouse "},
    {{of_hex(0x9a5fd8), 190}, " school education kindergarten nursery creche university college campus teaching "},
    {{of_hex(0xd648ae), 220}, " culture cultural library museum theatre theater cinema gallery concert community church mosque "},
    {{of_hex(0x78d6b6), 122}, " health hospital clinic care doctor medical "},
    {{of_hex(0xc9c832), 52}, " sport gym gymnasium leisure recreation pool swimming "},
    {{of_hex(0x9e5a40), 24},
     " industry industrial workshop production factory logistic logistics warehouse storage energy technical "},
    {{of_hex(0x96999f), 252}, " parking garage car bicycle bike transport station "},
    {{of_hex(0x8cb469), 82},
     " garden green park open courtyard lawn playground meadow forest wood tree plant ",
     GroundCover::plants},
    {{of_hex(0xbfe6f2), 131}, " water canal river pond lake harbour ", GroundCover::water},
    {{of_hex(0xdcdad4), 254}, " street road path square pavement rail railway "},
}};

// For names that hold none of these words.
constexpr std::array<UseColour, 8> kOtherTones = {{{of_hex(0xc9a27a), 33},
                                                   {of_hex(0x7fb7c9), 133},
                                                   {of_hex(0xb79fc4), 193},
                                                   {of_hex(0xa3b48c), 73},
                                                   {of_hex(0xdca59c), 13},
                                                   {of_hex(0x8d9dc2), 163},
                                                   {of_hex(0xcbc194), 43},
                                                   {of_hex(0x92b5a6), 113}}};
constexpr UseColour kUnnamedUse = {of_hex(0xc1beb9), 253};

// Runs of letters in lower case and in the singular; letters beyond ASCII stay as they are.
std::vector<std::string> words_of_use(std::string_view use) {
  std::vector<std::string> words(1);
  for (const char c : use) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x80 || std::isalpha(byte) != 0) words.back() += static_cast<char>(byte < 0x80 ? std::tolower(byte) : byte);
    else if (!words.back().empty()) words.emplace_back();
  }
  if (words.back().empty()) words.pop_back();
  for (std::string& word : words) {
    if (word.size() > 4 && word.ends_with("ies")) word.replace(word.size() - 3, 3, "y");
    else if (word.size() > 3 && word.back() == 's' && !word.ends_with("ss")) word.pop_back();
  }
  return words;
}

const KnownUse* known_use(const std::string& word) {
  const auto found = std::find_if(kKnownUses.begin(), kKnownUses.end(), [&](const KnownUse& one) {
    return one.words.find(" " + word + " ") != std::string_view::npos;
  });
  return found == kKnownUses.end() ? nullptr : &*found;
}

// In English the last word says what it is: a school library is a library. But a car park has cars, a business park offices, and
// flats above shops are flats.
const KnownUse* row_of_use_name(const std::string& use) {
  const std::vector<std::string> words = words_of_use(without_place(use));
  const KnownUse* row = nullptr;
  if (words.size() > 1 && words.back() == "park") {
    row = known_use(words[words.size() - 2]);
    if (row != nullptr && row->cover != GroundCover::none) row = nullptr;
  }
  for (auto word = words.rbegin(); word != words.rend() && row == nullptr; ++word) row = known_use(*word);
  return row;
}

// A lighter or deeper tone of the same colour, in sixteen steps.
Colour varied_tone(const Colour& colour, std::uint64_t number) {
  const auto step = static_cast<double>(number % 16);
  return step < 8 ? mix(colour, kWhite, 0.06 * step + 0.06) : mix(colour, kShade, 0.04 * (step - 7));
}

// Of the name in lower case.
std::uint64_t number_of_name(const std::string& use) {
  std::string name = use;
  for (char& c : name) c = static_cast<unsigned char>(c) < 0x80 ? static_cast<char>(std::tolower(c)) : c;
  Hash hash;
  hash.add(std::string_view(name));
  return hash.value();
}

bool is_one_word(const std::string& use) {
  return std::all_of(use.begin(), use.end(), [](unsigned char c) { return c >= 0x80 || std::isalpha(c) != 0; });
}

}  // namespace

GroundCover cover_of_use(const std::string& use) {
  const KnownUse* row = row_of_use_name(use);
  return row == nullptr ? GroundCover::none : row->cover;
}

UseColour use_colour(const std::string& use) {
  if (use.empty()) return kUnnamedUse;
  const KnownUse* row = row_of_use_name(use);
  if (row != nullptr && is_one_word(use)) return row->shown;
  const std::uint64_t number = number_of_name(use);
  if (row != nullptr) return {varied_tone(row->shown.colour, number), row->shown.cad};
  const UseColour& other = kOtherTones[number % kOtherTones.size()];
  return {varied_tone(other.colour, number / kOtherTones.size()), other.cad};
}

}  // namespace bl::drawing
