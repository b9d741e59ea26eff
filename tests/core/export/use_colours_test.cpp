// Colours of uses: they follow from names alone, everywhere alike, and people with any colour vision tell them apart.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/drawing/use_colours.h"
#include "tests/core/export/two_houses.h"

namespace bl::exporting {
namespace {

using Triple = std::array<double, 3>;
using Eyes = std::array<Triple, 3>;

// Rows of the matrices of Machado, Oliveira and Fernandes (2009) at full severity, for light that is linear.
constexpr Eyes kUsual = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
constexpr Eyes kProtanopia = {
    {{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}};
constexpr Eyes kDeuteranopia = {
    {{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}};

// CIE L*a*b* of a colour as these eyes see it, D65.
Triple seen_as(const drawing::Colour& colour, const Eyes& eyes) {
  const auto linear = [](double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
  const Triple light = {linear(colour.red), linear(colour.green), linear(colour.blue)};
  Triple rgb{};
  for (std::size_t k = 0; k < 3; ++k)
    rgb[k] = std::clamp(eyes[k][0] * light[0] + eyes[k][1] * light[1] + eyes[k][2] * light[2], 0.0, 1.0);
  const auto root = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116; };
  const double x = root((0.4124 * rgb[0] + 0.3576 * rgb[1] + 0.1805 * rgb[2]) / 0.9505),
               y = root(0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]),
               z = root((0.0193 * rgb[0] + 0.1192 * rgb[1] + 0.9505 * rgb[2]) / 1.089);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

double apart(const std::string& a, const std::string& b, const Eyes& eyes) {
  const Triple one = seen_as(drawing::use_colour(a).colour, eyes), other = seen_as(drawing::use_colour(b).colour, eyes);
  return std::sqrt(std::pow(one[0] - other[0], 2) + std::pow(one[1] - other[1], 2) + std::pow(one[2] - other[2], 2));
}

std::string hex_of(const std::string& use) { return drawing::hex(drawing::use_colour(use).colour); }

TEST(UseColours, WellKnownOnesAreToldApart) {
  const std::vector<std::string> uses = {"housing", "offices", "shops",    "hotel",   "school", "culture",
                                         "health",  "sport",   "industry", "parking", "garden", "water"};
  for (std::size_t a = 0; a < uses.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      EXPECT_GT(apart(uses[a], uses[b], kUsual), 25) << uses[a] << " and " << uses[b];
      EXPECT_GT(apart(uses[a], uses[b], kProtanopia), 9.5) << uses[a] << " and " << uses[b];
      EXPECT_GT(apart(uses[a], uses[b], kDeuteranopia), 9.5) << uses[a] << " and " << uses[b];
    }
}

TEST(UseColours, FollowFromTheNameAlone) {
  EXPECT_EQ(hex_of("housing"), hex_of("Dwellings"));
  EXPECT_EQ(hex_of("Shop"), hex_of("SHOPS"));
  EXPECT_EQ(hex_of("library"), hex_of("Libraries"));
  EXPECT_NE(hex_of("student housing"), hex_of("housing")) << "two uses of one scene stay two";
  EXPECT_LT(apart("student housing", "housing", kUsual), apart("student housing", "offices", kUsual));
  EXPECT_NE(hex_of("phase 1"), hex_of("phase 2"));
  EXPECT_EQ(hex_of(""), "#c1beb9");
  const std::vector<std::string> one = {"housing", "offices", "shops", "alchemy"}, turned(one.rbegin(), one.rend());
  for (const std::string& use : one)
    EXPECT_EQ(drawing::hex(drawing::Palette(one).colour(use)), drawing::hex(drawing::Palette(turned).colour(use))) << use;
}

TEST(UseColours, AreNotThoseOfWhatAUseLiesAt) {
  const auto kind = [](const std::string& use) {
    std::string nearest;
    for (const char* known : {"housing", "shops", "offices", "parking", "garden", "school"})
      if (nearest.empty() || apart(use, known, kUsual) < apart(use, nearest, kUsual)) nearest = known;
    return nearest;
  };
  EXPECT_EQ(kind("Flats above shops"), "housing");
  EXPECT_EQ(kind("Flats over the shops"), "housing");
  EXPECT_EQ(kind("Shops below flats"), "shops");
  EXPECT_EQ(kind("Offices beside a school"), "offices");
  EXPECT_EQ(kind("Garden on the parking"), "garden");
  EXPECT_EQ(drawing::cover_of_use("Shops with a garden"), drawing::GroundCover::none);
}

// Files of a scene whose rows stand the other way round have the same colours.
TEST(UseColours, FilesHaveThemWhateverTheOrder) {
  Proposal proposal = proposal_of(settled_world());
  std::map<std::string, std::string> colours;
  for (const Building& b : proposal.buildings) colours[b.use] = drawing::hex(b.colour);
  EXPECT_EQ(colours["housing"], hex_of("housing"));
  EXPECT_EQ(colours["shops"], hex_of("shops"));
  for (const UseRow& row : proposal.uses) EXPECT_EQ(drawing::hex(row.colour), hex_of(row.use));
  const std::string svg = file_of(proposal, "svg"), geojson = file_of(proposal, "geojson"), dxf = file_of(proposal, "dxf");
  for (const std::string use : {"housing", "shops"}) {
    EXPECT_NE(svg.find("fill=\"" + hex_of(use)), std::string::npos) << use;
    EXPECT_NE(geojson.find(hex_of(use)), std::string::npos) << use;
  }
  // A layer of a drawing: its name, its flags, then its colour.
  EXPECT_NE(dxf.find("-HOUSING\n70\n0\n62\n51\n"), std::string::npos);
  EXPECT_NE(dxf.find("-SHOPS\n70\n0\n62\n10\n"), std::string::npos);
}

}  // namespace
}  // namespace bl::exporting
