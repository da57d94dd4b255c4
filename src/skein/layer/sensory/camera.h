// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/base/id.h"
#include "skein/base/random.h"
#include "skein/layer/sensory/delay.h"
#include "skein/layer/sensory/sample_clock.h"
#include "skein/role/sensor.h"

namespace skein::sensory {

struct CameraOptions {
  double rate_hz = 1;                ///< pictures per second
  double latency = 0.2;              ///< [s]; with what is found in them
  double width = geo::radians(60);   ///< field of view across, left to right [rad]
  double length = geo::radians(45);  ///< field of view along, front to back [rad]
  /// Keeps it looking straight down, its top towards the nose, or at what the agent wants
  /// to see.
  bool gimbal = false;
  double max_tilt = geo::radians(60);  ///< of the gimbal, from straight down [rad]
  double range = 500;                  ///< furthest at which objects can be made out [m]
  double detection = 0.8;  ///< probability that a visible object is found, per picture
  double position_sd = 1;  ///< of a found position per axis [m]
  double direction_sd =
      geo::radians(0.6);  ///< of the direction to it; times its distance [rad]
};

/// Camera that looks along the body's down axis, so that its picture moves with roll and
/// pitch, unless a gimbal takes these out. A gimbal turns to the agent's region of
/// interest, as far as it tilts, by where the autopilot believes to be; at once, as
/// pictures are far apart for it.
///
/// The footprint is where the rays through the picture's corners meet the terrain: front
/// left, front right, back right, back left. A ray that meets nothing within the range
/// ends there. Objects on the ground are visible in the picture, within the range and
/// when no terrain is between; each visible one is found with the given probability, in
/// each picture anew, with errors of
///
///   position_sd^2 + (direction_sd distance)^2   per axis.
///
/// Corners and positions are relative to the vehicle, in the axes of N. For the agent.
class Camera final : public Sensor {
 public:
  Camera(const CameraOptions& options, std::uint64_t seed, EntityId entity,
         std::uint32_t instance = 0);

  void sample(const SensorView& view, std::vector<SensorSample>& out) override;
  bool payload() const override { return true; }
  bool finds_objects() const override { return true; }

 private:
  Quat attitude(const SensorView& view) const;  // of the camera
  FootprintSample footprint(const SensorView& view) const;
  void find_objects(const SensorView& view, std::vector<SensorSample>& out);

  CameraOptions options_;
  double right_, front_;        // of the picture's edge, at unit distance
  double cos_tilt_, sin_tilt_;  // of the furthest that the gimbal tilts
  SampleClock clock_;
  Delay<FootprintSample> footprints_;
  Delay<DetectionSample> detections_;
  RandomStream random_;
};

}  // namespace skein::sensory
