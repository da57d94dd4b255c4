// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <variant>

#include "skein/base/check.h"

namespace skein {

/// What kind of error an Error reports.
enum class ErrorCode {
  kBadInput,     ///< the content of a file, argument or message is wrong
  kNotFound,     ///< a file or name does not exist
  kUnavailable,  ///< the world failed: disk full, unwritable folder, socket closed
  kInterrupted,  ///< somebody asked to stop
  kInternal,     ///< a bug in Skein's own code: see internal_error()
};

/// What prevented a result, in words for the user.
struct Error {
  ErrorCode code = ErrorCode::kBadInput;
  std::string place;    ///< file, `file:line:column` or key; may be empty
  std::string message;  ///< what was found and what is allowed
  std::string hint;     ///< what would mend it; may be empty

  /// `place: message hint`, leaving out what is empty; a message without a full stop is
  /// parted from the hint.
  std::string text() const;
};

/// The error of whoever caught an exception that nothing outside Skein explains (a Bug,
/// an index out of range): it says "internal error" and asks for a report. `what` is the
/// exception's text.
Error internal_error(const std::string& what);

/// A value or the Error that prevented it.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : content_(std::move(value)) {}      // NOLINT: implicit on purpose
  Result(Error error) : content_(std::move(error)) {}  // NOLINT: implicit on purpose

  bool ok() const { return std::holds_alternative<T>(content_); }
  explicit operator bool() const { return ok(); }

  /// The value. Fails: Bug when there is none; ask ok() first.
  const T& value() const& {
    SKEIN_CHECK(ok(), error().text());
    return std::get<T>(content_);
  }
  T& value() & {
    SKEIN_CHECK(ok(), error().text());
    return std::get<T>(content_);
  }
  T&& value() && {
    SKEIN_CHECK(ok(), error().text());
    return std::get<T>(std::move(content_));
  }

  /// The error; valid only when ok() is false.
  const Error& error() const { return std::get<Error>(content_); }

 private:
  std::variant<T, Error> content_;
};

/// Success without a value, or an Error.
template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(std::move(error)), ok_(false) {}  // NOLINT: implicit

  bool ok() const { return ok_; }
  explicit operator bool() const { return ok_; }
  const Error& error() const { return error_; }

 private:
  Error error_;
  bool ok_ = true;
};

}  // namespace skein
