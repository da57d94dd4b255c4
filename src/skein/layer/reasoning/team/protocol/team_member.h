// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "skein/base/random.h"
#include "skein/base/time.h"
#include "skein/data/event/event.h"
#include "skein/data/team/team_message.h"
#include "skein/layer/reasoning/team/protocol/auction.h"
#include "skein/layer/reasoning/team/protocol/contacts.h"
#include "skein/layer/reasoning/team/protocol/knowledge.h"
#include "skein/layer/reasoning/team/protocol/orders.h"
#include "skein/layer/reasoning/team/protocol/team_config.h"

namespace skein::reasoning {

/// A message of the team protocol as it arrives.
struct TeamReceived {
  EntityId from;
  bool to_all = true;
  TeamMessage message;
};

/// A message of the team protocol to be sent.
struct TeamOutgoing {
  std::optional<EntityId> to = std::nullopt;  ///< none: all
  TeamMessage message;
};

/// What a step gives.
struct TeamStep {
  std::vector<TeamOutgoing> send;
  std::vector<Event> events;
  std::vector<TeamAllocationReport> allocations;  ///< what has become of them
  bool changed = false;                           ///< status() is another one than before
};

/// A member of a team that leads itself: aircraft, or a ground station that may lead.
///
/// A state machine without input and output: it is given the time and what arrived, and
/// gives what is to be sent. Members select a master, follow it, and select another one
/// when it is lost; newcomers join a team; two masters of one mission that meet become
/// one team, and when they meet again split the mission and both stay. Only times of
/// arrival on the own clock count: clocks may be off.
///
/// With TeamConfig::approval a master proposes allocations to the station of the operator
/// (decide()); in force meanwhile is what was approved before. What a lost member had is
/// taken over by who is idle, without asking: that a task is flown is approved, not by
/// whom. A proposal is withdrawn, and worked out anew, when a task or an able member came
/// or went; it ends with the lead of its proposer.
///
/// Events: those of teams (docs/events.md), of a station kAllocationProposed and
/// kAllocationOver; of hostile or broken input those of the subject `protocol`: such
/// messages change nothing.
class TeamMember {
 public:
  TeamMember(EntityId self, TeamConfig config);

  /// The operator's mission. To be called of those that begin together, or of a master to
  /// add tasks.
  /// @returns  false when it follows somebody, or has another mission: nothing is taken.
  bool submit(const std::string& mission, std::span<const TeamTask> tasks, Time now);

  /// Tasks of an operator, who is with this member: submitted while nobody else leads;
  /// else the master is asked to take them, until it has them.
  void hand_in(const std::string& mission, std::span<const TeamTask> tasks, Time now);

  /// The operator, who is with this member, does not want a task any more. Whoever leads
  /// is told; who flies it stops, and what comes after it need not wait.
  /// @returns  false when it is not known here, or over.
  bool withdraw_task(std::uint32_t task);
  /// Tasks that are known here, those among them that the leader has not heard of yet.
  std::map<std::uint32_t, TeamTask> all_tasks() const;
  /// Who flies which task, as others have said last; of several who has said so last.
  std::map<std::uint32_t, EntityId> executors() const;

  void set_resources(const TeamResources& resources) {
    resources_ = resources;
    refused_by_task_ = resources.refused;
  }
  /// How far it is with a task that it executes; 1: done.
  void set_progress(std::uint32_t task, double share) { progress_[task] = share; }
  /// It shall not lead any more: energy, the operator. A master hands over.
  void leave(bool leaving = true) { leaving_ = leaving; }
  /// Something else of a member was heard: a report, a plan.
  void note_heard(EntityId id, Time now) { contacts_.note_heard(id, now.seconds()); }

  /// The operator, who is with this member, approves a proposed allocation or not.
  /// @param number  of the proposal; 0: the only one that waits.
  /// @returns  why that cannot be; empty: the leader will be told until it answers.
  std::string decide(std::uint32_t number, bool approve);

  /// To be called several times a query period, with what has arrived since the last.
  TeamStep step(Time now, std::span<const TeamReceived> received);

