#include "skein/link/autopilot_client/command_sender.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace skein::autopilot_client {
namespace {

using mavlink::CommandInt;
using mavlink::CommandLong;
using vehicle_services::Channel;
using vehicle_services::Outbox;
using Outcome = RequestAnswer::Outcome;

const Time kAgainAfter = Time::from_seconds(0.5);
const Time kPatienceFor = Time::from_seconds(6);
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

}  // namespace

bool CommandSender::add(NumberedRequest request) {
  if (request.steps.empty()) {
    if (request.number != 0) answers_.push_back({request.number, Outcome::kAccepted, {}});
    return true;
  }
  if (waiting_.size() >= kMaxWaiting) return false;
  waiting_.push_back(std::move(request));
  return true;
}

void CommandSender::step_done() {
  begin_step();
  if (++place_ < waiting_.front().steps.size()) return;
  if (waiting_.front().number != 0)
    answers_.push_back({waiting_.front().number, Outcome::kAccepted, {}});
  waiting_.pop_front();
  place_ = 0;
}

void CommandSender::fail(Outcome outcome, std::string text) {
  if (waiting_.front().number != 0)
    answers_.push_back({waiting_.front().number, outcome, std::move(text)});
  waiting_.pop_front();
  place_ = 0;
  begin_step();
}

void CommandSender::begin_step() {
  sent_.reset();
  item_.reset();
  tries_ = 0;
  rejected_ = false;
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
  const auto* change = current<SetParameter>();
  if (!change || !sent_ || mavlink::text_of(value.param_id) != change->name) return;
  // Somebody else's question may bring the old one.
  constexpr std::uint8_t kReal32 = 9;
  const float tolerance = 1e-4F * std::max(1.F, std::abs(change->value));
  if (change->type == kReal32 &&
      !(std::abs(value.param_value - change->value) <= tolerance))
    return;
  step_done();
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
  const bool fence = mission->type == mavlink::MissionType::kFence;
  fail(Outcome::kDenied,
       fmt::format("{} refused: result {}", fence ? "fence" : "mission", ack.type));
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
      set.param_value = change.value;
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
  };
  const Time patient = patient_until_;
  std::visit(Sender{*this, now, channel, out}, waiting_.front().steps[place_]);
  patient_until_ = patient;  // repetitions do not make it longer
  sent_ = now;
  if (tries_ < 255) ++tries_;
}

void CommandSender::step(Time now, Channel channel, Outbox& out) {
  if (waiting_.empty()) return;
  if (!sent_) {
    patient_until_ = now + kPatienceFor;
    return send(now, channel, out);
  }
  if (now >= patient_until_ && rejected_)
    fail(Outcome::kDenied, text_of_result(kResultTemporarilyRejected));
  else if (now >= patient_until_)
    fail(Outcome::kNoAnswer, fmt::format("not answered in {} tries", tries_));
  else if (now - *sent_ >= kAgainAfter)
    send(now, channel, out);
}

}  // namespace skein::autopilot_client
