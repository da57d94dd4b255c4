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
constexpr double kAltitudeStep = 0.5;  // demanded anew at once [m]
constexpr double kAirspeedStep = 0.3;  // [m/s]

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
      fences_(options.system) {}

void AutopilotClient::close(Channel channel) {
  channels_.erase(channel);
  if (channel_ != channel) return;
  channel_.reset();
  if (up_) go_down("its connection was closed");
}

void AutopilotClient::report_change(Kind kind, std::string text) {
  reports_.emplace_back(LinkChange{kind, std::move(text)});
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
    self.hear_clock(from_ms(m.time_boot_ms), now);
    self.position_ = now;
    if (auto motion = self.telemetry_.handle(m, now, self.clock_))
      self.reports_.emplace_back(*motion);
  }
  void operator()(const mavlink::SystemTime& m) const {
    self.hear_clock(from_ms(m.time_boot_ms), now);
  }
  void operator()(const mavlink::Timesync& m) const {
    if (m.tc1 != 0) {
      self.clock_.round_trip(Time::from_ns(m.ts1), Time::from_ns(m.tc1), now);
      return;
    }
    mavlink::Timesync answer;
    answer.tc1 = now.ns();
    answer.ts1 = m.ts1;
    out.send(from, answer);
  }
  void operator()(const mavlink::AutopilotVersion& m) const { self.hear_identity(m); }
  void operator()(const mavlink::Statustext& m) const { self.hear_text(m, now); }
  void operator()(const mavlink::CommandAck& m) const { self.commands_.handle(m, now); }
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
  if (frame.id() == mavlink::kFacts<mavlink::Heartbeat>.id) {
    if (now - heard_ > options_.silence) return true;
    if (!std::exchange(duplicate_, true))
      report_change(Kind::kDuplicate,
                    fmt::format("another vehicle has number {} too; the first one counts",
                                options_.system));
  }
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
  using namespace mavlink;  // NOLINT: a list of messages
  dispatch<mavlink::Heartbeat, GlobalPositionInt, Attitude, VfrHud, Wind, WindCov,
           GpsRawInt, SysStatus, ExtendedSysState, HomePosition, SystemTime, Timesync,
           AutopilotVersion, Statustext, CommandAck, ParamValue, MissionRequest,
           MissionRequestInt, MissionAck, MissionCurrent>(frame,
                                                          Handler{*this, from, now, out});
}

void AutopilotClient::hear_heartbeat(const mavlink::Heartbeat& heartbeat, Channel from,
                                     Time now) {
  if (!is_vehicle(heartbeat)) return;
  telemetry_.handle(heartbeat);
  heard_ = now;
  channel_ = from;
  if (!up_) {
    come_up(fmt::format("{}, {}", name_of(telemetry_.make()),
                        telemetry_.condition().mode_name));
    set_up(now);
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

void AutopilotClient::come_up(const std::string& text) {
  up_ = true;
  duplicate_ = ambiguous_ = mismatched_ = false;
  report_change(Kind::kUp, was_up_ ? "heard again: " + text : "heard: " + text);
  was_up_ = true;
  condition_due_ = Time();
}

void AutopilotClient::go_down(const std::string& why) {
  up_ = false;
  commands_.abandon("the link is down");
  fences_.abandon("the link is down");
  report_change(Kind::kDown, why);
}

// Asks for its identity, its home and telemetry.
void AutopilotClient::set_up(Time now) {
  set_up_ = now;
  position_ = now;
  airspeed_.reset();
  altitude_.reset();
  const auto ask = [&](mavlink::CommandLong what) { commands_.add({0, {what}}); };
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
      report_change(Kind::kRebooted, fmt::format("its clock went back from {:.1f} to "
                                                 "{:.1f} s",
                                                 boot_->seconds(), boot.seconds()));
      set_up(now);
    }
    rebooted_ = now;
  }
  if (ambiguous_ && now - *rebooted_ > kOneAgain) ambiguous_ = false;
  boot_ = boot;
  clock_.hear(boot, now);
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
                  "it is not the vehicle expected");
  if (const auto* bank = std::get_if<BankSetpoint>(&request))
    return send_bank(*bank, now, out);
  if (const auto* track = std::get_if<TrackSetpoint>(&request))
    return send_track(*track, out);
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
  std::vector<RequestAnswer> answers = commands_.take_answers();
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