  const TeamStatus& status() const { return status_; }
  bool leads() const { return role_ == Role::kLeading; }
  /// Numbers of the tasks that it executes.
  const std::vector<std::uint32_t>& tasks() const { return executing_; }
  const TeamKnowledge& knowledge() const { return knowledge_; }
  /// T_lost [s], by the loss measured.
  double lost_after() const { return lost_; }
  /// After how long of silence a follower is lost [s]: T_lost, and longer where many say
  /// rarely that they are there (follower_period()).
  double follower_lost_after() const;
  /// The longest round trip measured [s].
  double round_trip() const { return round_trip_; }
  /// Of a master: whether all its orders were acknowledged.
  bool orders_acknowledged() const { return orders_.all_acknowledged(); }

 private:
  enum class Role : std::uint8_t { kNewcomer, kSelecting, kFollowing, kLeading, kAlone };

  // A follower, as its master has it.
  struct Follower {
    double claimed = 0;                       // when it last said that it follows
    bool certain = false;                     // it has said so
    bool able = true;                         // to fly tasks
    std::vector<std::uint32_t> refused = {};  // of them
  };
  // Another master of the same mission that should give way.
  struct Rival {
    double first = 0, heard = 0;
  };
  // A message to one that is repeated some times; it is the same however often it comes.
  struct Repeated {
    EntityId to;
    TeamContent content;
    int left = 0;
    double next = 0, until = 0;
  };
  // A split that was asked for.
  struct Asked {
    EntityId of;
    double first = 0, last = 0;
    std::map<std::uint32_t, std::vector<TeamTask>> parts;
  };
  // An allocation that a master has proposed.
  struct Proposal {
    std::uint32_t number = 0;
    TeamAllocated allocated;  // without who gets nothing
    TeamAllocation present;   // what was in force then
    std::set<std::uint32_t> tasks;
    std::set<EntityId> members;  // able ones
    bool seen = false, rejected = false;
    int quick = 0;    // messages that are left to be repeated soon
    double next = 0;  // when it is said again
  };
  // One that an operator is shown.
  struct Shown {
    TeamProposal proposal;
    std::optional<TeamAnswer> decision = std::nullopt;
    double next = 0;  // when that is said again
  };
  // How a newcomer looks for a team.
  struct Joining {
    double first_master = -1;  // when one was first heard
    double proposed = -1;      // when it proposed; before: it listens
    double next = 0;           // proposals are repeated
    double rest_until = 0;
    std::map<EntityId, std::optional<TeamAccept>> asked;  // none: no answer yet
    std::set<EntityId> rejected;
  };

  static constexpr int kInformRepeats = 3;  // in full, after a change
  static constexpr double kSilent = 2;      // query periods without a word of the master

  // team_member.cpp
  void report(EventKind kind, std::string text, EventNumbers numbers = {});
  void send_all(TeamContent content);
  void send_one(EntityId to, TeamContent content);
  void repeat(EntityId to, TeamContent content, int times);
  void follow(EntityId master, TeamReason reason);
  void lead(TeamReason reason, std::optional<EntityId> predecessor);
  void lose_master();
  void select_master();
  void step_alone();
  void send_periodic();
  void send_repeated();
  void set_executing(std::vector<std::uint32_t> tasks);
  void expire_order();
  void set_status(TeamReason reason);
  TeamInform own_inform() const;
  void send_inform();
  bool has_said_all(const TeamInform& inform) const;
  void send_news();
  double interval() {
    return times().query_period * (1 + times().jitter * (2 * random_.uniform() - 1));
  }
  // When the next is due, whenever the steps come: evenly after the last.
  double after(double last) {
    return std::max(last, now_ - times().query_period) + interval();
  }
  const TeamTimes& times() const { return config_.times; }
  double repeat_after() const;
  double exchange_time() const;
  bool is_of_lineage(const std::optional<TeamMission>& other) const;
  bool is_sibling(const std::optional<TeamMission>& other) const;
  // A station belongs to no branch: it follows whichever it receives.
  bool may_follow(const std::optional<TeamMission>& other) const {
    return is_of_lineage(other) || (is_operator(self_) && is_sibling(other));
  }
  bool is_operator(EntityId id) const { return config_.operators.contains(id); }
  bool leaves() const { return leaving_ || is_operator(self_); }
  bool takes_part_in_auction() const {
    return role_ == Role::kAlone && config_.structure == TeamStructure::kAuction;
  }
  void finish_own();
  bool finish(std::uint32_t task);
  bool has_done(std::uint32_t task) const {
    const auto share = progress_.find(task);
    return share != progress_.end() && share->second >= 1;
  }
  std::vector<TeamProgress> own_progress() const;
  TeamTimes known_times() const;
  TeamWorker own_worker() const;

