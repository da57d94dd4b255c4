#pragma once

#include <string>
#include <vector>

#include "skein/base/time.h"
#include "skein/data/zone_change.h"

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

  /// No-flight zones that the operator has drawn or taken back since the last call, in
  /// order, without numbers. Asked at every step of a run, so it must be quick. They take
  /// effect at the next decision of the ground station; what it does not take up becomes
  /// an event "zone-refused".
  virtual std::vector<ZoneChange> zone_wishes() { return {}; }
};

}  // namespace skein
