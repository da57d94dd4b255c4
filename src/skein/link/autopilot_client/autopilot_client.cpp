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
const Time kAbsence = Time::from_seconds(10);    // then it is said that nobody is there
const Time kOtherAlone = Time::from_seconds(3);  // a vehicle of another number
constexpr int kOtherClockAnswers = 3;            // in a row
const Time kTripWait = Time::from_seconds(10);   // for an answer about time

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

ReportedPlace place_in(const mavlink::GlobalPositionInt& m) {
  const double north = m.vx / 100.0, east = m.vy / 100.0;
  return {m.lat, m.lon, std::sqrt(north * north + east * east), from_ms(m.time_boot_ms)};
}

ReportedKind kind_in(const mavlink::Heartbeat& m) {
  return {m.type, m.autopilot};
}

// What an autopilot says of its board, as one number (FNV-1a); 0: nothing.
std::uint64_t hardware_in(const mavlink::AutopilotVersion& m) {
  std::uint64_t number = 0xcbf2'9ce4'8422'2325;
  bool known = false;
  const auto add = [&](std::uint64_t value) {
    known = known || value != 0;
    number = (number ^ value) * 0x100'0000'01b3;
  };
  add(m.uid);
  add(m.board_version);
  add(std::uint64_t{m.vendor_id} << 16 | m.product_id);
  for (const std::uint8_t byte : m.uid2) add(byte);
  return known ? number : 0;
}

}  // namespace

AutopilotClient::AutopilotClient(const AutopilotClientOptions& options,
                                 const geo::LocalFrame& frame)
    : options_(options),
      frame_(frame),
      telemetry_(frame),
      commands_(options.system),
      fences_(options.system),
      set_ups_(options.system, options.rate),
      setpoints_(options.system, frame),
      positions_(options.start) {}

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

void AutopilotClient::report_event(EventKind kind, std::string text) {
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
    if (is_vehicle(m)) self.note_double(self.identity_.take_kind(kind_in(m), now), now);
  }
  void operator()(const mavlink::GlobalPositionInt& m) const {
    self.hear_position(m, now);
    self.note_double(self.identity_.take_place(place_in(m), now), now);
  }
  void operator()(const mavlink::ExtendedSysState& m) const {
    self.telemetry_.handle(m);
    if (m.landed_state != 0)
      self.commands_.report_landed(self.telemetry_.condition().on_ground, now);
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
  void operator()(const mavlink::AutopilotVersion& m) const {
    self.hear_identity(m);
    self.note_double(self.identity_.take_hardware(hardware_in(m), now), now);
  }
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
  compare_other(frame, now);
  return false;
}

// It may be heard by two links. What is heard on the second does not count.
void AutopilotClient::compare_other(const mavlink::Frame& frame, Time now) {
  std::string how;
  using namespace mavlink;  // NOLINT: a list of messages
  struct Comparison {
    IdentityWatch& identity;
    Time now;
    std::string& how;
    void operator()(const mavlink::Heartbeat& m) const {
      if (is_vehicle(m)) how = identity.difference(kind_in(m));
    }
    void operator()(const GlobalPositionInt& m) const {
      how = identity.difference(place_in(m), now);
    }
    void operator()(const SystemTime& m) const {
      how = identity.difference({.boot = from_ms(m.time_boot_ms)}, now);
    }
  };
  dispatch<mavlink::Heartbeat, GlobalPositionInt, SystemTime>(
      frame, Comparison{identity_, now, how});
  if (how.empty()) return;
  duplicate_at_ = now;
  if (!std::exchange(duplicate_, true))
    report_change(Kind::kDuplicate,
                  fmt::format("another vehicle has number {} too, {}; the first one "
                              "counts",
                              options_.system, how));
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
  commands_.set_make(telemetry_.make());
  commands_.report(telemetry_.condition(), telemetry_.custom_mode(), now);
  // In another mode it no longer knows what it was to follow.
  const std::uint32_t before = std::exchange(mode_, telemetry_.custom_mode());
  if (mode_ != before) setpoints_.forget();
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
  positions_.forget();
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
      EventKind::kNotHeard,
      fmt::format("nothing is heard of the vehicle with system id {}", options_.system));
}

void AutopilotClient::go_down(const std::string& why) {
  up_ = false;
  commands_.abandon("the link is down");
  fences_.abandon("the link is down");
  set_ups_.abandon("the link is down");
  report_change(Kind::kDown, why);
}

void AutopilotClient::set_up(Time now) {
  set_up_ = now;
  position_ = now;
  setpoints_.forget();
  identified_.clear();
  set_ups_.begin(telemetry_.make(), now);
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
      positions_.forget_motion();
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
  report_event(EventKind::kClockSet,
               fmt::format("its clock was set ahead by {:.1f} s", ahead.seconds()));
}

void AutopilotClient::hear_answer(const mavlink::Timesync& answer, Time now) {
  const Time sent = Time::from_ns(answer.ts1), there = Time::from_ns(answer.tc1);
  if (sent <= now && sent > now - kTripWait) {
    trip_ = (now - sent).seconds();
    commands_.set_round_trip(now - sent);
  }
  if (clock_.round_trip(sent, there, now) != ClockAlignment::Answer::kOtherClock) {
    other_clock_ = 0;
    return;
  }
  if (++other_clock_ < kOtherClockAnswers || std::exchange(other_clock_said_, true))
    return;
  report_event(EventKind::kOtherClock,
               "it answers TIMESYNC by another clock than its telemetry's; the fastest "
               "messages align it instead");
}

void AutopilotClient::hear_position(const mavlink::GlobalPositionInt& position,
                                    Time now) {
  hear_clock(from_ms(position.time_boot_ms), now);
  position_ = now;
  positions_.count(now);
  const auto motion = telemetry_.handle(position, now, clock_);
  if (!motion) return;
  const VehicleCondition& condition = telemetry_.condition();
  // On the ground its place is an item of the check before take-off.
  for (OutsideEvent& event : positions_.add(*motion, condition.position,
                                            commanded_ || condition.on_ground, now))
    reports_.emplace_back(std::move(event));
  reports_.emplace_back(*motion);
}

PreflightResult AutopilotClient::check(Time now) const {
  PreflightInputs in;
  in.type = telemetry_.type();
  in.hovers = options_.hovers;
  in.quality = telemetry_.quality();
  in.origin = telemetry_.at_origin();
  positions_.describe_to(in, set_up_, now);
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
  const bool first = uids_.empty();
  if (version.uid != 0 && uids_.insert(version.uid).second && !first)
    report_change(Kind::kMismatch,
                  fmt::format("another aircraft answers as number {} than before",
                              options_.system));
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
  if (std::exchange(identified_, identity.make) != identity.make)
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
    return setpoints_.send(*bank, now, *channel_, out, commands_);
  if (const auto* track = std::get_if<TrackSetpoint>(&request))
    return setpoints_.send(*track, *channel_, out);
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
  step_requests(now, out);
  report_condition(now);
}

void AutopilotClient::step_requests(Time now, Outbox& out) {
  commands_.step(now, *channel_, out);
  fences_.step(now, *channel_, out);
  set_ups_.step(now, telemetry_.home().has_value(), *channel_, out);
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
