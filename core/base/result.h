// Result<T>: a value, or an error with a code, a place and a sentence that says what to do.
#pragma once

#include <cassert>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace bl {

/// What went wrong, from one list; the sentence beside it is for people, the code for programs and tests.
enum class ErrorCode {
  parse,          ///< text is not in the format it claims (JSON, CSV, GeoJSON, a number, a formula)
  unknown_field,  ///< a name that no declaration knows
  unknown_type,   ///< a typification, link kind or command that no declaration knows
  wrong_kind,     ///< a value of another kind than the declared one
  wrong_unit,     ///< two quantities of different dimensions meet
  out_of_range,   ///< a number outside the hard range
  not_finite,     ///< NaN or infinity where a finite number is needed
  missing,        ///< something required is not there
  duplicate,      ///< an id or name that exists already
  not_found,      ///< an id that points to nothing
  conflict,       ///< the change contradicts the scene as it is
  geometry,       ///< degenerate or unsupported shape
  infeasible,     ///< demands that cannot be met
  version,        ///< a file of a newer version, or a broken upgrade
  io,             ///< reading or writing failed
  cancelled,      ///< stopped on request
  internal,       ///< a defect of the program, caught at an edge
};

/// Stable lower-case name of a code, as it appears in JSON output.
std::string_view name_of(ErrorCode code);

/// An error that data can cause. `place` is a path such as `nodes/tower/smart_volume/demand`, or empty.
struct Error {
  ErrorCode code = ErrorCode::internal;
  std::string place;
  std::string message;

  /// "place: message", or the message alone where there is no place; bounded.
  std::string text() const;
  /// The same error with `prefix` put before its place.
  Error within(std::string_view prefix) const;
  bool operator==(const Error&) const = default;
};

/// The error with what it quotes from data cut where that is long, so that a sentence stays one: at most kLongestQuote bytes of a
/// quotation, kLongestMessage of a message. Every error that a Result takes passes through here.
inline constexpr std::size_t kLongestQuote = 240, kLongestMessage = 4000;
Error bounded(Error error);

/// A T or an Error; must be looked at before use.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : content_(std::in_place_index<0>, std::move(value)) {}      // NOLINT: implicit on purpose
  Result(Error error) : content_(std::in_place_index<1>, bounded(std::move(error))) {}  // NOLINT: implicit on purpose

  bool ok() const { return content_.index() == 0; }
  explicit operator bool() const { return ok(); }
  T& value() & {
    assert(ok());
    return std::get<0>(content_);
  }
  const T& value() const& {
    assert(ok());
    return std::get<0>(content_);
  }
  T&& value() && {
    assert(ok());
    return std::get<0>(std::move(content_));
  }
  const Error& error() const {
    assert(!ok());
    return std::get<1>(content_);
  }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T&& operator*() && { return std::move(*this).value(); }

 private:
  std::variant<T, Error> content_;
};

/// Success without a value, or an Error.
template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(bounded(std::move(error))), ok_(false) {}  // NOLINT: implicit on purpose

  bool ok() const { return ok_; }
  explicit operator bool() const { return ok_; }
  const Error& error() const {
    assert(!ok_);
    return error_;
  }

 private:
  Error error_;
  bool ok_ = true;
};

}  // namespace bl
