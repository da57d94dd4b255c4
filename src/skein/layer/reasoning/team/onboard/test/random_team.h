// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "skein/layer/reasoning/team/onboard/task_needs.h"
#include "skein/layer/reasoning/team/onboard/test/team_model.h"

namespace skein::reasoning {

/// A team to which things happen by chance, as a seed says: the radio is bad, and parts
/// and joins them; members and the station are lost and come back, the operator or a
/// failsafe takes aircraft, tasks come up, some after others, are withdrawn, or turn out
/// to be impossible. After some of it the radio is quiet for one re-selection, and all
/// must be as the model says.
class RandomTeam {
 public:
  struct Size {
    std::uint32_t least = 2, most = 7;  // aircraft; of these so many begin
  };

  RandomTeam(std::uint64_t seed, const TeamConfig& config, TaskSharing sharing,
             const Size& size)
      : random_(seed, 0, Purpose::kTest),
        most_aircraft_(size.most),
        // Proposed by who leads then, approved, and given as orders.
        exchanges_(config.approval ? 4 : 2),
        world_(seed, config, sharing),
        model_(world_, config, sharing) {
    const std::uint32_t count = size.least + below(size.most - size.least + 1);
    for (std::uint32_t id = 1; id <= most_aircraft_; ++id) sensors_[id] = below(2);
    for (std::uint32_t id = 1; id <= count; ++id) start(id);
    for (std::uint32_t k = 0; k <= count; ++k) add_task();
  }

  std::uint64_t events() const { return world_.air.events() + changes_; }
  std::size_t done() const { return world_.done.size(); }

  /// @returns  what is wrong after it; empty: nothing.
  std::string play_chapter() {
    world_.air.quality = {0.4 * random_.uniform(), 0.3 * random_.uniform(),
                          random_.uniform(), 2 * random_.uniform()};
    if (below(4) == 0) world_.air.quality = {};
    for (std::uint32_t k = 0, count = 1 + below(5); k < count; ++k) {
      change();
      run(kNoisy / count * random_.uniform());
    }
    return settle();
  }

  double now() const { return world_.now; }
  /// What has happened, a line for each.
  const std::string& story() const { return story_; }

 private:
  std::uint32_t below(std::uint32_t count) {
    return static_cast<std::uint32_t>(random_.uniform() * count);
  }
  Vec2 place() { return {random_.uniform(-300, 300), random_.uniform(-300, 300)}; }
  void note(const std::string& what) {
    ++changes_;
    story_ += std::to_string(world_.now) + " " + what + "\n";
  }

  void start(std::uint32_t id) {
    note("start " + std::to_string(id));
    world_.start(EntityId{id}, sensors_[id], place(), below(groups_));
  }
  void add_task() {
    TeamWorld::Wanted task{place(), random_.uniform(5, 40), 0, below(8) == 0};
    if (below(4) == 0) task.sensors = kCameraSensor;
    if (const auto count = static_cast<std::uint32_t>(world_.wanted.size());
        count > 0 && below(4) == 0)
      task.after = {1 + below(count)};
    world_.add_task(task);
    note("task " + std::to_string(world_.wanted.size()));
  }
  std::optional<EntityId> any_aircraft() {
    if (world_.aircraft.empty()) return std::nullopt;
    auto at = world_.aircraft.begin();
    std::advance(at, below(static_cast<std::uint32_t>(world_.aircraft.size())));
    return at->first;
  }

  void part() {
    groups_ = 2 + below(2);
    std::string text = "part";
    std::map<EntityId, std::size_t> groups;
    for (const auto& [id, known] : world_.informed) {
      if (!world_.air.has(id)) continue;
      groups[id] = below(groups_);
      text += " " + std::to_string(id.value) + "@" + std::to_string(groups.at(id));
    }
    world_.regroup(groups);
    note(text);
  }
  void join() {
    groups_ = 1;
    std::map<EntityId, std::size_t> groups;
    for (const auto& [id, known] : world_.informed)
      if (world_.air.has(id)) groups[id] = 0;
    world_.regroup(groups);
    note("join");
  }
  void switch_station() {
    const bool leaves = world_.air.has(TeamWorld::kStation);
    if (leaves)
      world_.air.remove(TeamWorld::kStation);
    else
      world_.air.put(TeamWorld::kStation, below(groups_));
    note(leaves ? "station off" : "station on");
  }

