#pragma once

#include <fmt/format.h>

#include <string_view>

namespace skein {

enum class LogLevel { kDebug, kInfo, kWarning, kError };

/// Lines below this level are dropped. For `main` only; the default is kWarning.
void set_log_level(LogLevel level);

/// Writes one line to standard error. Never part of what is recorded or hashed.
void log_line(LogLevel level, std::string_view text);

template <class... Args>
void log_info(fmt::format_string<Args...> format, Args&&... args) {
  log_line(LogLevel::kInfo, fmt::format(format, std::forward<Args>(args)...));
}
template <class... Args>
void log_warning(fmt::format_string<Args...> format, Args&&... args) {
  log_line(LogLevel::kWarning, fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace skein
