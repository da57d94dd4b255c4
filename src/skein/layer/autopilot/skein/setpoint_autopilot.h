// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <variant>

#include "skein/layer/autopilot/skein/point_controller.h"
#include "skein/role/autopilot.h"

namespace skein::autopilot {

/// Guidance for a vehicle whose own autopilot, on board, holds attitude and altitude: it
/// says from moment to moment what that one shall fly.
///
/// Control is a FlightCommand for what needs airspeed, and a TrackSetpoint for what can
/// hover. The state comes from outside, as TruthSamples; taking off and landing are the
/// vehicle's own affair, so those commands are refused here. Returns lead along the route
/// of set_return(), its last place is where they end.
class SetpointAutopilot final : public Autopilot {
 public:
  /// @param setup    made for an airframe that holds its attitude, or a multirotor.
  /// @param initial  where and how it flies at the start: home is there.
  SetpointAutopilot(std::shared_ptr<const SkeinSetup> setup, const NavEstimate& initial);

  void begin(const NavEstimate& start, bool on_ground) override;
  void sense(const SensorSample& sample) override;
  void command(const AutopilotCommand& command) override;
  void set_return(const ReturnRoute& route) override;
  Control control(Time now, double dt) override;
  NavEstimate estimate() const override;
  AutopilotStatus status() const override;

 private:
  ControllerView view() const { return {nav_, {}, 0}; }
  AutopilotCommand led_home(const AutopilotCommand& command) const;
  TrackSetpoint setpoint(const MultirotorDemand& demand) const;

  std::shared_ptr<const SkeinSetup> setup_;
  NavState nav_;
  Vec3 home_N_;
  std::variant<PointController, MultirotorGuidance> controller_;
  AutopilotCommand command_;
  ReturnRoute return_;
  std::string refused_;
  int refusals_ = 0;
};

/// The setup for a vehicle of these limits.
/// @param airframe  a multirotor's own; anything else is taken as what holds its
///                  attitude.
std::shared_ptr<const SkeinSetup> setpoint_setup(const SkeinOptions& options,
                                                 const FlightLimits& limits,
                                                 const Airframe& airframe);

}  // namespace skein::autopilot
