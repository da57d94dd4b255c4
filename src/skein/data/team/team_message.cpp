// SPDX-License-Identifier: Apache-2.0
#include "skein/data/team/team_message.h"

namespace skein {
namespace {

std::size_t bytes_of(const std::vector<TeamTask>& tasks, std::size_t each) {
  std::size_t bytes = 0;
  for (const TeamTask& task : tasks) bytes += each + 2 * task.after.size();
  return bytes;
}

struct AirBytes {
  std::size_t operator()(const TeamQuery&) const { return 25; }
  std::size_t operator()(const TeamInform& m) const {
    return 70 + 2 * m.resources.refused.size();
  }
  std::size_t operator()(const TeamPropose& m) const {
    return 70 + 2 * m.resources.refused.size();
  }
  std::size_t operator()(const TeamAccept&) const { return 25; }
  std::size_t operator()(const TeamReject&) const { return 13; }
  std::size_t operator()(const TeamConfirm&) const { return 17; }
  std::size_t operator()(const TeamDecline&) const { return 13; }
  std::size_t operator()(const TeamAssign& m) const { return 21 + bytes_of(m.tasks, 48); }
  std::size_t operator()(const TeamAssignAck&) const { return 17; }
  std::size_t operator()(const TeamState& m) const {
    return 21 + 2 * m.members.size() + 8 * m.met.size() + bytes_of(m.tasks, 24);
  }
  std::size_t operator()(const TeamMerge& m) const { return 25 + 2 * m.members.size(); }
  std::size_t operator()(const TeamSplit& m) const { return 25 + bytes_of(m.tasks, 24); }
  std::size_t operator()(const TeamBids& m) const { return 17 + 10 * m.bids.size(); }
  std::size_t operator()(const TeamProposal& m) const { return 24 + 4 * m.shares.size(); }
  std::size_t operator()(const TeamDecision&) const { return 14; }
  std::size_t operator()(const TeamHere&) const { return 25; }
};

}  // namespace

std::string name_of(const TeamMission& mission) {
  if (!mission.branch) return mission.name;
  return mission.name + "/" + std::to_string(mission.branch->value);
}

std::string_view kind_of(const TeamContent& content) {
  return std::visit([]<class T>(const T&) { return kind_of<T>(); }, content);
}

std::size_t air_bytes(const TeamContent& content) {
  return std::visit(AirBytes{}, content);
}

}  // namespace skein
