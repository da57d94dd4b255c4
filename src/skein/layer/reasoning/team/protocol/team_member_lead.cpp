// SPDX-License-Identifier: Apache-2.0
// What a master does.
#include <fmt/format.h>

#include <algorithm>

#include "skein/layer/reasoning/team/protocol/team_member.h"

namespace skein::reasoning {
namespace {

constexpr std::uint32_t kStateEvery = 5;  // queries
constexpr std::size_t kQueryTimes = 64;   // queries that may still be answered
constexpr double kSmoothing = 0.3;        // of measured round trips

// Of what is executed; what is done is not.
std::vector<std::uint32_t> numbers_of(const std::vector<TeamProgress>& tasks) {
  std::vector<std::uint32_t> numbers;
  for (const TeamProgress& task : tasks)
    if (task.share < 1) numbers.push_back(task.task);
  return numbers;
}

TeamWorker worker_of(EntityId id, const TeamInform& inform) {
  TeamWorker worker{id, inform.resources, numbers_of(inform.tasks)};
  for (const TeamProgress& task : inform.tasks)
    if (task.share < 1) worker.shares.push_back(task.share);
  return worker;
}

}  // namespace

TeamWorker TeamMember::own_worker() const {
  TeamInform own;
  own.resources = resources_;
  own.tasks = own_progress();
  return worker_of(self_, own);
}

std::vector<EntityId> TeamMember::member_ids() const {
  std::set<EntityId> ids = {self_};
  for (const auto& [id, follower] : followers_) ids.insert(id);
  return {ids.begin(), ids.end()};
}

void TeamMember::lead(TeamReason reason, std::optional<EntityId> predecessor) {
  role_ = Role::kLeading;
  led_since_ = now_;
  repeated_.clear();
  predecessor_ = predecessor;
  successor_.reset();
  chosen_.reset();
  order_until_.reset();
  order_of_ = self_;
  rivals_.clear();
  asked_.reset();
  followers_.clear();
  orders_.clear();
  orders_.set(self_, open_of(executing_));  // it flies on until it allocates
  siblings_.clear();
  taken_back_.clear();
  in_force_.clear();
  proposal_.reset();
  for (const auto& [number, task] : handed_in_)
    if (knowledge_.tasks.try_emplace(number, task).second)
      knowledge_.tasks.at(number).branch = mission_->branch;
  report(EventKind::kTeamSelected,
         fmt::format("{} leads ({}).", self_.value, name_of(reason)));
  // Who has lost its master says more often that it is there.
  const double holds = reason == TeamReason::kSelected ? lost_ : follower_lost_after();
  for (const auto& [id, contact] : contacts_.all()) {
    const auto& master = contact.inform.master;
    const bool free = !master || master == predecessor || master == self_;
    if (is_of_lineage(contact.inform.mission) && free && !contact.leads &&
        now_ - contact.informed <= holds)
      add_follower(id, false, "heard");
  }
  if (reason == TeamReason::kHandover && predecessor)
    add_follower(*predecessor, false, "handed over");
  changed_ = true;
  next_query_ = now_;
  set_status(reason);
}

void TeamMember::add_follower(EntityId id, bool certain, const char* why) {
  const auto [place, is_new] = followers_.try_emplace(id);
  place->second.certain = place->second.certain || certain;
  place->second.claimed = now_;
  if (!is_new) return;
  report(EventKind::kTeamJoined, fmt::format("{} follows ({}).", id.value, why),
         {.other = id});
  if (const auto* contact = contacts_.find(id)) {
    orders_.set(id, {});
    orders_.informed(id, numbers_of(contact->inform.tasks));
  }
  changed_ = true;
}

void TeamMember::drop_follower(EntityId id, const std::string& why) {
  followers_.erase(id);
  orders_.remove(id);
  round_trips_.erase(id);
  report(EventKind::kTeamFollowerLost, fmt::format("{} {}.", id.value, why),
         {.other = id});
  changed_ = true;
}

void TeamMember::inform_as_master(EntityId from, const TeamInform& inform) {
  if (is_sibling(inform.mission)) return heard_sibling(*inform.mission->branch);
  if (inform.master == self_) {
    rivals_.erase(from);
    measure_round_trip(from, inform);
    add_follower(from, true, "it says so");
    Follower& follower = followers_.at(from);
    if (follower.able != inform.resources.able ||
        follower.refused != inform.resources.refused)
      changed_ = true;
    follower.able = inform.resources.able;
    follower.refused = inform.resources.refused;
    orders_.informed(from, numbers_of(inform.tasks));
    take_progress(inform);
    return;
  }
  const auto known = followers_.find(from);
  if (known == followers_.end() || !inform.master) return;
  const bool hands_on =
      followers_.contains(*inform.master) || inform.master == predecessor_;
  if (known->second.certain && !hands_on)
    drop_follower(from, fmt::format("follows {}", inform.master->value));
}

void TeamMember::take_progress(const TeamInform& inform) {
  for (const TeamProgress& progress : inform.tasks)
    if (progress.share >= 1) finish(progress.task);
}

void TeamMember::measure_round_trip(EntityId from, const TeamInform& inform) {
  const auto sent = query_times_.find(inform.query);
  if (sent == query_times_.end()) return;
  const double measured = now_ - sent->second - inform.held;
  if (measured < 0) return;
  const auto [place, is_new] = round_trips_.try_emplace(from, measured);
  if (!is_new) place->second += kSmoothing * (measured - place->second);
  round_trip_ = 0;
  for (const auto& [id, time] : round_trips_) round_trip_ = std::max(round_trip_, time);
}

void TeamMember::drop_silent() {
  std::vector<EntityId> silent;
  const double holds = follower_lost_after();
  for (const auto& [id, follower] : followers_) {
    const double patience = follower.certain ? holds : exchange_time();
    if (now_ - follower.claimed > patience) silent.push_back(id);
  }
  for (const EntityId id : silent) drop_follower(id, "is silent");
  // Its answers are a second way to hear of it.
  const double period = follower_period(times(), status_.members.size());
  const double overdue = std::max(lost_ / 2, period + times().query_period);
  for (const auto& [id, follower] : followers_)
    if (now_ - follower.claimed > overdue) orders_.remind(id);
}

bool TeamMember::hears_sibling() const {
  return mission_->branch && std::ranges::any_of(siblings_, [&](const auto& sibling) {
           return sibling.first != mission_->branch && now_ - sibling.second <= lost_;
         });
}

void TeamMember::heard_sibling(EntityId branch) {
  siblings_[branch] = now_;
}

// Tasks of branches that are lost go to the lowest branch that is there.
void TeamMember::look_at_siblings() {
  for (const auto& [number, task] : knowledge_.tasks)
    if (task.branch) siblings_.try_emplace(*task.branch, now_);
  std::set<EntityId> taken;
  if (mission_->branch) {
    bool is_lowest = true;
    for (const auto& [branch, heard] : siblings_)
      if (branch < *mission_->branch && now_ - heard <= lost_) is_lowest = false;
    for (const auto& [branch, heard] : siblings_)
      if (is_lowest && branch != *mission_->branch && now_ - heard > lost_)
        taken.insert(branch);
  }
  if (taken == taken_back_) return;
  for (const EntityId branch : taken)
    if (!taken_back_.contains(branch))
      report(EventKind::kTeamTookBack,
             fmt::format("tasks of the lost {}/{}.", mission_->name, branch.value),
             {.other = branch});
  for (const EntityId branch : taken_back_)
    if (!taken.contains(branch))
      report(EventKind::kTeamGaveBack,
             fmt::format("tasks of {}/{}.", mission_->name, branch.value),
             {.other = branch});
  taken_back_ = std::move(taken);
  changed_ = true;
}

bool TeamMember::is_ours(const TeamTask& task) const {
  if (!mission_->branch || !task.branch) return true;
  return task.branch == mission_->branch || taken_back_.contains(*task.branch);
}

std::vector<TeamTask> TeamMember::open_tasks() const {
  const auto is_over = [this](std::uint32_t number) {
    const auto known = knowledge_.tasks.find(number);
    return known != knowledge_.tasks.end() && known->second.done;
  };
  std::vector<TeamTask> open;
  for (const auto& [number, task] : knowledge_.tasks) {
    if (task.done || !is_ours(task)) continue;
    open.push_back(task);
    std::erase_if(open.back().after, is_over);
  }
  return open;
}

std::vector<std::uint32_t> TeamMember::open_of(std::vector<std::uint32_t> tasks) const {
  std::erase_if(tasks, [&](std::uint32_t number) {
    const auto known = knowledge_.tasks.find(number);
    return known == knowledge_.tasks.end() || known->second.done;
  });
  return tasks;
}

std::vector<TeamWorker> TeamMember::workers() const {
  std::vector<TeamWorker> all;
  for (const EntityId id : member_ids()) {
    if (id == self_) {
      if (resources_.able) all.push_back(own_worker());
      continue;
    }
    const auto* contact = contacts_.find(id);
    if (!contact || !contact->inform.resources.able) continue;
    all.push_back(worker_of(id, contact->inform));
  }
  return all;
}

void TeamMember::allocate() {
  changed_ = false;
  allocated_ = now_;
  const auto tasks = open_tasks();
  auto all = workers();
  if (config_.approval) {
    keep_in_force(tasks, all);
    take_over(tasks, all);
    propose(tasks, all);
  } else {
    TeamAllocated found = config_.allocate(tasks, all);
    const bool is_new = found.given != in_force_;
    in_force_ = found.given;
    if (is_new) note_allocation(AllocationState::kUnasked, 0, found);
  }
  order_what_is_in_force();
}

void TeamMember::give_orders() {
  const double patience = exchange_time();
  const auto outcome = orders_.step(now_, repeat_after(), times().query_period, patience);
  for (const TeamOrders::Sent& order : outcome.sent) {
    TeamAssign assign{*mission_, order.number, {}};
    for (const std::uint32_t task : order.tasks)
      assign.tasks.push_back(knowledge_.tasks.at(task));
    send_one(order.to, std::move(assign));
  }
  for (const EntityId id : outcome.unanswered)
    report(EventKind::kTeamOrderUnanswered,
           fmt::format("{} has not acknowledged its order.", id.value), {.other = id});
  std::vector<std::uint32_t> own = orders_.own();
  std::erase_if(own, [this](std::uint32_t task) { return yielded_.contains(task); });
  set_executing(std::move(own));
}

void TeamMember::hand_over() {
  if (!leaves()) return;
  if (successor_ && now_ - successor_since_ <= exchange_time()) return;
  std::vector<EntityId> able;
  for (const auto& [id, follower] : followers_) {
    const auto* contact = contacts_.find(id);
    if (follower.certain && contact && !contact->inform.leaving && id != successor_ &&
        contact->inform.state_number == knowledge_.number())
      able.push_back(id);
  }
  if (able.empty()) return;
  // A station that has found its team waits a moment until all of it may be chosen.
  if (is_operator(self_) && able.size() < followers_.size() &&
      now_ - led_since_ <= 2 * exchange_time())
    return;
  successor_ = config_.select(able);
  successor_since_ = now_;
  next_query_ = now_;
  report(EventKind::kTeamHandover, fmt::format("{} shall lead.", successor_->value),
         {.other = successor_});
  send_knowledge();
}

void TeamMember::send_knowledge() {
  for (std::uint32_t part = 0; part < knowledge_.parts(); ++part)
    send_all(knowledge_.part(part, member_ids()));
}

void TeamMember::step_leading() {
  drop_silent();
  look_at_siblings();
  hand_over();
  if (asked_ && now_ - asked_->first > exchange_time()) asked_.reset();
  if (asked_ && now_ - asked_->last >= std::max(repeat_after(), times().query_period / 2))
    ask_split(asked_->of);
  finish_own();
  if (config_.allocation_period > 0 && now_ - allocated_ >= config_.allocation_period)
    changed_ = true;
  if (able_ != resources_.able || tasks_refused_ != resources_.refused) changed_ = true;
  able_ = resources_.able;
  tasks_refused_ = resources_.refused;
  if (changed_ && !is_held_by_rival() && !asked_) allocate();
  send_proposal();
  give_orders();
  set_status(TeamReason::kMembers);
}

void TeamMember::send_query() {
  const auto members = member_ids();
  TeamQuery query;
  query.mission = mission_;
  query.members = static_cast<std::uint32_t>(members.size());
  query.members_hash = hash_of_members(members);
  query.state_number = knowledge_.number();
  query.led = static_cast<float>(now_ - led_since_);
  query.round_trip = static_cast<float>(round_trip_);
  query.successor = successor_;
  query.predecessor = predecessor_;
  send_all(query);
  query_times_[sent_to_all_] = now_;
  while (query_times_.size() > kQueryTimes) query_times_.erase(query_times_.begin());

  const bool lags = std::ranges::any_of(followers_, [&](const auto& follower) {
    const auto* contact = contacts_.find(follower.first);
    return !contact || contact->inform.members_hash != query.members_hash ||
           contact->inform.state_number != query.state_number;
  });
  const bool is_heard = !followers_.empty() || hears_sibling();
  if (!is_heard || (!lags && queries_++ % kStateEvery != 0)) return;
  for (std::uint32_t part = 0; part < std::min(2U, knowledge_.parts()); ++part)
    send_all(knowledge_.part(next_part_++, members));
}

}  // namespace skein::reasoning
