// SPDX-License-Identifier: Apache-2.0
// How other air traffic flies: one row each.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <any>
#include <cmath>
#include <memory>

#include "skein/assemble/kinds/kinds_of.h"
#include "skein/assemble/kinds/ranges.h"
#include "skein/exchange/traffic/traffic_log.h"
#include "skein/geo/place_limits.h"
#include "skein/layer/environment/traffic/circuit_flight.h"
#include "skein/layer/environment/traffic/intruder_flight.h"
#include "skein/layer/environment/traffic/recorded_flight.h"
#include "skein/layer/environment/traffic/straight_flight.h"
#include "skein/layer/environment/traffic/wandering_flight.h"
#include "skein/scenario/utc.h"

namespace skein::assemble {
namespace {

using namespace environment;
using scenario::Fields;
using scenario::Range;

constexpr Range kTrafficSpeed{.above = 0, .at_most = 400};
constexpr Range kTrafficClimb{.at_least = -100, .at_most = 100};
constexpr Range kTurnRate{.at_least = -90, .at_most = 90};
constexpr Range kTrafficCourse{.at_least = -360, .at_most = 360};
constexpr Range kTrafficLength{.above = 0, .at_most = 1e6};

Fields<TurnAside> aside_fields() {
  using T = TurnAside;
  return Fields<T>()
      .number("from_s", &T::from, "When it begins, after it has come.",
              {.at_least = 0, .at_most = 1e7})
      .required()
      .number("for_s", &T::length, "How long.", {.above = 0, .at_most = 1e7})
      .angle_deg("turn_rate_deg_per_s", &T::turn_rate,
                 "Rate of turn, positive to the right.", kTurnRate)
      .number("climb_mps", &T::climb, "From its begin on, up. Null: as before.",
              kTrafficClimb);
}

Fields<StraightFlightOptions> straight_fields() {
  using T = StraightFlightOptions;
  return Fields<T>()
      .number("speed_mps", &T::speed, "Over ground, level part.", kTrafficSpeed)
      .angle_deg("course_deg", &T::course, "Over ground.", kTrafficCourse)
      .number("climb_mps", &T::climb, "Up.", kTrafficClimb)
      .object("turns", &T::asides, aside_fields(),
              "Turns on the way, and other climbs; it keeps its new course and climb.")
      .items({.at_most = 1000})
      .rule("turns", [](const T& t) {
        for (std::size_t k = 1; k < t.asides.size(); ++k)
          if (t.asides[k].from < t.asides[k - 1].from + t.asides[k - 1].length)
            return fmt::format("number {} begins before the one before it is over.", k);
        return std::string();
      });
}

Fields<CircuitOptions> circuit_fields() {
  using T = CircuitOptions;
  return Fields<T>()
      .angle_deg("course_deg", &T::course, "Of its first leg: the runway.",
                 kTrafficCourse)
      .number("length_m", &T::length, "Along that leg, corners included.", kTrafficLength)
      .number("width_m", &T::width, "Across it, corners included.", kTrafficLength)
      .number("turn_radius_m", &T::turn_radius, "Of its four corners.", kTrafficLength)
      .word("side", &T::side, "To which side it turns.",
            {{"left", CircuitSide::kLeft, "counter-clockwise on the map"},
             {"right", CircuitSide::kRight, "clockwise"}})
      .number("speed_mps", &T::speed, "Over ground, level part.", kTrafficSpeed)
      .number("height_m", &T::height,
              "Above where it begins. With one it is an aerodrome's circuit: it climbs "
              "there, levels off, and descends to touch down where it began. 0: a level "
              "racetrack.",
              {.at_least = 0, .at_most = 5000})
      .number("climb_mps", &T::climb, "Of an aerodrome's circuit.",
              {.above = 0, .at_most = 100})
      .number("descent_mps", &T::descent, "The same, down.", {.above = 0, .at_most = 100})
      .rule("turn_radius_m",
            [](const T& t) {
              return 2 * t.turn_radius > std::min(t.length, t.width) * (1 + 1e-12)
                         ? std::string("must be at most half of length_m and of width_m.")
                         : std::string();
            })
      .rule("height_m", [](const T& t) {
        const double lacks = circuit_lacks(t);
        return lacks > 0 ? fmt::format(
                               "cannot be climbed to and descended from on the "
                               "way around: {:.0f} s are missing.",
                               lacks)
                         : std::string();
      });
}

template <class T>
Fields<T> with_limits(Fields<T> fields) {
  return std::move(fields)
      .angle_deg("turn_rate_deg_per_s", [](T & t) -> auto& { return t.limits.turn_rate; },
                 "At most.", {.above = 0, .at_most = 90})
      .number("climb_mps", [](T & t) -> auto& { return t.limits.climb; },
              "At most, up and down.", {.above = 0, .at_most = 100})
      .number("acceleration_mps2", [](T & t) -> auto& { return t.limits.acceleration; },
              "At most, along its course.", {.above = 0, .at_most = 20});
}

template <class T>
std::string speed_error(const T& t) {
  return t.fastest < t.slowest ? std::string("must be at least slowest_mps.")
                               : std::string();
}

Fields<WanderingOptions> wandering_fields() {
  using T = WanderingOptions;
  constexpr Range kAltitude{.at_least = -500, .at_most = 20000};
  return with_limits(Fields<T>())
      .number("slowest_mps", &T::slowest, "Over ground, level part.", kTrafficSpeed)
      .number("fastest_mps", &T::fastest, "Over ground, level part.", kTrafficSpeed)
      .number("radius_m", &T::radius,
              "Of the disc around where it begins that its waypoints lie in.",
              kTrafficLength)
      .number("lowest_msl_m", &T::lowest, "That it flies at.", kAltitude)
      .number("highest_msl_m", &T::highest, "That it flies at.", kAltitude)
      .number("mean_leg_s", &T::mean_leg, "Mean time between two changes of mind.",
              {.at_least = 5, .at_most = 1e6})
      .rule("fastest_mps", speed_error<T>)
      .rule("highest_msl_m", [](const T& t) {
        return t.highest < t.lowest ? std::string("must be at least lowest_msl_m.")
                                    : std::string();
      });
}

struct IntruderChoice : IntruderOptions {
  std::string follows;
};

Fields<IntruderChoice> intruder_fields() {
  using T = IntruderChoice;
  return with_limits(Fields<T>())
      .text("follows", &T::follows,
            "The aircraft that it follows, such as scout-1. Empty: the first.")
      .number("slowest_mps", &T::slowest, "Over ground, level part; at the start.",
              kTrafficSpeed)
      .number("fastest_mps", &T::fastest, "Over ground, level part.", kTrafficSpeed)
      .angle_deg("course_deg", &T::course, "At the start.", kTrafficCourse)
      .number("distance_m", &T::distance, "That it keeps behind the other. 0: none.",
              {.at_least = 0, .at_most = 1e5})
      .number("above_m", &T::above, "That it keeps above the other; below: negative.",
              {.at_least = -5000, .at_most = 5000})
      .number("lead_s", &T::lead, "It aims so far ahead of the other, at most.",
              {.at_least = 0, .at_most = 600})
      .rule("fastest_mps", speed_error<T>);
}

struct RecordedChoice : RecordedFlightOptions {
  std::string file;
  std::string track;
};

Fields<RecordedChoice> recorded_flight_fields() {
  using T = RecordedChoice;
  return Fields<T>()
      .file("file", &T::file,
            "A table of places by time, or a log of ADS-B; docs/traffic.md has the "
            "columns.")
      .required()
      .text("track", &T::track,
            "Which aircraft of the log, by its id. Empty: the first, and those after it "
            "for "
            "the others of the group.")
      .number("gap_s", &T::gap, "Longer without a place, it is not there meanwhile.",
              {.above = 0, .at_most = 1e6});
}

const exchange::LoggedFlight* find_track(const exchange::TrafficLog& log,
                                         const std::string& track, std::size_t index) {
  if (track.empty()) return index < log.flights.size() ? &log.flights[index] : nullptr;
  for (const exchange::LoggedFlight& each : log.flights)
    if (each.id == track) return &each;
  return nullptr;
}

Error bad_traffic(const char* key, std::string message) {
  return {ErrorCode::kBadInput, key, std::move(message), ""};
}

using SharedLog = std::shared_ptr<const exchange::TrafficLog>;

// What of a log was passed over.
void note_log(const exchange::TrafficLog& log, const std::string& file,
              std::vector<std::string>& warnings) {
  if (log.repeated > 0)
    warnings.push_back(
        fmt::format("{}: {} rows repeat an old position, left out.", file, log.repeated));
  if (log.barometric > 0)
    warnings.push_back(
        fmt::format("{}: {} rows are flown by barometric altitude; most rows of their "
                    "aircraft have no other.",
                    file, log.barometric));
  if (log.other_datum > 0)
    warnings.push_back(fmt::format(
        "{}: {} rows lack the altitude that their aircraft is flown by (geometric or "
        "barometric), left out.",
        file, log.other_datum));
  if (log.far > 0)
    warnings.push_back(fmt::format(
        "{}: {} rows lie over {:.0f} km from the origin (up to {:.0f} km), left out.",
        file, log.far, geo::kMaxPlaceDistance / 1000, log.farthest / 1000));
  if (!log.ignored.empty())
    warnings.push_back(fmt::format("{}: columns without a meaning here: {}.", file,
                                   fmt::join(log.ignored, ", ")));
}

std::string span_text(double start_unix, double first, double last) {
  const auto utc = [&](double time) {
    return scenario::utc_text(static_cast<std::int64_t>(std::floor(start_unix + time)));
  };
  return fmt::format("{} to {}", utc(first), utc(last));
}

// A flight wholly before or after the run is never there.
void note_times(const exchange::LoggedFlight& flight, const TrafficContext& c) {
  const double first = flight.places.front().time, last = flight.places.back().time;
  if (!c.warnings || (first <= c.duration && last >= 0)) return;
  const auto start = scenario::parse_utc(c.start_utc);
  const double start_unix = start ? static_cast<double>(*start) : 0;
  c.warnings->push_back(fmt::format(
      "traffic {}: it is never there: its log covers {}, the run {}; is start_utc right?",
      c.name, span_text(start_unix, first, last), span_text(start_unix, 0, c.duration)));
}

// Read once for a group.
Result<SharedLog> log_of(const RecordedChoice& o, const TrafficContext& c) {
  if (const auto* known = c.shared ? std::any_cast<SharedLog>(c.shared) : nullptr)
    return *known;
  const auto start = scenario::parse_utc(c.start_utc);
  auto read = exchange::read_traffic_log(
      o.file, {c.frame, start ? static_cast<double>(*start) : 0});
  if (!read) return read.error();
  SharedLog log = std::make_shared<const exchange::TrafficLog>(std::move(read).value());
  if (c.warnings) note_log(*log, o.file, *c.warnings);
  if (c.shared) *c.shared = log;
  return log;
}

Result<std::unique_ptr<TrafficAircraft>> recorded_flight(const RecordedChoice& o,
                                                         const TrafficContext& c) {
  if (!o.track.empty() && c.count > 1)
    return bad_traffic("track",
                       fmt::format("is one aircraft, and the group has {}.", c.count));
  const auto read = log_of(o, c);
  if (!read) return read.error();
  const exchange::TrafficLog& log = *read.value();
  const exchange::LoggedFlight* flight = find_track(log, o.track, c.index);
  if (!flight)
    return o.track.empty()
               ? bad_traffic("file", fmt::format("has {} aircraft; the group has {}.",
                                                 log.flights.size(), c.count))
               : bad_traffic("track",
                             fmt::format("the log has no \"{}\"; its first is \"{}\".",
                                         o.track, log.flights.front().id));
  note_times(*flight, c);
  std::vector<RecordedPlace> places;
  for (const exchange::LoggedPlace& each : flight->places)
    places.push_back({each.time, each.p_N});
  auto made = std::make_unique<RecordedFlight>(std::move(places), o);
  const RecordedFaults faults = made->faults();
  if (c.warnings && faults.jumps + faults.gaps > 0)
    c.warnings->push_back(fmt::format(
        "traffic {}: the log has {} jumps and {} gaps; it is not there in gaps.", c.name,
        faults.jumps, faults.gaps));
  return std::unique_ptr<TrafficAircraft>(std::move(made));
}

}  // namespace

Kinds<TrafficAircraft, TrafficContext> traffic_kinds() {
  using Made = Result<std::unique_ptr<TrafficAircraft>>;
  Kinds<TrafficAircraft, TrafficContext> kinds("traffic");
  kinds.add("straight", "Straight on, with turns and climbs at given times.",
            straight_fields(),
            [](const StraightFlightOptions& o, const TrafficContext& c) {
              return std::make_unique<StraightFlight>(c.begin, o);
            });
  kinds.add("circuit", "An aerodrome's circuit or a racetrack, again and again.",
            circuit_fields(), [](const CircuitOptions& o, const TrafficContext& c) {
              return std::make_unique<CircuitFlight>(
                  c.begin, o,
                  static_cast<double>(c.index) / static_cast<double>(c.count));
            });
  kinds.add("recorded", "As was recorded: from a table or a log of ADS-B.",
            recorded_flight_fields(), recorded_flight);
  kinds.add("wandering",
            "A pilot that ignores everybody: random waypoints, turns and climbs.",
            wandering_fields(), [](const WanderingOptions& o, const TrafficContext& c) {
              return std::make_unique<WanderingFlight>(c.begin, o, c.seed, c.traffic);
            });
  kinds.add("intruder", "Follows an aircraft, whatever that one does.", intruder_fields(),
            [](const IntruderChoice& o, const TrafficContext& c) -> Made {
              const std::optional<EntityId> whom = c.find(o.follows);
              if (!whom)
                return bad_traffic(
                    "follows",
                    o.follows.empty()
                        ? std::string("there are no aircraft.")
                        : fmt::format("there is no aircraft \"{}\".", o.follows));
              return std::unique_ptr<TrafficAircraft>(
                  std::make_unique<IntruderFlight>(c.begin, o, *whom));
            });
  return kinds;
}

}  // namespace skein::assemble
