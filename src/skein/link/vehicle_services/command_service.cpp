// SPDX-License-Identifier: Apache-2.0
#include "skein/link/vehicle_services/command_service.h"

#include <algorithm>

#include "skein/link/vehicle_services/vehicle_commands.h"

namespace skein::vehicle_services {
namespace {

using mavlink::CommandId;
using mavlink::CommandResult;

constexpr std::size_t kMaxExecuted = 16;
// A sender that says that it repeats itself has heard nothing since.
const Time kRepeated = Time::from_seconds(30);
const Time kUnsaid = Time::from_seconds(10);
const Time kReportAgain = Time::from_seconds(1);
constexpr std::uint8_t kNoProgress = 255;

bool is_from(const Peer& a, const Peer& b) {
  return a.system == b.system && a.component == b.component;
}

}  // namespace

void acknowledge(CommandId id, CommandResult result, std::uint8_t percent, const Peer& to,
                 Outbox& out) {
  mavlink::CommandAck ack;
  ack.command = static_cast<std::uint16_t>(id);
  ack.result = static_cast<std::uint8_t>(result);
  ack.progress = percent;
  ack.target_system = to.system;
  ack.target_component = to.component;
  out.send(to.channel, ack);
}

CommandService::Executed* CommandService::find_repeated(const Command& command,
                                                        const Peer& from,
                                                        std::uint8_t sequence,
                                                        Time wall) {
  for (auto e = executed_.rbegin(); e != executed_.rend(); ++e) {
    if (wall - e->at > (command.is_repeated ? kRepeated : kUnsaid) ||
        !is_from(e->from, from) || !e->command.is_same(command))
      continue;
    const bool frame_again = e->sequence == sequence;
    const bool cannot_say = command.in_integers && e == executed_.rbegin();
    if (command.is_repeated || frame_again || cannot_say) return &*e;
  }
  return nullptr;
}

void CommandService::remember(const Executed& executed) {
  if (executed_.size() >= kMaxExecuted) executed_.erase(executed_.begin());
  executed_.push_back(executed);
}

void CommandService::handle(const Command& command, const Peer& from,
                            std::uint8_t sequence, bool for_all, VehicleParts& parts,
                            Outbox& out) {
  const auto answer_with = [&](CommandResult result) {
    acknowledge(command.id, result, kNoProgress, from, out);
  };
  if (is_query(command.id)) {
    const Answer answer = judge_query(command, parts, from.channel);
    answer_with(answer.result);
    if (answer.result == CommandResult::kAccepted)
      send_reply(command, parts, from.channel, out);
    return;
  }
  if (for_all) return;
  const Time wall = parts.vehicle.now.wall;
  if (Executed* known = find_repeated(command, from, sequence, wall)) {
    known->at = wall;
    if (known->result == CommandResult::kInProgress && running_)
      return acknowledge(command.id, CommandResult::kInProgress, running_->percent, from,
                         out);
    return answer_with(known->result);
  }
  if (running_ && command.id == running_->command.id)
    return answer_with(CommandResult::kTemporarilyRejected);
  Answer answer = execute(command, parts);
  if (!answer.reason.empty())
    parts.vehicle.say(mavlink::Severity::kWarning, std::move(answer.reason));
  if (answer.result == CommandResult::kAccepted && answer.take_off_msl) {
    answer.result = CommandResult::kInProgress;
    running_ = Running{command, from,
                       TakeOffProgress(parts.vehicle, *answer.take_off_msl), wall};
  }
  remember({command, from, sequence, wall, answer.result});
  acknowledge(command.id, answer.result,
              running_ && answer.take_off_msl ? 0 : kNoProgress, from, out);
}

void CommandService::step(VehicleParts& parts, Outbox& out) {
  if (!running_) return;
  const Time wall = parts.vehicle.now.wall;
  const auto [result, percent] = running_->progress.check(parts.vehicle);
  running_->percent = percent;
  const bool ended = result != CommandResult::kInProgress;
  if (!ended && wall - running_->reported < kReportAgain) return;
  running_->reported = wall;
  acknowledge(running_->command.id, result, ended ? kNoProgress : percent, running_->from,
              out);
  if (!ended) return;
  // For who asks again because this answer was lost.
  for (Executed& e : executed_)
    if (e.result == CommandResult::kInProgress) {
      e.result = result;
      e.at = wall;
    }
  running_.reset();
}

void CommandService::close(Channel channel) {
  std::erase_if(executed_, [&](const Executed& e) { return e.from.channel == channel; });
  if (running_ && running_->from.channel == channel) running_.reset();
}

}  // namespace skein::vehicle_services
