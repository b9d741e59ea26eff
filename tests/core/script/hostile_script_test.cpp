// Scripts that run for ever, take all memory, fail, or answer rubbish: each is stopped and named with file and line.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <ctime>
#include <fstream>

#include "core/script/link_script.h"
#include "tests/links/link_case.h"

namespace bl::script {
namespace {

struct Hostile {
  const char* name;
  std::string text;
  const char* said;  // the beginning of what is said, and some of its words after a `|`
};

std::string body(const std::string& lines) {
  return "return {id = 'bad', doc = 'Bad.',\nreads = {here = {at = 'from', port = 'node.position'}},\n"
         "proposes = {move = {at = 'from', port = 'node.position'}},\nevaluate = function(params, ends, tick)\n" +
         lines + "\nend}\n";
}

std::string declaring(const std::string& reads) {
  return "return {id = 'bad', doc = 'Bad.',\nreads = {" + reads +
         "},\nproposes = {move = {at = 'from', port = 'node.position'}},\nevaluate = function() return {} end}\n";
}

std::string tags(const std::string& lines) {
  return "return {id = 'bad', doc = 'Bad.',\n\nproposes = {tags = {at = 'from', port = 'facade.style'}},\n"
         "evaluate = function(params, ends, tick)\n" +
         lines + "\nend}\n";
}

std::vector<Hostile> hostile_scripts() {
  const std::string big = "local t = {} for i = 1, 5000 do t[i] = '' end\n";
  return {
      {"for ever", body("while true do end"), "bad.lua:5: |500000 instructions"},
      {"for ever without a loop", body("local function f() return f() end return f()"), "bad.lua:5: |instructions"},
      {"for ever at the start", "while true do end", "bad.lua:1: |instructions"},
      {"pcall loop", body("while true do pcall(function() while true do end end) end"), "bad.lua:5: |nil value (global 'pcall')"},
      {"table bomb", body("local t = {}\nwhile true do t[#t + 1] = {} end"), "bad.lua:6: |table or the depth of its calls"},
      {"array bomb", body("local t = {}\nfor i = 1, 1e9 do t[i] = i end"), "bad.lua:6: |table or the depth of its calls"},
      {"string bomb", body("local s = 'x'\nwhile true do s = s .. s end"), "bad.lua:6: |text grew"},
      {"string heap", body("local t, s = {}, ('x')\nfor i = 1, 11 do s = s .. s end\nfor i = 1, 1e9 do t[i % 3000] = s .. i end"),
       "bad.lua:7: |MiB of memory"},
      {"deep recursion", body("local function f(n) return 1 + f(n + 1) end\nreturn f(1)"), "bad.lua:5: |depth of its calls"},
      {"growing arguments", body("local function f(...) return f(1, ...) end\nreturn f()"), "bad.lua:5: |stopped"},
      {"sort of nonsense",
       body("local t = {}\nfor i = 1, 3000 do t[i] = i end\nwhile true do table.sort(t, function() return true end) end"),
       "bad.lua:7: |instructions"},
      {"insert in front", body("local t = {}\nfor i = 1, 1e9 do table.insert(t, 1, i) end"), "bad.lua:6: |instructions"},
      {"concat of nothing", body(big + "while true do table.concat(t) end"), "bad.lua:6: |instructions"},
      {"unpack of nothing", body("while true do table.unpack({}, 1, 90) end"), "bad.lua:5: |"},
      {"unpack of much", body("return table.unpack({}, 1, 1e8)"), "bad.lua:4: |100 values"},
      {"comparing long texts",
       body("local s = 'x'\nfor i = 1, 11 do s = s .. s end\nlocal r = s:reverse()\nwhile true do local _ = s < r end"),
       "bad.lua:8: |instructions"},
      {"a pattern", body("return string.find('aaaa', '.-.-.-.-b')"), "bad.lua:5: |nil value (field 'find')"},
      {"a pattern of a text", body("return ('aaaa'):find('b')"), "bad.lua:5: |nil value (method 'find')"},
      {"rep", body("return ('x'):rep(1e9)"), "bad.lua:5: |nil value (method 'rep')"},
      {"files", body("return io.open('/etc/passwd')"), "bad.lua:5: |nil value (global 'io')"},
      {"an error", body("error('no way')"), "bad.lua:5: |no way"},
      {"an error that is a table", body("error({})"), "bad.lua:5: |no text"},
      {"an error that is no UTF-8", body("error('no \\xff way')"), "bad.lua:5: |no ? way"},
      {"a failed assertion", body("assert(1 > 2, 'smaller')"), "bad.lua:5: |smaller"},
      {"an error in the library", body("\ntable.sort({1, 'x'})\n"), "bad.lua:6: |compare"},
      {"index of nil", body("return {move = ends.there.x}"), "bad.lua:5: |`ends` has no `there`; it has `here`"},
      {"arithmetic on a text", body("return {move = 'a' + 1}"), "bad.lua:5: |arithmetic"},
      {"a name that is not declared", body("return {move = ends.here - ends.her}"),
       "bad.lua:5: |`ends` has no `her`; it has `here`"},
      {"a parameter that is not declared", body("return {move = ends.here * params.gain}"), "bad.lua:5: |`params` has no `gain`"},
      {"a point and nothing", body("local a\nreturn {move = ends.here - a}"), "bad.lua:6: |one is nil"},
      {"a point by a point", body("return {move = ends.here * ends.here}"), "bad.lua:5: |by a number, not by a point"},
      {"print", body("print('x')"), "bad.lua:5: |error(text) shows a text"},
      {"one point for many",
       "return {id = 'bad', doc = 'Bad.',\nproposes = {move = {at = 'from', port = 'node.position', whole = true}},\n"
       "reads = {here = {at = 'from', port = 'node.position', whole = true}},\nevaluate = function() return {move = point(0, 0, "
       "1)} end}",
       "bad.lua:4: |`move` needs a list of points, one for each node, not a point"},
      {"a value for nobody",
       "return {id = 'bad', doc = 'Bad.',\nproposes = {move = {at = 'from', port = 'node.position', whole = true}},\n"
       "reads = {here = {at = 'from', port = 'node.position', whole = true}},\nevaluate = function() return {move = {[7] = "
       "point(0, 0, 1)}} end}",
       "bad.lua:4: |for node 7 of an end of 1 nodes"},
      {"no answer", body(""), "bad.lua:4: |must return a table"},
      {"a number as answer", body("return 3"), "bad.lua:4: |must return a table"},
      {"wrong kind", body("return {move = 3}"), "bad.lua:4: |`move` needs a point"},
      {"half a point", body("return {move = {x = 1, y = 2}}"), "bad.lua:4: |z is no number"},
      {"NaN", body("return {move = point(0 / 0, 0, 0)}"), "bad.lua:4: |finite"},
      {"infinity", body("return {move = point(math.huge, 0, 0)}"), "bad.lua:4: |finite"},
      {"undeclared answer", body("return {mvoe = point()}"), "bad.lua:4: |`mvoe`, which `proposes` does not declare"},
      {"nameless answer", body("return {point()}"), "bad.lua:4: |without a name"},
      {"bytecode", "\x1bLua\x54", "bad.lua: |binary"},
      {"no Lua", "return {id = 'bad',\n\nthis is no Lua", "bad.lua:3: |"},
      {"a reserved word", declaring("here = {end = 'from', port = 'node.position'}"), "bad.lua:2: |near 'end'"},
      {"nothing", "", "bad.lua:1: |must return a table"},
      {"a number", "return 3", "bad.lua:1: |must return a table"},
      {"no UTF-8", "return '\xff'", "bad.lua: |UTF-8"},
      {"unknown typification", declaring("here = {at = 'from', port = 'smart_volum.volume'}"),
       "bad.lua:2: |did you mean `smart_volume`"},
      {"unknown port", declaring("here = {at = 'from', port = 'smart_volume.volum'}"), "bad.lua:2: |did you mean `volume`"},
      {"unknown unit", declaring("here = {at = 'from', port = 'smart_volume.volume', unit = 'furlong'}"),
       "bad.lua:2: |unknown unit `furlong`"},
      {"unit that is no SI unit", declaring("here = {at = 'from', port = 'node.position', unit = 'km'}"),
       "bad.lua:2: |values come in `m`"},
      {"wrong unit", declaring("here = {at = 'from', port = 'smart_volume.volume', unit = 'm'}"), "bad.lua:2: |in cubic metres"},
      {"a word that stands before as well",
       "-- volume, here\nlocal here = 'smart_volume.volume'\nreturn {id = 'bad', doc = 'The volume here.',\nreads = {\n"
       "here = {at = 'to', port = 'smart_volume.volume', unit = 'm3'},\n},\nproposes = {\n"
       "here = {at = 'to',\nport = 'smart_volume.volume', unit = 'm3'}}, evaluate = function() return {} end}",
       "bad.lua:9: |cannot be changed by links"},
      {"a wrong unit of two",
       "return {id = 'bad', doc = 'demand',\nreads = {now = {at = 'to', port = 'smart_volume.demand', unit = 'm3'}},\n"
       "proposes = {demand = {at = 'to', port = 'smart_volume.demand', unit = 'm2'}}, evaluate = function() return {} end}",
       "bad.lua:3: |in cubic metres"},
      {"a table put together",
       "local link = {id = 'bad', doc = 'x'}\nlink.proposes = {v = {at = 'to', port = 'smart_volume.volume'}}\n"
       "link.evaluate = function() end\nreturn link",
       "bad.lua:2: |cannot be changed by links"},
      {"`end` for `at`", declaring("here = {['end'] = 'from', port = 'node.position'}"), "bad.lua:2: |called `at`"},
      {"unknown end", declaring("here = {at = 'left', port = 'node.position'}"), "bad.lua:2: |\"from\" or \"to\""},
      {"unknown field", declaring("here = {at = 'from', prot = 'node.position'}"), "bad.lua:2: |did you mean `port`"},
      {"taken id", "return {id = 'ratio', doc = 'x', proposes = {}, evaluate = function() end}", "bad.lua:1: |already"},
      {"no id", "return {doc = 'x'}", "bad.lua:1: |`id` of the script is missing"},
      {"computed port",
       "return {id = 'bad', doc = 'x',\nproposes = {v = {at = 'to', port = 'smart_volume.volume'}}, evaluate = function() end}",
       "bad.lua:2: |cannot be changed by links"},
      {"default out of range",
       "return {id = 'bad', doc = 'x',\nparams = {{id = 'size', default = 5, max = 3, doc = 'x'}},\nproposes = {}, evaluate = 3}",
       "bad.lua:2: |at most 3"},
      {"an address", body("error(string.format('%20p', 'some text that is long enough to lie on the heap'))"),
       "bad.lua:5: |format knows no %p"},
      {"an address with a flag", body("error(('%-p'):format('a'))"), "bad.lua:5: |format knows no %p"},
      {"an address behind a percent sign", body("error(('%%%9.3p'):format('a'))"), "bad.lua:5: |format knows no %p"},
      {"the system's own numbers", body("error(('%a'):format(1))"), "bad.lua:5: |format knows no %a"},
      {"format of a table", body("error(('%s'):format({}))"), "bad.lua:5: |format takes numbers and texts"},
      {"a percent sign", body("error(('%%p %d'):format(3))"), "bad.lua:5: |%p 3"},
      {"a zero byte", body("return {move = '\\0'}"), "bad.lua:5: |zero byte"},
      {"a zero byte in hexadecimal", body("return {['move\\x00typo'] = point()}"), "bad.lua:5: |zero byte"},
      {"a zero byte as a character", body("return {move = '\\u{000}'}"), "bad.lua:5: |zero byte"},
      {"a zero byte as it is", body("return {move = '" + std::string(1, '\0') + "'}"), "bad.lua:5: |zero byte"},
      {"no zero byte", body("error('\\\\0 \\01 \\0011')"), "bad.lua:5: |\\0 "},
      {"a zero byte made", body("local s = string.char(65, 0)"), "bad.lua:5: |zero byte"},
      {"a zero byte formatted", body("local s = ('%c'):format(0)"), "bad.lua:5: |zero byte"},
      {"many bytes", body("local s = 'x'\nfor i = 1, 11 do s = s .. s end\nwhile true do local _ = s:byte(1, -1) end"),
       "bad.lua:7: |byte gives at most 100 values"},
      {"insert of too much", body("table.insert({}, 1, 2, 3)"), "bad.lua:5: |insert takes"},
      {"too many texts",
       tags("local s, t = 'x', {}\nfor i = 1, 11 do s = s .. s end\nfor i = 1, 300 do t[i] = s end\nreturn {tags = t}"),
       "bad.lua:4: |more than 256 KiB"},
      {"too long a script", "return '" + std::string(300000, 'x') + "'", "bad.lua: |longer than 256 KiB"},
      {"a deep table in the text", "return " + std::string(1000, '{') + std::string(1000, '}'), "bad.lua: |C stack overflow"},
  };
}

std::string said_by(const std::string& text) {
  auto kind = read_link_script("bad", text, full_registry());
  if (!kind) return kind.error().text();
  LinkCase link(*kind);
  return link.from("node.position", Vector3{1, 2, 3}).run();
}

// BL_SENTENCES=FILE writes the table with the times.
TEST(HostileScript, IsStoppedAndNamed) {
  std::FILE* table = nullptr;
  if (const char* path = std::getenv("BL_SENTENCES")) table = std::fopen(path, "w");
  for (const Hostile& hostile : hostile_scripts()) {
    const auto begin = std::chrono::steady_clock::now();
    const std::string said = said_by(hostile.text);
    const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    const std::string wanted = hostile.said, start = wanted.substr(0, wanted.find('|')),
                      words = wanted.substr(wanted.find('|') + 1);
    EXPECT_TRUE(said.starts_with(start)) << hostile.name << ": " << said;
    EXPECT_NE(said.find(words), std::string::npos) << hostile.name << ": " << said;
    EXPECT_EQ(said, said_by(hostile.text)) << hostile.name;
    if (table != nullptr) std::fprintf(table, "| %s | %.2f | %s |\n", hostile.name, ms, said.c_str());
  }
  if (table != nullptr) std::fclose(table);
}

// Evaluations after a stopped one are as if nothing had been.
TEST(HostileScript, LeavesNothingBehind) {
  const auto kind =
      read_link_script("bad", body("if ends.here.x > 1 then while true do end end\nreturn {move = ends.here}"), full_registry());
  ASSERT_TRUE(kind.ok());
  LinkCase link(*kind);
  EXPECT_NE(link.from("node.position", Vector3{2, 0, 0}).run(), "");
  EXPECT_EQ(link.from("node.position", Vector3{1, 0, 0}).run(), "");
  expect_near(link.move(End::from), {1, 0, 0});
}

// Each of these asks much of one instruction or one call; what a tick may run is bounded in time all the same.
TEST(HostileScript, NoInstructionRunsLong) {
  const std::string long_text = "local z = ' ' for i = 1, 11 do z = z .. z end z = z .. z:sub(1, 1900)\n";
  const std::string many = "local function many(n, ...) if n == 0 then return ... end return many(n - 1, n, ...) end\n";
  // The length of this table is looked for among powers of two, and each of them lies at the end of a chain.
  std::string sparse = "{1, 2, 3, 4, [5] = 1";
  for (int i = 3; i < 62; ++i) sparse += ", [" + std::to_string(std::int64_t{1} << i) + "] = 1";
  for (int i = 0; i < 8; ++i)
    for (int k = 1; k <= 23; ++k) sparse += ", [" + std::to_string((1 << i) + 255 * 64 * k) + "] = 1";
  sparse += "}";
  const std::string chain = "local t = {} for i = 0, 7 do t[2 ^ i // 1 | 0] = 1 end for i = 1, 1e9 do t[i * 8191] = i end\n";
  const std::pair<const char*, std::string> cases[] = {
      {"lower", long_text + "while true do local _ = z:lower() end"},
      {"tonumber", long_text + "while true do local _ = tonumber(z, 10) end"},
      {"sine of spaces", long_text + "while true do local _ = math.sin(z .. 1) end"},
      {"for over spaces", long_text + "z = z .. 1 while true do for i = 1, z do end end"},
      {"formatting",
       "local p = '%.99f' p = p .. p .. p .. p p = p .. p while true do "
       "local _ = p:format(1e300, 1e300, 1e300, 1e300, 1e300, 1e300, 1e300, 1e300) end"},
      {"random of texts", long_text + "while true do local _ = random(z, z, z, z, z, z, z, z, z, z, z, z, z, z, z, z) end"},
      {"handing on", many + "local function use() end local function all(...) while true do use(...) use(...) use(...) end end "
                            "all(many(8000))"},
      {"largest of many", many + "local function all(...) while true do local _ = math.max(...) end end all(many(8000))"},
      {"returning many", "local function grow(n) if n > 0 then return n, grow(n - 1) end end while true do grow(150) end"},
      {"a chain of names", chain},
      {"a chain of names that is read", "local t = {} for i = 1, 2000 do t[i * 2047] = i end while true do local _ = t[0] end"},
      {"a short chain", "local t = {} for i = 1, 250 do t[i * 255] = i end while true do local _ = t[0] end"},
      {"the length of a chain", "local t = " + sparse + " while true do local _ = #t end"},
      {"sparse pairs", "local t = {} for i = 1, 250 do t[i * 255] = i end while true do for k in pairs(t) do end end"},
  };
  for (const auto& [name, lines] : cases) {
    const auto begin = std::clock();
    const std::string said = said_by(body(lines));
    const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    EXPECT_NE(said, "") << name;
    EXPECT_LT(seconds, 2) << name << ": " << said;
    if (std::getenv("BL_SENTENCES") != nullptr) std::printf("%-32s %.3f s  %s\n", name, seconds, said.c_str());
  }
}

// A text of a port with a zero byte is refused before the script can compare it.
TEST(HostileScript, GetsNoZeroBytesFromPorts) {
  const auto kind =
      read_link_script("bad",
                       "return {id = 'bad', doc = 'x', params = {{id = 'word', default = 'a', doc = 'x'}},\n"
                       "proposes = {move = {at = 'from', port = 'node.position'}},\nevaluate = function(params) return {} end}",
                       full_registry());
  ASSERT_TRUE(kind.ok()) << kind.error().text();
  LinkCase link(*kind);
  EXPECT_EQ(link.set("word", std::string("ab")).run(), "");
  EXPECT_NE(link.set("word", std::string("a\0b", 3)).run().find("zero byte"), std::string::npos);
}

}  // namespace
}  // namespace bl::script