  void withdraw() {
    const std::uint32_t task =
        1 + below(static_cast<std::uint32_t>(world_.wanted.size()));
    if (!world_.air.has(TeamWorld::kStation)) return;
    note("withdraw " + std::to_string(task));
    world_.withdraw(task);
  }

  void change() {
    const auto one = any_aircraft();
    const auto kind = below(13);
    if (kind < 2) return part();
    if (kind < 4) return join();
    if (kind == 4) return add_task(), add_task();
    if (kind == 5) return switch_station();
    if (kind == 6) {
      const std::uint32_t id = 1 + below(most_aircraft_);
      if (!world_.aircraft.contains(EntityId{id})) start(id);
      return;
    }
    if (kind == 12) return withdraw();
    if (!one) return;
    TeamWork& work = world_.aircraft.at(*one).work;
    const std::string name = std::to_string(one->value);
    if (kind == 7 || kind == 8) {
      note("lose " + name);
      const std::uint32_t id = one->value;
      world_.lose(*one);
      if (below(3) == 0) start(id);
    } else if (kind == 9) {
      note("impossible " + name);
      if (work.state == TaskState::kFlying) work.state = TaskState::kImpossible;
    } else if (kind == 10) {
      note((work.free ? "take " : "give back ") + name);
      world_.take(*one, work.free);
    } else {
      note((work.leaves ? "fit " : "leaves ") + name);
      const bool leaves = !work.leaves;
      world_.take(*one, leaves);
      work.leaves = leaves;
    }
  }

  void run(double duration) {
    for (const double end = world_.now + duration; world_.now < end;) world_.step();
  }

  // Whom each follows, and what it flies.
  using Present =
      std::map<EntityId,
               std::pair<std::optional<EntityId>, std::optional<std::uint32_t>>>;
  Present present() const {
    Present all;
    for (const auto& [id, one] : world_.aircraft)
      all[id] = {one.team->member().status().master, world_.flown_by(id)};
    return all;
  }

  // One re-selection: T_lost until it begins, an exchange until somebody leads, and
  // another one until its orders are obeyed. Then nothing changes any more.
  std::string settle() {
    note("quiet");
    world_.quiet = true;
    world_.air.quality = {0, 0, 0.1, 0.2};
    for (const double begin = world_.now;;) {
      const auto [lost, exchange] = world_.timers();
      if (world_.now >= begin + lost + exchanges_ * exchange + kSettled &&
          world_.is_steady(kSettled, kStable + 1))
        break;
      world_.step();
    }
    std::string wrong;
    for (const std::string& one : model_.look()) wrong += one + "\n";
    const auto before = present();
    for (auto& [id, one] : world_.aircraft) one.sent = 0;
    run(kStable);
    if (wrong.empty() && present() != before) wrong = "it does not stay so\n";
    for (const auto& [id, one] : world_.aircraft)
      if (one.sent > kMaxSent * kStable)
        wrong += std::to_string(id.value) + " sends " + std::to_string(one.sent) +
                 " messages\n";
    world_.quiet = false;
    return wrong;
  }

  // Of the time without changes.
  static constexpr double kNoisy = 40;    // [s] before, at most
  static constexpr double kSettled = 10;  // query periods besides T_lost and exchanges
  static constexpr double kStable = 8;    // [s] for which nothing changes after that
  static constexpr double kMaxSent = 12;  // messages of a member in a query period

  RandomStream random_;
  std::uint32_t most_aircraft_;
  int exchanges_;
  TeamWorld world_;
  TeamModel model_;
  std::map<std::uint32_t, std::uint32_t> sensors_;
  std::uint32_t groups_ = 1;
  std::uint64_t changes_ = 0;
  std::string story_;
};

}  // namespace skein::reasoning
