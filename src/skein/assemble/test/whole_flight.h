// SPDX-License-Identifier: Apache-2.0
#pragma once

// Whole aircraft fly in a scenario, from plant to autopilot, and everything that a run
// records is kept in memory.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "skein/data/event/event.h"
#include "skein/data/event/record.h"
#include "skein/data/vehicle/autopilot.h"
#include "skein/data/vehicle/sensing.h"
#include "skein/data/vehicle/vehicle.h"
#include "skein/geo/rotation.h"
#include "skein/role/recorder.h"

namespace skein::record {
class ContentHash;
class RunStatistics;
}  // namespace skein::record

namespace skein::assemble {

/// One record of an aircraft: what was true, what it believed, and what it did.
struct FlightRow {
  Time time;
  VehicleState truth;
  NavEstimate nav;
  AutopilotStatus status;

  double altitude() const { return -truth.p_N.z(); }
  geo::Euler attitude() const { return geo::to_euler(truth.q_NB); }
};

/// Everything that was recorded.
class FlightLog final : public Recorder {
 public:
  FlightLog();
  FlightLog(FlightLog&&) noexcept;
  ~FlightLog() override;

  void record(const Record& record) override;

  std::string hash() const;
  /// A number of the summary; NaN when there is none of that name.
  double figure(const std::string& name) const;
  /// The first event of that kind and text (empty: any); null when there is none.
  const Event* find(EventKind kind, const std::string& text = "") const;
  /// All events in words, for messages of tests.
  std::string story() const;

  std::map<std::uint32_t, std::vector<FlightRow>> rows;  ///< by entity
  std::vector<Event> events;
  std::vector<Detection> detections;
  std::vector<RangeScan> scans;
  std::vector<ObjectMotion> motions;
  std::vector<TrafficMotion> traffic_motions;
  std::vector<TrafficBeliefRecord> traffic_beliefs;
  std::vector<Footprint> footprints;

 private:
  std::unique_ptr<record::ContentHash> hash_;
  std::unique_ptr<record::RunStatistics> statistics_;
};

/// What a scripted aircraft commands its autopilot, one after the other.
struct ScriptLine {
  AutopilotCommand command;
  double at = 0;           ///< not before [s]
  bool when_done = false;  ///< and not before the last one is done
};

/// How a scenario is run by a test.
struct Flown {
  std::vector<ScriptLine> script = {};  ///< of every aircraft; empty: its own agent
  int threads = 1;
  std::int64_t ticks = 0;  ///< steps that are made at once; 0: all
};

/// Runs a scenario given as text. What is wrong with it is an exception: the test fails.
FlightLog fly(const std::string& text, const Flown& how = {});

/// Root of the mean square and largest size of some numbers.
struct Spread {
  double square = 0, max = 0;
  int count = 0;
  void add(double x) {
    square += x * x;
    max = std::max(max, std::abs(x));
    ++count;
  }
  double rms() const { return count > 0 ? std::sqrt(square / count) : NAN; }
};

}  // namespace skein::assemble
