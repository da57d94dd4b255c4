// SPDX-License-Identifier: Apache-2.0
// The payload, which looks at the world for the agent: one row each.

#include "skein/assemble/kinds/sensor_kinds.h"
#include "skein/layer/sensory/camera.h"
#include "skein/layer/sensory/edge_finder.h"
#include "skein/layer/sensory/fire_sensor.h"
#include "skein/layer/sensory/rangefinder.h"

namespace skein::assemble {
namespace {

using scenario::Fields;

Fields<sensory::FireSensorOptions> fire_sensor_fields() {
  using T = sensory::FireSensorOptions;
  return Fields<T>()
      .number("rate_hz", &T::rate_hz, "Readings per second.", kSensorRate)
      .number("look_ahead_m", &T::look_ahead,
              "Of the looked-at point, horizontally along the heading.", kSensorError)
      .number("max_height_m", &T::max_height,
              "Above that point; higher up there are no readings.",
              {.above = 0, .at_most = 1e5})
      .number("false_in", &T::false_in,
              "Probability of `inside` over ground that does not burn.", kProbability)
      .number("false_out", &T::false_out,
              "Probability of `outside` over ground that does.", kProbability)
      .integer("phenomenon", &T::phenomenon,
               "Which of environment.phenomena it senses, from 0. Null: all of them.",
               {.at_least = 0, .at_most = 1000});
}

Fields<sensory::EdgeFinderOptions> edge_finder_fields() {
  using T = sensory::EdgeFinderOptions;
  return Fields<T>()
      .number("rate_hz", &T::rate_hz, "Samples per second.", kSensorRate)
      .number("range_m", &T::range, "Boundaries further away are not seen.",
              {.above = 0, .at_most = 1e6})
      .integer("phenomenon", &T::phenomenon,
               "Which of environment.phenomena it sees, from 0.",
               {.at_least = 0, .at_most = 1000});
}

// What rangefinder and LiDAR have in common.
template <class T>
Fields<T> ranging() {
  return sampled<T>()
      .number("range_m", &T::range, "Furthest it sees.", {.above = 0, .at_most = 1e5})
      .number("bias_sd_m", &T::bias_sd, "Wandering error.", kSensorError)
      .duration_s("bias_time_s", &T::bias_time, "Its correlation time.", {.above = 0})
      .number("noise_sd_m", &T::noise_sd, "White.", kSensorError);
}

Fields<sensory::RangefinderOptions> rangefinder_fields() {
  using T = sensory::RangefinderOptions;
  return ranging<T>()
      .angle_deg("azimuth_deg", &T::azimuth, "Of the beam: from forward to the right.")
      .angle_deg("depression_deg", &T::depression, "Of the beam: below forward.",
                 {.at_least = -90, .at_most = 90});
}

Fields<sensory::LidarOptions> lidar_fields() {
  using T = sensory::LidarOptions;
  return ranging<T>()
      .integer("beams", &T::beams, "Evenly spaced over the field of view.",
               {.at_least = 1, .at_most = 10000})
      .angle_deg("field_of_view_deg", &T::field_of_view,
                 "From the first beam to the last.", {.at_least = 0, .at_most = 360})
      .angle_deg("depression_deg", &T::depression, "Of the middle beam: below forward.",
                 {.at_least = -90, .at_most = 90});
}

Fields<sensory::CameraOptions> camera_fields() {
  using T = sensory::CameraOptions;
  return sampled<T>()
      .angle_deg("width_deg", &T::width, "Field of view across.",
                 {.above = 0, .below = 170})
      .angle_deg("length_deg", &T::length, "Field of view along.",
                 {.above = 0, .below = 170})
      .boolean(
          "gimbal", &T::gimbal,
          "It looks straight down whatever the aircraft does, or at the target of an "
          "orbit; else it is fixed to the body and moves with roll and pitch.")
      .angle_deg("max_tilt_deg", &T::max_tilt,
                 "Of the gimbal, from straight down; 0: it always looks straight down.",
                 {.at_least = 0, .at_most = 85})
      .number("range_m", &T::range, "Furthest at which objects can be made out.",
              {.above = 0, .at_most = 1e5})
      .number("detection", &T::detection,
              "Probability that a visible object is found, per picture.", kProbability)
      .number("position_sd_m", &T::position_sd, "Of a found position per axis.",
              kSensorError)
      .angle_deg("direction_sd_deg", &T::direction_sd, "Of the direction to it.",
                 {.at_least = 0, .at_most = 45});
}

}  // namespace

void add_payload_sensors(Kinds<Sensor, AircraftContext>& kinds) {
  using Made = Result<std::unique_ptr<Sensor>>;
  kinds.add("fire", "The cheap in/out sensor: does the ground at one point burn?",
            fire_sensor_fields(),
            [](const sensory::FireSensorOptions& o, const AircraftContext& c) -> Made {
              if (o.phenomenon)
                if (auto good = check_phenomenon(*o.phenomenon, c.phenomena); !good)
                  return good.error();
              return std::unique_ptr<Sensor>(
                  std::make_unique<sensory::FireSensor>(o, c.seed, c.self, c.instance));
            });
  kinds.add("edge-finder",
            "Sees the nearest point of the true edge: a benchmark's ideal.",
            edge_finder_fields(),
            [](const sensory::EdgeFinderOptions& o, const AircraftContext& c) -> Made {
              // The first may be missing: then there is no edge.
              if (o.phenomenon > 0)
                if (auto good = check_phenomenon(o.phenomenon, c.phenomena); !good)
                  return good.error();
              return std::unique_ptr<Sensor>(std::make_unique<sensory::EdgeFinder>(o));
            });
  kinds.add("camera", "Looks down: its footprint, and objects that it finds there.",
            camera_fields(),
            [](const sensory::CameraOptions& o, const AircraftContext& c) {
              return std::make_unique<sensory::Camera>(o, c.seed, c.self, c.instance);
            });
  kinds.add("rangefinder", "Distance to the ground along one beam.", rangefinder_fields(),
            [](const sensory::RangefinderOptions& o, const AircraftContext& c) {
              return std::make_unique<sensory::Rangefinder>(o, c.seed, c.self,
                                                            c.instance);
            });
  kinds.add("lidar", "Distances to the ground along a fan of beams.", lidar_fields(),
            [](const sensory::LidarOptions& o, const AircraftContext& c) {
              return std::make_unique<sensory::Lidar>(o, c.seed, c.self, c.instance);
            });
}

}  // namespace skein::assemble
