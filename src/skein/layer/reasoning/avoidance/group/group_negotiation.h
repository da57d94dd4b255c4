// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <vector>

#include "skein/data/radio/message.h"
#include "skein/layer/reasoning/avoidance/pairwise/pair_negotiation.h"

namespace skein::reasoning {

/// One of a group, as its coordinator knows it.
struct JoinedMember {
  EntityId who;
  double rejoins = 0;   ///< where its plan must be met again, by the time of the plan [s]
  FlightLimits limits;  ///< what its manoeuvres are made with
};

/// How several solve their conflicts together: a coordinator invites, those who can take
/// part say so, it works out what each shall do, and all fly it once all have said that
/// they will, or none does.
///
/// Who does not answer is left out: its flight is one that the others keep apart from.
/// Whatever is lost is said again, whatever comes twice changes nothing; it ends by
/// itself before what was worked out would begin. Whoever flies its part already (its
/// PlanReport says so) has accepted.
/// Reference: spec/team.md section 7; [Sislak11].
class GroupNegotiation {
 public:
  enum class State { kOpen, kAgreed, kFailed };

  /// @param name   of the group: its coordinator, who may be `self`, and its number
  ///               there.
  /// @param own    the own flight.
  /// @param delay  of messages among the members, one way, the longest [s].
  GroupNegotiation(EntityId self, const NegotiationName& name,
                   const GroupInvitation& invitation, NegotiatingFlight own, double delay,
                   Time now);

  void take(EntityId from, const GroupJoining& joining);
  void take(EntityId from, const GroupPlan& plan);
  void take(EntityId from, const GroupAcceptance& acceptance);
  /// One of the group flies what comes out: it has heard that all take part.
  void other_flies_it() { other_flies_ = true; }

  struct View {
    /// What comes out for those who take part; of the coordinator. None: nothing that is
    /// better than to go on.
    std::function<std::optional<std::vector<GroupManoeuvre>>(
        std::span<const JoinedMember>)>
        solve;
    /// Whether zones and ground leave a flight free; empty: they do.
    std::function<bool(const FlightPlan&)> is_free;
  };
  /// Works on, and says what there is to be said.
  void step(Time now, const View& view, std::vector<Message>& out);
  /// It does not take part any more, and says so.
  void leave(std::vector<Message>& out);

  State state() const { return state_; }
  std::string_view why_failed() const { return why_; }
  const NegotiationName& name() const { return name_; }
  double begin() const { return invitation_.begin; }  ///< of what was agreed [s]
  double apart() const { return invitation_.apart; }  ///< of all conflicts [s]
  double rejoins() const { return own_.rejoins; }

  /// What was agreed, once it was. None: the own aircraft goes on.
  const std::optional<FlightPlan>& flight() const { return flight_; }
  ManoeuvreKind kind() const { return kind_; }
  /// Whether it is known what comes out.
  bool is_solved() const { return plan_.has_value(); }
  /// Who takes part, without the own aircraft.
  std::vector<EntityId> partners() const;

 private:
  bool coordinates() const { return name_.opener == self_; }
  void fail(std::string_view why);
  void send(EntityId to, decltype(Message::content) content,
            std::vector<Message>& out) const;
  void say(std::vector<Message>& out) const;
  void coordinate(Time now, const View& view);
  void judge(const View& view);

  EntityId self_;
  NegotiationName name_;
  GroupInvitation invitation_;
  NegotiatingFlight own_;
  double joins_until_ = 0, deadline_ = 0, repeat_ = 1;  // [s]
  Time said_;
  bool changed_ = true, other_flies_ = false;
  std::map<EntityId, JoinedMember> joined_;
  std::set<EntityId> absent_;  // who has said that it does not take part
  std::optional<GroupPlan> plan_;
  std::optional<bool> own_answer_;
  std::set<EntityId> accepted_;
  std::optional<FlightPlan> flight_;
  ManoeuvreKind kind_ = ManoeuvreKind::kGoOn;
  State state_ = State::kOpen;
  std::string_view why_;
};

/// The flight that a manoeuvre of a group makes of a plan; none where that does not work.
std::optional<FlightPlan> flight_of(const GroupManoeuvre& manoeuvre,
                                    const NegotiatingFlight& flight, double begin);

}  // namespace skein::reasoning
