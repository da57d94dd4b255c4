// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "skein/data/event/event_kind.h"
#include "skein/data/team/team_message.h"
#include "skein/layer/reasoning/team/protocol/timers.h"

namespace skein::reasoning {

/// What a received message is, before anybody looks at what it says.
enum class TeamVerdict : std::uint8_t {
  kNew,           ///< to be looked at
  kLate,          ///< out of date: what it says of now was said anew before it came
  kRepeated,      ///< it was here before
  kOtherVersion,  ///< of the protocol
  kOwnId,         ///< somebody else has the own id
  kUnknown,       ///< not one of those that may be in the team
  kDuplicateId,   ///< two senders have one id
  kImplausible,   ///< no member would say so
};

/// The event that reports a refused message. Bug for verdicts that refuse none.
EventKind event_of(TeamVerdict verdict);

/// Of proposed allocations.
inline constexpr std::uint32_t kMaxProposalNumber = 1000000;

/// Whether no honest sender could have made a message: numbers that are not finite or out
/// of all bounds, lists of more than 1000, names of missions that are empty or long.
bool is_implausible(const TeamContent& content);

/// How long somebody may be silent [s].
struct TeamSilence {
  double lost = 4;    ///< longer: it may begin to count its messages anew
  double absent = 4;  ///< longer: it was out of reach, and the gap is no loss of messages
};

/// Whom a member hears, and the last that each said of itself.
class TeamContacts {
 public:
  struct Contact {
    double heard = -1e300;     ///< when something of it arrived last [s]
    double informed = -1e300;  ///< when `inform` arrived, or `here` that renews it [s]
    double queried = -1e300;   ///< when `query` arrived [s]
    TeamInform inform;
    TeamQuery query;
    std::uint32_t query_number = 0;
    bool leads = false;  ///< the last that it said to all was a query
  };

  /// @param known  ids that may be in the team; empty: any.
  TeamContacts(EntityId self, std::set<EntityId> known)
      : self_(self), known_(std::move(known)) {}

  /// Judges a message, and remembers its sender and what it says of itself.
  /// @param to_all  whether it was sent to all.
  TeamVerdict take(EntityId from, bool to_all, const TeamMessage& message, double now,
                   const TeamSilence& silence);

  const std::map<EntityId, Contact>& all() const { return contacts_; }
  const Contact* find(EntityId id) const;
  /// Who executes which task, as members have said not longer than `forgotten` [s] ago;
  /// of several who has said so last.
  std::map<std::uint32_t, EntityId> executors(double now, double forgotten) const;
  /// Something else of it was heard: a report, a plan.
  void note_heard(EntityId id, double now);
  /// Whether a sender has begun to count anew with the last message taken.
  bool restarted() const { return restarted_; }
  double loss() const { return loss_.loss(); }

 private:
  // The last 64 numbers of a sequence that arrived, and what they said.
  struct Sequence {
    bool begun = false;
    std::uint32_t highest = 0;
    std::uint64_t seen = 0;                   // bit k: highest - k arrived
    std::array<std::uint64_t, 64> content{};  // hash of number n at n % 64
    std::array<std::uint32_t, 3> newest{};    // of each kind of news, its number
    double last = -1e300;  // when a number arrived that was higher than all before
  };
  struct Peer {
    Sequence to_all, to_self;
  };
  TeamVerdict judge(Peer& peer, const TeamMessage& message, bool to_all, double now,
                    const TeamSilence& silence);
  TeamVerdict newer(Peer& peer, const TeamMessage& message, bool to_all, double now,
                    const TeamSilence& silence);
  TeamVerdict older(Peer& peer, const TeamMessage& message, bool to_all, double now,
                    const TeamSilence& silence);
  static bool is_out_of_date(Sequence& sequence, const TeamMessage& message);

  EntityId self_;
  std::set<EntityId> known_;
  std::map<EntityId, Contact> contacts_;
  std::map<EntityId, Peer> peers_;
  LossMeter loss_;
  bool restarted_ = false;
};

}  // namespace skein::reasoning
