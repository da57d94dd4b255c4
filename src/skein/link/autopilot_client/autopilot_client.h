// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "skein/base/time.h"
#include "skein/data/vehicle/vehicle_report.h"
#include "skein/geo/local_frame.h"
#include "skein/link/autopilot_client/clock_alignment.h"
#include "skein/link/autopilot_client/command_sender.h"
#include "skein/link/autopilot_client/identity_watch.h"
#include "skein/link/autopilot_client/position_history.h"
#include "skein/link/autopilot_client/setpoint_sender.h"
#include "skein/link/autopilot_client/telemetry.h"
#include "skein/link/autopilot_client/telemetry_requests.h"
#include "skein/link/mavlink/frame.h"
#include "skein/link/mavlink/sequence_watch.h"
#include "skein/link/vehicle_services/outbox.h"

namespace skein::autopilot_client {

using vehicle_services::Channel;
using vehicle_services::Outbox;

struct AutopilotClientOptions {
  std::uint8_t system = 1;  ///< of the vehicle
  /// What it must be; another that answers with its number is not commanded.
  bool hovers = false;
  double rate = 10;                      ///< of its motion [Hz]
  Time silence = Time::from_seconds(3);  ///< then its link is down
  /// Where it is to be before it is first commanded; none: anywhere.
  std::optional<StartArea> start = std::nullopt;
  std::int64_t unix_ns = 0;  ///< since 1970, at time 0 of this end's clock
};

/// The far end of a link to one vehicle with an autopilot of ArduPilot, PX4 or a make
/// that behaves like them: heartbeats, clocks, telemetry, requests until they are
/// answered, setpoints.
///
/// Knows no sockets: frames are handed in with the channel that they came by, what goes
/// out goes to an Outbox. Times are of one clock that never goes back.
///
/// What it does about
///   - silence: the link is down, what waits for an answer is given up; heard again, it
///     is up, and set up anew;
///   - a reboot (the vehicle's clock goes back): reported, set up anew;
///   - another vehicle under its number: reported once; one of another airframe is not
///     commanded; of two at once the first counts, and by one channel, where nobody can
///     tell them apart, neither is commanded (IdentityWatch); one vehicle that is heard
///     by two links is led by the first;
///   - a vehicle of another number in its place, or none at all: reported once;
///   - a clock that answers are given by and telemetry is not, or that is set: reported,
///     aligned again;
///   - a position that jumps: reported;
///   - a vehicle that is not where it is to begin: it is not commanded, and is said once;
///   - a take-off, or arming: denied while its check fails (check_preflight), with the
///     items that fail.
class AutopilotClient {
 public:
  AutopilotClient(const AutopilotClientOptions& options, const geo::LocalFrame& frame);

  std::uint8_t system() const { return options_.system; }

  /// A peer by which the vehicle may be reached.
  /// @param exposed  it is beyond this machine and frames are not signed: whoever gets
  ///                 there may speak for the vehicle, which is said with the link.
  void open(Channel channel, bool exposed = false) {
    channels_.insert(channel);
    if (exposed) exposed_.insert(channel);
  }
  void close(Channel channel);

  /// Takes in a frame of its vehicle; passes over those of others.
  void receive(const mavlink::Frame& frame, Channel from, Time now, Outbox& out);

  /// Takes in a frame of a vehicle that nobody here expects, heard where this one is to
  /// be.
  void receive_other(const mavlink::Frame& frame, Time now);

  /// Puts a request to the vehicle.
  /// @param number  comes back with its answer; 0: no answer is wanted.
  void request(std::uint32_t number, const VehicleRequest& request, Time now,
               Outbox& out);

  /// Sends what is due. To be called every 20 ms or so.
  void step(Time now, Outbox& out);

  /// What has been learnt since the last call, in order.
  std::vector<VehicleReport> take_reports();

