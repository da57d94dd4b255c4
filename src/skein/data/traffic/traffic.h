// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "skein/base/id.h"
#include "skein/base/time.h"
#include "skein/data/describe/describe.h"
#include "skein/geo/vec.h"

// Other air traffic: aircraft that belong to nobody who takes part. What they do, what
// sensors say of them, and what is believed of them on board.

namespace skein {

/// What an aircraft carries by which others may notice it.
enum class Transmitter : std::uint8_t { kAdsB, kFlarm, kTransponder };

constexpr auto names_of(const Transmitter*) {
  return std::to_array<std::string_view>({"ads-b", "flarm", "transponder"});
}

struct Transmitters {
  bool ads_b = false;
  bool flarm = false;
  bool transponder = false;

  friend constexpr bool operator==(const Transmitters&, const Transmitters&) = default;
};

constexpr auto describe(const Transmitters*) {
  using T = Transmitters;
  return described<T>({"transmitters"}, "What an aircraft carries to be noticed by.",
                      field("ads_b", &T::ads_b, "it broadcasts its place by ADS-B"),
                      field("flarm", &T::flarm, "the same by FLARM"),
                      field("transponder", &T::transponder, "it answers radars"));
}

/// Those of a list.
inline Transmitters transmitters(std::span<const Transmitter> list) {
  Transmitters all;
  for (const Transmitter each : list) {
    all.ads_b |= each == Transmitter::kAdsB;
    all.flarm |= each == Transmitter::kFlarm;
    all.transponder |= each == Transmitter::kTransponder;
  }
  return all;
}

/// The address that an aircraft that takes part sends, 24 bits.
constexpr std::uint32_t team_address(EntityId id) {
  return (id.value + 1) & 0xFFFFFF;
}

/// Another aircraft.
struct AirTraffic {
  std::uint32_t id = 0;
  std::string name;
  std::string flight;         ///< kind of its behaviour
  std::uint32_t address = 0;  ///< that it sends, 24 bits
  Transmitters sends = {};
};

constexpr auto describe(const AirTraffic*) {
  using T = AirTraffic;
  return described<T>({"air_traffic", "traffic"},
                      "An aircraft that belongs to nobody who takes part (traffic).",
                      field("traffic_id", &T::id, "which"),
                      field("name", &T::name, "as the scenario has it"),
                      field("flight", &T::flight, "kind of its behaviour"),
                      field("address", &T::address, "that it sends"),
                      field("", &T::sends, "what it carries"));
}

/// Whether other traffic is there.
enum class TrafficPhase : std::uint8_t {
  kAbsent,  ///< before it comes and after it has left
  kFlies,
  kGap,     ///< its record says nothing of this time: it is not there
  kJumped,  ///< it flies, and its record has just set it somewhere else
};

constexpr auto names_of(const TrafficPhase*) {
  return std::to_array<std::string_view>({"absent", "flies", "gap", "jumped"});
}

constexpr bool is_there(TrafficPhase phase) {
  return phase == TrafficPhase::kFlies || phase == TrafficPhase::kJumped;
}

/// Where another aircraft truly is at one time, and how it flies on.
struct TrafficMotion {
  Time time;
  std::uint32_t traffic = 0;     ///< AirTraffic::id
  Vec3 position = Vec3::Zero();  ///< [m]
  Vec3 velocity = Vec3::Zero();  ///< over ground [m/s]
  TrafficPhase phase = TrafficPhase::kFlies;

