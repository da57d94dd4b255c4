#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "skein/record/flight_series.h"
#include "skein/record/forecast_statistics.h"
#include "skein/record/metrics.h"
#include "skein/record/object_track.h"
#include "skein/record/rows.h"
#include "skein/record/summary.h"
#include "skein/record/traffic_path.h"

namespace skein::record {

/// One entity's track, at equal steps of time.
struct StoredTrack {
  EntityId id;
  double start = 0, step = 0;                ///< [s]
  std::vector<double> north, east, heading;  ///< [m], [m], [rad]
  std::vector<double> altitude_msl;          ///< [m]
};

/// The rings of one time. `floats` per ring as in the database: see run_database.h.
struct StoredFrame {
  double time = 0;  ///< [s]
  std::vector<std::vector<float>> rings;
};

/// Rings as a mission believed at one time that they would be at a later one.
struct StoredForecast {
  double made = 0, time = 0;  ///< [s]
  std::string mission;
  std::vector<std::vector<float>> rings;  ///< as those of beliefs
};

/// A thing on the ground and how it moved.
struct StoredObject {
  GroundObject object;
  ObjectTrack track;
};

/// Another aircraft and how it flew.
struct StoredTraffic {
  AirTraffic what;
  TrafficPath path;
};

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
  std::vector<StoredTrack> tracks;
  std::vector<FlightSeries> flights;
  std::vector<StoredFrame> truth, belief;
  std::vector<StoredForecast> ahead;  ///< in order of when they were made
  std::vector<Crossing> crossings;
  std::vector<StoredObject> objects;
  std::vector<Detection> detections;
  std::vector<StoredTraffic> traffic;
  std::vector<TrafficBeliefRecord> traffic_beliefs;   ///< firm ones, in order of time
  std::vector<AlertRecord> alerts;                    ///< in order of time
  std::vector<StoredBands> bands;                     ///< in order of time
  std::vector<StoredRecommendation> recommendations;  ///< in order of time
  std::vector<ForecastScore> forecasts;               ///< that have been scored
  std::vector<ArrivalForecast> arrivals;              ///< in order of time
  std::vector<ZoneRecord> zones;                      ///< in order of time
  std::vector<MissionRecord> missions;                ///< in order of time
  std::vector<StoredSeries> mission_series;           ///< by mission, then figure
  std::vector<Event> events;                          ///< in order of time
  int events_left_out = 0;                            ///< more of the most frequent kinds
  double message_bin = 60;                            ///< [s]
  std::vector<int> messages_sent, messages_lost;      ///< per bin
  std::vector<StoredLoad> loads;                      ///< in order of time
  std::vector<StoredRadio> radios;                    ///< in the order of their entities
  std::vector<LinkUse> links;  ///< of the whole run, in the order of sender and receiver
  std::unique_ptr<TerrainRow> terrain;  ///< null when the run has none
};

/// How much a reader keeps.
struct ReadBudget {
  int frames = 240;            ///< perimeters of the truth, and of the belief
  int track_samples = 120000;  ///< over all entities
  double shortest_step = 1;    ///< between track samples [s]
  int flights = 8;             ///< aircraft whose flight over time is kept
  int flight_samples = 500;    ///< of each
  int crossings = 6000;
  int detections = 6000;
  int object_motions = 3000;    ///< of each object
  int traffic_motions = 60000;  ///< of all together
  int traffic_beliefs = 20000;
  int alerts = 4000;
  int bands = 6000;
  int events = 400;
};

/// Reads the database of the run in `directory`, also of one that was cut off.
/// Fails: kNotFound without a database; kBadInput when it is damaged or of another kind.
Result<StoredRun> read_run(const std::filesystem::path& directory,
                           const ReadBudget& budget);

}  // namespace skein::record
