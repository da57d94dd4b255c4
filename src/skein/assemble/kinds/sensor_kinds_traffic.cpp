// SPDX-License-Identifier: Apache-2.0
// What finds other aircraft: one row each.

#include "skein/assemble/kinds/sensor_kinds.h"
#include "skein/layer/sensory/passive_detector.h"
#include "skein/layer/sensory/traffic_radar.h"
#include "skein/layer/sensory/traffic_receiver.h"

namespace skein::assemble {
namespace {

using scenario::Fields;

struct AdsBChoice : sensory::TrafficReceiverOptions {};

struct FlarmChoice : sensory::TrafficReceiverOptions {
  FlarmChoice() {
    hears = Transmitter::kFlarm;
    range = 5000;
    reception = 0.9;
    best_position_sd = 3;
    worst_position_sd = 10;
    altitude_sd = 8;
    velocity_sd = 0.5;
  }
};

template <class T>
Fields<T> receiver_fields() {
  return sampled<T>()
      .number("range_m", &T::range, "Furthest sender that it hears.",
              {.above = 0, .at_most = 1e6})
      .number("reception", &T::reception,
              "Probability that a broadcast in range is received.", kProbability)
      .number(
          "best_position_sd_m", &T::best_position_sd,
          "Of senders' positions per horizontal axis: each sender has one of its own, "
          "from this one",
          {.above = 0, .at_most = 1e4})
      .number("worst_position_sd_m", &T::worst_position_sd, "to this one.",
              {.above = 0, .at_most = 1e4})
      .number("altitude_sd_m", &T::altitude_sd, "Of their altitudes.",
              {.above = 0, .at_most = 1e4})
      .number("velocity_sd_mps", &T::velocity_sd, "Of their velocities per axis.",
              {.above = 0, .at_most = 1e3})
      .rule("worst_position_sd_m", [](const T& t) {
        return t.worst_position_sd < t.best_position_sd
                   ? std::string("must be at least best_position_sd_m.")
                   : std::string();
      });
}

Fields<sensory::TrafficRadarOptions> radar_fields() {
  using T = sensory::TrafficRadarOptions;
  constexpr scenario::Range kAngle{.above = 0, .at_most = 45};
  return sampled<T>()
      .number("range_m", &T::range, "Furthest it sees.", {.above = 0, .at_most = 1e6})
      .angle_deg("width_deg", &T::width, "Field of view across, about the nose.",
                 {.above = 0, .at_most = 360})
      .angle_deg("height_deg", &T::height, "Field of view up and down.",
                 {.above = 0, .at_most = 180})
      .number("detection", &T::detection,
              "Probability that an aircraft in view is found, per scan.", kProbability)
      .number("range_sd_m", &T::range_sd, "Of the range.", {.above = 0, .at_most = 1e4})
      .angle_deg("bearing_sd_deg", &T::bearing_sd, "Of the bearing.", kAngle)
      .angle_deg("elevation_sd_deg", &T::elevation_sd, "Of the elevation.", kAngle);
}

Fields<sensory::PassiveDetectorOptions> passive_fields() {
  using T = sensory::PassiveDetectorOptions;
  return sampled<T>()
      .number("range_m", &T::range, "Furthest transponder that it hears.",
              {.above = 0, .at_most = 1e6})
      .number("detection", &T::detection,
              "Probability that a transponder in range is found, per look.", kProbability)
      .number("range_sd", &T::range_sd, "Of the range, as a share of it.",
              {.above = 0, .at_most = 1})
      .angle_deg("bearing_sd_deg", &T::bearing_sd, "Of the bearing.",
                 {.above = 0, .at_most = 90})
      .number("height_sd_m", &T::height_sd, "Of the height over the own one.",
              {.above = 0, .at_most = 1e4})
      .number("height_share", &T::height_share, "Of replies that have an altitude.",
              kProbability);
}

}  // namespace

void add_traffic_sensors(Kinds<Sensor, AircraftContext>& kinds) {
  kinds.add(
      "ads-b-in", "Receives what aircraft with ADS-B say of themselves.",
      receiver_fields<AdsBChoice>(), [](const AdsBChoice& o, const AircraftContext& c) {
        return std::make_unique<sensory::TrafficReceiver>(o, c.seed, c.self, c.instance);
      });
  kinds.add("flarm", "Receives what aircraft with FLARM say of themselves, near by.",
            receiver_fields<FlarmChoice>(),
            [](const FlarmChoice& o, const AircraftContext& c) {
              constexpr std::uint32_t kFlarms = 128;  // their streams begin here
              return std::make_unique<sensory::TrafficReceiver>(o, c.seed, c.self,
                                                                kFlarms + c.instance);
            });
  kinds.add("passive", "Coarse range and bearing of aircraft with a transponder.",
            passive_fields(),
            [](const sensory::PassiveDetectorOptions& o, const AircraftContext& c) {
              return std::make_unique<sensory::PassiveDetector>(o, c.seed, c.self,
                                                                c.instance);
            });
  kinds.add(
      "radar", "Range, bearing and elevation of all that flies ahead.", radar_fields(),
      [](const sensory::TrafficRadarOptions& o, const AircraftContext& c) {
        return std::make_unique<sensory::TrafficRadar>(o, c.seed, c.self, c.instance);
      });
}

}  // namespace skein::assemble
