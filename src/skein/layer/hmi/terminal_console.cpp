// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/hmi/terminal_console.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "skein/base/shown_text.h"
#include "skein/data/command/command_text.h"

namespace skein::hmi {
namespace {

constexpr int kUsualWidth = 80;

int terminal_width(std::FILE* out) {
  winsize size{};
  if (ioctl(fileno(out), TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return kUsualWidth;
  return size.ws_col;
}

std::string clock_text(double seconds) {
  const long s = std::lround(std::floor(seconds));
  return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

std::string speed_text(double speed) {
  return speed < 10 ? fmt::format("{:.1f}x", speed) : fmt::format("{:.0f}x", speed);
}

// Cuts after `columns` characters, never within a UTF-8 sequence.
std::string cut(const std::string& text, int columns) {
  int seen = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool starts_character = (static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80U;
    if (starts_character && seen++ == columns) return text.substr(0, i);
  }
  return text;
}

}  // namespace

std::string progress_line(const RunProgress& progress, int width) {
  const double end = progress.end.seconds();
  const double now = progress.now.seconds();
  const double done = end > 0 ? std::clamp(now / end, 0.0, 1.0) : 1.0;
  constexpr int kBar = 20;
  const int full = static_cast<int>(std::floor(done * kBar));
  std::string line = fmt::format(
      "[{}{}] {:3.0f} %  {} / {}  {}", std::string(static_cast<std::size_t>(full), '#'),
      std::string(static_cast<std::size_t>(kBar - full), '.'), std::floor(done * 100),
      clock_text(now), clock_text(end), speed_text(progress.speed));
  if (progress.speed > 0 && done < 1)
    line += fmt::format("  {} left", clock_text(std::ceil((end - now) / progress.speed)));
  if (!progress.headline.empty()) line += "  " + progress.headline;
  return cut(line, width);
}

TerminalConsole::TerminalConsole(const std::atomic<bool>& stop, std::FILE* out, int input)
    : TerminalConsole(stop, out, isatty(fileno(out)) == 1, 0, input) {}

TerminalConsole::TerminalConsole(const std::atomic<bool>& stop, std::FILE* out,
                                 bool is_terminal, int width, int input)
    : stop_(stop),
      out_(out),
      is_terminal_(is_terminal),
      fixed_width_(width),
      input_(input) {}

TerminalConsole::~TerminalConsole() {
  if (!drawn_.empty()) std::fputs("\n", out_);
}

std::vector<CommandRecord> TerminalConsole::commands() {
  std::vector<CommandRecord> given;
  for (const std::string& line : input_.take()) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    auto command = read_ ? read_(line) : parse_command(line);
    if (command) {
      given.push_back({Time(), "terminal", std::move(command).value()});
      continue;
    }
    // On a line of its own; the progress is drawn anew below.
    fmt::print(out_, "{}{}\n", drawn_.empty() ? "" : "\n", shown(command.error().text()));
    std::fflush(out_);
    drawn_.clear();
  }
  return given;
}

void TerminalConsole::announce(const Event& event, std::string_view who) {
  if (!is_terminal_) return;
  const std::string what = event.kind == EventKind::kRecommended
                               ? "recommended path: " + event.text
                               : event.text;
  // Over the progress, which is drawn anew below.
  fmt::print(out_, "{}{} {}: {}\n", drawn_.empty() ? "" : "\r\x1b[K",
             clock_text(event.time.seconds()), shown(std::string(who)), shown(what));
  std::fflush(out_);
  drawn_.clear();
}

void TerminalConsole::show(const RunProgress& progress) {
  if (!is_terminal_) return;
  const int width = fixed_width_ > 0 ? fixed_width_ : terminal_width(out_);
  // The last column stays free: a full line would wrap.
  std::string line = progress_line(progress, std::max(width - 1, 1));
  if (line == drawn_) return;
  drawn_ = std::move(line);
  fmt::print(out_, "\r{}\x1b[K", drawn_);
  std::fflush(out_);
}

}  // namespace skein::hmi
