#pragma once

#include <string>

#include "base/time.h"

namespace skein {

/// A short look at a running simulation.
struct RunProgress {
  Time now;
  Time end;
  double speed = 0;      ///< simulated over wall time
  std::string headline;  ///< key figures in one line
};

/// The operator's view of a run: sees progress, may ask to stop.
class OperatorConsole {
 public:
  virtual ~OperatorConsole() = default;

  /// Called a few times a second of wall time.
  virtual void show(const RunProgress& progress) = 0;

  /// Whether the operator asked for an end of the run. Must be quick.
  virtual bool stop_requested() const = 0;
};

}  // namespace skein
