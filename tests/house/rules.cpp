// The tables and the readers behind the rules of the house.
#include "tests/house/rules.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <functional>
#include <initializer_list>
#include <span>

#include "tests/house/layers.h"

namespace bl::house {

namespace {

// A row reads: headers of this library only in this folder, and in .cpp files only where that is said.
struct Library {
  std::string_view beginning, folder;
  bool cpp_only;
  std::string_view name;
};

constexpr std::array kLibraries = {
    Library{"CGAL/", "core/geometry/", true, "CGAL"},
    Library{"nlohmann/json.hpp", "", true, "nlohmann/json.hpp (headers take nlohmann/json_fwd.hpp)"},
    Library{"muParser", "", true, "muParser"},
    Library{"sleef.h", "core/base/", true, "SLEEF"},
    Library{"utf8proc.h", "core/base/", true, "utf8proc"},
    Library{"proj.h", "core/import/", true, "PROJ"},
    Library{"csv.h", "core/csv/", true, "libcsv"},
    Library{"embree3/", "core/sun/", true, "Embree"},
    Library{"lua.hpp", "core/script/", true, "Lua"},
    Library{"mosquitto.h", "core/live/", true, "libmosquitto"},
    Library{"lo/", "core/live/", true, "liblo"},
    Library{"curl/", "core/live/", true, "libcurl"},
    Library{"libexif/", "core/import/", true, "libexif"},
    Library{"boost/", "core/serve/", false, "Boost"},
    Library{"sqlite3.h", "core/journal/", true, "SQLite"},
    Library{"stb/", "ui/desktop/view/", true, "stb"},
    Library{"GLFW/", "ui/desktop/", false, "GLFW"},
    Library{"imgui", "ui/desktop/", false, "Dear ImGui"},
    Library{"backends/imgui", "ui/desktop/", false, "Dear ImGui"},
    Library{"epoxy/", "ui/desktop/", false, "epoxy"},
};

// A row reads: this word is not used in these folders; an empty list means in none of ours.
struct Word {
  std::string_view word;
  std::span<const std::string_view> folders, except;
  std::string_view why;
};

constexpr std::array<std::string_view, 6> kOrdered = {"core/graph/",         "core/define/", "core/session/",
                                                      "core/live/commands/", "nodes/",       "links/"};
// Connections need pauses and rates; what they bring reaches the result through the log only.
constexpr std::array<std::string_view, 6> kClocks = {"ui/", "tests/", "core/base/", "core/live/", "core/host/", "core/serve/"};
constexpr std::string_view kUnordered = "the order of a hash table must not reach the state: take std::map, std::set or a vector";
constexpr std::array<std::string_view, 2> kWriters = {"core/file/", "tests/"};
constexpr std::string_view kOneWriter = "files are written in one place: take write_file or LogWriter of core/file";
constexpr std::string_view kOwnRandom = "its output is not fixed by the standard: take core/base/random.h";

// Functions of the C library's mathematics whose last bits follow the processor; those that round exactly are free.
constexpr std::array<std::string_view, 29> kInexact = {"sin",    "cos",    "tan",   "asin",  "acos",  "atan", "atan2", "sinh",
                                                       "cosh",   "tanh",   "asinh", "acosh", "atanh", "exp",  "exp2",  "exp10",
                                                       "expm1",  "log",    "log2",  "log10", "log1p", "pow",  "cbrt",  "hypot",
                                                       "lgamma", "tgamma", "erf",   "erfc",  "sincos"};
// What reaches the state, or is written into scenes.
constexpr std::array<std::string_view, 3> kExact = {"core/", "nodes/", "links/"};
// Drawings: they are looked at, and never read back.
constexpr std::array<std::string_view, 2> kDrawn = {"core/drawing/", "core/report/"};
constexpr std::string_view kOwnMathematics = "its last bits follow the processor: take core/base/mathematics.h";

constexpr std::array kWords = {
    Word{"std::hash", {}, {}, "its output is not fixed by the standard: take core/base/hash.h"},
    Word{"rand", {}, {}, kOwnRandom},
    Word{"random_device", {}, {}, kOwnRandom},
    Word{"unordered_map", kOrdered, {}, kUnordered},
    Word{"unordered_set", kOrdered, {}, kUnordered},
    Word{"unordered_multimap", kOrdered, {}, kUnordered},
    Word{"unordered_multiset", kOrdered, {}, kUnordered},
    Word{"fopen", {}, kWriters, kOneWriter},
    Word{"ofstream", {}, kWriters, kOneWriter},
    Word{"O_CREAT", {}, kWriters, kOneWriter},
    Word{"mkstemp", {}, kWriters, kOneWriter},
    Word{"chrono",
         {},
         kClocks,
         "the wall clock must not reach the result: only ui, tests, core/base, core/live, core/host and core/serve may read it"},
};

bool is_word_character(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

bool starts_with_any(std::string_view path, std::span<const std::string_view> beginnings) {
  return std::any_of(beginnings.begin(), beginnings.end(), [&](auto b) { return path.starts_with(b); });
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r')) text.remove_suffix(1);
  return text;
}

// Calls visit(number, line) for every line, counting from 1.
void for_each_line(std::string_view text, const std::function<void(int, std::string_view)>& visit) {
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    visit(number, text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

std::string joined(std::initializer_list<std::string_view> parts) {
  std::string text;
  for (const std::string_view part : parts) text.append(part);
  return text;
}

std::string place(std::string_view path, int line) { return joined({path, ":", std::to_string(line)}); }

// Does the line of code hold the word by itself? A function of that name with an object before it is another one.
bool holds_word(std::string_view line, std::string_view word) {
  for (std::size_t at = line.find(word); at != std::string_view::npos; at = line.find(word, at + 1)) {
    const std::string_view before = line.substr(0, at), after = line.substr(at + word.size());
    if (!before.empty() && (is_word_character(before.back()) || before.back() == '.' || before.ends_with("->"))) continue;
    if (!after.empty() && is_word_character(after.front())) continue;
    if (word == "rand" && !trimmed(after).starts_with("(")) continue;
    return true;
  }
  return false;
}

// The function of the C library's mathematics that the line of code calls, with its f or l for other widths; or nothing.
// A call is a name before a bracket that is not empty; with another scope than std or none, or an object before it, it is
// another's.
std::string_view inexact_call(std::string_view line) {
  for (std::size_t at = 0; at < line.size();) {
    const auto begin = std::find_if(line.begin() + static_cast<std::ptrdiff_t>(at), line.end(), is_word_character);
    const auto end = std::find_if_not(begin, line.end(), is_word_character);
    const std::string_view name(begin, end), after = trimmed(std::string_view(end, line.end()));
    std::string_view before(line.begin(), begin);
    at = static_cast<std::size_t>(end - line.begin());
    std::string_view plain = name;
    if (plain.starts_with("__builtin_")) plain.remove_prefix(10);
    const auto is_inexact = [&](std::string_view word) {
      return std::find(kInexact.begin(), kInexact.end(), word) != kInexact.end();
    };
    const bool is_wide = plain.size() > 1 && (plain.back() == 'f' || plain.back() == 'l');
    if (!is_inexact(plain) && !(is_wide && is_inexact(plain.substr(0, plain.size() - 1)))) continue;
    const bool is_std = before.ends_with("std::"),
               is_global = before.ends_with("::") && (before.size() == 2 || !is_word_character(before[before.size() - 3]));
    if (is_std) return name;  // also where it is named without being called
    if (!after.starts_with("(") || trimmed(after.substr(1)).starts_with(")")) continue;
    if (is_global) return name;
    if (before.ends_with("::") || before.ends_with(".") || before.ends_with("->")) continue;
    return name;
  }
  return {};
}

// Does the line of code name one of the distributions of the standard library?
bool holds_distribution(std::string_view line) {
  for (std::size_t at = line.find("std::"); at != std::string_view::npos; at = line.find("std::", at + 1)) {
    std::string_view name = line.substr(at + 5);
    name = name.substr(0, std::find_if_not(name.begin(), name.end(), is_word_character) - name.begin());
    if (name.ends_with("_distribution")) return true;
  }
  return false;
}

}  // namespace

std::string code_only(std::string_view text) {
  std::string code(text);
  const auto blank = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < std::min(end, code.size()); ++i)
      if (code[i] != '\n') code[i] = ' ';
  };
  const auto end_of = [&](std::string_view closing, std::size_t from) {
    const std::size_t at = text.find(closing, from);
    return at == std::string_view::npos ? text.size() : at + closing.size();
  };
  for (std::size_t i = 0; i < text.size();) {
    const std::string_view rest = text.substr(i);
    const bool is_separator = text[i] == '\'' && i > 0 && is_word_character(text[i - 1]);
    std::size_t end = i + 1;
    if (rest.starts_with("//")) {
      end = std::min(text.find('\n', i), text.size());
    } else if (rest.starts_with("/*")) {
      end = end_of("*/", i + 2);
    } else if (rest.starts_with("R\"") && (i == 0 || !is_word_character(text[i - 1]))) {
      const std::size_t bracket = std::min(rest.find('('), rest.size());
      end = end_of(joined({")", rest.substr(2, bracket - std::min<std::size_t>(bracket, 2)), "\""}), i + bracket);
    } else if ((text[i] == '"' || text[i] == '\'') && !is_separator) {
      while (end < text.size() && text[end] != text[i] && text[end] != '\n') end += text[end] == '\\' ? 2 : 1;
      ++end;
    } else {
      ++i;
      continue;
    }
    blank(i, end);
    i = end;
  }
  return code;
}

std::vector<Finding> check_includes(std::string_view path, std::string_view text) {
  std::vector<Finding> findings;
  const Room* room = layers().room_of(path);
  if (room == nullptr) {
    findings.push_back({place(path, 1), "this folder has no row in core/layers.txt: give it one"});
    return findings;
  }
  // Blanking keeps the length of lines, but takes the quoted name away: the place comes from the code, the name from the text.
  const std::string code = code_only(text);
  std::size_t offset = 0;
  for_each_line(code, [&](int number, std::string_view line) {
    const std::string_view original = trimmed(text.substr(offset, line.size()));
    offset += line.size() + 1;
    std::string_view directive = trimmed(line);
    if (!directive.starts_with("#")) return;
    directive = trimmed(directive.substr(1));
    if (!directive.starts_with("include")) return;
    const std::size_t open = original.find_first_of("\"<");
    if (open == std::string_view::npos) return;
    const bool is_quoted = original[open] == '"';
    const std::size_t close = original.find(is_quoted ? '"' : '>', open + 1);
    const std::string name(original.substr(open + 1, close == std::string_view::npos ? close : close - open - 1));
    const auto report = [&](const std::string& sentence) { findings.push_back({place(path, number), sentence}); };

    const std::array<std::string_view, 5> ours = {"core/", "nodes/", "links/", "ui/", "tests/"};
    if (starts_with_any(name, ours)) {
      const bool is_allowed =
          (layers().room_of(name) == room && !room->is_alone) ||
          std::any_of(room->sees.begin(), room->sees.end(), [&](const std::string& f) { return lies_in(name, f); });
      if (!is_allowed) report(joined({room->folder, " may not include ", name, " (core/layers.txt: who may include whom)"}));
      if (const std::size_t inside = name.find("/inside/");
          inside != std::string::npos && room->folder != "tests" && !lies_in(path, std::string_view(name).substr(0, inside)))
        report(joined({name, " is private to ", name.substr(0, inside), ": include one of the headers of the folder itself"}));
      if (!is_quoted) report(joined({"our own header ", name, " is included with <>: take quotes"}));
    } else if (is_quoted) {
      report(joined({"\"", name, "\" is no path from the root of the checkout: write it as such, or take <> for a library"}));
    }
    for (const Library& library : kLibraries) {
      if (!name.starts_with(library.beginning)) continue;
      if (!path.starts_with(library.folder) && !path.starts_with(joined({"tests/", library.folder}))) {
        report(joined({library.name, " is seen by ", library.folder, " only"}));
      } else if (library.cpp_only && !path.ends_with(".cpp")) {
        report(joined({library.name, " is seen by .cpp files only"}));
      }
    }
  });
  return findings;
}

std::vector<Finding> check_words(std::string_view path, std::string_view text) {
  std::vector<Finding> findings;
  for_each_line(code_only(text), [&](int number, std::string_view line) {
    for (const Word& row : kWords) {
      if (!row.folders.empty() && !starts_with_any(path, row.folders)) continue;
      if (starts_with_any(path, row.except) || !holds_word(line, row.word)) continue;
      findings.push_back({place(path, number), joined({"`", row.word, "`: ", row.why})});
    }
    if (const std::string_view name = inexact_call(line);
        !name.empty() && starts_with_any(path, kExact) && !starts_with_any(path, kDrawn))
      findings.push_back({place(path, number), joined({"`", name, "`: ", kOwnMathematics})});
    if (holds_distribution(line)) findings.push_back({place(path, number), joined({"a standard distribution: ", kOwnRandom})});
  });
  return findings;
}

std::vector<Finding> check_names(std::string_view path, std::string_view text) {
  std::vector<Finding> findings;
  const Room* room = layers().room_of(path);
  if (room == nullptr) return findings;
  const auto is_of_another = [&](std::string_view name) {
    return std::any_of(layers().rooms.begin(), layers().rooms.end(),
                       [&](const Room& other) { return other.names != room->names && other.names == name; });
  };
  for_each_line(code_only(text), [&](int number, std::string_view line) {
    constexpr std::string_view kWord = "namespace ";
    if (!line.starts_with(kWord) || !line.ends_with(" {")) return;
    const std::string_view name = line.substr(kWord.size(), line.size() - kWord.size() - 2);
    const bool is_own = name == room->names || (name.starts_with(room->names + "::") && !is_of_another(name));
    if (name.starts_with("bl") && !is_own)
      findings.push_back(
          {place(path, number),
           "`" + std::string(name) + "` is not this folder's namespace: core/layers.txt gives it `" + room->names + "`"});
  });
  return findings;
}

std::vector<Finding> check_form(std::string_view path, std::string_view text) {
  std::vector<Finding> findings;
  const std::string_view first = text.substr(0, text.find('\n'));
  const auto spaces = std::count(first.begin(), first.end(), ' ');
  if (!first.starts_with("// ") || spaces < 3)
    findings.push_back({place(path, 1), "the first line of a file is a comment: one sentence that says what the file is for"});
  if (path.ends_with(".h")) {
    bool has_guard = false;
    for_each_line(code_only(text), [&](int, std::string_view line) { has_guard |= trimmed(line) == "#pragma once"; });
    if (!has_guard) findings.push_back({place(path, 1), "the header has no `#pragma once`"});
  }
  return findings;
}

std::vector<Finding> check_functions(std::string_view path, std::string_view text, int most) {
  std::vector<Finding> findings;
  const std::string code = code_only(text);
  struct Block {
    bool is_function = false;
    int begin = 0;
  };
  std::vector<Block> open;
  std::size_t head = 0;  // where the declaration before the next brace begins
  int line = 1, head_line = 1;
  bool has_head = false;
  for (std::size_t at = 0; at < code.size(); ++at) {
    const char c = code[at];
    if (c == '\n') ++line;
    if (!has_head && std::isspace(static_cast<unsigned char>(c)) == 0) {
      has_head = true;
      head = at;
      head_line = line;
    }
    if (c == '{') {
      const std::string_view declaration = std::string_view(code).substr(head, at - head);
      const bool is_inner = std::any_of(open.begin(), open.end(), [](const Block& b) { return b.is_function; });
      // Conditions of the preprocessor before it may hold brackets.
      const bool is_namespace = holds_word(declaration, "namespace");
      const bool is_scope = holds_word(declaration, "class") || holds_word(declaration, "struct") ||
                            holds_word(declaration, "enum") || holds_word(declaration, "union");
      const char last = trimmed(declaration).empty() ? '=' : trimmed(declaration).back();
      const bool is_value = last == '(' || last == ',' || last == '=';  // the brace of a table
      const bool has_brackets = !is_value && !is_namespace && declaration.find('(') != std::string_view::npos;
      open.push_back({!is_inner && has_brackets && (!is_scope || declaration.find(')') != std::string_view::npos), head_line});
    } else if (c == '}' && !open.empty()) {
      const Block block = open.back();
      open.pop_back();
      if (block.is_function && line - block.begin + 1 > most)
        findings.push_back({place(path, block.begin), joined({"a function of ", std::to_string(line - block.begin + 1),
                                                              " lines, more than ", std::to_string(most), ": split it"})});
    }
    if (c == '{' || c == '}' || c == ';') has_head = false;
  }
  return findings;
}

}  // namespace bl::house
