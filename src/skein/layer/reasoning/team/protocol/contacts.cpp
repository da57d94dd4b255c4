#include "skein/layer/reasoning/team/protocol/contacts.h"

#include <algorithm>
#include <cmath>

#include "skein/layer/reasoning/team/protocol/fingerprint.h"

namespace skein::reasoning {
namespace {

constexpr std::size_t kMaxItems = 1000;  // of a list
constexpr std::size_t kMaxName = 64;     // bytes
constexpr double kMaxPlace = 1e7;        // [m]
constexpr double kMaxNumber = 1e7;       // speeds, times, bids
constexpr std::uint32_t kWindow = 64;    // numbers that a sequence remembers
constexpr double kMaxRate = 64;          // messages to one receiver in a second

bool is_sane(double value) {
  return std::isfinite(value) && value >= 0 && value <= kMaxNumber;
}
bool is_sane(const Vec3& place) {
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
         is_sane(resources.endurance);
}
bool is_sane(const TeamTask& task) {
  return is_sane(task.place);
}
bool is_sane(const TeamProgress& progress) {
  return progress.share >= 0 && progress.share <= 1;
}
bool is_sane(const TeamMeeting& meeting) {
  return meeting.lower < meeting.higher;
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

}  // namespace

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
                               double now, double lost) {
  restarted_ = false;
  if (from == self_) return TeamVerdict::kOwnId;
  if (!known_.empty() && !known_.contains(from)) return TeamVerdict::kUnknown;
  if (message.version != TeamMessage::kVersion) return TeamVerdict::kOtherVersion;
  if (is_implausible(message.content)) return TeamVerdict::kImplausible;
  Peer& peer = peers_[from];
  const TeamVerdict verdict =
      judge(to_all ? peer.to_all : peer.to_self, message, to_all, now, lost);
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

TeamVerdict TeamContacts::judge(Sequence& sequence, const TeamMessage& message,
                                bool to_all, double now, double lost) {
  if (!sequence.begun) {
    sequence.begun = true;
    sequence.highest = message.number;
    sequence.seen = 1;
    sequence.content.fill(0);
    sequence.content[message.number % kWindow] = fingerprint(message);
    sequence.last = now;
    return TeamVerdict::kNew;
  }
  return message.number > sequence.highest ? newer(sequence, message, to_all, now, lost)
                                           : older(sequence, message, to_all, now, lost);
}

TeamVerdict TeamContacts::newer(Sequence& sequence, const TeamMessage& message,
                                bool to_all, double now, double lost) {
  const std::uint32_t step = message.number - sequence.highest;
  const double silent = now - sequence.last;
  // Numbers that nobody could have used up meanwhile are made up.
  if (step > kWindow + kMaxRate * std::max(0.0, silent)) return TeamVerdict::kImplausible;
  if (to_all) loss_.arrived(silent > lost ? 0 : step - 1);
  sequence.seen = step < kWindow ? (sequence.seen << step) | 1 : 1;
  sequence.highest = message.number;
  sequence.content[message.number % kWindow] = fingerprint(message);
  sequence.last = now;
  return TeamVerdict::kNew;
}

TeamVerdict TeamContacts::older(Sequence& sequence, const TeamMessage& message,
                                bool to_all, double now, double lost) {
  const std::uint32_t back = sequence.highest - message.number;
  if (back >= kWindow) {
    if (now - sequence.last <= lost) return TeamVerdict::kDuplicateId;
    sequence = {};  // it was switched off and on
    restarted_ = true;
    return judge(sequence, message, to_all, now, lost);
  }
  const std::uint64_t bit = std::uint64_t{1} << back;
  const std::uint64_t said = fingerprint(message);
  std::uint64_t& kept = sequence.content[message.number % kWindow];
  if ((sequence.seen & bit) != 0) {
    if (kept != said) {
      if (now - sequence.last <= lost) return TeamVerdict::kDuplicateId;
      sequence = {};
      restarted_ = true;
      return judge(sequence, message, to_all, now, lost);
    }
    return TeamVerdict::kRepeated;
  }
  sequence.seen |= bit;
  kept = said;
  if (to_all) loss_.arrived_late();
  return TeamVerdict::kLate;
}

}  // namespace skein::reasoning
