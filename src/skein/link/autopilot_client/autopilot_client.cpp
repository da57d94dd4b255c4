// SPDX-License-Identifier: Apache-2.0
#include "skein/link/autopilot_client/autopilot_client.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "skein/base/valid_text.h"
#include "skein/link/autopilot_client/request_steps.h"
#include "skein/link/autopilot_client/virtual_senses.h"
#include "skein/link/mavlink/dispatch.h"

namespace skein::autopilot_client {
namespace {

using Kind = LinkChange::Kind;

constexpr std::uint8_t kAutopilotComponent = 1;
constexpr std::uint8_t kOnboardController = 18;  // MAV_TYPE
constexpr std::uint8_t kActive = 4;              // MAV_STATE
constexpr std::uint8_t kWarning = 4;             // MAV_SEVERITY
constexpr std::uint64_t kTakesAttitude = 64;     // MAV_PROTOCOL_CAPABILITY
constexpr std::uint64_t kTakesLocalTarget = 128;
constexpr std::uint64_t kTakesFence = 16384;
constexpr std::size_t kMaxText = 500;

const Time kSecond = Time::from_seconds(1);
const Time kRebootStep = Time::from_seconds(1);
const Time kDuplicateWindow = Time::from_seconds(5);
const Time kOneAgain = Time::from_seconds(10);  // of a clock that only goes forth
const Time kFreshComplaint = Time::from_seconds(4);
const Time kAltitudePeriod = Time::from_seconds(0.5);
constexpr double kAltitudeStep = 0.5;             // demanded anew at once [m]
constexpr double kAirspeedStep = 0.3;             // [m/s]
const Time kRateWindow = Time::from_seconds(5);   // of positions
const Time kHomePeriod = Time::from_seconds(10);  // asked for while it is not known
const Time kAbsence = Time::from_seconds(10);     // then it is said that nobody is there
const Time kOtherAlone = Time::from_seconds(3);   // a vehicle of another number
constexpr int kOtherClockAnswers = 3;             // in a row
const Time kTripWait = Time::from_seconds(10);    // for an answer about time
// A position that is further from where the last one leads has jumped.
constexpr double kJumpDistance = 50;             // and what it flies in a second [m]
constexpr double kJumpSpeed = 20;                // and so much more for each second [m/s]
const Time kJumpWindow = Time::from_seconds(5);  // after more nobody knows

// Telemetry that is asked for: the message, and its rate over the rate of the motion.
struct Stream {
  std::uint32_t message;
  double rate;  // [Hz]; 0: that of the motion
};
constexpr Stream kStreams[] = {
    {mavlink::kFacts<mavlink::GlobalPositionInt>.id, 0},
    {mavlink::kFacts<mavlink::Attitude>.id, 0},
    {mavlink::kFacts<mavlink::VfrHud>.id, 2},
    {mavlink::kFacts<mavlink::SysStatus>.id, 1},
    {mavlink::kFacts<mavlink::GpsRawInt>.id, 2},
    {mavlink::kFacts<mavlink::ExtendedSysState>.id, 2},
    {mavlink::kFacts<mavlink::MissionCurrent>.id, 1},
    {mavlink::kFacts<mavlink::SystemTime>.id, 1},
    {mavlink::kFacts<mavlink::HomePosition>.id, 0.5},
};

bool is_vehicle(const mavlink::Heartbeat& heartbeat) {
  constexpr std::uint8_t kNoVehicles[] = {5, 6, 18, 26, 27, 30};  // tracker, GCS, ...
  for (const std::uint8_t type : kNoVehicles)
    if (heartbeat.type == type) return false;
  return heartbeat.autopilot != mavlink::kAutopilotInvalid;
}

std::string name_of(mavlink::Make make) {
  switch (make) {
    case mavlink::Make::kArduPilot:
      return "ArduPilot";
    case mavlink::Make::kPx4:
      return "PX4";
    case mavlink::Make::kOther:
      return "an autopilot of another make";
  }
  return {};
}

Time from_ms(std::uint32_t ms) {
  return Time::from_ns(std::int64_t{ms} * 1'000'000);
}

}  // namespace

AutopilotClient::AutopilotClient(const AutopilotClientOptions& options,
                                 const geo::LocalFrame& frame)
    : options_(options),
      frame_(frame),
      telemetry_(frame),
      commands_(options.system),
      fences_(options.system),
      set_ups_(options.system) {}

void AutopilotClient::close(Channel channel) {
  channels_.erase(channel);
  exposed_.erase(channel);
  if (channel_ != channel) return;
  channel_.reset();
  if (up_) go_down("its connection was closed");
}

void AutopilotClient::report_change(Kind kind, std::string text) {
  reports_.emplace_back(LinkChange{kind, std::move(text)});
}

void AutopilotClient::report_event(const char* kind, std::string text) {
  reports_.emplace_back(OutsideEvent{kind, std::move(text)});
}

// What a frame of the vehicle's autopilot is for this end.
struct AutopilotClient::Handler {
  AutopilotClient& self;
  Channel from;
  Time now;
  Outbox& out;

