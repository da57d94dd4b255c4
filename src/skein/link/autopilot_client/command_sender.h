// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "skein/base/time.h"
#include "skein/data/vehicle/vehicle_report.h"
#include "skein/link/autopilot_client/takeover_watch.h"
#include "skein/link/mavlink/constants.h"
#include "skein/link/mavlink/flight_modes.h"
#include "skein/link/mavlink/messages.h"
#include "skein/link/vehicle_services/outbox.h"

namespace skein::autopilot_client {

/// Changes a parameter; done when the vehicle says the new value, as far as a value of
/// the type that it has there can be that: integers are rounded or cut. When it keeps
/// another value, that is its answer.
struct SetParameter {
  std::string name;
  float value = 0;
  std::uint8_t type = 9;  ///< MAV_PARAM_TYPE
};

/// Waits until the vehicle says that it is in the mode that it has accepted.
struct AwaitMode {
  VehicleMode mode = VehicleMode::kGuided;
  std::string name;  ///< as its make calls it
};

/// The same, that it is armed.
struct AwaitArmed {};

/// Replaces the stored mission, or another list that is loaded up the same way.
struct SendMission {
  std::vector<mavlink::MissionItemInt> items;
  mavlink::MissionType type = mavlink::MissionType::kMission;
};

/// One part of a request: what is sent until it is answered.
using RequestStep = std::variant<mavlink::CommandLong, mavlink::CommandInt, SetParameter,
                                 SendMission, AwaitMode, AwaitArmed>;

/// A request with its steps, one after the other; the first that fails ends it.
struct NumberedRequest {
  std::uint32_t number = 0;  ///< 0: its answer interests nobody
  std::vector<RequestStep> steps;
};

/// Sends requests one after the other until each is answered.
///
/// A step that is not answered is sent again each half second, commands with a rising
/// confirmation, for six seconds and four round trips; what is in progress, and a mission
/// of which items are asked for, may take longer. All of the vehicle's protocols are
/// played by the vehicle's own rules of repetition, so that answers which come twice do
/// no harm.
///
/// A command that changes who flies (a mode, arming, take-off, landing, going to a place)
/// is sent again only after a heartbeat that was sent later than it arrived and shows
/// that it had no effect; where a heartbeat shows its effect it is done, whether or not
/// it was acknowledged. When a heartbeat shows a mode that nothing here leads to
/// (TakeoverWatch), all requests with commands are withdrawn: whoever chose that mode
/// keeps it. Only disarming by force is not: it is sent until it is answered.
///
/// The text of an answer that is no acceptance begins with the step that failed: "arm:
/// denied", "mode GUIDED: not answered in 12 tries".
class CommandSender {
 public:
  explicit CommandSender(std::uint8_t system, std::uint8_t component = 1)
      : system_(system), component_(component) {}

  /// @returns  false when too many wait already.
  bool add(NumberedRequest request);

  void handle(const mavlink::CommandAck& ack, Time now);
  void handle(const mavlink::ParamValue& value);
  /// A heartbeat has come in.
  /// @param mode_number  as the vehicle's make counts modes.
  void report(const VehicleCondition& condition, std::uint32_t mode_number, Time now);
  /// It has been reported whether the vehicle stands, which heartbeats do not say.
  void report_landed(bool on_ground, Time now);
  /// PX4 sends integers as the bits of parameters' values, others as numbers. The modes
  /// of unknown makes say nothing of who flies.
  void set_make(mavlink::Make make) { make_ = make; }
  /// From here to the vehicle and back.
  void set_round_trip(Time round_trip) { round_trip_ = round_trip; }
  void handle(const mavlink::MissionRequest& request, vehicle_services::Channel channel,
              Time now, vehicle_services::Outbox& out);
  void handle(const mavlink::MissionRequestInt& request,
              vehicle_services::Channel channel, Time now, vehicle_services::Outbox& out);
  void handle(const mavlink::MissionAck& ack);

  /// Sends what is due over the vehicle's channel.
  void step(Time now, vehicle_services::Channel channel, vehicle_services::Outbox& out);

  /// The vehicle is gone: nothing that waits will be answered.
  void abandon(const std::string& why);

  /// Answers since the last call.
  std::vector<RequestAnswer> take_answers();
  bool idle() const { return waiting_.empty(); }

 private:
  void send(Time now, vehicle_services::Channel channel, vehicle_services::Outbox& out);
  void send_item(std::uint16_t number, std::uint8_t type,
                 vehicle_services::Channel channel, Time now,
                 vehicle_services::Outbox& out);
  void begin_step();
  void await(Time now);
  bool may_repeat() const;
  bool is_shown() const;
  ModeSet leads_to() const;
  void withdraw();
  std::string name() const;
  void step_done();
  void fail(RequestAnswer::Outcome outcome, std::string text);
  template <class T>
  const T* current() const {
    return waiting_.empty() ? nullptr : std::get_if<T>(&waiting_.front().steps[place_]);
  }

  std::uint8_t system_, component_;
  std::deque<NumberedRequest> waiting_;
  std::size_t place_ = 0;     // of the step of the first that is under way
  std::optional<Time> sent_;  // that step, last
  Time patient_until_;        // for its answer
  std::uint8_t tries_ = 0;
  bool rejected_ = false;              // for now, as the vehicle said
  bool in_progress_ = false;           // the same
  std::optional<std::uint16_t> item_;  // of a mission: sent last
  std::optional<double> kept_;         // of a parameter: another value than was asked for
  int kept_times_ = 0;
  VehicleMode mode_ = VehicleMode::kOther;
  std::string mode_name_;
  bool armed_ = false;
  bool on_ground_ = true;  // until it is reported
  mavlink::Make make_ = mavlink::Make::kOther;
  TakeoverWatch takeover_;
  std::optional<Time> heartbeat_, landed_at_;  // reported last
  Time round_trip_;
  VehicleMode mode_before_ = VehicleMode::kOther;  // the step under way was first sent
  bool stood_ = false;                             // then
  std::vector<RequestAnswer> answers_;
};

}  // namespace skein::autopilot_client
