// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/contacts.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "skein/layer/reasoning/team/protocol/fingerprint.h"

namespace skein::reasoning {
namespace {

constexpr std::size_t kMaxItems = 1000;  // of a list
constexpr std::size_t kMaxBefore = 100;  // tasks that one comes after
constexpr std::size_t kMaxName = 64;     // bytes
constexpr double kMaxPlace = 1e7;        // [m]
constexpr double kMaxNumber = 1e7;       // speeds, times, bids
constexpr std::uint32_t kWindow = 64;    // numbers that a sequence remembers
constexpr double kMaxRate = 64;          // messages to one receiver in a second

bool is_sane(double value) {
  return std::isfinite(value) && value >= 0 && value <= kMaxNumber;
}
template <int kSize>
bool is_sane(const Eigen::Matrix<double, kSize, 1>& place) {
  return place.allFinite() && place.cwiseAbs().maxCoeff() <= kMaxPlace;
}
bool is_sane(const TeamMission& mission) {
  return !mission.name.empty() && mission.name.size() <= kMaxName;
}
bool is_sane(const std::optional<TeamMission>& mission) {
  return !mission || is_sane(*mission);
}
bool is_sane(const TeamResources& resources) {
  return is_sane(resources.place) && is_sane(resources.speed) &&
         is_sane(resources.endurance) &&
         is_sane(Vec2(resources.home_north, resources.home_east)) &&
         resources.refused.size() <= kMaxItems;
}
bool is_sane(const TeamTask& task) {
  return is_sane(task.place) && task.after.size() <= kMaxBefore &&
         std::ranges::find(task.after, task.number) == task.after.end();
}
bool is_sane(const TeamProgress& progress) {
  return progress.share >= 0 && progress.share <= 1;
}
bool is_sane(const TeamEncounter& encounter) {
  return encounter.lower < encounter.higher;
}
bool is_sane(const EntityId&) {
  return true;
}
bool is_sane(const std::optional<float>& utility) {
  return !utility || (std::isfinite(*utility) && std::abs(*utility) <= kMaxNumber);
}
bool is_sane(const TeamBid& bid) {
  return is_sane(bid.value);
}
bool is_sane(const TeamShare&) {
  return true;
}
template <class T>
bool is_sane(const std::vector<T>& list) {
  return list.size() <= kMaxItems &&
         std::ranges::all_of(list, [](const T& item) { return is_sane(item); });
}

struct Sane {
  bool operator()(const TeamQuery& m) const {
    return is_sane(m.mission) && is_sane(m.led) && is_sane(m.round_trip);
  }
  bool operator()(const TeamInform& m) const {
    return is_sane(m.mission) && is_sane(m.held) && is_sane(m.resources) &&
           is_sane(m.tasks);
  }
  bool operator()(const TeamPropose& m) const { return is_sane(m.resources); }
  bool operator()(const TeamAccept& m) const {
    return is_sane(m.mission) && is_sane(m.distance);
  }
  bool operator()(const TeamReject&) const { return true; }
  bool operator()(const TeamConfirm&) const { return true; }
  bool operator()(const TeamDecline&) const { return true; }
  bool operator()(const TeamAssign& m) const {
    return is_sane(m.mission) && is_sane(m.tasks);
  }
  bool operator()(const TeamAssignAck&) const { return true; }
  bool operator()(const TeamState& m) const {
    return m.part < m.parts && m.parts <= kMaxItems && is_sane(m.members) &&
           is_sane(m.met) && is_sane(m.tasks);
  }
  bool operator()(const TeamMerge& m) const {
    return is_sane(m.mission) && is_sane(m.meeting) && is_sane(m.members);
  }
  bool operator()(const TeamSplit& m) const {
    return m.part < m.parts && m.parts <= kMaxItems && is_sane(m.mission) &&
           is_sane(m.meeting) && is_sane(m.tasks);
  }
  bool operator()(const TeamBids& m) const {
    return is_sane(m.mission) && is_sane(m.bids);
  }
  bool operator()(const TeamProposal& m) const {
    return is_sane(m.mission) && m.number > 0 && m.number <= kMaxProposalNumber &&
           is_sane(m.value) && is_sane(m.bound) && is_sane(m.shares);
  }
  bool operator()(const TeamHere& m) const { return is_sane(m.held); }
  bool operator()(const TeamDecision& m) const { return m.number <= kMaxProposalNumber; }
};

// What a member says of itself, what is bid, what is proposed; none: it counts whenever
// it comes.
std::optional<std::size_t> kind_of_news(const TeamContent& content) {
  if (std::holds_alternative<TeamQuery>(content) ||
      std::holds_alternative<TeamInform>(content) ||
      std::holds_alternative<TeamHere>(content))
    return 0;
  if (std::holds_alternative<TeamBids>(content)) return 1;
  if (std::holds_alternative<TeamProposal>(content)) return 2;
  return std::nullopt;
}

}  // namespace

EventKind event_of(TeamVerdict verdict) {
  switch (verdict) {
    case TeamVerdict::kOtherVersion:
      return EventKind::kTeamOtherVersion;
    case TeamVerdict::kOwnId:
      return EventKind::kTeamOwnId;
    case TeamVerdict::kUnknown:
      return EventKind::kTeamUnknownSender;
    case TeamVerdict::kDuplicateId:
      return EventKind::kTeamDuplicateId;
    case TeamVerdict::kImplausible:
      return EventKind::kTeamImplausible;
    case TeamVerdict::kNew:
    case TeamVerdict::kLate:
    case TeamVerdict::kRepeated:
      break;
  }
  throw Bug("a message that is not refused has no such event");
}

bool is_implausible(const TeamContent& content) {
  return !std::visit(Sane{}, content);
}

const TeamContacts::Contact* TeamContacts::find(EntityId id) const {
  const auto found = contacts_.find(id);
  return found == contacts_.end() ? nullptr : &found->second;
}

void TeamContacts::note_heard(EntityId id, double now) {
  if (id != self_) contacts_[id].heard = now;
}

TeamVerdict TeamContacts::take(EntityId from, bool to_all, const TeamMessage& message,
                               double now, const TeamSilence& silence) {
  restarted_ = false;
  if (from == self_) return TeamVerdict::kOwnId;
  if (!known_.empty() && !known_.contains(from)) return TeamVerdict::kUnknown;
  if (message.version != TeamMessage::kVersion) return TeamVerdict::kOtherVersion;
  if (is_implausible(message.content)) return TeamVerdict::kImplausible;
  const TeamVerdict verdict = judge(peers_[from], message, to_all, now, silence);
  if (verdict != TeamVerdict::kNew && verdict != TeamVerdict::kLate) return verdict;
  Contact& contact = contacts_[from];
  contact.heard = now;
  if (!to_all || verdict == TeamVerdict::kLate) return verdict;
  if (const auto* inform = std::get_if<TeamInform>(&message.content)) {
    contact.inform = *inform;
    contact.informed = now;
    contact.leads = false;
  } else if (const auto* here = std::get_if<TeamHere>(&message.content)) {
    // Of one whose inform was lost it says nothing but that it is there.
    if (contact.leads || contact.inform.master != here->master) return verdict;
    contact.inform.query = here->query;
    contact.inform.held = here->held;
    contact.inform.members_hash = here->members_hash;
    contact.inform.state_number = here->state_number;
    contact.informed = now;
  } else if (const auto* query = std::get_if<TeamQuery>(&message.content)) {
    contact.query = *query;
    contact.query_number = message.number;
    contact.queried = now;
    contact.leads = query->mission.has_value();
  }
  return verdict;
}

std::map<std::uint32_t, EntityId> TeamContacts::executors(double now,
                                                          double forgotten) const {
  std::map<std::uint32_t, EntityId> all;
  for (const auto& [id, contact] : contacts_) {
    if (now - contact.informed > forgotten) continue;
    const auto& tasks = contact.inform.tasks;
    if (tasks.empty()) continue;
    const auto left = std::ranges::find_if(
        tasks, [](const TeamProgress& task) { return task.share < 1; });
    const auto flown = left == tasks.end() ? tasks.front().task : left->task;
    const auto [known, is_first] = all.try_emplace(flown, id);
    if (!is_first && contact.informed > contacts_.at(known->second).informed)
      known->second = id;
  }
  return all;
}

TeamVerdict TeamContacts::judge(Peer& peer, const TeamMessage& message, bool to_all,
                                double now, const TeamSilence& silence) {
  Sequence& sequence = to_all ? peer.to_all : peer.to_self;
  if (!sequence.begun) {
    sequence.begun = true;
    sequence.highest = message.number;
    sequence.seen = 1;
    sequence.content.fill(0);
    sequence.content[message.number % kWindow] = fingerprint(message);
    is_out_of_date(sequence, message);
    sequence.last = now;
    return TeamVerdict::kNew;
  }
  return message.number > sequence.highest ? newer(peer, message, to_all, now, silence)
                                           : older(peer, message, to_all, now, silence);
}

TeamVerdict TeamContacts::newer(Peer& peer, const TeamMessage& message, bool to_all,
                                double now, const TeamSilence& silence) {
  Sequence& sequence = to_all ? peer.to_all : peer.to_self;
  const std::uint32_t step = message.number - sequence.highest;
  const double silent = now - sequence.last;
  // Numbers that nobody could have used up meanwhile are made up.
  if (step > kWindow + kMaxRate * std::max(0.0, silent)) return TeamVerdict::kImplausible;
  if (to_all) loss_.arrived(silent > silence.absent ? 0 : step - 1);
  sequence.seen = step < kWindow ? (sequence.seen << step) | 1 : 1;
  sequence.highest = message.number;
  sequence.content[message.number % kWindow] = fingerprint(message);
  is_out_of_date(sequence, message);
  sequence.last = now;
  return TeamVerdict::kNew;
}

TeamVerdict TeamContacts::older(Peer& peer, const TeamMessage& message, bool to_all,
                                double now, const TeamSilence& silence) {
  Sequence& sequence = to_all ? peer.to_all : peer.to_self;
  const std::uint32_t back = sequence.highest - message.number;
  const std::uint64_t bit = back < kWindow ? std::uint64_t{1} << back : 0;
  const std::uint64_t said = fingerprint(message);
  std::uint64_t& kept = sequence.content[message.number % kWindow];
  const bool is_seen = (sequence.seen & bit) != 0;
  if (is_seen && kept == said) return TeamVerdict::kRepeated;
  // It was switched off and on: it begins to count anew after a silence. A number that
  // was never used may be late; but not by a silence of all that it says.
  const bool was_used = is_seen || bit == 0;
  const double last =
      was_used ? sequence.last : std::max(peer.to_all.last, peer.to_self.last);
  if (now - last > silence.lost) {
    sequence = {};
    if (to_all) peer.to_self = {};
    restarted_ = true;
    return judge(peer, message, to_all, now, silence);
  }
  if (was_used) return TeamVerdict::kDuplicateId;
  sequence.seen |= bit;
  kept = said;
  if (to_all) loss_.arrived_late();
  return is_out_of_date(sequence, message) ? TeamVerdict::kLate : TeamVerdict::kNew;
}

// What it says of now counts when nothing newer of the same kind is known. Else the
// number is noted.
bool TeamContacts::is_out_of_date(Sequence& sequence, const TeamMessage& message) {
  const auto kind = kind_of_news(message.content);
  if (!kind) return false;
  if (message.number < sequence.newest[*kind]) return true;
  sequence.newest[*kind] = message.number;
  return false;
}

}  // namespace skein::reasoning
