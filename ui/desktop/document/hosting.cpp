// What the server says is read from its files, because a pipe would end it with the window.
#include "ui/desktop/document/hosting.h"

#include <unistd.h>

#include <charconv>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "core/define/json_text.h"
#include "core/file/file_io.h"

namespace bl::desktop {

namespace {

namespace fs = std::filesystem;

bool is_everywhere(const std::string& bind) { return bind == "0.0.0.0" || bind == "::"; }

// Of complaints the last line says why a program has ended.
std::string last_line_of(const std::string& text) {
  const std::size_t end = text.find_last_not_of('\n');
  if (end == std::string::npos) return "";
  const std::size_t begin = text.rfind('\n', end);
  return text.substr(begin == std::string::npos ? 0 : begin + 1, end - (begin == std::string::npos ? 0 : begin + 1) + 1);
}

// The sentences of the command line name options, which a window does not have.
std::string in_words_of_window(const std::string& line, const HostingPlan& plan) {
  if (line.empty()) return "The server has ended and has not said why.";
  if (line.find("Address already in use") != std::string::npos)
    return "Port " + plan.port + " is in use by another program. Go back to \"Address and file\" and choose another port.";
  return line;
}

}  // namespace

std::string fault_of_place(const HostingPlan& plan) {
  int port = 0;
  const char* end = plan.port.data() + plan.port.size();
  const auto [stop, error] = std::from_chars(plan.port.data(), end, port);
  if (plan.port.empty() || error != std::errc() || stop != end || port < 1 || port > 65535)
    return "A port is a whole number from 1 to 65535, such as 8080.";
  if (plan.certificate.empty() != plan.key.empty()) return "A certificate and its key belong together: choose both, or neither.";
  if (!plan.certificate.empty() && plan.name.empty()) return "Type the host name for which the certificate was made.";
  for (const std::string& file : {plan.certificate, plan.key})
    if (!file.empty() && ::access(file.c_str(), R_OK) != 0) return file + " cannot be read.";
  if (!plan.journal.ends_with(".blsession")) return "The name of the session file ends in .blsession.";
  std::error_code ignored;
  const fs::path folder = fs::absolute(plan.journal, ignored).parent_path();
  if (!fs::is_directory(folder, ignored)) return "There is no folder " + folder.string() + ".";
  if (::access(folder.c_str(), W_OK) != 0) return "Nothing can be written into the folder " + folder.string() + ".";
  return "";
}

std::vector<std::string> words_of(const HostingPlan& plan, bool is_check) {
  std::vector<std::string> words{"serve", plan.scene, "--port", plan.port, "--bind", plan.bind, "--journal", plan.journal};
  if (!plan.certificate.empty())
    words.insert(words.end(), {"--certificate", plan.certificate, "--key", plan.key, "--name", plan.name});
  if (plan.is_live) words.emplace_back("--live");
  if (plan.scripts) words.emplace_back("--scripts");
  if (is_check) words.emplace_back("--check");
  else words.insert(words.end(), {"--invites", ServerProcess::kPrivateFile});
  return words;
}

Result<std::unique_ptr<Hosting>> Hosting::begin(const std::string& program, HostingPlan plan, ServerProcess::Lives lives) {
  auto process = ServerProcess::start(program, words_of(plan, false), lives);
  if (!process) return process.error();
  std::unique_ptr<Hosting> hosting(new Hosting());
  hosting->plan_ = std::move(plan);
  hosting->process_ = std::move(*process);
  return hosting;
}

Hosting::~Hosting() {
  if (stage_ == Stage::opening) process_->interrupt();
}

// `room BKRT at http://192.168.1.5:8080/BKRT`; the keys were written before it.
void Hosting::read_opening() {
  const std::string text = process_->output();
  constexpr std::string_view kBegin = "room ", kAt = " at ";
  const std::size_t begin = text.find(kBegin), end = text.find('\n', begin);
  if (begin == std::string::npos || end == std::string::npos) return;
  const std::string line = text.substr(begin + kBegin.size(), end - begin - kBegin.size());
  const std::size_t at = line.find(kAt);
  if (at == std::string::npos) return;
  code_ = line.substr(0, at);
  page_ = line.substr(at + kAt.size());
  const auto written = read_file(process_->private_file());
  const Json keys = written ? Json::parse(*written, nullptr, false) : Json();
  if (!keys.is_object() || !keys.contains(code_) || !keys[code_].is_object()) return;
  for (const auto& [role, key] : keys[code_].items())
    if (key.is_string()) keys_[role] = key.get<std::string>();
  std::error_code ignored;
  fs::remove(process_->private_file(), ignored);  // the room shows keys to facilitators; a file of them helps nobody any more
  const std::string host = !plan_.name.empty() ? plan_.name : is_everywhere(plan_.bind) ? "127.0.0.1" : plan_.bind;
  const std::string quoted = host.find(':') == std::string::npos ? host : "[" + host + "]";
  address_ = (plan_.certificate.empty() ? "room://" : "https://") + quoted + ":" + plan_.port + "/" + code_ +
             "#k=" + keys_["facilitator"];
  if (!plan_.name.empty()) page_ = "https://" + quoted + ":" + plan_.port + "/" + code_;
  stage_ = Stage::open;
}

Hosting::Stage Hosting::turn() {
  if (stage_ == Stage::opening) read_opening();
  if (stage_ != Stage::ended && process_->exit_code()) {
    if (stage_ != Stage::ending) why_ = in_words_of_window(last_line_of(process_->complaints()), plan_);
    stage_ = Stage::ended;
  }
  return stage_;
}

void Hosting::end() {
  if (stage_ == Stage::ended) return;
  stage_ = Stage::ending;
  process_->interrupt();
}

}  // namespace bl::desktop
