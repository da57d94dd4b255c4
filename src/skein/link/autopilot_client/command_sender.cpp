// SPDX-License-Identifier: Apache-2.0
#include "skein/link/autopilot_client/command_sender.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "skein/link/autopilot_client/request_steps.h"

namespace skein::autopilot_client {
namespace {

using mavlink::CommandInt;
using mavlink::CommandLong;
using vehicle_services::Channel;
using vehicle_services::Outbox;
using Outcome = RequestAnswer::Outcome;

const Time kAgainAfter = Time::from_seconds(0.5);
const Time kPatienceFor = Time::from_seconds(6);
constexpr int kRoundTrips = 4;  // that the first answer may take in addition
const Time kPatienceInProgress = Time::from_seconds(60);
constexpr std::size_t kMaxWaiting = 32;

enum : std::uint8_t {  // MAV_RESULT
  kResultAccepted = 0,
  kResultTemporarilyRejected = 1,
  kResultDenied = 2,
  kResultUnsupported = 3,
  kResultFailed = 4,
  kResultInProgress = 5,
};

std::optional<std::uint16_t> command_in(const RequestStep& step) {
  if (const auto* command = std::get_if<CommandLong>(&step)) return command->command;
  if (const auto* command = std::get_if<CommandInt>(&step)) return command->command;
  return std::nullopt;
}

// Whether it goes on whatever mode the vehicle is in.
bool stops_motors(const RequestStep& step) {
  const auto* command = std::get_if<CommandLong>(&step);
  return command && command->command == kArmDisarm && command->param1 < 0.5F &&
         command->param2 > 0;
}

// Whether it changes who flies, or whether it flies.
bool takes_control(const RequestStep& step) {
  switch (command_in(step).value_or(0)) {
    case kDoSetMode:
    case kArmDisarm:
    case kNavTakeOff:
    case kNavLand:
    case kDoReposition:
      return !stops_motors(step);
    default:
      return false;
  }
}

// Whether the request is a command to whoever flies; a list that is stored is none.
bool is_command(const NumberedRequest& request) {
  return std::ranges::any_of(request.steps, [](const RequestStep& step) {
    return command_in(step).has_value() && !stops_motors(step);
  });
}

std::uint8_t number_of(const SendMission& mission) {
  return static_cast<std::uint8_t>(mission.type);
}

std::string text_of_result(std::uint8_t result) {
  switch (result) {
    case kResultTemporarilyRejected:
      return "rejected for now";
    case kResultDenied:
      return "denied";
    case kResultUnsupported:
      return "not supported";
    case kResultFailed:
      return "failed";
    default:
      return fmt::format("result {}", result);
  }
}

// How people call a command.
std::string name_of_command(std::uint16_t command) {
  switch (command) {
    case kNavReturn:
      return "return";
    case kNavLand:
      return "land";
    case kNavTakeOff:
      return "take-off";
    case kDoSetMode:
      return "mode";
    case kDoChangeSpeed:
      return "speed";
    case kDoReposition:
      return "go to";
    case kDoSetMissionCurrent:
      return "mission item";
    case kMissionStart:
      return "mission";
    case kArmDisarm:
      return "arm";
    default:
      return fmt::format("command {}", command);
  }
}

// MAV_PARAM_TYPE: from 1, an unsigned byte, to 8, a signed integer of 64 bits.
bool is_integer(std::uint8_t type) {
  return type >= 1 && type <= 8;
}

double decoded(const mavlink::ParamValue& value, bool bytewise) {
  if (!bytewise || !is_integer(value.param_type)) return value.param_value;
  constexpr std::uint8_t kUnsigned32 = 5;
  const auto bits = std::bit_cast<std::uint32_t>(value.param_value);
  return value.param_type == kUnsigned32
             ? static_cast<double>(bits)
             : static_cast<double>(static_cast<std::int32_t>(bits));
}

float coded(const SetParameter& change, bool bytewise) {
  if (!bytewise || !is_integer(change.type)) return change.value;
  return std::bit_cast<float>(static_cast<std::int32_t>(std::lround(change.value)));
}

// Whether a value of that type is what was asked for.
bool is_value(double stored, double asked, std::uint8_t type) {
  if (is_integer(type)) return std::abs(stored - asked) < 1;
  return std::abs(stored - asked) <= 1e-4 * std::max(1.0, std::abs(asked));
}

}  // namespace

// Of the step under way.
std::string CommandSender::name() const {
  const NumberedRequest& request = waiting_.front();
  const RequestStep& step = request.steps[place_];
  if (const auto* mode = std::get_if<AwaitMode>(&step)) return "mode " + mode->name;
  if (std::holds_alternative<AwaitArmed>(step)) return "arm";
  if (const auto* change = std::get_if<SetParameter>(&step))
    return "parameter " + change->name;
  if (const auto* mission = std::get_if<SendMission>(&step))
    return mission->type == mavlink::MissionType::kFence ? "fence" : "mission";
  const auto* after = place_ + 1 < request.steps.size()
                          ? std::get_if<AwaitMode>(&request.steps[place_ + 1])
                          : nullptr;
  if (const auto* plain = std::get_if<CommandLong>(&step);
      plain && plain->command == kArmDisarm && plain->param1 < 0.5F)
    return "disarm";
  const std::string command = name_of_command(command_in(step).value_or(0));
  return after ? command + " " + after->name : command;
}

void CommandSender::report(const VehicleCondition& condition, std::uint32_t mode_number,
                           Time now) {
  const bool taken =
      takeover_.report(condition.mode, mode_number) && make_ != mavlink::Make::kOther;
  mode_ = condition.mode;
  mode_name_ = condition.mode_name;
  armed_ = condition.armed;
  heartbeat_ = now;
  if (taken) return withdraw();
  if (is_shown()) step_done();
}

void CommandSender::report_landed(bool on_ground, Time now) {
  on_ground_ = on_ground;
  landed_at_ = now;
  if (is_shown()) step_done();
}

// The modes that the step under way leads to.
ModeSet CommandSender::leads_to() const {
  const NumberedRequest& request = waiting_.front();
  const std::size_t last = std::min(place_ + 1, request.steps.size() - 1);
  for (std::size_t k = place_; k <= last; ++k)
    if (const auto* mode = std::get_if<AwaitMode>(&request.steps[k]))
      return mode_set(mode->mode);
  switch (command_in(request.steps[place_]).value_or(0)) {
    case kNavTakeOff:
      return mode_set(VehicleMode::kTakeOff);
    case kNavLand:
      return mode_set(VehicleMode::kLand);
    case kDoReposition:
      return mode_set(make_ == mavlink::Make::kPx4 ? VehicleMode::kHold
                                                   : VehicleMode::kGuided);
    default:
      return 0;
  }
}

// Whether the last heartbeat shows what the command under way is for.
bool CommandSender::is_shown() const {
  if (waiting_.empty() || !sent_) return false;
  const RequestStep& step = waiting_.front().steps[place_];
  const bool in_mode = (leads_to() & mode_set(mode_)) != 0;
  switch (command_in(step).value_or(0)) {
    case kDoSetMode:
      return in_mode;
    case kArmDisarm:
      return armed_ == (std::get<CommandLong>(step).param1 > 0.5F);
    case kNavTakeOff:
      return (in_mode && mode_ != mode_before_) || (stood_ && !on_ground_);
    case kNavLand:
    case kDoReposition:
      return in_mode && mode_ != mode_before_;
    default:
      return false;
  }
}

// The vehicle may have obeyed it, and its pilot have decided otherwise since: that shows
// in a heartbeat that was sent after it arrived.
bool CommandSender::may_repeat() const {
  const RequestStep& step = waiting_.front().steps[place_];
  if (!takes_control(step)) return true;
  const Time shown = *sent_ + std::max(kAgainAfter, round_trip_);
  if (command_in(step) == kNavTakeOff && landed_at_ && *landed_at_ < shown) return false;
  return !in_progress_ && heartbeat_ && *heartbeat_ >= shown;
}

void CommandSender::withdraw() {
  const std::string why = fmt::format(
      "withdrawn, since somebody else has changed its mode to {}", mode_name_);
  while (!waiting_.empty() && is_command(waiting_.front()))
    fail(Outcome::kWithdrawn, why);
  std::erase_if(waiting_, [&](const NumberedRequest& request) {
    if (!is_command(request)) return false;
    if (request.number != 0)
      answers_.push_back({request.number, Outcome::kWithdrawn, why});
    return true;
  });
}

bool CommandSender::add(NumberedRequest request) {
  if (request.steps.empty()) {
    if (request.number != 0) answers_.push_back({request.number, Outcome::kAccepted, {}});
    return true;
  }
  if (waiting_.size() >= kMaxWaiting) return false;
  waiting_.push_back(std::move(request));
  if (waiting_.size() == 1) begin_step();
  return true;
}

void CommandSender::step_done() {
  if (++place_ >= waiting_.front().steps.size()) {
    if (waiting_.front().number != 0)
      answers_.push_back({waiting_.front().number, Outcome::kAccepted, {}});
    waiting_.pop_front();
    place_ = 0;
  }
  begin_step();
}

void CommandSender::fail(Outcome outcome, std::string text) {
  if (waiting_.front().number != 0)
    answers_.push_back({waiting_.front().number, outcome,
                        fmt::format("{}: {}", name(), std::move(text))});
  waiting_.pop_front();
  place_ = 0;
  begin_step();
}

void CommandSender::begin_step() {
  sent_.reset();
  item_.reset();
  tries_ = 0;
  rejected_ = in_progress_ = false;
  kept_.reset();
  kept_times_ = 0;
  takeover_.end();
  if (!waiting_.empty()) takeover_.lead_to(leads_to());
}

void CommandSender::abandon(const std::string& why) {
  while (!waiting_.empty()) fail(Outcome::kNoAnswer, why);
}

std::vector<RequestAnswer> CommandSender::take_answers() {
  return std::exchange(answers_, {});
}

void CommandSender::handle(const mavlink::CommandAck& ack, Time now) {
  if (waiting_.empty() || !sent_) return;
  const auto command = command_in(waiting_.front().steps[place_]);
  if (!command || *command != ack.command) return;
  switch (ack.result) {
    case kResultAccepted:
      return step_done();
    case kResultInProgress:
      in_progress_ = true;
      patient_until_ = now + kPatienceInProgress;
      return;
    case kResultTemporarilyRejected:
      // Of a repetition while the first is under way; else it is asked again until
      // patience ends.
      rejected_ = true;
      return;
    case kResultUnsupported:
      return fail(Outcome::kUnsupported, text_of_result(ack.result));
    default:
      return fail(Outcome::kDenied, text_of_result(ack.result));
  }
}

void CommandSender::handle(const mavlink::ParamValue& value) {
  if (!current<SetParameter>() || !sent_) return;
  auto& change = std::get<SetParameter>(waiting_.front().steps[place_]);
  if (mavlink::text_of(value.param_id) != change.name) return;
  const double stored = decoded(value, make_ == mavlink::Make::kPx4);
  if (is_value(stored, change.value, value.param_type)) return step_done();
  change.type = value.param_type;
  // Somebody else's question may bring the old one; what it says again and again after it
  // was asked for another is what it keeps.
  kept_times_ = kept_ == stored ? kept_times_ + 1 : 1;
  kept_ = stored;
  constexpr int kKept = 3;
  if (kept_times_ >= kKept && tries_ >= kKept)
    fail(Outcome::kDenied,
         fmt::format("{} was requested, the vehicle keeps {}", change.value, stored));
}

void CommandSender::handle(const mavlink::MissionRequest& request, Channel channel,
                           Time now, Outbox& out) {
  send_item(request.seq, request.mission_type, channel, now, out);
}

void CommandSender::handle(const mavlink::MissionRequestInt& request, Channel channel,
                           Time now, Outbox& out) {
  send_item(request.seq, request.mission_type, channel, now, out);
}

void CommandSender::send_item(std::uint16_t number, std::uint8_t type, Channel channel,
                              Time now, Outbox& out) {
  const auto* mission = current<SendMission>();
  if (!mission || !sent_ || number >= mission->items.size() ||
      type != number_of(*mission))
    return;
  mavlink::MissionItemInt item = mission->items[number];
  item.seq = number;
  item.mission_type = type;
  item.target_system = system_;
  item.target_component = component_;
  out.send(channel, item);
  item_ = number;
  sent_ = now;
  patient_until_ = now + kPatienceFor;
}

void CommandSender::handle(const mavlink::MissionAck& ack) {
  const auto* mission = current<SendMission>();
  if (!mission || !sent_ || ack.mission_type != number_of(*mission)) return;
  if (ack.type == 0) return step_done();
  fail(Outcome::kDenied, fmt::format("refused: result {}", ack.type));
}

void CommandSender::send(Time now, Channel channel, Outbox& out) {
  struct Sender {
    CommandSender& self;
    Time now;
    Channel channel;
    Outbox& out;
    void operator()(CommandLong command) const {
      command.target_system = self.system_;
      command.target_component = self.component_;
      command.confirmation = self.tries_;
      out.send(channel, command);
    }
    void operator()(CommandInt command) const {
      command.target_system = self.system_;
      command.target_component = self.component_;
      out.send(channel, command);
    }
    void operator()(const SetParameter& change) const {
      mavlink::ParamSet set;
      set.target_system = self.system_;
      set.target_component = self.component_;
      mavlink::set_text(set.param_id, change.name);
      set.param_value = coded(change, self.make_ == mavlink::Make::kPx4);
      set.param_type = change.type;
      out.send(channel, set);
    }
    void operator()(const SendMission& mission) const {
      // Once items are asked for, the count would begin it anew.
      if (self.item_)
        return self.send_item(*self.item_, number_of(mission), channel, now, out);
      mavlink::MissionCount count;
      count.target_system = self.system_;
      count.target_component = self.component_;
      count.count = static_cast<std::uint16_t>(mission.items.size());
      count.mission_type = number_of(mission);
      out.send(channel, count);
    }
    // Nothing is sent to wait.
    void operator()(const AwaitMode&) const {}
    void operator()(const AwaitArmed&) const {}
  };
  const Time patient = patient_until_;
  std::visit(Sender{*this, now, channel, out}, waiting_.front().steps[place_]);
  patient_until_ = patient;  // repetitions do not make it longer
  sent_ = now;
  if (tries_ < 255) ++tries_;
}

// What was accepted shows in what the vehicle says of itself, or it is said that not.
void CommandSender::await(Time now) {
  const auto* mode = current<AwaitMode>();
  if (mode ? mode_ == mode->mode : armed_) return step_done();
  if (!sent_) {
    sent_ = now;
    patient_until_ = now + kPatienceFor;
  }
  if (now < patient_until_) return;
  fail(Outcome::kDenied, mode ? fmt::format("accepted, but it stays in {}", mode_name_)
                              : std::string("accepted, but it stays disarmed"));
}

void CommandSender::step(Time now, Channel channel, Outbox& out) {
  if (waiting_.empty()) return;
  if (current<AwaitMode>() || current<AwaitArmed>()) return await(now);
  if (!sent_) {
    patient_until_ = now + kPatienceFor + round_trip_ * kRoundTrips;
    mode_before_ = mode_;
    stood_ = on_ground_;
    return send(now, channel, out);
  }
  if (now >= patient_until_ && rejected_)
    fail(Outcome::kDenied, text_of_result(kResultTemporarilyRejected));
  else if (now >= patient_until_)
    fail(Outcome::kNoAnswer,
         fmt::format("not answered in {} {}", tries_, tries_ == 1 ? "try" : "tries"));
  else if (now - *sent_ >= kAgainAfter && may_repeat())
    send(now, channel, out);
}

}  // namespace skein::autopilot_client
