// SPDX-License-Identifier: Apache-2.0
#include "skein/link/process/kept_program.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <system_error>

namespace skein::process {
namespace {

using namespace std::chrono_literals;

constexpr auto kPause = 1s;       // before another start
constexpr int kMaxRestarts = 10;  // what ends as often is broken
constexpr std::size_t kLines = 5;

Result<void> make_folder(const std::filesystem::path& folder) {
  if (folder.empty()) return {};
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error) return {};
  return Error{ErrorCode::kUnavailable, folder.string(), error.message() + ".", ""};
}

}  // namespace

Result<void> KeptProgram::start() {
  if (auto made = make_folder(program_.folder); !made) return made;
  if (auto made = make_folder(program_.log.parent_path()); !made) return made;
  auto started = ChildProcess::start(program_);
  if (!started) return started.error();
  process_ = std::move(started).value();
  ended_ = false;
  return {};
}

std::optional<KeptProgram::Change> KeptProgram::look(Clock::time_point now) {
  if (!process_) return std::nullopt;
  if (!ended_) {
    const ProcessStatus& status = process_->look(now);
    if (status.running) return std::nullopt;
    ended_ = true;
    again_at_ = now + kPause;
    return Change{false,
                  fmt::format("{} {}; the end of {}: {}", program_.arguments.front(),
                              status.text(), program_.log.string(),
                              fmt::join(process_->last_lines(kLines), " | "))};
  }
  if (!restart_ || restarts_ == kMaxRestarts || now < again_at_) return std::nullopt;
  ++restarts_;
  again_at_ = now + kPause;
  if (auto started = start(); !started)
    return Change{false, "it cannot be started again: " + started.error().text()};
  return Change{true, program_.arguments.front() + " is started again"};
}

bool KeptProgram::runs(Clock::time_point now) {
  return process_ && !ended_ && process_->look(now).running;
}

void KeptProgram::stop(Clock::time_point now) {
  if (process_) process_->stop(now);
}

}  // namespace skein::process
