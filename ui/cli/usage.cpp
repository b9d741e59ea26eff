// Rewrites the messages of the command line library as sentences that say what to do.
#include "ui/cli/usage.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "core/base/text.h"

namespace bl::cli {

namespace {

// What stands between two parts of the library's sentence; nothing where it is another sentence.
std::string between(std::string_view text, std::string_view begin, std::string_view end) {
  if (!text.starts_with(begin)) return "";
  const std::size_t stop = text.find(end, begin.size());
  return stop == std::string_view::npos ? "" : std::string(text.substr(begin.size(), stop - begin.size()));
}

// Without its dashes, an argument stands in the help in capitals.
std::string name_in_help(const CLI::Option& option) {
  return option.get_positional() ? option.get_type_name() : "--" + option.get_lnames().front();
}

// "The scene" in the middle of a sentence; "OSM" stays as it is.
std::string in_mid_sentence(std::string text) {
  const bool is_word = text.size() > 1 && (text[1] == ' ' || (text[1] >= 'a' && text[1] <= 'z'));
  if (is_word && text[0] >= 'A' && text[0] <= 'Z') text[0] = static_cast<char>(text[0] - 'A' + 'a');
  return text;
}

std::string of_unknown(const CLI::App& task, const std::string& otherwise) {
  const std::vector<std::string> rest = task.remaining(true);
  const auto unknown = std::find_if(rest.begin(), rest.end(), [](const std::string& word) { return word.starts_with("-"); });
  if (unknown == rest.end()) return rest.empty() ? otherwise : "`" + rest.front() + "` is one argument more than the task takes.";
  std::vector<std::string> names;
  for (const CLI::Option* option : task.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  const std::string word = unknown->substr(0, unknown->find('=')), near = did_you_mean(word, names);
  return "there is no option `" + word + "`" + near + (near.empty() ? "." : "");
}

std::string of_missing(const CLI::App& task, const std::string& otherwise) {
  const std::string name = otherwise.substr(0, otherwise.find(" is required"));
  const CLI::Option* option = task.get_option_no_throw(name);
  return option == nullptr ? otherwise : name_in_help(*option) + " is missing: " + in_mid_sentence(option->get_description());
}

std::string of_no_number(const CLI::App& task, const std::string& otherwise) {
  const std::string name = between(otherwise, "Could not convert: ", " = ");
  const CLI::Option* option = name.empty() ? nullptr : task.get_option_no_throw(name);
  if (option == nullptr) return otherwise;
  const std::string found = otherwise.substr(otherwise.find(" = ") + 3);
  const bool is_length = option->get_type_name() == "METRES";
  return name + ": expects a plain number" + (is_length ? " of metres" : "") + ", such as 12, without a unit; found `" + found +
         "`";
}

}  // namespace

std::string usage_sentence(const CLI::App& task, const CLI::ParseError& error) {
  const std::string otherwise = error.what();
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) return of_unknown(task, otherwise);
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) return of_missing(task, otherwise);
  if (dynamic_cast<const CLI::ConversionError*>(&error) != nullptr) return of_no_number(task, otherwise);
  return otherwise;
}

}  // namespace bl::cli
