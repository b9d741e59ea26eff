// The rules of the house as functions over text, so that they can be tried on samples as well as on the tree.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace bl::house {

/// One place where a rule is broken.
struct Finding {
  std::string place;     ///< "core/graph/tick.cpp:12"
  std::string sentence;  ///< what is wrong and what to do
};

/// The text with comments, strings and character literals blanked out; line breaks stay where they are.
std::string code_only(std::string_view text);

/// Who may include whom, and which library may be seen where. `path` is relative to the root of the checkout.
std::vector<Finding> check_includes(std::string_view path, std::string_view text);

/// A function body with more lines than `most`, from the line of its name to its closing brace. Tables (a body that is one
/// `return {...}` or an initialiser) and lambdas inside of functions are counted with the function that holds them.
std::vector<Finding> check_functions(std::string_view path, std::string_view text, int most);

/// Words that would make results depend on the library, the clock or the order of a hash table.
std::vector<Finding> check_words(std::string_view path, std::string_view text);

/// Namespaces that are neither the one of the file's room nor lie within it.
std::vector<Finding> check_names(std::string_view path, std::string_view text);

/// A sentence on the first line, and `#pragma once` in headers.
std::vector<Finding> check_form(std::string_view path, std::string_view text);

}  // namespace bl::house
