// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/team_member.h"

#include <fmt/format.h>

#include <algorithm>

namespace skein::reasoning {
namespace {

constexpr double kMinRepeat = 0.3;  // query periods
constexpr double kFirstWait = 10;   // query periods, before the first master is selected
constexpr double kMaxDelay = 8;     // [s] that is taken for normal while none is known
// Members that went silent together with the master were heard as long as it was, but for
// the jitter of their messages.
constexpr double kAfterMaster = 1.5;  // query periods
constexpr int kInformEvery = 5;       // query periods, in full without one
constexpr double kMuchLost = 0.15;    // of messages: then nothing is left out
constexpr double kSameLoss = 0.05;    // by which members may measure it otherwise

// But for where it is, how long it can fly and how far it is with its tasks.
bool is_same_but_for_flight(const TeamInform& a, const TeamInform& b) {
  const auto same_task = [](const TeamProgress& one, const TeamProgress& other) {
    return one.task == other.task && (one.share >= 1) == (other.share >= 1);
  };
  return a.mission == b.mission && a.master == b.master && a.leaving == b.leaving &&
         a.resources.able == b.resources.able &&
         a.resources.sensors == b.resources.sensors &&
         a.resources.speed == b.resources.speed &&
         a.resources.refused == b.resources.refused &&
         std::ranges::equal(a.tasks, b.tasks, same_task);
}

}  // namespace

TeamMember::TeamMember(EntityId self, TeamConfig config)
    : self_(self),
      config_(std::move(config)),
      random_(config_.seed, self.value, Purpose::kTeam),
      contacts_(self, config_.known),
      orders_(self) {
  lost_ = time_until_lost(times(), contacts_.loss());
  status_.members = {self_};
}

bool TeamMember::submit(const std::string& mission, std::span<const TeamTask> tasks,
                        Time now) {
  if (mission_ && (mission_->name != mission || role_ == Role::kFollowing)) return false;
  now_ = now.seconds();
  knowledge_.submit(tasks);
  for (const TeamTask& task : tasks)
    if (mission_ && !task.branch)
      knowledge_.tasks.at(task.number).branch = mission_->branch;
  changed_ = true;
  if (mission_) return true;
  mission_ = TeamMission{mission, std::nullopt};
  role_ = Role::kSelecting;
  evidence_ = direct_ = now_;
  if (config_.structure == TeamStructure::kNone ||
      config_.structure == TeamStructure::kAuction)
    role_ = Role::kAlone;
  return true;
}

// Without a diameter that is given: that of the box around all tasks.
TeamTimes TeamMember::known_times() const {
  TeamTimes known = times();
  if (known.mission_diameter > 0 || knowledge_.tasks.empty()) return known;
  Vec2 low = knowledge_.tasks.begin()->second.place, high = low;
  for (const auto& [number, task] : knowledge_.tasks) {
    low = low.cwiseMin(task.place);
    high = high.cwiseMax(task.place);
  }
  known.mission_diameter = (high - low).norm();
  return known;
}

TeamStep TeamMember::step(Time now, std::span<const TeamReceived> received) {
  TeamStep out;
  out_ = &out;
  time_ = now;
  now_ = now.seconds();
  const TeamStatus before = status_;
  if (next_query_ == 0 && next_inform_ == 0) {
    // Not all at the same moment.
    next_query_ = now_ + times().query_period * random_.uniform();
    next_inform_ = now_ + times().query_period * random_.uniform();
  }
  for (const TeamReceived& one : received) receive(one);
  refuse_yielded();
  withdraw_handed_in();
  lost_ = time_until_lost(known_times(), contacts_.loss());
  if (config_.structure == TeamStructure::kFixedMaster && config_.fixed_master == self_ &&
      role_ == Role::kSelecting)
    lead(TeamReason::kFixed, std::nullopt);
  // Nobody else can know the mission yet.
  if (is_operator(self_) && role_ == Role::kSelecting && !master_)
    lead(TeamReason::kAlone, std::nullopt);
  switch (role_) {
    case Role::kNewcomer:
      step_joining();
      break;
    case Role::kFollowing:
      if (now_ - evidence_ > lost_) lose_master();
      break;
    case Role::kSelecting:
      select_master();
      break;
    case Role::kLeading:
      step_leading();
      break;
    case Role::kAlone:
      step_alone();
      break;
  }
  expire_order();
  step_shown();
  if (!resources_.able) set_executing({});
  send_periodic();
  send_repeated();
  out.changed = !(status_ == before);
  out_ = nullptr;
  return out;
}

void TeamMember::report(EventKind kind, std::string text, EventNumbers numbers) {
  out_->events.push_back({time_, self_, kind, std::move(text), numbers});
}

void TeamMember::send_all(TeamContent content) {
  out_->send.push_back(
      {std::nullopt, {TeamMessage::kVersion, ++sent_to_all_, std::move(content)}});
}

void TeamMember::send_one(EntityId to, TeamContent content) {
  out_->send.push_back({to, {TeamMessage::kVersion, ++sent_to_[to], std::move(content)}});
}

double TeamMember::repeat_after() const {
  return std::max(kMinRepeat * times().query_period, 2 * round_trip_);
}

// For how long an exchange stays open: until the other is lost, and there and back.
double TeamMember::exchange_time() const {
  return lost_ + (round_trip_ > 0 ? round_trip_ : 2 * kMaxDelay);
}

void TeamMember::repeat(EntityId to, TeamContent content, int more) {
  repeated_.push_back({to, std::move(content), more + 1, now_, now_ + exchange_time()});
}

void TeamMember::send_repeated() {
  for (Repeated& one : repeated_) {
    if (now_ < one.next) continue;
    send_one(one.to, one.content);
    --one.left;
    one.next = now_ + repeat_after();
  }
  std::erase_if(repeated_, [&](const Repeated& one) {
    return one.left <= 0 || one.next > one.until;
  });
}

bool TeamMember::is_of_lineage(const std::optional<TeamMission>& other) const {
  return mission_ && other && mission_->name == other->name && !is_sibling(other);
}

bool TeamMember::is_sibling(const std::optional<TeamMission>& other) const {
  return mission_ && other && mission_->name == other->name && mission_->branch &&
         other->branch && mission_->branch != other->branch;
}

void TeamMember::set_status(TeamReason reason) {
  TeamStatus next{mission_, std::nullopt, {}, reason};
  if (role_ == Role::kLeading) {
    next.master = self_;
    next.members = member_ids();
  } else if (role_ == Role::kAlone) {
    next.master = self_;
    next.members = {self_};
  } else {
    if (role_ == Role::kFollowing) next.master = master_;
    std::set<EntityId> all(members_.begin(), members_.end());
    all.insert(self_);
    next.members.assign(all.begin(), all.end());
  }
  if (reason == TeamReason::kMembers) next.reason = status_.reason;
  status_ = std::move(next);
}

void TeamMember::set_executing(std::vector<std::uint32_t> tasks) {
  if (!resources_.able) tasks.clear();
  if (tasks == executing_) return;
  executing_ = std::move(tasks);
  next_inform_ = std::min(next_inform_, now_);
}

TeamInform TeamMember::own_inform() const {
  TeamInform inform;
  inform.mission = mission_;
  if (role_ == Role::kFollowing) inform.master = master_;
  if (role_ == Role::kLeading) inform.master = self_;
  if (const auto* master = master_ ? contacts_.find(*master_) : nullptr;
      master && role_ == Role::kFollowing && master->leads) {
    inform.query = master->query_number;
    inform.held = static_cast<float>(std::max(0.0, now_ - master->queried));
  }
  inform.members_hash = hash_of_members(status_.members);
  inform.state_number = knowledge_.number();
  inform.leaving = leaves();
  inform.resources = resources_;
  inform.tasks = own_progress();
  return inform;
}

// In full when something has changed that others act upon, some times over as messages
// are lost, and now and then; nothing while all of it has been said.
void TeamMember::send_inform() {
  TeamInform inform = own_inform();
  if (!is_same_but_for_flight(inform, informed_)) informs_ = kInformRepeats;
  const bool follows = role_ == Role::kFollowing && informs_ <= 0;
  if (inform.master != here_.master || inform.members_hash != here_.members_hash)
    regrouped_ = now_;
  if (follows) ++since_inform_;
  if (follows && has_said_all(inform)) return;
  here_ = {inform.master, inform.query, inform.held, inform.members_hash,
           inform.state_number};
  said_here_ = now_;
  if (follows && since_inform_ < kInformEvery) return send_all(here_);
  informs_ = std::max(0, informs_ - 1);
  since_inform_ = 0;
  informed_ = inform;
  send_all(std::move(inform));
}

// In a large team that has not changed of late, while it receives its master: what it
// would say was sent not long ago.
bool TeamMember::has_said_all(const TeamInform& inform) const {
  const double query_period = times().query_period;
  const double period = follower_period(times(), status_.members.size());
  return period > query_period && contacts_.loss() <= kMuchLost &&
         now_ - evidence_ <= kSilent * query_period &&
         now_ - regrouped_ > exchange_time() &&
         inform.state_number == here_.state_number &&
         now_ - said_here_ < period - query_period / 2;
}

// The longer from word to word, the longer it is asked by its orders before.
double TeamMember::follower_lost_after() const {
  if (contacts_.loss() > kMuchLost + kSameLoss) return lost_;
  const double period = follower_period(times(), status_.members.size());
  return lost_ + 3 * (period - times().query_period);
}

// To a master that has just begun to lead here, and knows less.
void TeamMember::send_news() {
  TeamState news = knowledge_.news();
  if (news.tasks.empty()) return;
  news.members = {self_};
  send_one(*master_, std::move(news));
}

// Of what it executes, and of what it has done and others do not know to be done.
std::vector<TeamProgress> TeamMember::own_progress() const {
  std::vector<TeamProgress> all;
  for (const std::uint32_t task : executing_) {
    const auto share = progress_.find(task);
    all.push_back({task, share == progress_.end() ? 0 : share->second});
  }
  for (const auto& [task, share] : progress_) {
    if (share < 1 || std::ranges::find(executing_, task) != executing_.end()) continue;
    const auto known = knowledge_.tasks.find(task);
    if (known == knowledge_.tasks.end() || !known->second.done) all.push_back({task, 1});
  }
  return all;
}

// @returns  whether that is news.
bool TeamMember::finish(std::uint32_t task) {
  const auto known = knowledge_.tasks.find(task);
  if (known == knowledge_.tasks.end() || known->second.done) return false;
  known->second.done = true;
  changed_ = true;
  return true;
}

void TeamMember::finish_own() {
  for (const auto& [task, share] : progress_)
    if (share >= 1) finish(task);
}

void TeamMember::send_periodic() {
  if (role_ == Role::kLeading) {
    if (now_ >= next_query_) {
      send_query();
      next_query_ = after(next_query_);
    }
    return;
  }
  if (role_ == Role::kNewcomer && now_ >= next_query_) {
    send_all(TeamQuery{});
    next_query_ = after(next_query_);
  }
  if (now_ < next_inform_) return;
  send_inform();
  next_inform_ = after(next_inform_);
  if (role_ == Role::kFollowing) {
    send_handed_in();
    send_news();
    inform_stations();
  }
  if (!takes_part_in_auction() || !mission_) return;
  send_all(TeamBids{*mission_, auction_.known(self_)});
  // Somebody knows less, or more.
  const std::uint32_t number = knowledge_.number();
  if (std::ranges::any_of(contacts_.all(), [&](const auto& contact) {
        return now_ - contact.second.informed <= lost_ &&
               contact.second.inform.state_number != number;
      }))
    send_all(knowledge_.part(next_part_++, {self_}));
}

void TeamMember::step_alone() {
  finish_own();
  auto tasks = open_tasks();
  if (config_.structure == TeamStructure::kNone) {
    const TeamWorker self = own_worker();
    if (resources_.able)
      set_executing(orderable(config_.allocate(tasks, {&self, 1}).given[self_], tasks));
    return set_status(TeamReason::kAlone);
  }
  for (const EntityId id : auction_.bidders()) {
    const auto* contact = contacts_.find(id);
    if (!contact || now_ - contact->heard > lost_) auction_.drop(id);
  }
  std::erase_if(tasks, [this](const TeamTask& task) {
    return !task.after.empty() || refuses(resources_, task.number);
  });
  if (auction_.bid(self_, resources_, tasks, config_.utility, config_.bundle))
    next_inform_ = std::min(next_inform_, now_);
  set_executing(auction_.won());
  set_status(TeamReason::kAlone);
}

void TeamMember::follow(EntityId master, TeamReason reason) {
  if (role_ == Role::kLeading) {
    withdraw();
    members_ = member_ids();
    followers_.clear();
    rivals_.clear();
    asked_.reset();
    orders_.clear();
    siblings_.clear();
    taken_back_.clear();
  }
  std::erase_if(repeated_, [&](const Repeated& one) { return one.to != master; });
  role_ = Role::kFollowing;
  if (master_ != master) knowledge_.forget_master();
  master_ = master;
  announced_.reset();
  chosen_.reset();
  passed_over_.clear();
  evidence_ = direct_ = now_;
  if (const auto* contact = contacts_.find(master); contact && contact->leads) {
    evidence_number_ = contact->query_number;
    if (may_follow(contact->query.mission)) mission_ = contact->query.mission;
  } else {
    evidence_number_ = 0;
  }
  if (std::ranges::find(members_, master) == members_.end()) members_.push_back(master);
  orders_from_.erase(master);  // it may count anew since it led here last
  if (order_of_ != master) order_until_ = now_ + exchange_time();
  next_inform_ = now_;
  report(EventKind::kTeamFollowing,
         fmt::format("{} leads ({}).", master.value, name_of(reason)), {.other = master});
  set_status(reason);
}

void TeamMember::expire_order() {
  if (!order_until_ || role_ != Role::kFollowing || now_ <= *order_until_) return;
  order_until_.reset();
  order_of_.reset();
  if (executing_.empty()) return;
  report(EventKind::kTeamOrderExpired,
         "the new master has given no order; the old one is dropped.");
  set_executing({});
}

void TeamMember::lose_master() {
  report(EventKind::kTeamMasterLost,
         fmt::format("{} is silent for {:.1f} s.", master_->value, now_ - evidence_),
         {.other = master_});
  role_ = Role::kSelecting;
  chosen_.reset();
  passed_over_.clear();
  order_until_.reset();
  set_status(TeamReason::kLost);
  select_master();
}

void TeamMember::select_master() {
  // At the start nothing can have been heard before it has travelled.
  const double travel = contacts_.all().empty() ? kMaxDelay : 0;
  const double first = master_ ? 0 : kFirstWait * times().query_period;
  if (now_ - evidence_ <= std::max(lost_, first) + travel) return;
  if (config_.structure == TeamStructure::kFixedMaster) return;  // it waits for it
  std::vector<EntityId> heard;
  const double from = evidence_ + kAfterMaster * times().query_period;
  for (const auto& [id, contact] : contacts_.all()) {
    const TeamInform& said = contact.inform;
    const bool free = !said.master || said.master == master_ || said.master == self_;
    if (contact.informed > from && now_ - contact.informed <= lost_ && free &&
        !said.leaving && is_of_lineage(said.mission) && !passed_over_.contains(id))
      heard.push_back(id);
  }
  const bool nobody = heard.empty() && (!is_operator(self_) || is_team_gone());
  if (!leaves() || nobody) heard.push_back(self_);
  if (heard.empty()) return;
  std::ranges::sort(heard);
  const EntityId choice = config_.select(heard);
  if (choice != chosen_) {
    chosen_ = choice;
    chosen_since_ = now_;
  }
  const double waited = now_ - chosen_since_;
  if (choice == self_ && waited >= kAfterMaster * times().query_period)
    lead(TeamReason::kSelected, master_);
  else if (choice != self_ && waited > exchange_time())
    passed_over_.insert(choice);
}

}  // namespace skein::reasoning
