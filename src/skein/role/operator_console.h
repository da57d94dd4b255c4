#pragma once

#include <string>
#include <vector>

#include "skein/base/time.h"
#include "skein/data/command.h"

namespace skein {

/// A short look at a running simulation.
struct RunProgress {
  Time now;
  Time end;
  double speed = 0;      ///< simulated over wall time
  std::string headline;  ///< key figures in one line
};

/// The operator's view of a run: sees progress, may steer it and ask to stop.
class OperatorConsole {
 public:
  virtual ~OperatorConsole() = default;

  /// Called a few times a second of wall time.
  virtual void show(const RunProgress& progress) = 0;

  /// Whether the operator asked for an end of the run. Must be quick.
  virtual bool stop_requested() const = 0;

  /// What has been asked for since the last call, in order; the times are filled in by
  /// the run. Asked at every step of a run, and while it stands still, so it must be
  /// quick. What cannot be done becomes an event "command-refused".
  virtual std::vector<CommandRecord> commands() { return {}; }
};

}  // namespace skein
