// SPDX-License-Identifier: Apache-2.0
#include "skein/record/figures/mission/mission_statistics.h"

#include <algorithm>
#include <utility>

#include "skein/record/figures/mission/formation_meter.h"
#include "skein/record/figures/mission/patrol_meter.h"
#include "skein/record/figures/mission/survey_meter.h"
#include "skein/record/figures/mission/track_meter.h"

namespace skein::record {
namespace {

constexpr std::int64_t kSeriesPeriod = 10;  // [s]
constexpr double kMoved = 1;  // places nearer than this to the last are passed over [m]

// One meter for each kind of goal.
struct MakeMeter {
  Time begin;

  std::unique_ptr<MissionMeter> operator()(const SurveyGoal& goal) const {
    return std::make_unique<SurveyMeter>(goal, begin);
  }
  std::unique_ptr<MissionMeter> operator()(const TrackGoal& goal) const {
    return std::make_unique<TrackMeter>(goal);
  }
  std::unique_ptr<MissionMeter> operator()(const PatrolGoal& goal) const {
    return std::make_unique<PatrolMeter>(goal, begin);
  }
  std::unique_ptr<MissionMeter> operator()(const FormationGoal& goal) const {
    return std::make_unique<FormationMeter>(goal);
  }
  // Perimeters have figures of their own: RunStatistics.
  std::unique_ptr<MissionMeter> operator()(const PerimeterGoal&) const { return nullptr; }
  std::unique_ptr<MissionMeter> operator()(const OpenGoal&) const { return nullptr; }
};

}  // namespace

template <class Feed>
void MissionStatistics::feed(Feed feed) {
  for (auto& [key, mission] : missions_)
    if (mission.runs && mission.meter) feed(*mission.meter);
}

bool MissionStatistics::measures() const {
  return std::any_of(missions_.begin(), missions_.end(),
                     [](const auto& each) { return each.second.meter != nullptr; });
}

void MissionStatistics::mission(const MissionRecord& record) {
  advance(record.time);
  Mission& mission = missions_[{record.id, record.value.mission}];
  switch (record.value.state) {
    case MissionState::kBegun:
      mission = {record.value.mission, record.id, record.time, {}, true, nullptr};
      mission.meter = std::visit(MakeMeter{record.time}, record.value.goal);
      if (mission.meter)
        for (const auto& [object, all] : motions_)
          for (const ObjectMotion& motion : all) mission.meter->object_moves(motion);
      note(mission, record.time);
      return;
    case MissionState::kPaused:
      mission.runs = false;
      return;
    case MissionState::kResumed:
      mission.runs = true;
      if (mission.meter) mission.meter->goal_changed(record.value.goal);
      return;
    case MissionState::kChanged:
      if (mission.meter) mission.meter->goal_changed(record.value.goal);
      return;
    case MissionState::kOver:
      mission.runs = false;
      mission.over = record.time;
      note(mission, record.time);
      return;
  }
}

void MissionStatistics::truth(Time time, EntityId id, const Vec3& p_N) {
  if (!measures()) return;
  advance(time);
  Flight& flight = flights_[id];
  flight.has_truth = true;
  move(id, flight, time, geo::horizontal(p_N));
}

void MissionStatistics::estimate(Time time, EntityId id, const Vec3& p_N,
                                 bool on_ground) {
  if (!measures()) return;
  Flight& flight = flights_[id];
  flight.on_ground = on_ground;
  if (!flight.has_truth) {
    advance(time);
    move(id, flight, time, geo::horizontal(p_N));
  }
}

void MissionStatistics::move(EntityId id, Flight& flight, Time time, const Vec2& place) {
  const Vec2 from = flight.last.value_or(place);
  if (flight.last && (place - from).norm() < kMoved) return;
  flight.last = place;
  if (!flight.on_ground)
    feed([&](MissionMeter& meter) { meter.moved(time, id, from, place); });
}

void MissionStatistics::event(const Event& event) {
  if (event.kind != EventKind::kLeft) return;
  flights_.erase(event.entity);
  feed([&](MissionMeter& meter) { meter.left(event.entity); });
}

void MissionStatistics::detection(const Detection& detection) {
  feed([&](MissionMeter& meter) { meter.detected(detection); });
}

void MissionStatistics::footprint(const Footprint& picture) {
  feed([&](MissionMeter& meter) { meter.pictured(picture); });
}

void MissionStatistics::motion(const ObjectMotion& motion) {
  motions_[motion.object].push_back(motion);
  feed([&](MissionMeter& meter) { meter.object_moves(motion); });
}

void MissionStatistics::belief(const ObjectBeliefRecord& record) {
  const auto found = missions_.find({record.id, record.value.mission});
  if (found != missions_.end() && found->second.meter)
    found->second.meter->believed(record.time, record.value);
}

void MissionStatistics::advance(Time now) {
  now_ = std::max(now_, now);
  for (; next_tick_ <= now; next_tick_ += Time::from_seconds(1)) {
    feed([&](MissionMeter& meter) { meter.tick(next_tick_); });
    if (next_tick_.ns() % (kSeriesPeriod * 1'000'000'000) == 0)
      for (const auto& [key, mission] : missions_)
        if (mission.runs) note(mission, next_tick_);
  }
}

void MissionStatistics::note(const Mission& mission, Time time) {
  if (mission.meter)
    series_.push_back(
        {time, mission.station, mission.name, mission.meter->figures(time)});
}

std::vector<MissionFigures> MissionStatistics::take_series() {
  return std::exchange(series_, {});
}

void MissionStatistics::add_figures(std::map<std::string, double>& figures) const {
  for (const auto& [key, mission] : missions_) {
    const std::string prefix = "mission_" + mission.name + "_";
    figures[prefix + "begun_s"] = mission.begun.seconds();
    if (mission.over)
      figures[prefix + "took_s"] = (*mission.over - mission.begun).seconds();
    if (!mission.meter) continue;
    for (const MissionFigure& figure :
         mission.meter->figures(mission.over.value_or(now_)))
      figures[prefix + std::string(figure.name)] = figure.value;
  }
}

}  // namespace skein::record
