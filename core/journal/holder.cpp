// The note is a file of three lines. A note that a crash has left is never read, because it is asked for only while the file is
// locked.
#include "core/journal/holder.h"

#include <unistd.h>

#include <array>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <sstream>

#include "core/base/moment.h"
#include "core/base/printable.h"
#include "core/file/file_io.h"

namespace bl::journal {

namespace {

constexpr std::size_t kMostNote = 1024;  // [bytes]

std::string note_of(const std::string& path) { return path + "-holder"; }

}  // namespace

void note_holder(const std::string& path, std::int64_t since) {
  std::array<char, 256> host{};
  if (gethostname(host.data(), host.size() - 1) != 0) host[0] = '\0';
  const std::string text = std::string(host.data()) + "\n" + std::to_string(getpid()) + "\n" + std::to_string(since) + "\n";
  const auto file = open_growing_file(note_of(path));
  if (!file) return;
  std::fwrite(text.data(), 1, text.size(), *file);
  std::fclose(*file);
}

void forget_holder(const std::string& path) {
  std::error_code ignored;
  std::filesystem::remove(note_of(path), ignored);
}

std::string sentence_of_holder(const std::string& path) {
  std::string sentence = "another program has this file open";
  const auto note = read_plain_file(note_of(path), kMostNote);
  if (!note) return sentence;
  std::istringstream lines(*note);
  std::string host, process, since;
  if (!std::getline(lines, host) || !std::getline(lines, process) || !std::getline(lines, since)) return sentence;
  sentence += ": process " + printable(process) + " on the computer " + printable(host);
  std::int64_t milliseconds = 0;
  std::from_chars(since.data(), since.data() + since.size(), milliseconds);
  const std::string moment = milliseconds > 0 ? moment_text(milliseconds) : std::string();
  return (moment.empty() ? sentence : sentence + ", since " + moment) + "; end it first";
}

}  // namespace bl::journal