  /// Where it is at another time, if it goes on like this [m].
  Vec3 at(Time now) const { return position + (now - time).seconds() * velocity; }
};

constexpr auto describe(const TrafficMotion*) {
  using T = TrafficMotion;
  return described<T>(
      {"traffic_motion", "traffic_motions"},
      "How another aircraft truly flies from now on, until the next of its rows (off by "
      "less than 0.5 m).",
      field("time", &T::time, "from when on"), field("traffic_id", &T::traffic, "which"),
      field("", &T::position, axes::kPlace, "then"),
      field("", &T::velocity, axes::kVelocity, "over ground"),
      field("phase", &T::phase, "whether it is there"));
}

/// An aircraft as sensors for traffic may find it now: other traffic, or one that takes
/// part.
struct VisibleAircraft {
  Vec3 p_N = Vec3::Zero();  ///< [m]
  Vec3 v_N = Vec3::Zero();  ///< over ground [m/s]
  std::uint32_t address = 0;
  Transmitters sends = {};
  std::optional<EntityId> entity = {};  ///< of one that takes part
};

/// Another aircraft says where it is: ADS-B, FLARM.
struct TrafficBroadcast {
  Time time;
  std::uint32_t address = 0;  ///< of the sender, 24 bits
  Transmitter by = Transmitter::kAdsB;
  Vec3 p_N = Vec3::Zero();  ///< [m]
  Vec3 v_N = Vec3::Zero();  ///< over ground [m/s]
  double position_sd = 0;   ///< as the sender states it, per horizontal axis [m]
  double altitude_sd = 0;   ///< [m]
  double velocity_sd = 0;   ///< per axis [m/s]
};

constexpr auto describe(const TrafficBroadcast*) {
  using T = TrafficBroadcast;
  return described<T>(
      {"traffic_broadcast"}, "Another aircraft says where it is.",
      field("time", &T::time, "when it was there"),
      field("address", &T::address, "of the sender"),
      field("by", &T::by, "how it was sent"), field("", &T::p_N, axes::kPlace, "where"),
      field("", &T::v_N, axes::kVelocity, "over ground"),
      field("position_sd", &T::position_sd, unit::kMetre, "per horizontal axis"),
      field("altitude_sd", &T::altitude_sd, unit::kMetre, "of the altitude"),
      field("velocity_sd", &T::velocity_sd, unit::kMetrePerSecond, "per axis"));
}

/// A radar on board has found an aircraft.
struct RadarPlot {
  Time time;
  double range = 0, range_sd = 0;          ///< [m]
  double bearing = 0, bearing_sd = 0;      ///< from the nose, to the right, level [rad]
  double elevation = 0, elevation_sd = 0;  ///< above the horizon [rad]
};

constexpr auto describe(const RadarPlot*) {
  using T = RadarPlot;
  return described<T>(
      {"radar_plot"}, "A radar on board has found an aircraft.",
      field("time", &T::time, "when it was measured"),
      field("range", &T::range, unit::kMetre, "to it"),
      field("range_sd", &T::range_sd, unit::kMetre, "of the range"),
      field("bearing", &T::bearing, unit::kDegree, "from the nose, to the right"),
      field("bearing_sd", &T::bearing_sd, unit::kDegree, "of the bearing"),
      field("elevation", &T::elevation, unit::kDegree, "above the horizon"),
      field("elevation_sd", &T::elevation_sd, unit::kDegree, "of the elevation"));
}

/// A passive detector has received a transponder: coarse range and bearing.
struct TransponderContact {
  Time time;
  double range = 0, range_sd = 0;      ///< [m]
  double bearing = 0, bearing_sd = 0;  ///< from the nose, to the right, level [rad]
  /// Above the own altitude [m]; none: the transponder did not say its own.
  std::optional<double> height = {};
  double height_sd = 0;  ///< [m]
};

constexpr auto describe(const TransponderContact*) {
  using T = TransponderContact;
  return described<T>(
      {"transponder_contact"}, "A passive detector has received a transponder.",
      field("time", &T::time, "when it was measured"),
      field("range", &T::range, unit::kMetre, "to it, by its strength"),
      field("range_sd", &T::range_sd, unit::kMetre, "of the range"),
      field("bearing", &T::bearing, unit::kDegree, "from the nose, to the right"),
      field("bearing_sd", &T::bearing_sd, unit::kDegree, "of the bearing"),
      field("height", &T::height, unit::kMetre,
            "above the own altitude; null: not known"),
      field("height_sd", &T::height_sd, unit::kMetre, "of the height"));
}

/// What says where another aircraft is.
enum class TrafficSource : std::uint8_t {
  kBroadcast,  ///< the aircraft itself (ADS-B, FLARM)
  kRadar,      ///< range, bearing and elevation
  kPassive,    ///< its transponder's signal: coarse bearing and range
};
inline constexpr int kTrafficSources = 3;

/// What is believed on board of another aircraft.
struct TrafficBelief {
  std::uint32_t track = 0;                    ///< number on board, never used again
  std::optional<std::uint32_t> address = {};  ///< that it has sent
  Vec3 position = Vec3::Zero();               ///< [m]
  Vec3 velocity = Vec3::Zero();               ///< [m/s]
  double horizontal_sd = 0;                   ///< in the worst direction [m]
  double vertical_sd = 0;                     ///< [m]
  double velocity_sd = 0;                     ///< on the worst axis [m/s]
  std::uint32_t updates = 0;                  ///< measurements of it so far
  bool firm = false;                          ///< it may be acted on
  // Sources that have said something of it in the last 10 s:
  bool by_broadcast = false, by_radar = false, by_passive = false;
  Time measured;  ///< when its last measurement was
};

constexpr auto describe(const TrafficBelief*) {
  using T = TrafficBelief;
  return described<T>(
      {"traffic_belief"}, "What is believed on board of another aircraft.",
      field("track", &T::track, "its number on board"),
      field("address", &T::address, "that it has sent; null: none"),
      field("", &T::position, axes::kPlace, "where it is believed to be"),
      field("", &T::velocity, axes::kVelocity, "how it is believed to fly"),
      field("horizontal_sd", &T::horizontal_sd, unit::kMetre, "in the worst direction"),
      field("vertical_sd", &T::vertical_sd, unit::kMetre, "of the altitude"),
      field("velocity_sd", &T::velocity_sd, unit::kMetrePerSecond, "on the worst axis"),
      field("updates", &T::updates, "measurements of it so far"),
      field("firm", &T::firm, "it may be acted on"),
      field("by_broadcast", &T::by_broadcast, "heard by ADS-B or FLARM, of late"),
      field("by_radar", &T::by_radar, "seen by radar, of late"),
      field("by_passive", &T::by_passive, "heard by a passive detector, of late"),
      field("measured", &T::measured, "when its last measurement was"));
}

}  // namespace skein
