// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "skein/data/vehicle/air.h"
#include "skein/layer/autopilot/estimator/flight_estimator.h"
#include "skein/layer/autopilot/skein/fixed_wing_controller.h"
#include "skein/layer/autopilot/skein/land_detector.h"
#include "skein/layer/autopilot/skein/multirotor_controller.h"
#include "skein/layer/autopilot/skein/point_controller.h"
#include "skein/layer/autopilot/skein/sensor_selector.h"
#include "skein/layer/autopilot/skein/skein_setup.h"
#include "skein/role/autopilot.h"

namespace skein::autopilot {

/// Skein's own autopilot, for fixed wings, multirotors and plants that hold their own
/// attitude.
///
/// Each control step: the estimator's state -> modes and failsafes decide who flies and
/// by which order -> guidance -> control. It sees its sensors only. With an
/// ideal-navigation sensor the state is what that says, and the estimator costs nothing.
///
/// Commands that cannot be flown are refused (AutopilotStatus::refused), and what was
/// flown goes on. Until the first command it holds where it is; on the ground it stands.
///
/// Returns and landings of failsafes, and returns that the agent commands, lead along the
/// route of set_return(), which holds until another is set; so does what it takes to get
/// home.
class SkeinAutopilot final : public Autopilot {
 public:
  /// @param initial     where and how the flight begins: home is there.
  /// @param ground_msl  the ground at home [m]; none: where it begins.
  SkeinAutopilot(std::shared_ptr<const SkeinSetup> setup, const NavEstimate& initial,
                 bool on_ground, std::optional<double> ground_msl = std::nullopt);

  /// Home stays where it is, and the agent's last command is flown again from its
  /// beginning: agents may command only once.
  void begin(const NavEstimate& start, bool on_ground) override;
  void sense(const SensorSample& sample) override;
  void command(const AutopilotCommand& command) override;
  void set_return(const ReturnRoute& route) override;
  Control control(Time now, double dt) override;
  NavEstimate estimate() const override { return estimator_.estimate(); }
  AutopilotStatus status() const override;

  const FlightEstimator& estimator() const { return estimator_; }
  const Decision& decision() const { return modes_.decision(); }

 private:
  using Controller =
      std::variant<FixedWingController, MultirotorController, PointController>;
  SkeinAutopilot(std::shared_ptr<const SkeinSetup> setup, const NavEstimate& initial,
                 bool on_ground, const Vec3& home_N);
  static Controller make_controller(const SkeinSetup& setup, const Vec3& home_N);

  ControllerView view() const;
  bool is_lost(FlightSensor sensor) const {
    return (lost_ >> static_cast<unsigned>(sensor) & 1u) != 0;
  }
  bool selected(const SensorSample& sample);
  bool selected(FlightSensor sensor, std::uint8_t unit, Time time);
  void take(const PowerSample& sample);
  void look_around(Time now, const NavState& nav);
  void obey(Order order, Order before, const ControllerView& now);
  void give(const AutopilotCommand& command, const ControllerView& now);
  void lead_home(const ControllerView& now);
  bool returns() const;
  bool is_landing(const NavState& nav) const;
  HomeNeed need_of_return(const NavState& nav, const HomeFlight& flight) const;
  AutopilotCommand failsafe_command(Order order, const ControllerView& now) const;
  Control fly(Order order, const ControllerView& now, double dt);
  void change_gains();

  std::shared_ptr<const SkeinSetup> setup_;
  Vec3 home_N_;  // on the ground, as far as that is known
  FlightEstimator estimator_;
  ModeLogic modes_;
  FenceWatch fence_;
  MotorWatch motors_;
  Consumption consumption_;
  LandDetector ground_;
  SensorSelector sensors_;
  Controller controller_;
  ModeInput input_;
  Order order_ = Order::kStand;
  AutopilotCommand agent_command_;
  AutopilotCommand take_off_;
  ReturnRoute return_;
  bool return_changed_ = false;
  bool powered_ = false;  // a battery monitor has been received
  Time power_time_;
  double power_charge_ = 1;
  std::uint8_t lost_ = 0;      // bit k: FlightSensor k
  std::uint8_t standing_ = 0;  // motors, as the battery monitor says
  std::uint8_t failed_ = 0;    // motors that have stood under throttle
  double throttle_ = 0;        // mean of what the motors were commanded
  Control last_;
  std::size_t lap_ = 0;  // whose gains are flown
  std::string refused_;
  int refusals_ = 0;
};

}  // namespace skein::autopilot
