// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "skein/data/event/record.h"
#include "skein/record/figures/mission/mission_meter.h"

namespace skein::record {

/// The figures of one mission at one time.
struct MissionFigures {
  Time time;
  EntityId station;
  std::string mission;
  std::vector<MissionFigure> figures;
};

/// How the missions of a run reach their goals: one meter for each, by its goal
/// (MissionGoal), fed by records while the mission runs. Places of aircraft are the true
/// ones, of those without a truth the estimated ones; on the ground they see nothing.
class MissionStatistics {
 public:
  void mission(const MissionRecord& record);
  void truth(Time time, EntityId id, const Vec3& p_N);
  void estimate(Time time, EntityId id, const Vec3& p_N, bool on_ground);
  void event(const Event& event);
  void detection(const Detection& detection);
  void footprint(const Footprint& picture);
  void motion(const ObjectMotion& motion);
  void belief(const ObjectBeliefRecord& record);

  /// Adds `mission_<name>_begun_s`, `_took_s` (where it is over) and, under the same
  /// prefix, what its meter says.
  void add_figures(std::map<std::string, double>& figures) const;

  /// What the meters of running missions have said every ten seconds since the last call,
  /// and at their ends.
  std::vector<MissionFigures> take_series();

 private:
  struct Mission {
    std::string name;
    EntityId station;
    Time begun;
    std::optional<Time> over;
    bool runs = false;
    std::unique_ptr<MissionMeter> meter;  // null: nothing is measured
  };
  struct Flight {
    std::optional<Vec2> last;
    bool has_truth = false, on_ground = false;
  };
  bool measures() const;  // some mission has a meter
  void advance(Time now);
  void move(EntityId id, Flight& flight, Time time, const Vec2& place);
  void note(const Mission& mission, Time time);
  template <class Feed>
  void feed(Feed feed);  // feed(meter) of every mission that runs

  std::map<std::pair<EntityId, std::string>, Mission> missions_;
  std::map<EntityId, Flight> flights_;
  std::map<std::uint32_t, std::vector<ObjectMotion>> motions_;  // for later missions
  std::vector<MissionFigures> series_;
  Time now_, next_tick_;
};

}  // namespace skein::record
