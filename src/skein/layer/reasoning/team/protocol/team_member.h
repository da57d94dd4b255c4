// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "skein/base/time.h"
#include "skein/data/team/team_message.h"
#include "skein/layer/reasoning/team/protocol/alone.h"
#include "skein/layer/reasoning/team/protocol/approval_server.h"
#include "skein/layer/reasoning/team/protocol/duplicates.h"
#include "skein/layer/reasoning/team/protocol/election.h"
#include "skein/layer/reasoning/team/protocol/following.h"
#include "skein/layer/reasoning/team/protocol/joining.h"
#include "skein/layer/reasoning/team/protocol/leading.h"
#include "skein/layer/reasoning/team/protocol/member_state.h"
#include "skein/layer/reasoning/team/protocol/presence.h"
#include "skein/layer/reasoning/team/protocol/reception.h"
#include "skein/layer/reasoning/team/protocol/station.h"

namespace skein::reasoning {

/// A member of a team that leads itself: aircraft, or a ground station that may lead.
///
/// A state machine without input and output: it is given the time and what arrived, and
/// gives what is to be sent. Members elect a leader, follow it, and elect another one
/// when it is lost; newcomers join a team; two leaders of one mission that meet become
/// one team, and when they meet again split the mission and both stay. Only times of
/// arrival on the own clock count: clocks may be off.
///
/// With TeamConfig::approval a leader proposes allocations to the station of the operator
/// (decide()); in force meanwhile is what was approved before.
///
/// It is made of parts (README.md in this folder): messages and timers go to the part
/// that the present role has for them.
///
/// Events: those of teams (docs/events.md), of a station kAllocationProposed and
/// kAllocationOver; of hostile or broken input those of the subject `protocol`: such
/// messages change nothing.
class TeamMember {
 public:
  TeamMember(EntityId self, TeamConfig config);

  /// The operator's mission. To be called of those that begin together, or of a leader to
  /// add tasks.
  /// @returns  false when it follows somebody, or has another mission: nothing is taken.
  bool submit(const std::string& mission, std::span<const TeamTask> tasks, Time now);

  /// Tasks of an operator, who is with this member: submitted while nobody else leads;
  /// else the leader is asked to take them, until it has them.
  void hand_in(const std::string& mission, std::span<const TeamTask> tasks, Time now);

  /// The operator, who is with this member, does not want a task any more. Whoever leads
  /// is sent that; who flies it stops, and what comes after it need not wait.
  /// @returns  false when it is not known here, or over.
  bool withdraw_task(std::uint32_t task);
  /// Tasks that are known here, those among them that the leader has not received yet.
  std::map<std::uint32_t, TeamTask> all_tasks() const;
  /// Who flies which task, as others have said last; of several who has said so last.
  std::map<std::uint32_t, EntityId> executors() const;

  void set_resources(const TeamResources& resources);
  /// How far it is with a task that it executes; 1: done.
  void set_progress(std::uint32_t task, double share);
  /// It shall not lead any more: energy, the operator. A leader hands over.
  void leave(bool leaving = true) { member_.leaving = leaving; }
  /// Something else of a member was received: a report, a plan.
  void note_heard(EntityId id, Time now);

  /// The operator, who is with this member, approves a proposed allocation or not.
  /// @param number  of the proposal; 0: the only one that waits.
  /// @returns  why that cannot be; empty: the leader will be sent it until it answers.
  std::string decide(std::uint32_t number, bool approve);

  /// To be called several times a query period, with what has arrived since the last.
  TeamStep step(Time now, std::span<const TeamReceived> received);

  const TeamStatus& status() const { return member_.status; }
  bool leads() const { return member_.leads(); }
  /// Numbers of the tasks that it executes.
  const std::vector<std::uint32_t>& tasks() const { return member_.own.executing(); }
  const TeamKnowledge& knowledge() const { return member_.knowledge; }
  /// T_lost [s], by the loss measured.
  double lost_after() const { return member_.lost; }
  /// After how long of silence a follower is lost [s].
  double follower_lost_after() const { return member_.follower_lost_after(); }
  /// The longest round trip measured [s].
  double round_trip() const { return member_.round_trip; }
  /// Of a leader: whether all its orders were acknowledged.
  bool orders_acknowledged() const { return leading_.orders_acknowledged(); }

 private:
  void take_tasks(const std::string& mission, std::span<const TeamTask> tasks);
  void change(const TeamTransition& transition);
  void follow(const FollowOther& other);
  void lead(const LeadTeam& how);
  void elect();
  void step_role();
  void send_decisions();
  void send_periodic();

  void receive(const TeamReceived& received);
  void take(EntityId from, const TeamInform& inform);
  void on(EntityId from, const TeamQuery& query);
  void on(EntityId from, const TeamInform& inform);
  void on(EntityId from, const TeamHere& here);
  void on(EntityId from, const TeamAccept& accept);
  void on(EntityId from, const TeamReject& reject);
  void on(EntityId from, const TeamAssign& assign);
  void on(EntityId from, const TeamState& state);
  void on(EntityId from, const TeamSplit& split);
  void on(EntityId from, const TeamBids& bids);
  void on(EntityId from, const TeamProposal& proposal);
  void on(EntityId from, const TeamDecision& decision);
  // Of everything else only a leader takes notice.
  template <class Content>
  void on(EntityId from, const Content& content) {
    if (leads()) leading_.on(member_, from, content);
  }

  MemberState member_;
  TeamReception reception_;
  TeamPresence presence_;
  DuplicateTasks duplicates_;
  TeamElection election_;
  TeamJoining joining_;
  TeamFollowing following_;
  TeamLeading leading_;
  TeamAlone alone_;
  TeamStation station_;
  ApprovalServer server_;
};

}  // namespace skein::reasoning
