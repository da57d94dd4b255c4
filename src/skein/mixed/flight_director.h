#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "skein/base/time.h"
#include "skein/data/vehicle_report.h"
#include "skein/data/vehicle_request.h"
#include "skein/mixed/control_monitor.h"
#include "skein/role/vehicle.h"
#include "skein/role/vehicle_port.h"

namespace skein::mixed {

/// Brings an outside autopilot into the mode that is needed, and notices when somebody
/// else takes it.
///
///   take_off()   arms and takes off, again every few seconds as long as that is denied
///   fly()        guided, to be led by setpoints
///   land()       lands, and disarms
///
/// Whoever else takes it has it until it is given back (ControlMonitor): nothing is asked
/// for meanwhile.
class FlightDirector {
 public:
  explicit FlightDirector(bool hovers) : hovers_(hovers), control_(hovers) {}

  void take_off(const TakeOffRequest& request);
  void fly();
  void land(const LandRequest& request);

  /// What the vehicle has said of its link.
  void hear(const LinkChange& change);
  void hear(const VehicleText& text, Time now) { control_.hear(text, now); }
  void hear(const RequestAnswer& answer, Time now, std::vector<VehicleEvent>& events);

  /// Once a step of the run: asks for what is missing.
  /// @param knows_position  else it is asked for nothing in the air.
  void step(Time now, const VehicleCondition& condition, double altitude_msl,
            bool knows_position, VehiclePort& port, std::vector<VehicleEvent>& events);

  /// Its agent shall command it again.
  /// Fails: kBadInput when its agent commands it, its link is down, or sticks fly it.
  Result<void> hand_back(std::vector<VehicleEvent>& events);
  /// Who has it.
  const ControlMonitor& control() const { return control_; }

  bool up() const { return up_; }
  /// Setpoints are of use: it is guided, or is to become so.
  bool takes_setpoints() const {
    return up_ && goal_ == Goal::kFly && !control_.is_taken();
  }
  /// It is in the mode that was asked for.
  bool reached() const { return reached_; }
  /// What was asked for is over: it has climbed, it has landed.
  bool done() const { return done_; }
  bool taking_off() const { return goal_ == Goal::kTakeOff; }
  bool landing() const { return goal_ == Goal::kLand; }

 private:
  enum class Goal : std::uint8_t { kNone, kTakeOff, kFly, kLand };

  void set_goal(Goal goal);
  void begin_again();
  void step_take_off(Time now, const VehicleCondition& condition, double altitude_msl,
                     VehiclePort& port);
  void step_flight(Time now, const VehicleCondition& condition, VehiclePort& port);
  void step_landing(Time now, const VehicleCondition& condition, VehiclePort& port);
  void ask(Time now, const VehicleRequest& request, VehiclePort& port);
  bool may_ask(Time now) const { return pending_ == 0 && now >= again_at_; }
  bool is_wanted(VehicleMode mode) const;

  bool hovers_;
  Goal goal_ = Goal::kNone;
  TakeOffRequest take_off_;
  LandRequest land_;
  bool up_ = false;
  bool asked_ = false;    // since the goal was set, or the vehicle rebooted
  bool started_ = false;  // what was asked for was accepted
  bool reached_ = false, done_ = false;
  ControlMonitor control_;
  std::uint32_t number_ = 0, pending_ = 0;  // of requests
  Time again_at_;
  std::optional<Time> on_ground_since_;
  std::string denied_;  // the last reason, reported once
};

}  // namespace skein::mixed
