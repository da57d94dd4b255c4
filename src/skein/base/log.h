// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace skein {

/// What a program says about its own working, for people who look into it. Never part of
/// what is recorded or hashed; may be called from any thread.
enum class LogLevel { kDebug, kInfo, kWarning, kError };

/// Lines below this level are dropped; kWarning at the start of a program.
void set_log_level(LogLevel level);
bool logs(LogLevel level);

/// Writes one line to standard error, as "warning: text".
void log_line(LogLevel level, std::string_view text);

namespace detail {
template <class... Args>
void log_formatted(LogLevel level, fmt::format_string<Args...> format, Args&&... args) {
  if (logs(level)) log_line(level, fmt::format(format, std::forward<Args>(args)...));
}
}  // namespace detail

template <class... Args>
void log_debug(fmt::format_string<Args...> format, Args&&... args) {
  detail::log_formatted(LogLevel::kDebug, format, std::forward<Args>(args)...);
}
template <class... Args>
void log_info(fmt::format_string<Args...> format, Args&&... args) {
  detail::log_formatted(LogLevel::kInfo, format, std::forward<Args>(args)...);
}
template <class... Args>
void log_warning(fmt::format_string<Args...> format, Args&&... args) {
  detail::log_formatted(LogLevel::kWarning, format, std::forward<Args>(args)...);
}

}  // namespace skein
