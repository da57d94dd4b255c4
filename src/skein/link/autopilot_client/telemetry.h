// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "skein/base/time.h"
#include "skein/data/vehicle/vehicle_report.h"
#include "skein/geo/local_frame.h"
#include "skein/link/autopilot_client/clock_alignment.h"
#include "skein/link/autopilot_client/preflight_check.h"
#include "skein/link/mavlink/flight_modes.h"
#include "skein/link/mavlink/messages.h"

namespace skein::autopilot_client {

/// What a vehicle's telemetry says of its motion and condition.
///
/// A motion is made with each position (GLOBAL_POSITION_INT), which has a time; attitude,
/// airspeed and wind are the newest that came before.
class Telemetry {
 public:
  explicit Telemetry(const geo::LocalFrame& frame) : frame_(frame) {}

  void handle(const mavlink::Heartbeat& m);
  void handle(const mavlink::Attitude& m);
  void handle(const mavlink::VfrHud& m);
  void handle(const mavlink::Wind& m);
  void handle(const mavlink::WindCov& m);
  void handle(const mavlink::GpsRawInt& m);
  void handle(const mavlink::SysStatus& m);
  void handle(const mavlink::ExtendedSysState& m);
  void handle(const mavlink::HomePosition& m);
  void handle(const mavlink::EkfStatusReport& m);
  void handle(const mavlink::EstimatorStatus& m);
  /// @returns  the motion; nothing until the vehicle knows where it is. When it no longer
  ///           does by satellites, its motion is that of its dead reckoning, with a
  ///           deviation that grows, and its condition says that it has no position.
  std::optional<VehicleMotion> handle(const mavlink::GlobalPositionInt& m, Time now,
                                      const ClockAlignment& clock);

  const VehicleCondition& condition() const { return condition_; }
  mavlink::Make make() const { return make_; }
  /// MAV_TYPE.
  std::uint8_t type() const { return type_; }
  bool hovers() const;
  std::uint32_t custom_mode() const { return custom_mode_; }
  /// Where the vehicle calls home, which relative altitudes count from [m].
  std::optional<double> home_msl() const { return home_msl_; }
  /// The same as a place; none while it does not say.
  const std::optional<Vec3>& home() const { return home_; }
  const PositionQuality& quality() const { return quality_; }
  /// What is left of its battery, from 0 to 1; none while it does not say.
  const std::optional<double>& charge() const { return charge_; }
  /// Its last position was about latitude and longitude 0: its estimator has no origin.
  bool at_origin() const { return at_origin_; }

 private:
  geo::LocalFrame frame_;
  VehicleCondition condition_;
  VehicleMotion motion_;
  mavlink::Make make_ = mavlink::Make::kOther;
  std::uint8_t type_ = 0;
  std::uint32_t custom_mode_ = 0;
  std::optional<double> home_msl_;
  bool landed_known_ = false;
  std::optional<Vec3> home_;
  std::optional<double> charge_;
  PositionQuality quality_;
  bool at_origin_ = false;
  bool known_ = false;  // it has known where it is
  Time known_at_;       // last
};

}  // namespace skein::autopilot_client
