// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "skein/record/figures/flight_series.h"
#include "skein/record/figures/forecast_statistics.h"
#include "skein/record/figures/metrics.h"
#include "skein/record/store/summary.h"

namespace skein::record {

/// A range of values and what they lead to, in degrees and SI.
struct StoredBand {
  double from = 0, to = 0;
  AlertRegion region = AlertRegion::kNone;
};

/// What an aircraft may fly at one time; NaN: nothing is advised, or there is none.
struct StoredBands {
  EntityId id;
  double time = 0;  ///< [s]
  std::uint32_t level = 0;
  double track_advised_deg = 0, speed_advised = 0, vertical_speed_advised = 0;
  double recovery = 0;  ///< [s]
  std::vector<StoredBand> tracks, speeds, vertical_speeds, altitudes;
};

/// What became of a recommended path.
struct StoredRecommendation {
  RecommendationRecord record;  ///< without the path
  std::string path_json;
};

/// One figure of a mission over time.
struct StoredSeries {
  std::string mission, figure;
  std::vector<float> times;  ///< [s]
  std::vector<float> values;
};

/// The load of the air until a time, since the one before.
struct StoredLoad {
  double time = 0;            ///< [s]
  double mean = 0, most = 0;  ///< of all radios: shares of the time
};

/// What the radio of an entity did in a run; shares are means.
struct StoredRadio {
  EntityId id;
  RadioUse use;
};

/// How a run came to its end.
enum class RunEnding { kComplete, kInterrupted, kCutOff };

/// What a report shows of a stored run: long series thinned out.
struct StoredRun {
  RunInfo info;
  RunSummary summary;  ///< computed from the rows when the run was cut off
  RunEnding ending = RunEnding::kCutOff;
  double duration = 0;  ///< [s]
  double allocation_start =
      std::numeric_limits<double>::quiet_NaN();  ///< [s]; NaN = never
  std::vector<EntityRecord> entities;
  std::vector<double> metric_times;       ///< [s]
  std::vector<PerimeterMetrics> metrics;  ///< of the believer that came first
  std::vector<FlightSeries> flights;
  std::vector<AlertRecord> alerts;                    ///< in order of time
  std::vector<StoredBands> bands;                     ///< in order of time
  std::vector<StoredRecommendation> recommendations;  ///< in order of time
  std::vector<ForecastScore> forecasts;               ///< that have been scored
  std::vector<ArrivalForecast> arrivals;              ///< in order of time
  std::vector<StoredSeries> mission_series;           ///< by mission, then figure
  std::vector<Event> events;                          ///< in order of time
  int events_left_out = 0;                            ///< more of the most frequent kinds
  double message_bin = 60;                            ///< [s]
  std::vector<int> messages_sent, messages_lost;      ///< per bin
  /// Bytes in the wire form that were sent, per bin, by kind of message; what goes to
  /// everyone once.
  std::map<std::string, std::vector<double>> messages_bytes;
  std::vector<StoredLoad> loads;    ///< in order of time
  std::vector<StoredRadio> radios;  ///< in the order of their entities
  std::vector<LinkUse> links;  ///< of the whole run, in the order of sender and receiver
};

/// How much a reader keeps.
struct ReadBudget {
  int flights = 8;           ///< aircraft whose flight over time is kept
  int flight_samples = 500;  ///< of each
  int alerts = 4000;
  int bands = 6000;
  int events = 400;
};

/// Reads the database of the run in `directory`, also of one that was cut off.
/// Fails: kNotFound without a database; kBadInput when it is damaged or of another kind.
Result<StoredRun> read_run(const std::filesystem::path& directory,
                           const ReadBudget& budget);

}  // namespace skein::record
