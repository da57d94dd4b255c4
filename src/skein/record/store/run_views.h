// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "skein/base/result.h"
#include "skein/data/airspace/zone.h"
#include "skein/data/perimeter/fire.h"
#include "skein/record/store/believer.h"
#include "skein/record/store/sqlite.h"

namespace skein::record {

/// A believed boundary as a run has stored it.
struct StoredBelief {
  Believer who;
  BoundaryEstimate boundary;
  std::optional<Time> made;  ///< of a forecast
};

/// Where an aircraft believed to be, second by second.
struct StoredPath {
  std::string name;
  Time from, until;
  std::vector<Vec2> places;  ///< [m]
};

/// Looks into a run at one time, also into one that goes on.
class RunViews {
 public:
  /// Fails: as read_run().
  static Result<RunViews> open(const std::filesystem::path& directory);

  /// The last time of which there is something, and whether the run has ended.
  Result<Time> last() const;
  Result<bool> ended() const;
  /// Simulated time 0, ISO 8601; may be empty.
  Result<std::string> start_utc() const;

  /// The newest boundary of each mission, not after `at`.
  Result<std::vector<StoredBelief>> beliefs(Time at) const;
  /// The newest forecasts of each mission, made not after `at`.
  Result<std::vector<StoredBelief>> forecasts(Time at) const;
  /// Flights of all aircraft until `at`.
  Result<std::vector<StoredPath>> paths(Time at) const;
  /// No-fly zones in force at `at`.
  Result<std::vector<Zone>> zones(Time at) const;

 private:
  explicit RunViews(Sqlite database) : database_(std::move(database)) {}
  Result<std::vector<StoredBelief>> rings(const std::string& source,
                                          const std::string& time, Time at) const;

  mutable Sqlite database_;
};

}  // namespace skein::record