  bool up() const { return up_; }
  /// The channel by which the vehicle is heard; none while the link is down.
  std::optional<Channel> channel() const {
    return up_ ? std::optional(*channel_) : std::nullopt;
  }
  /// Of the vehicle's frames.
  const mavlink::SequenceWatch& sequence() const { return sequence_; }
  /// What it was sent of a virtual world, but for traffic.
  const FeedHealth& feeds() const { return feeds_; }
  double round_trip() const { return clock_.shortest_round_trip(); }

 private:
  struct Handler;

  bool accepts(const mavlink::Frame& frame, Channel from, Time now);
  void compare_other(const mavlink::Frame& frame, Time now);
  void hear_heartbeat(const mavlink::Heartbeat& heartbeat, Channel from, Time now);
  void hear_clock(Time boot, Time now);
  void hear_answer(const mavlink::Timesync& answer, Time now);
  void hear_position(const mavlink::GlobalPositionInt& position, Time now);
  void report_event(EventKind kind, std::string text);
  PreflightResult check(Time now) const;
  bool admits(std::uint32_t number, const VehicleRequest& request, Time now);
  void say_absence(Time now);
  void note_double(const std::optional<std::string>& found, Time now);
  void hear_text(const mavlink::Statustext& text, Time now);
  void hear_identity(const mavlink::AutopilotVersion& version);
  void come_up(const std::string& text);
  void go_down(const std::string& why);
  void set_up(Time now);
  void report_condition(Time now);
  void report_change(LinkChange::Kind kind, std::string text);
  void request_fence(std::uint32_t number, const FenceUpload& fence);
  void refuse(std::uint32_t number, RequestAnswer::Outcome outcome, std::string why);
  void step_requests(Time now, Outbox& out);
  bool ours() const { return !mismatched_ && !ambiguous_ && !two_speak_; }
  // In flight: it is where it is to be when it is first commanded.
  bool placed() const {
    return commanded_ || telemetry_.condition().on_ground || positions_.is_in_place();
  }

  AutopilotClientOptions options_;
  geo::LocalFrame frame_;
  Telemetry telemetry_;
  ClockAlignment clock_;
  CommandSender commands_;
  CommandSender fences_;  // beside them: commands do not wait for a long fence
  TelemetryRequests set_ups_;
  SetpointSender setpoints_;
  PositionHistory positions_;
  FeedHealth feeds_;
  mavlink::SequenceWatch sequence_;
  IdentityWatch identity_;
  bool two_speak_ = false;  // as IdentityWatch has it
  Time duplicate_at_;       // a sign of it, last
  std::set<Channel> channels_, exposed_;
  std::optional<Channel> channel_;  // by which it is heard
  bool up_ = false, mismatched_ = false, duplicate_ = false;
  bool ambiguous_ = false;  // two answer by one channel
  bool commanded_ = false;  // it has accepted something, so it began where it was to
  bool other_clock_said_ = false, absence_said_ = false;
  Time came_up_;
  std::optional<double> trip_;  // of the last answer about time, since it came up [s]
  int other_clock_ = 0;         // answers in a row by another clock than the telemetry's
  std::set<std::uint8_t> others_;    // numbers heard in its place
  std::optional<Time> other_since_;  // the first of them
  std::optional<Time> begun_;        // the first step
  std::optional<Time> clock_set_at_;
  std::uint32_t failed_ = 0;  // items of the check, and what was said of them
  std::string failed_text_;
  bool was_up_ = false;
  Time heard_;                // last
  Time position_;             // last
  Time set_up_;               // last
  std::optional<Time> boot_;  // the vehicle's clock, last
  std::optional<Time> rebooted_;
  std::set<std::uint64_t> uids_;  // of boards that answered
  std::string identified_;        // reported
  std::uint64_t capabilities_ = 0;
  std::uint32_t version_ = 0;
  Time heartbeat_due_, timesync_due_, condition_due_;
  Time heartbeat_;
  VehicleCondition reported_;
  std::uint32_t mode_ = 0;  // as its make counts them, of the last heartbeat
  std::string complaint_;   // the last text of weight
  Time complained_;
  std::string long_text_;  // of several parts
  std::vector<VehicleReport> reports_;
};

}  // namespace skein::autopilot_client
