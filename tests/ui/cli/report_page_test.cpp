// Pages as a browser reads them: no two things of one name, no text on a bar, and tables whose columns say of what.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "tests/ui/cli/program.h"

namespace bl::test {

namespace {

std::string attribute(const std::string& tag, const std::string& name) {
  const std::size_t at = tag.find(" " + name + "=\"");
  if (at == std::string::npos) return "";
  const std::size_t begin = at + name.size() + 3;
  return tag.substr(begin, tag.find('"', begin) - begin);
}
double number(const std::string& tag, const std::string& name) {
  const std::string text = attribute(tag, name);
  return text.empty() ? 0 : std::stod(text);
}

// Opening tags of a kind, each with the text up to the next tag.
std::vector<std::pair<std::string, std::string>> elements(const std::string& page, const std::string& kind) {
  std::vector<std::pair<std::string, std::string>> found;
  for (std::size_t at = page.find("<" + kind + " "); at != std::string::npos; at = page.find("<" + kind + " ", at + 1)) {
    const std::size_t end = page.find('>', at);
    found.emplace_back(page.substr(at, end - at), page.substr(end + 1, page.find('<', end) - end - 1));
  }
  return found;
}

std::size_t letters_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string surrounded_scene(const std::string& demand) {
  return R"({"format": "behaviourlinks", "version": 1, "nodes": [
    {"id": "site", "types": {"boundary": {"form": "plan", "plan": [[0, 0, 0], [40, 0, 0], [40, 20, 0], [0, 20, 0]], "height": 30}}},
    {"id": "solver", "types": {"smart_volumes_solver": {}}},
    {"id": "v", "name": "A volume with a name that is a good deal longer than any name has to be", "position": [10, 10, 8],
     "types": {"smart_volume": {"use": "housing", "demand": )" +
         demand + R"(}}},
    {"id": "w", "position": [30, 10, 8], "types": {"smart_volume": {"use": "office", "demand": 1500}}},
    {"id": "j1", "position": [-200, -5, 0], "types": {"junction": {}}}, {"id": "j2", "position": [200, -5, 0], "types": {"junction": {}}},
    {"id": "s", "types": {"street": {"start": "j1", "end": "j2"}}},
    {"id": "near", "name": "Post office", "types": {"existing_building": {"height": 9, "outline": [[-12, 8, 0], [-6, 8, 0], [-6, 14, 0], [-12, 14, 0]]}}}],
    "links": []})";
}

class Pages : public testing::Test {
 protected:
  Pages() {
    place.write("a.json", surrounded_scene("2000"));
    place.write("b.json", surrounded_scene("3500"));
    const Outcome compared = place.run({"compare", "a.json", "b.json", "--ticks", "80", "--report", "d.html"});
    EXPECT_EQ(compared.code, 0) << compared.err;
    EXPECT_EQ(place.run({"run", "a.json", "--ticks", "30", "--report", "out"}).code, 0);
  }
  Workplace place;
};

TEST_F(Pages, EveryIdIsThereOnceAndMeansSomething) {
  for (const char* file : {"d.html", "out/report.html"}) {
    const std::string page = place.text(file);
    std::set<std::string> ids;
    for (std::size_t at = page.find(" id=\""); at != std::string::npos; at = page.find(" id=\"", at + 1)) {
      const std::string id = page.substr(at + 5, page.find('"', at + 5) - at - 5);
      EXPECT_TRUE(ids.insert(id).second) << file << ": " << id;
    }
    EXPECT_GT(ids.size(), 6u) << file;
    std::size_t meant = 0;
    for (const char* begin : {"url(#", "href=\"#"})
      for (std::size_t at = page.find(begin); at != std::string::npos; at = page.find(begin, at + 1)) {
        const std::size_t first = page.find('#', at) + 1;
        EXPECT_TRUE(ids.contains(page.substr(first, page.find_first_of(")\"", first) - first))) << file;
        ++meant;
      }
    EXPECT_GT(meant, 4u) << file;
  }
}

// Rules of the style stand above attributes, and a class that has none means nothing: texts are placed by classes that are there.
TEST_F(Pages, TextsAreSetByClassesOfTheStyle) {
  for (const char* file : {"d.html", "out/report.html"}) {
    const std::string page = place.text(file);
    EXPECT_EQ(page.find("text-anchor=\""), std::string::npos) << file;
    const std::string style = page.substr(page.find("text{"), page.find("</style>", page.find("text{")) - page.find("text{"));
    for (const auto& [tag, text] : elements(page, "text")) {
      std::istringstream classes(attribute(tag, "class"));
      for (std::string one; classes >> one;) EXPECT_NE(style.find("." + one), std::string::npos) << file << ": " << tag;
    }
  }
}

TEST_F(Pages, BarsAreBesideTheirTexts) {
  const std::string page = place.text("d.html");
  std::size_t bars = 0;
  for (std::size_t at = page.find("<svg"); at != std::string::npos; at = page.find("<svg", at + 1)) {
    const std::string svg = page.substr(at, page.find("</svg>", at) - at);
    if (svg.find("Bars to the right") == std::string::npos) continue;
    const auto texts = elements(svg, "text"), rows = elements(svg, "rect");
    for (const auto& [bar, nothing] : rows) {
      if (attribute(bar, "x").empty()) continue;  // the paper
      ++bars;
      const double left = number(bar, "x"), right = left + number(bar, "width"), top = number(bar, "y"),
                   bottom = top + number(bar, "height");
      for (const auto& [tag, text] : texts) {
        const double y = number(tag, "y"), width = 5.6 * static_cast<double>(letters_of(text)), x = number(tag, "x");
        if (y < top || y > bottom + 3) continue;
        const std::string kind = attribute(tag, "class");
        const double begin = kind.find("end") != std::string::npos     ? x - width
                             : kind.find("start") != std::string::npos ? x
                                                                       : x - width / 2;
        EXPECT_TRUE(begin + width <= left || begin >= right) << text << " lies on its bar";
        EXPECT_GE(begin, 0) << text;
        EXPECT_LE(begin + width, 1000) << text;
      }
    }
  }
  EXPECT_GT(bars, 4u);
}

// What is short of what; and one meaning of `error` in table and JSON.
TEST_F(Pages, ColumnsSayOfWhat) {
  place.write("brief.json", R"({"format": "behaviourlinks", "version": 1, "nodes": [{"id": "site", "types": {"boundary": {}}},
    {"id": "solver", "types": {"smart_volumes_solver": {}}},
    {"id": "brief", "types": {"programme": {"rows": [{"use": "theatre", "floor_area": 5000, "storey_height": 8}]}}},
    {"id": "stage", "position": [0, 0, 8], "types": {"smart_volume": {"use": "theatre"}}}],
    "links": [{"id": "deal", "kind": "demand", "from": "brief", "to": "stage"}]})");
  ASSERT_EQ(place.run({"run", "brief.json", "--ticks", "60", "--report", "brief", "--json", "brief.out"}).code, 0);
  std::istringstream table(place.text("brief/volumes.csv"));
  std::string header, row;
  std::getline(table, header);
  std::getline(table, row);
  const auto cell = [&](const std::string& name) {
    std::istringstream names(header), cells(row);
    for (std::string one, value; std::getline(names, one, ',') && std::getline(cells, value, ',');)
      if (one == name) return std::stod("0" + value);
    ADD_FAILURE() << "no column " << name << " in " << header;
    return -1.0;
  };
  const nlohmann::json volume = place.json("brief.out")["volumes"][0];
  const double asked = cell("asked [m3]"), had = cell("volume [m3]"), floor = cell("floor_area [m2]");
  EXPECT_NEAR(cell("short_of_volume [m3]"), std::max(0.0, asked - had), 1e-9);
  EXPECT_NEAR(cell("short_of_volume [%]"), 100 * std::max(0.0, asked - had) / asked, 1e-9);
  // There is room for two storeys of 8 m and half of a third one, of 1600 m² each.
  EXPECT_NEAR(floor, 4000, 1e-6);
  EXPECT_NEAR(cell("short_of_floor_area [m2]"), 5000 - floor, 1e-9);
  EXPECT_NEAR(cell("short_of_floor_area [%]"), 100 * (5000 - floor) / 5000, 1e-9);
  EXPECT_EQ(cell("error"), volume["error"].get<double>());
  EXPECT_NEAR(volume["short_floor_area"].get<double>(), 5000 - floor, 1e-9);
}

}  // namespace

}  // namespace bl::test
