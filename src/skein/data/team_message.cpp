#include "skein/data/team_message.h"

namespace skein {
namespace {

struct AirBytes {
  std::size_t operator()(const TeamQuery&) const { return 25; }
  std::size_t operator()(const TeamInform&) const { return 70; }
  std::size_t operator()(const TeamPropose&) const { return 70; }
  std::size_t operator()(const TeamAccept&) const { return 25; }
  std::size_t operator()(const TeamReject&) const { return 13; }
  std::size_t operator()(const TeamConfirm&) const { return 17; }
  std::size_t operator()(const TeamDecline&) const { return 13; }
  std::size_t operator()(const TeamAssign& m) const { return 21 + 48 * m.tasks.size(); }
  std::size_t operator()(const TeamAssignAck&) const { return 17; }
  std::size_t operator()(const TeamState& m) const {
    std::size_t bytes = 21 + 2 * m.members.size() + 8 * m.met.size();
    for (const TeamTask& task : m.tasks) bytes += 24 + 2 * task.after.size();
    return bytes;
  }
  std::size_t operator()(const TeamMerge& m) const { return 25 + 2 * m.members.size(); }
  std::size_t operator()(const TeamSplit& m) const { return 25 + 24 * m.tasks.size(); }
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