  // team_member_receive.cpp
  void receive(const TeamReceived& received);
  void refuse(const TeamReceived& received, TeamVerdict verdict);
  void on(EntityId from, const TeamQuery& query);
  void on(EntityId from, const TeamInform& inform);
  void on(EntityId from, const TeamHere& here);
  void on(EntityId from, const TeamPropose& propose);
  void on(EntityId from, const TeamAccept& accept);
  void on(EntityId from, const TeamReject& reject);
  void on(EntityId from, const TeamConfirm& confirm);
  void on(EntityId from, const TeamDecline& decline);
  void on(EntityId from, const TeamAssign& assign);
  void on(EntityId from, const TeamAssignAck& ack);
  void on(EntityId from, const TeamState& state);
  void on(EntityId from, const TeamMerge& merge);
  void on(EntityId from, const TeamSplit& split);
  void on(EntityId from, const TeamBids& bids);
  void on(EntityId from, const TeamProposal& proposal);
  void on(EntityId from, const TeamDecision& decision);
  void compare_executing(EntityId from, const TeamInform& inform);
  bool flies(std::uint32_t task) const;
  void refuse_yielded();
  void take(EntityId from, const TeamInform& inform);
  void state_as_follower(EntityId from, const TeamState& state);
  bool may_add_tasks(EntityId from, const TeamState& state) const;
  void query_as_follower(EntityId from, const TeamQuery& query);
  void inform_as_follower(EntityId from, const TeamInform& inform);

  // team_member_lead.cpp
  void step_leading();
  void inform_as_master(EntityId from, const TeamInform& inform);
  void take_progress(const TeamInform& inform);
  void measure_round_trip(EntityId from, const TeamInform& inform);
  void add_follower(EntityId id, bool certain, const char* why);
  void drop_follower(EntityId id, const std::string& why);
  void drop_silent();
  void look_at_siblings();
  void heard_sibling(EntityId branch);
  bool hears_sibling() const;
  bool is_ours(const TeamTask& task) const;
  void allocate();
  void give_orders();
  void hand_over();
  void send_query();
  void send_knowledge();
  std::vector<TeamWorker> workers() const;
  std::vector<TeamTask> open_tasks() const;
  std::vector<std::uint32_t> open_of(std::vector<std::uint32_t> tasks) const;
  std::vector<EntityId> member_ids() const;

  // team_member_meet.cpp
  void meet(EntityId other, const TeamQuery& query);
  void yield_to(EntityId other, bool counted);
  void ask_split(EntityId other);
  void answer_split(EntityId other, const TeamMerge& merge);
  void send_split(EntityId other, const TeamMission& mission);
  bool is_held_by_rival();

  // team_member_station.cpp
  void send_handed_in();
  void withdraw_handed_in();
  void inform_stations();
  bool is_team_gone() const;
  void inform_as_station(EntityId from, const TeamInform& inform);

  // team_member_approval.cpp
  void keep_in_force(std::span<const TeamTask> tasks, std::vector<TeamWorker>& workers);
  void take_over(std::span<const TeamTask> tasks, std::vector<TeamWorker>& workers);
  void propose(std::span<const TeamTask> tasks, std::span<const TeamWorker> workers);
  void send_proposal();
  TeamProposal said(const Proposal& proposal, AllocationState state) const;
  void settle(EntityId from, const TeamDecision& decision);
  void put_in_force();
  void order_what_is_in_force();
  void withdraw();
  void note_allocation(AllocationState state, std::uint32_t number,
                       const TeamAllocated& allocated);

  // team_member_desk.cpp
  bool is_desk(EntityId id) const {
    return is_operator(id) || config_.fixed_master == id;
  }
  std::string name(EntityId id) const;
  std::string text_of(EntityId proposer, const TeamProposal& proposal) const;
  void show(EntityId proposer, const TeamProposal& proposal);
  void end_shown(EntityId proposer, AllocationState state, const char* why);
  void step_shown();