  void operator()(const mavlink::Heartbeat& m) const {
    self.hear_heartbeat(m, from, now);
  }
  void operator()(const mavlink::GlobalPositionInt& m) const {
    self.hear_position(m, now);
    self.note_double(
        self.identity_.take_position(m.lat, m.lon, from_ms(m.time_boot_ms), now), now);
  }
  void operator()(const mavlink::SystemTime& m) const {
    self.hear_clock(from_ms(m.time_boot_ms), now);
  }
  void operator()(const mavlink::Timesync& m) const {
    if (m.tc1 != 0) return self.hear_answer(m, now);
    mavlink::Timesync answer;
    answer.tc1 = now.ns();
    answer.ts1 = m.ts1;
    out.send(from, answer);
  }
  void operator()(const mavlink::AutopilotVersion& m) const { self.hear_identity(m); }
  void operator()(const mavlink::Statustext& m) const { self.hear_text(m, now); }
  void operator()(const mavlink::CommandAck& m) const {
    self.commands_.handle(m, now);
    self.set_ups_.handle(m, now);
  }
  void operator()(const mavlink::ParamValue& m) const { self.commands_.handle(m); }
  void operator()(const mavlink::MissionRequest& m) const {
    self.commands_.handle(m, from, now, out);
    self.fences_.handle(m, from, now, out);
  }
  void operator()(const mavlink::MissionRequestInt& m) const {
    self.commands_.handle(m, from, now, out);
    self.fences_.handle(m, from, now, out);
  }
  void operator()(const mavlink::MissionAck& m) const {
    self.commands_.handle(m);
    self.fences_.handle(m);
  }
  void operator()(const mavlink::MissionCurrent& m) const {
    const int first = self.telemetry_.make() == mavlink::Make::kArduPilot ? 1 : 0;
    MissionProgress progress;
    progress.current = static_cast<std::uint16_t>(std::max(int{m.seq} - first, 0));
    progress.finished = m.mission_state == 5;  // MISSION_STATE_COMPLETE
    self.reports_.emplace_back(progress);
  }
  template <class Other>
  void operator()(const Other& m) const {
    self.telemetry_.handle(m);
  }
};

// Whether a frame is of the vehicle: by its number, and by the channel where it lives.
bool AutopilotClient::accepts(const mavlink::Frame& frame, Channel from, Time now) {
  if (frame.system() != options_.system || frame.component() != kAutopilotComponent ||
      channels_.count(from) == 0)
    return false;
  if (!channel_ || *channel_ == from || !up_) return true;
  // Somebody with its number, heard elsewhere while it is heard where it was.
  if (frame.id() == mavlink::kFacts<mavlink::Heartbeat>.id &&
      now - heard_ > options_.silence)
    return true;
  duplicate_at_ = now;
  if (!std::exchange(duplicate_, true))
    report_change(Kind::kDuplicate,
                  fmt::format("another vehicle has number {} too; the first one counts",
                              options_.system));
  return false;
}

void AutopilotClient::receive(const mavlink::Frame& frame, Channel from, Time now,
                              Outbox& out) {
  if (!accepts(frame, from, now)) return;
  sequence_.hear(frame);
  // Answers to others are none of its business.
  if (frame.target_system() != 0 && frame.target_system() != out.system()) return;
  // Before its first heartbeat nothing tells what it is.
  if (!up_ && frame.id() != mavlink::kFacts<mavlink::Heartbeat>.id) return;
  if (up_) heard_ = now;
  note_double(identity_.take_sequence(frame.sequence(), now), now);
  using namespace mavlink;  // NOLINT: a list of messages
  dispatch<mavlink::Heartbeat, GlobalPositionInt, Attitude, VfrHud, Wind, WindCov,
           GpsRawInt, SysStatus, ExtendedSysState, HomePosition, SystemTime, Timesync,
           EkfStatusReport, EstimatorStatus, AutopilotVersion, Statustext, CommandAck,
           ParamValue, MissionRequest, MissionRequestInt, MissionAck, MissionCurrent>(
      frame, Handler{*this, from, now, out});
}

void AutopilotClient::hear_heartbeat(const mavlink::Heartbeat& heartbeat, Channel from,
                                     Time now) {
  if (!is_vehicle(heartbeat)) return;
  telemetry_.handle(heartbeat);
  commands_.report(telemetry_.condition());
  commands_.set_bytewise(telemetry_.make() == mavlink::Make::kPx4);
  heard_ = heartbeat_ = now;
  channel_ = from;
  if (!up_) {
    come_up(fmt::format("{}, {}{}", name_of(telemetry_.make()),
                        telemetry_.condition().mode_name,
                        exposed_.contains(from)
                            ? "; not signed: whoever reaches the link may speak for it"
                            : ""));
    set_up(now);
    came_up_ = now;
    trip_.reset();
  }
  const bool other = telemetry_.hovers() != options_.hovers;
  if (other && !mismatched_)
    report_change(
        Kind::kMismatch,
        fmt::format("a {} answers as number {}, a {} was expected; it is not "
                    "commanded",
                    telemetry_.hovers() ? "multirotor" : "fixed wing", options_.system,
                    options_.hovers ? "multirotor" : "fixed wing"));
  // Until the link is lost or it reboots: two may answer in turn.
  mismatched_ = mismatched_ || other;
}

// Two speak as one on its channel, if `found` says so.
void AutopilotClient::note_double(const std::optional<std::string>& found, Time now) {
  two_speak_ = identity_.is_ambiguous(now);
  if (found || two_speak_ || ambiguous_) duplicate_at_ = now;
  if (now - duplicate_at_ > kOneAgain) duplicate_ = false;
  if (!found || std::exchange(duplicate_, true)) return;
  report_change(
      Kind::kDuplicate,
      fmt::format("{}: another vehicle may have number {}, or somebody speaks "
                  "in its name{}",
                  *found, options_.system, two_speak_ ? "; neither is commanded" : ""));
}

void AutopilotClient::come_up(const std::string& text) {
  up_ = true;
  duplicate_ = ambiguous_ = mismatched_ = two_speak_ = false;
  identity_.forget();
  report_change(Kind::kUp, was_up_ ? "heard again: " + text : "heard: " + text);
  was_up_ = true;
  condition_due_ = Time();
  // While nobody heard it its clock may have been set.
  clock_.forget();
  motion_.reset();
  positions_.clear();
}

// Said once for each number, when the vehicle itself is not there.
void AutopilotClient::receive_other(const mavlink::Frame& frame, Time now) {
  if (up_ || frame.component() != kAutopilotComponent) return;
  mavlink::dispatch<mavlink::Heartbeat>(frame, [&](const mavlink::Heartbeat& m) {
    if (!is_vehicle(m)) return;
    if (!other_since_) other_since_ = now;
    if (now - *other_since_ < kOtherAlone || !others_.insert(frame.system()).second)
      return;
    absence_said_ = true;
    report_change(
        Kind::kMismatch,
        fmt::format("a vehicle with system id {} is heard, {} is expected; it is "
                    "not commanded",
                    frame.system(), options_.system));
  });
}

void AutopilotClient::say_absence(Time now) {
  if (!begun_) begun_ = now;
  if (was_up_ || absence_said_ || now - *begun_ < kAbsence) return;
  absence_said_ = true;
  report_event(
      "not-heard",
      fmt::format("nothing is heard of the vehicle with system id {}", options_.system));
}

void AutopilotClient::go_down(const std::string& why) {
  up_ = false;
  commands_.abandon("the link is down");
  fences_.abandon("the link is down");
  set_ups_.abandon("the link is down");
  report_change(Kind::kDown, why);
}

// Asks for its identity, its home and telemetry.
void AutopilotClient::set_up(Time now) {
  set_up_ = now;
  position_ = now;
  airspeed_.reset();
  altitude_.reset();
  home_due_ = now + kHomePeriod;
  const auto ask = [&](mavlink::CommandLong what) { set_ups_.add({0, {what}}); };
  for (const Stream& stream : kStreams)
    ask(command(
        kSetMessageInterval, static_cast<float>(stream.message),
        static_cast<float>(1e6 / (stream.rate > 0 ? stream.rate : options_.rate))));
  ask(command(kRequestMessage,
              static_cast<float>(mavlink::kFacts<mavlink::AutopilotVersion>.id)));
  ask(command(kRequestMessage,
              static_cast<float>(mavlink::kFacts<mavlink::HomePosition>.id)));
  const std::uint32_t wind = telemetry_.make() == mavlink::Make::kArduPilot
                                 ? mavlink::kFacts<mavlink::Wind>.id
                                 : mavlink::kFacts<mavlink::WindCov>.id;
  ask(command(kSetMessageInterval, static_cast<float>(wind), 1e6F));
  const std::uint32_t estimator = telemetry_.make() == mavlink::Make::kArduPilot
                                      ? mavlink::kFacts<mavlink::EkfStatusReport>.id
                                      : mavlink::kFacts<mavlink::EstimatorStatus>.id;
  ask(command(kSetMessageInterval, static_cast<float>(estimator), 1e6F));
}

void AutopilotClient::hear_clock(Time boot, Time now) {
  if (boot_ && boot + kRebootStep < *boot_) {
    clock_.forget();
    if (rebooted_ && now - *rebooted_ < kDuplicateWindow) {
      ambiguous_ = true;
      if (!std::exchange(duplicate_, true))
        report_change(Kind::kDuplicate,
                      fmt::format("two vehicles have number {}: its clock goes forth "
                                  "and back; neither is commanded",
                                  options_.system));
    } else {
      mismatched_ = false;
      commands_.abandon("the vehicle has rebooted");
      fences_.abandon("the vehicle has rebooted");
      identity_.forget();
      set_ups_.abandon("the vehicle has rebooted");
      motion_.reset();
      report_change(Kind::kRebooted, fmt::format("its clock went back from {:.1f} to "
                                                 "{:.1f} s",
                                                 boot_->seconds(), boot.seconds()));
      set_up(now);
    }
    rebooted_ = now;
  }
  if (ambiguous_ && now - *rebooted_ > kOneAgain) ambiguous_ = false;
  boot_ = boot;
  const Time ahead = clock_.hear(boot, now);
  if (ahead == Time()) return;
  clock_set_at_ = now;
  report_event("clock-set",
               fmt::format("its clock was set ahead by {:.1f} s", ahead.seconds()));
}

void AutopilotClient::hear_answer(const mavlink::Timesync& answer, Time now) {
  const Time sent = Time::from_ns(answer.ts1), there = Time::from_ns(answer.tc1);
  if (sent <= now && now - sent < kTripWait) trip_ = (now - sent).seconds();
  if (clock_.round_trip(sent, there, now) != ClockAlignment::Answer::kOtherClock) {
    other_clock_ = 0;
    return;
  }
  if (++other_clock_ < kOtherClockAnswers || std::exchange(other_clock_said_, true))
    return;
  report_event("other-clock",
               "it answers TIMESYNC by another clock than its telemetry's; the fastest "
               "messages align it instead");
}

void AutopilotClient::hear_position(const mavlink::GlobalPositionInt& position,
                                    Time now) {
  hear_clock(from_ms(position.time_boot_ms), now);
  position_ = now;
  positions_.push_back(now);
  while (now - positions_.front() > kRateWindow) positions_.pop_front();
  const auto motion = telemetry_.handle(position, now, clock_);
  if (!motion) return;
  watch_place(*motion, now);
  reports_.emplace_back(*motion);
}

// Whether it jumps, and whether it is where it is to begin.
void AutopilotClient::watch_place(const VehicleMotion& motion, Time now) {
  // By dead reckoning it drifts, and jumps when satellites are back.
  const bool known = telemetry_.condition().position;
  if (motion_ && known && known_) {
    const double dt = (motion.time - motion_->time).seconds();
    const Vec3 off = motion.p_N - motion_->p_N - dt * motion_->v_N;
    const double limit =
        kJumpDistance + motion.v_N.norm() + kJumpSpeed * std::max(dt, 0.0);
    if (motion.time - motion_->time < kJumpWindow && off.norm() > limit) {
      jump_at_ = now;
      report_event("position-jumped", fmt::format("its position jumped by {:.0f} m in "
                                                  "{:.1f} s",
                                                  off.norm(), dt));
    }
  }
  known_ = known;
  motion_at_ = now;
  motion_ = motion;
  // On the ground it is an item of the check before take-off.
  const VehicleCondition& condition = telemetry_.condition();
  if (commanded_ || !options_.start || condition.on_ground) {
    misplaced_ = false;
    return;
  }
  const std::string why = misplaced(motion.p_N, *options_.start, false);
  if (!why.empty() && !misplaced_)
    report_event("wrong-place", why + "; it is not commanded");
  misplaced_ = !why.empty();
}

PreflightResult AutopilotClient::check(Time now) const {
  PreflightInputs in;
  in.type = telemetry_.type();
  in.hovers = options_.hovers;
  in.start = options_.start;
  in.quality = telemetry_.quality();
  in.origin = telemetry_.at_origin();
  if (motion_) {
    in.position = motion_->p_N;
    in.position_age = (motion_at_ - motion_->time).seconds();
  }
  const double window = (now - std::max(set_up_, now - kRateWindow)).seconds();
  in.position_rate = window > 0 ? static_cast<double>(positions_.size()) / window : 0;
  in.since_position = positions_.empty() ? 1e9 : (now - positions_.back()).seconds();
  if (jump_at_) in.since_jump = (now - *jump_at_).seconds();
  if (clock_set_at_) in.since_clock = (now - *clock_set_at_).seconds();
  in.home = telemetry_.home();
  in.since_heartbeat = (now - heartbeat_).seconds();
  in.round_trip =
      clock_.shortest_round_trip() > 0 ? clock_.shortest_round_trip() : trip_.value_or(0);
  in.charge = telemetry_.charge();
  in.emergency = telemetry_.condition().emergency;
  return check_preflight(in);
}

// Whether a request may go out; if not, its answer is given. While the same items fail
// the text stays the same, whatever numbers are in it.
bool AutopilotClient::admits(std::uint32_t number, const VehicleRequest& request,
                             Time now) {
  const auto* arming = std::get_if<ArmRequest>(&request);
  const bool starts = std::holds_alternative<TakeOffRequest>(request) ||
                      (arming != nullptr && arming->arm && !arming->force);
  if (!starts) return true;
  // How long a round trip takes is waited for, and who does not answer is not.
  if (!trip_ && now - came_up_ < kTripWait) {
    refuse(number, RequestAnswer::Outcome::kDenied, {});
    return false;
  }
  PreflightResult result = check(now);
  if (result.failed == 0) {
    failed_ = 0;
    return true;
  }
  if ((result.failed & ~failed_) != 0) {
    failed_ = result.failed;
    failed_text_ = "check before take-off: " + std::move(result.text);
  }
  refuse(number, RequestAnswer::Outcome::kDenied, failed_text_);
  return false;
}

void AutopilotClient::hear_identity(const mavlink::AutopilotVersion& version) {
  capabilities_ = version.capabilities;
  version_ = version.flight_sw_version;
  if (uid_ && *uid_ != version.uid && version.uid != 0)
    report_change(Kind::kMismatch,
                  fmt::format("another aircraft answers as number {} than before",
                              options_.system));
  if (version.uid != 0) uid_ = version.uid;
  VehicleIdentity identity;
  identity.make = fmt::format("{} {}.{}.{}", name_of(telemetry_.make()), version_ >> 24,
                              version_ >> 16 & 0xff, version_ >> 8 & 0xff);
  identity.hovers = telemetry_.hovers();
  identity.airframe = identity.hovers ? "multirotor" : "fixed wing";
  using Following = VehicleIdentity::Following;
  if (identity.hovers || (capabilities_ & kTakesLocalTarget) != 0)
    identity.following = Following::kTrajectory;
  else if ((capabilities_ & kTakesAttitude) != 0)
    identity.following = Following::kBank;
  reports_.emplace_back(std::move(identity));
}

// Parts of a long text are joined; the last is the one that is not full.
void AutopilotClient::hear_text(const mavlink::Statustext& text, Time now) {
  const std::string_view part = mavlink::text_of(text.text);
  if (text.id != 0 && text.chunk_seq == 0) long_text_.clear();
  if (long_text_.size() < kMaxText) long_text_ += part;
  if (text.id != 0 && part.size() == text.text.size()) return;
  // Only now: a character may begin in one part and end in the next.
  std::string whole = valid_text(std::exchange(long_text_, {}));
  if (text.severity <= kWarning) {
    complaint_ = whole;
    complained_ = now;
  }
  reports_.emplace_back(VehicleText{text.severity, std::move(whole)});
}

void AutopilotClient::refuse(std::uint32_t number, RequestAnswer::Outcome outcome,
                             std::string why) {
  if (number != 0) reports_.emplace_back(RequestAnswer{number, outcome, std::move(why)});
}

void AutopilotClient::request(std::uint32_t number, const VehicleRequest& request,
                              Time now, Outbox& out) {
  if (!up_) return refuse(number, RequestAnswer::Outcome::kNoAnswer, "the link is down");
  if (!ours())
    return refuse(number, RequestAnswer::Outcome::kDenied,
                  {});  // said already, as events
  if (const auto* obstacles = std::get_if<ObstacleDistances>(&request)) {
    ++feeds_.obstacles;
    return out.send(*channel_, coded(*obstacles, now));
  }
  if (const auto* fix = std::get_if<PositionFix>(&request)) {
    ++feeds_.fixes;
    return out.send(*channel_, coded(*fix, frame_, options_.unix_ns + now.ns()));
  }
  if (const auto* fence = std::get_if<FenceUpload>(&request))
    return request_fence(number, *fence);
  if (!placed()) return refuse(number, RequestAnswer::Outcome::kDenied, {});
  if (const auto* bank = std::get_if<BankSetpoint>(&request))
    return send_bank(*bank, now, out);
  if (const auto* track = std::get_if<TrackSetpoint>(&request))
    return send_track(*track, out);
  if (!admits(number, request, now)) return;
  const RequestTarget target{telemetry_.make(), telemetry_.hovers(),
                             telemetry_.home_msl().value_or(0)};
  std::vector<RequestStep> steps = steps_of(request, target, frame_);
  if (steps.empty())
    return refuse(number, RequestAnswer::Outcome::kUnsupported, "it has no such command");
  if (!commands_.add({number, std::move(steps)}))
    refuse(number, RequestAnswer::Outcome::kNoAnswer, "too many requests wait");
}

void AutopilotClient::request_fence(std::uint32_t number, const FenceUpload& fence) {
  if (capabilities_ != 0 && (capabilities_ & kTakesFence) == 0)
    return refuse(number, RequestAnswer::Outcome::kUnsupported, "it keeps no fence");
  std::vector<RequestStep> steps = steps_of(fence, {}, frame_);
  if (steps.empty())
    return refuse(number, RequestAnswer::Outcome::kUnsupported,
                  "the fence has too many corners");
  // What waits is of older zones.
  fences_.abandon("another fence follows");
  fences_.add({number, std::move(steps)});
}

void AutopilotClient::send_bank(const BankSetpoint& setpoint, Time now, Outbox& out) {
  mavlink::SetAttitudeTarget attitude;
  attitude.time_boot_ms = static_cast<std::uint32_t>(now.ns() / 1'000'000);
  attitude.target_system = options_.system;
  attitude.target_component = kAutopilotComponent;
  // Roll alone counts: ArduPilot takes it for such a mask, and height and speed are its
  // own affair.
  attitude.type_mask = 0b1100'0110;
  const double half = setpoint.roll / 2;
  attitude.q = {static_cast<float>(math::cos(half)), static_cast<float>(math::sin(half)),
                0, 0};
  out.send(*channel_, attitude);

  const bool moved =
      !altitude_ || std::abs(*altitude_ - setpoint.altitude_msl) > kAltitudeStep;
  if (moved || now >= altitude_due_) {
    altitude_ = setpoint.altitude_msl;
    altitude_due_ = now + kAltitudePeriod;
    mavlink::SetPositionTargetGlobalInt target;
    target.time_boot_ms = attitude.time_boot_ms;
    target.target_system = options_.system;
    target.target_component = kAutopilotComponent;
    target.coordinate_frame = 5;  // global, altitude above mean sea level
    target.type_mask = 0xfffb;    // nothing but the altitude
    target.alt = static_cast<float>(setpoint.altitude_msl);
    out.send(*channel_, target);
  }
  const bool faster =
      !airspeed_ || std::abs(*airspeed_ - setpoint.airspeed) > kAirspeedStep;
  if (faster && now >= airspeed_due_) {
    airspeed_ = setpoint.airspeed;
    airspeed_due_ = now + kSecond;
    commands_.add(
        {0, {command(kDoChangeSpeed, 0, static_cast<float>(setpoint.airspeed), -1)}});
  }
}

void AutopilotClient::send_track(const TrackSetpoint& setpoint, Outbox& out) {
  mavlink::SetPositionTargetGlobalInt target;
  target.target_system = options_.system;
  target.target_component = kAutopilotComponent;
  target.coordinate_frame = 5;
  constexpr std::uint16_t kIgnoreYaw = 0x400, kIgnoreYawRate = 0x800;
  target.type_mask =
      setpoint.heading ? kIgnoreYawRate : std::uint16_t{kIgnoreYaw | kIgnoreYawRate};
  const ScaledPlace place = scaled_place(setpoint.p_N.head<2>(), frame_);
  target.lat_int = place.latitude;
  target.lon_int = place.longitude;
  target.alt = static_cast<float>(-setpoint.p_N.z());
  const Eigen::Vector3f v = setpoint.v_N.cast<float>(), a = setpoint.a_N.cast<float>();
  target.vx = v.x();
  target.vy = v.y();
  target.vz = v.z();
  target.afx = a.x();
  target.afy = a.y();
  target.afz = a.z();
  target.yaw = static_cast<float>(setpoint.heading.value_or(0));
  out.send(*channel_, target);
}

void AutopilotClient::report_condition(Time now) {
  const VehicleCondition& condition = telemetry_.condition();
  if (condition == reported_ && now < condition_due_) return;
  reported_ = condition;
  condition_due_ = now + kSecond;
  reports_.emplace_back(condition);
}

void AutopilotClient::step(Time now, Outbox& out) {
  say_absence(now);
  if (up_ && now - heard_ > options_.silence)
    go_down(fmt::format("nothing heard for {:.1f} s", (now - heard_).seconds()));
  if (now >= heartbeat_due_) {
    heartbeat_due_ = now + kSecond;
    mavlink::Heartbeat heartbeat;
    heartbeat.type = kOnboardController;
    heartbeat.autopilot = mavlink::kAutopilotInvalid;
    heartbeat.system_status = kActive;
    heartbeat.mavlink_version = 3;
    // While it is heard, by its channel alone: others are those of other vehicles.
    if (up_)
      out.send(*channel_, heartbeat);
    else
      for (const Channel channel : channels_) out.send(channel, heartbeat);
  }
  if (!up_) return;
  if (now >= timesync_due_) {
    timesync_due_ = now + kSecond;
    mavlink::Timesync question;
    question.ts1 = now.ns();
    out.send(*channel_, question);
  }
  // It answers but says nothing of its motion: what was asked for was lost.
  if (now - position_ > kDuplicateWindow && now - set_up_ > kDuplicateWindow) set_up(now);
  if (!telemetry_.home() && now >= home_due_) {
    home_due_ = now + kHomePeriod;
    set_ups_.add(
        {0,
         {command(kRequestMessage,
                  static_cast<float>(mavlink::kFacts<mavlink::HomePosition>.id))}});
  }
  step_requests(now, out);
  report_condition(now);
}

void AutopilotClient::step_requests(Time now, Outbox& out) {
  commands_.step(now, *channel_, out);
  fences_.step(now, *channel_, out);
  set_ups_.step(now, *channel_, out);
  std::vector<RequestAnswer> answers = commands_.take_answers();
  for (const RequestAnswer& answer : answers)
    commanded_ = commanded_ || answer.outcome == RequestAnswer::Outcome::kAccepted;
  for (RequestAnswer& answer : fences_.take_answers()) {
    const bool taken = answer.outcome == RequestAnswer::Outcome::kAccepted;
    ++(taken ? feeds_.fences : feeds_.fences_refused);
    answers.push_back(std::move(answer));
  }
  for (RequestAnswer& answer : answers) {
    if (answer.outcome == RequestAnswer::Outcome::kDenied &&
        now - complained_ < kFreshComplaint && !complaint_.empty())
      answer.text += ": " + complaint_;
    reports_.emplace_back(std::move(answer));
  }
}

std::vector<VehicleReport> AutopilotClient::take_reports() {
  return std::exchange(reports_, {});
}

}  // namespace skein::autopilot_client
