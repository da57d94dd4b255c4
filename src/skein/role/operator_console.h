// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "skein/base/time.h"
#include "skein/data/command/command.h"
#include "skein/data/event/event.h"

namespace skein {

/// A short look at a running simulation.
struct RunProgress {
  Time now;
  Time end;
  double speed = 0;          ///< simulated over wall time
  std::string headline;      ///< key figures in one line
  std::uint64_t misses = 0;  ///< steps that began too late for real time
};

/// The operator's view of a run: sees progress, may steer it and ask to stop.
class OperatorConsole {
 public:
  virtual ~OperatorConsole() = default;

  /// Called a few times a second of wall time.
  virtual void show(const RunProgress& progress) = 0;

  /// Called for each event that an operator is to know of at once (is_announced()), in
  /// order.
  /// @param who  the name of the entity that it happened to.
  virtual void announce(const Event& event, std::string_view who) {
    static_cast<void>(event);
    static_cast<void>(who);
  }

  /// Whether the operator asked for an end of the run. Must be quick.
  virtual bool stop_requested() const = 0;

  /// What has been asked for since the last call, in order; the times are filled in by
  /// the run. Asked at every step of a run, and while it stands still, so it must be
  /// quick. What cannot be done becomes an event "command-refused".
  virtual std::vector<CommandRecord> commands() { return {}; }
};

}  // namespace skein