  // team_member_join.cpp
  void step_joining();
  void choose_team();

  EntityId self_;
  TeamConfig config_;
  RandomStream random_;
  TeamContacts contacts_;
  TeamKnowledge knowledge_;
  TeamOrders orders_;
  Auction auction_;
  TeamResources resources_;                     // and what it leaves to other teams
  std::vector<std::uint32_t> refused_by_task_;  // as given
  std::map<std::uint32_t, double> progress_;
  std::map<std::uint32_t, TeamTask> handed_in_;
  std::set<std::uint32_t> withdrawn_;  // of those, before the team was known to have them
  bool leaving_ = false;

  double now_ = 0;
  Time time_;
  TeamStep* out_ = nullptr;  // of the step that is going on
  double lost_ = 0;
  double round_trip_ = 0;  // the longest; 0 until it is known
  std::uint32_t sent_to_all_ = 0;
  std::map<EntityId, std::uint32_t> sent_to_;
  double next_query_ = 0, next_inform_ = 0;
  TeamInform informed_;        // the last that it sent
  TeamHere here_;              // as it stood in that, or in the last `here`
  double said_here_ = -1e300;  // when
  double regrouped_ = -1e300;  // when its team changed, or met another one
  int informs_ = 0,
      since_inform_ = 0;  // that are left to be sent in full; periods since the last
  std::vector<Repeated> repeated_;
  std::map<std::pair<EntityId, TeamVerdict>, double> refused_;  // when last reported

  Role role_ = Role::kNewcomer;
  std::optional<TeamMission> mission_;
  TeamStatus status_;
  std::vector<std::uint32_t> executing_;
  std::set<std::pair<std::uint32_t, EntityId>> twice_;  // and who executes it too
  std::map<std::uint32_t, EntityId> yielded_;           // tasks, and to whom

  // As a follower, or without a master that there was.
  std::optional<EntityId> master_;
  std::vector<EntityId> members_;  // as the master says
  double evidence_ = 0;            // when it was last known to lead
  double direct_ = 0;              // when it was last heard
  std::uint32_t evidence_number_ = 0;
  std::optional<EntityId> announced_;              // its successor
  std::map<EntityId, std::uint32_t> orders_from_;  // the last one's number
  std::optional<EntityId> order_of_;               // whose order it executes
  std::optional<double> order_until_;              // the first order of a new master
  std::optional<EntityId> chosen_;
  double chosen_since_ = 0;
  std::set<EntityId> passed_over_;  // were chosen, and did not lead

  // As the station of an operator.
  std::map<EntityId, Shown> shown_;               // by who proposes
  std::map<EntityId, std::uint32_t> last_shown_;  // its number
  std::uint32_t highest_shown_ = 0;

  // As a newcomer.
  Joining joining_;
  std::uint32_t exchange_ = 0;

  // As a master.
  double led_since_ = 0;
  std::optional<EntityId> predecessor_, successor_;
  double successor_since_ = 0;
  std::map<EntityId, Follower> followers_;
  std::map<EntityId, Rival> rivals_;
  std::map<EntityId, std::uint32_t> accepted_;  // newcomers, and in which exchange
  std::optional<Asked> asked_;
  std::map<EntityId, double> siblings_;  // of each branch, when it was heard
  std::set<EntityId> taken_back_;        // branches whose tasks it has taken
  std::map<std::uint32_t, double> query_times_;
  std::map<EntityId, double> round_trips_;
  std::uint32_t queries_ = 0, next_part_ = 0;
  bool changed_ = false;                      // tasks are to be allocated anew
  bool able_ = true;                          // whether it was when they were
  std::vector<std::uint32_t> tasks_refused_;  // by itself, when they were
  double allocated_ = 0;                      // when they were
  TeamAllocation in_force_;  // what members are ordered; of all that are able
  std::optional<Proposal> proposal_;
  std::uint32_t proposals_ = 0;                               // the last one's number
  std::pair<std::uint32_t, AllocationState> last_settled_{};  // what became of the last
  std::set<EntityId> split_with_;  // with whom the mission was split
};

}  // namespace skein::reasoning
