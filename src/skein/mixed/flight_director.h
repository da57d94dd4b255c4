// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "skein/base/time.h"
#include "skein/data/vehicle/vehicle_report.h"
#include "skein/data/vehicle/vehicle_request.h"
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
///   bring_back() sends it home, or down where it is, and leaves it on the ground
///
/// What is refused is reported with the command and the reason (take-off-denied,
/// request-denied): once, and again when the reason is another, but none more often than
/// once a minute. What was armed for a take-off that is then refused is disarmed.
///
/// Whoever else takes it has it until it is given back (ControlMonitor): nothing is asked
/// for meanwhile.
class FlightDirector {
 public:
  explicit FlightDirector(bool hovers) : hovers_(hovers), control_(hovers) {}

  void take_off(const TakeOffRequest& request);
  void fly();
  void land(const LandRequest& request);
  /// It cannot be commanded. Nothing else is asked of it for the rest of the run but to
  /// land.
  void bring_back(const std::string& why);

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
  double climbs_to() const { return take_off_.altitude_msl; }
  bool brings_back() const { return goal_ == Goal::kBringBack; }
  /// Why it is brought back, for people.
  const std::string& why_back() const { return brought_back_; }
  /// It flies, nobody else has it, and it has taken a command before: whether it goes on
  /// to do so matters.
  bool leads(const VehicleCondition& condition) const {
    return up_ && !control_.is_taken() && accepted_ && condition.armed &&
           !condition.on_ground && (goal_ == Goal::kTakeOff || goal_ == Goal::kFly);
  }
  bool landing() const { return goal_ == Goal::kLand; }

 private:
  enum class Goal : std::uint8_t { kNone, kTakeOff, kFly, kLand, kBringBack };

  void set_goal(Goal goal);
  void begin_again();
  void step_take_off(Time now, const VehicleCondition& condition, double altitude_msl,
                     VehiclePort& port);
  void step_flight(Time now, const VehicleCondition& condition, VehiclePort& port);
  void step_landing(Time now, const VehicleCondition& condition, VehiclePort& port);
  void step_bring_back(Time now, const VehicleCondition& condition, VehiclePort& port);
  void watch_stand(Time now, const VehicleCondition& condition);
  void refused(const std::string& reason, Time now, std::vector<VehicleEvent>& events);
  void not_brought_back(const std::string& reason, std::vector<VehicleEvent>& events);
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
  std::string denied_;  // the last reason
  std::map<std::pair<EventKind, std::string>, Time>
      said_;                          // when reported last, by reason
  int denials_ = 0;                   // in a row
  bool accepted_ = false;             // it has taken a command, some time
  bool armed_before_ = false;         // when a take-off was asked for
  bool disarm_ = false;               // a take-off was refused after arming
  std::optional<Time> stands_since_;  // armed for a take-off that was accepted
  std::string pending_event_;         // a reason that was found in a step
  std::string brought_back_;          // why
  std::string not_back_;              // the first refusal of what brings it back
  bool lands_next_ = false, not_back_said_ = false;
};

}  // namespace skein::mixed
