// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "skein/data/radio/message.h"
#include "skein/layer/reasoning/avoidance/manoeuvre/candidates.h"
#include "skein/layer/reasoning/avoidance/negotiation/deal.h"

namespace skein::reasoning {

/// A negotiation by who has opened it and its number there.
struct NegotiationName {
  EntityId opener;
  std::uint32_t number = 0;
  friend bool operator==(const NegotiationName&, const NegotiationName&) = default;
};

/// One of the two of a negotiation, as both know it.
struct NegotiatingFlight {
  FlightPlan plan;      ///< that it has said it flies
  double rejoins = 0;   ///< where its plan must be met again, by the time of the plan [s]
  FlightLimits limits;  ///< what its manoeuvres are made with
};

/// What a negotiation is about. All numbers are those of the notice.
struct NegotiatedConflict {
  EntityId self, other;
  NegotiationName name;
  double begin = 0, meets = 0, closest = 0, apart = 0;  ///< [s]
  Separation separation;                                ///< that the two have to keep
  double look_until = 0;           ///< encounters after it do not count [s]
  double delay = 0;                ///< of messages between the two, one way [s]
  DealRule deal = DealRule::kSum;  ///< by which the own aircraft agrees
};

/// The rule by which two agree that prefer these: of different ones the one that trusts
/// the other less, kSum before kProduct before kZeuthen.
constexpr DealRule deal_rule_of(DealRule a, DealRule b) {
  return std::max(a, b);
}

/// What an option of this cost is worth in a deal: 1 - cost / 120 s, never below 0.
double utility_of(double cost);

/// What the own aircraft counts with while it makes its offers.
struct NegotiationView {
  std::span<const KnownFlight> others;  ///< all but the other of the negotiation
  /// Whether zones and ground leave a flight free; empty: they do.
  std::function<bool(const FlightPlan&)> is_free;
};

/// The negotiation of two about one conflict: iterative peer-to-peer.
///
/// Each offers all that it can do and what that costs it. Both make the same flights of
/// both offers, find the same deal among the pairs that are apart, and say so. Where no
/// pair is apart, both offer stronger manoeuvres: 1, 1.7, 3 times. It is agreed when both
/// have said the same pair, or when the other says that it flies it already.
///
/// The deal is the one of deal_rule_of() of what both prefer, each saying so with its
/// offers. By kSum it is the pair with the least sum of costs (ties: the first of the
/// opener's, then of the other's). By the others it is that of agree() over the
/// utilities, the opener being aircraft 1; options without utility to their own aircraft
/// are none. Concessions need no messages of their own: each works them out for both.
///
/// Whatever is lost is said again, whatever comes twice changes nothing; it ends by
/// itself when its time is over.
/// Reference: spec/team.md section 6; [Sislak11].
class PairNegotiation {
 public:
  enum class State { kOpen, kAgreed, kFailed };

  PairNegotiation(const NegotiatedConflict& conflict, NegotiatingFlight own,
                  NegotiatingFlight other, Time now);

  /// The notice that opens it, which the opener sends and repeats.
  void set_notice(const ConflictNotice& notice) { notice_ = notice; }

  void take(const Offers& offers);
  void take(const Acceptance& acceptance);
  /// The other flies what was agreed.
  void other_flies_it() { other_flies_ = true; }
  /// The other does not take part.
  void refuse(std::string_view why);

  /// Works on, and says what there is to be said.
  void step(Time now, const NegotiationView& view, std::vector<Message>& out);

  State state() const { return state_; }
  std::string_view why_failed() const { return why_; }
  const NegotiatedConflict& conflict() const { return conflict_; }

  /// What was agreed, once it was: the own manoeuvre and flight, from `begin` on.
  const Manoeuvre& manoeuvre() const { return agreed_.manoeuvre; }
  const FlightPlan& flight() const { return agreed_.flight; }
  /// Where that meets the plan again, by the time of the plan [s].
  double rejoins() const { return own_.rejoins; }

  /// Says once more what the other may not have received.
  void say_again(std::vector<Message>& out) const;

 private:
  static constexpr std::array kStrengths = {1.0, 1.7, 3.0};
  struct Side {
    std::optional<Offers> offers;
    std::vector<std::optional<FlightPlan>> flights;
  };
  struct Pair {
    std::size_t own = 0, other = 0;
  };

  bool opened() const { return conflict_.name.opener == conflict_.self; }
  void make_offers(const NegotiationView& view);
  void make_flights();
  std::optional<Pair> deal() const;
  std::optional<Pair> cheapest() const;
  std::optional<Pair> fairest(DealRule rule) const;
  bool are_apart(const Pair& pair) const;
  bool work(const NegotiationView& view);
  void fail(std::string_view why);
  void send(decltype(Message::content) content, std::vector<Message>& out) const;

  NegotiatedConflict conflict_;
  NegotiatingFlight own_, other_;
  Time said_;
  double repeat_ = 1, deadline_ = 0;
  std::optional<ConflictNotice> notice_;
  std::array<Side, kStrengths.size()> mine_, theirs_;
  std::size_t strength_ = 0;
  std::optional<Acceptance> my_acceptance_, their_acceptance_;
  bool other_flies_ = false, changed_ = true;
  State state_ = State::kOpen;
  std::string_view why_;
  Candidate agreed_;
};

/// The flight with a manoeuvre, from the conflict's begin to the end of the plan: what
/// comes after `rejoins` is flown as much later as the manoeuvre takes longer.
std::optional<FlightPlan> flight_with(const Manoeuvre& manoeuvre,
                                      const NegotiatingFlight& flight,
                                      const NegotiatedConflict& conflict);

}  // namespace skein::reasoning
