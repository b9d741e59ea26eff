// A handler for `new` that fails, and one for exceptions that nobody can catch any more.
#include "core/base/scarcity.h"

#include <unistd.h>

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>
#include <system_error>

namespace bl {

namespace {

// Taking down a large tree of JSON asks for memory itself, in a destructor, where a failure would abort [bytes].
constexpr std::size_t kLaidAside = std::size_t{32} << 20;
constexpr std::string_view kMemory = "memory ran out: give the program more, or less to do, such as a part of the file.";
constexpr std::string_view kThreads =
    "the system gives the program no more threads: end other programs, or raise the limit (`ulimit -u`).";

std::atomic<char*> laid_aside{nullptr};
std::atomic<bool> has_run_out{false};
std::terminate_handler usual_end = nullptr;
std::string_view said_besides;

// Sets the laid aside free and fails all the same: what was asked for would only use it up.
void no_memory() {
  has_run_out = true;
  if (char* block = laid_aside.exchange(nullptr)) ::operator delete(block);
  throw std::bad_alloc();
}

// Nothing here may ask for memory.
[[noreturn]] void say_and_end(std::string_view sentence) {
  for (const std::string_view part : {std::string_view("behaviourlinks: "), sentence, said_besides, std::string_view("\n")})
    if (::write(STDERR_FILENO, part.data(), part.size()) < 0) break;
  ::_exit(1);
}

[[noreturn]] void last_word() {
  if (has_run_out) say_and_end(kMemory);
  try {
    if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
  } catch (const std::system_error& error) {
    if (error.code() == std::errc::resource_unavailable_try_again) say_and_end(kThreads);
  } catch (...) {}
  if (usual_end != nullptr) usual_end();
  std::_Exit(1);
}

}  // namespace

void prepare_for_scarcity(std::string_view comfort) {
  said_besides = comfort;
  laid_aside = static_cast<char*>(::operator new(kLaidAside, std::nothrow));
  std::set_new_handler(no_memory);
  usual_end = std::set_terminate(last_word);
}

std::string memory_sentence() { return std::string(kMemory); }
std::string thread_sentence() { return std::string(kThreads); }

}  // namespace bl
