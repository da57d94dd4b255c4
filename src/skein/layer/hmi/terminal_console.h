// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdio>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "skein/base/result.h"
#include "skein/layer/hmi/line_input.h"
#include "skein/role/operator_console.h"

namespace skein::hmi {

/// One line that shows how far a run is: bar, simulated time, speed factor, remaining
/// wall time, headline. No longer than `width` columns: the headline is cut first.
std::string progress_line(const RunProgress& progress, int width);

/// Shows a run's progress in one line of a terminal, redrawn in place. When the output is
/// no terminal it stays silent. Alerts stay above it as lines of their own. Reads
/// commands of the operator (data/command/command_text.h) line by line, when it is given
/// an input; what is wrong with one is reported at once.
///
/// Thread safety: used by one thread; only `stop` may be set from others or from a signal
/// handler (the atomic must then be lock-free, as it is on every supported machine).
class TerminalConsole final : public OperatorConsole {
 public:
  /// @param stop  outlives the console; true asks the run to end.
  /// @param out   where to draw; standard error, so that results can be piped.
  /// @param input  descriptor to read commands from; negative: none.
  explicit TerminalConsole(const std::atomic<bool>& stop, std::FILE* out = stderr,
                           int input = -1);

  /// Reads lines as commands by `read` from now on, in place of parse_command().
  void read_with(std::function<Result<Command>(std::string_view line)> read) {
    read_ = std::move(read);
  }
  /// As above, given whether `out` is a terminal and how wide: for tests and odd
  /// terminals.
  TerminalConsole(const std::atomic<bool>& stop, std::FILE* out, bool is_terminal,
                  int width, int input = -1);
  /// Ends the line.
  ~TerminalConsole() override;
  TerminalConsole(const TerminalConsole&) = delete;
  TerminalConsole& operator=(const TerminalConsole&) = delete;

  /// Draws nothing that is drawn already.
  void show(const RunProgress& progress) override;
  /// On a line of its own, "uav-2: traffic, 2 o'clock, 1.2 km, same altitude".
  void announce(const Event& event, std::string_view who) override;
  bool stop_requested() const override { return stop_.load(std::memory_order_relaxed); }
  std::vector<CommandRecord> commands() override;

 private:
  const std::atomic<bool>& stop_;
  std::FILE* out_;
  bool is_terminal_;
  int fixed_width_;  // 0 = ask the terminal
  std::string drawn_;
  LineInput input_;
  std::function<Result<Command>(std::string_view)> read_;
};

}  // namespace skein::hmi
