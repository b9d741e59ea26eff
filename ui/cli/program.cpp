// Complaints about a command line name the task that was meant; a task of another name gets a suggestion.
#include "ui/cli/program.h"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/base/scarcity.h"
#include "core/base/text.h"
#include "ui/cli/commands.h"
#include "ui/cli/file_rule.h"
#include "ui/cli/terminal.h"
#include "ui/cli/usage.h"

namespace bl::cli {

namespace {

int answered(const CLI::App& app, const CLI::ParseError& error, int count, char** arguments) {
  if (error.get_exit_code() == 0) return app.exit(error);
  const auto chosen = app.get_subcommands();
  complain(usage_sentence(chosen.empty() ? app : *chosen.front(), error));
  const CLI::Option* plugins = app.get_option_no_throw("--plugins");
  const auto is_plugins = [](const char* argument) { return std::string_view(argument).starts_with("--plugins"); };
  if (!chosen.empty() && plugins != nullptr && plugins->empty() && std::any_of(arguments + 1, arguments + count, is_plugins))
    complain("--plugins FOLDER stands before the task: " + app.get_name() + " --plugins FOLDER " + chosen.front()->get_name() +
             " ...");
  complain("`" + app.get_name() + " " + (chosen.empty() ? "" : chosen.front()->get_name() + " ") + "--help` explains.");
  return kBadInput;
}

}  // namespace

std::optional<int> refusal(CLI::App& app, int count, char** arguments) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) names.push_back(command->get_name());
  if (count > 1 && !names.empty() && arguments[1][0] != '-' &&
      std::find(names.begin(), names.end(), arguments[1]) == names.end()) {
    complain("there is no command `" + std::string(arguments[1]) + "`" + did_you_mean(arguments[1], names) + "; `" +
             app.get_name() + " --help` lists all.");
    return kBadInput;
  }
  try {
    app.parse(count, arguments);
  } catch (const CLI::ParseError& error) { return answered(app, error, count, arguments); }
  std::vector<CLI::App*> parsed = app.get_subcommands();
  if (names.empty()) parsed.push_back(&app);
  for (const CLI::App* chosen : parsed)
    if (const std::string sentence = wrong_files(*chosen); !sentence.empty()) {
      complain(sentence);
      return kBadInput;
    }
  return std::nullopt;
}

int guarded(const std::function<int()>& work) {
  // A limit on the size of files shall be an error of the write, which is told and cleaned up after, not the end of the program.
  std::signal(SIGXFSZ, SIG_IGN);
  prepare_for_scarcity();
  try {
    const int code = work();
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
    complain("the output could not be written: the disk is full, or the reader of the output has ended.");
    return kBadInput;
  } catch (const std::bad_alloc&) { complain(memory_sentence()); } catch (const std::system_error& error) {
    if (error.code() == std::errc::resource_unavailable_try_again) complain(thread_sentence());
    else complain(std::string("a request to the system failed: ") + error.what());
  } catch (const std::exception& error) {
    complain(std::string("this is a defect of the program, please report it: ") + error.what());
  }
  return 1;
}

}  // namespace bl::cli
