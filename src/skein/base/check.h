// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace skein {

/// A bug in Skein's own code: thrown by SKEIN_CHECK, caught only by the run loop and
/// `main`. Never used for input; see Result.
class Bug : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

namespace detail {
[[noreturn]] void fail_check(const char* condition, const char* file, int line,
                             const std::string& values);

template <class... Values>
std::string join_values(const Values&... values) {
  std::string text;
  ((text += fmt::format(" {}", values)), ...);
  return text;
}
}  // namespace detail

}  // namespace skein

/// Stops with a Bug when `condition` is false; further arguments are printed.
#define SKEIN_CHECK(condition, ...)                                           \
  do {                                                                        \
    if (!(condition)) [[unlikely]]                                            \
      ::skein::detail::fail_check(#condition, __FILE__, __LINE__,             \
                                  ::skein::detail::join_values(__VA_ARGS__)); \
  } while (false)
