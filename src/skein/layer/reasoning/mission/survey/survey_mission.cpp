// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/mission/survey/survey_mission.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "skein/geo/polygon.h"
#include "skein/layer/reasoning/trajectory/flight_context.h"
#include "skein/layer/reasoning/trajectory/grown_zone.h"
#include "skein/layer/reasoning/trajectory/level_out.h"
#include "skein/solve/coverage/coverage.h"
#include "skein/solve/coverage/survey_sharing.h"

namespace skein::reasoning {
namespace {

constexpr double kRadiusFactor = 1.1;     // of planned turns, as SurveyTask flies them
constexpr double kVertical = 20;          // kept from floors and ceilings [m]
constexpr double kShareAgain = 30;        // at the earliest [s]
constexpr std::size_t kWorthSharing = 4;  // lines that somebody has left, times two ends
constexpr double kWorthIt = 10;           // earlier at the end, for sharing anew [s]
constexpr double kUntilObeyed = 0.5;      // from an order to a plan for it [s]
constexpr double kOrderDelay =
    3;  // from a report to the order that answers it, with room [s]
constexpr double kAlongLine = 0.9;  // cosine of the course to the line that one is on
constexpr double kOnLine = 0.25;    // of the swath, from the line that one is on

// Where an aircraft begins with what it is ordered now.
FlightState begin_of(const NavEstimate& nav, const FlightLimits& limits, Time now) {
  return state_when_level(nav, limits, (now - nav.time).seconds() + kUntilObeyed);
}

}  // namespace

SurveyMission::SurveyMission(const std::vector<EntityId>& team,
                             SurveyMissionOptions options)
    : TaskingMission(team),
      options_(std::move(options)),
      zones_(options_.zones),
      has_lines_(team.size(), false) {}

MissionGoal SurveyMission::goal() const {
  const Survey& survey = options_.survey;
  return SurveyGoal{survey.area, survey.holes, survey.swath, planned_at_.seconds(),
                    planned_for_};
}

MissionDemand SurveyMission::demand() const {
  MissionDemand demand;
  if (done_) demand.max = 0;
  Vec2 middle = Vec2::Zero();
  for (const Vec2& p : options_.survey.area) middle += p;
  demand.place = middle / static_cast<double>(options_.survey.area.size());
  return demand;
}

std::vector<TaskingMission::Aircraft*> SurveyMission::own() {
  std::vector<Aircraft*> own;
  for (Aircraft& each : team())
    if (each.mine) own.push_back(&each);
  return own;
}

Vec2 SurveyMission::wind() const {
  Vec2 sum = Vec2::Zero();
  for (const Aircraft& each : team())
    if (each.mine) sum += each.nav.wind_N;
  return sum / std::max(1, mine());
}

// Of the slowest and widest of them.
FlightLimits SurveyMission::limits() const {
  std::optional<FlightLimits> all;
  for (const Aircraft& each : team()) {
    if (!each.mine) continue;
    if (!all) all = each.limits;
    all->airspeed = std::min(all->airspeed, each.limits->airspeed);
    all->turn_radius = std::max(all->turn_radius, each.limits->turn_radius);
  }
  return planning_limits(all.value_or(FlightLimits()), kRadiusFactor);
}

void SurveyMission::pursue(const AgentInput& in, AgentOutput& out) {
  for (const Message& message : in.inbox)
    if (const auto* change = std::get_if<ZoneChange>(&message.content))
      zones_.take(*change);
  if (done_ || mine() == 0) return;
  if (!begun_) begun_ = in.now;
  if (!planned_) {
    if ((in.now - *begun_).seconds() >= options_.settling) plan(in.now, out);
    return;
  }
  // Lines of those that are gone.
  for (std::size_t k = 0; k < team().size(); ++k) {
    if (!has_lines_[k] || team()[k].mine) continue;
    has_lines_[k] = false;
    const std::vector<Vec2> left = left_of(team()[k]);
    nobodys_.insert(nobodys_.end(), left.begin(), left.end());
  }
  if (must_share(in.now)) share_anew(in.now, out);
  done_ = nobodys_.empty();
  for (std::size_t k = 0; k < team().size(); ++k)
    if (has_lines_[k] && !team()[k].has_done()) done_ = false;
  if (done_)
    out.events.push_back({in.now, EntityId{}, EventKind::kSurveyed,
                          "nothing is left that its aircraft can fly"});
}

void SurveyMission::plan(Time now, AgentOutput& out) {
  const std::vector<Aircraft*> who = own();
  solve::CoverageQuery query;
  query.area = options_.survey.area;
  query.holes = options_.survey.holes;
  query.swath = options_.survey.swath;
  query.overlap = options_.survey.overlap;
  query.bearing = options_.bearing;
  // Turns keep out of the margin as lines do.
  for (const Zone& zone : zones_.zones())
    query.zones.push_back(grown(zone, options_.zone_margin, kVertical));
  query.altitude_msl = -who.front()->nav.p_N.z();
  query.start_time = now.seconds();
  query.limits = limits();
  query.wind = wind();
  query.planner = options_.planner.get();
  query.aircraft.clear();
  for (const Aircraft* each : who) {
    FlightState start = begin_of(each->nav, *each->limits, now);
    start.p_N.z() = who.front()->nav.p_N.z();
    query.aircraft.push_back({start, std::nullopt});
  }
  const solve::CoverageResult result = solve::plan_coverage(query);
  if (result.line_ends.empty()) {
    if (std::exchange(why_not_, result.reason) != result.reason)
      out.events.push_back(
          {now, EntityId{}, EventKind::kNoPlan,
           fmt::format("{}: {}", name_of(result.outcome), result.reason)});
    return;
  }
  planned_ = true;
  planned_at_ = shared_ = now;
  planned_for_ = result.longest;
  out.events.push_back(
      {now, EntityId{}, EventKind::kPlanned,
       fmt::format("a survey of {} lines by {} aircraft in {:.0f} s, {:.1f} % of {:.2f} "
                   "km^2",
                   result.lines, who.size(), result.longest, 100 * result.covered_share,
                   result.area / 1e6)});
  give(who, result.line_ends, now, out);
}

std::vector<Vec2> SurveyMission::left_of(const Aircraft& aircraft) const {
  if (aircraft.has_done()) return {};
  const auto* survey = std::get_if<Survey>(&rest_of(aircraft));
  return survey ? survey->lines : std::vector<Vec2>();
}

// Somebody has nothing to do while there are lines that nobody has, or more than a few
// that another has.
bool SurveyMission::must_share(Time now) const {
  if ((now - shared_).seconds() < kShareAgain && nobodys_.empty()) return false;
  bool idle = false, many = false;
  for (std::size_t k = 0; k < team().size(); ++k) {
    const Aircraft& each = team()[k];
    if (!each.mine) continue;
    if (!has_lines_[k] || each.has_done()) idle = true;
    if (has_lines_[k] && left_of(each).size() > kWorthSharing) many = true;
  }
  return !nobodys_.empty() || (idle && many);
}

SurveyMission::OwnLine SurveyMission::line_of(const Aircraft& aircraft) const {
  const std::vector<Vec2> left = left_of(aircraft);
  if (left.size() < 2 || aircraft.state != TaskState::kFlying) return {};
  const Vec2 along = left[1] - left[0];
  const double length = along.norm();
  if (length <= 0) return {};
  const Vec2 here = geo::horizontal(aircraft.nav.p_N) - left[0];
  const Vec2 ahead = along / length;
  const double flown = here.dot(ahead);
  const Vec2 v = geo::horizontal(aircraft.nav.v_N);
  if (flown < 0 || flown > length || ahead.dot(v) < kAlongLine * v.norm() ||
      std::abs(geo::cross(ahead, here)) > kOnLine * options_.survey.swath)
    return {};
  const double from = flown + kOrderDelay * v.norm();
  if (from >= length) return {{}, true};
  return {{left[0] + from * ahead, left[1]}, false};
}

void SurveyMission::share_anew(Time now, AgentOutput& out) {
  const std::vector<Aircraft*> who = own();
  std::vector<Vec2> lines = nobodys_;
  std::vector<FlightState> starts;
  std::vector<std::vector<Vec2>> first(who.size());  // that each is on
  double before = 0, longest = 0;
  for (std::size_t a = 0; a < who.size(); ++a) {
    const Aircraft& each = *who[a];
    const auto k = static_cast<std::size_t>(&each - team().data());
    starts.push_back(begin_of(each.nav, *each.limits, now));
    if (!has_lines_[k]) continue;
    OwnLine own_line = line_of(each);
    if (own_line.too_short) return;  // soon
    std::vector<Vec2> left = left_of(each);
    if (!own_line.ends.empty()) {
      left.erase(left.begin(), left.begin() + 2);
      starts.back().p_N.head<2>() = own_line.ends[1];
      starts.back().heading = geo::bearing(own_line.ends[1] - own_line.ends[0]);
      first[a] = std::move(own_line.ends);
    }
    lines.insert(lines.end(), left.begin(), left.end());
    // One that does not say how long it takes may take any time.
    before = std::max(before,
                      each.time_to_go.value_or(std::numeric_limits<double>::infinity()));
  }
  solve::SurveyShares shares = solve::share_survey(lines, starts, limits(), wind());
  for (std::size_t a = 0; a < who.size(); ++a) {
    double duration = shares.durations[a];
    if (!first[a].empty())
      duration += (first[a][1] - geo::horizontal(who[a]->nav.p_N)).norm() /
                  std::max(1.0, geo::horizontal(who[a]->nav.v_N).norm());
    longest = std::max(longest, duration);
  }
  shared_ = now;
  const bool any = std::any_of(shares.lines.begin(), shares.lines.end(),
                               [](const auto& share) { return !share.empty(); });
  // In a wind that is too strong just now nobody flies them.
  if (!any || (nobodys_.empty() && longest > before - kWorthIt)) return;
  nobodys_.clear();
  out.events.push_back(
      {now, EntityId{}, EventKind::kShared,
       fmt::format("{} lines among {} aircraft", lines.size() / 2, who.size())});
  for (std::size_t a = 0; a < who.size(); ++a)
    shares.lines[a].insert(shares.lines[a].begin(), first[a].begin(), first[a].end());
  give(who, shares.lines, now, out);
}

void SurveyMission::give(const std::vector<Aircraft*>& who,
                         const std::vector<std::vector<Vec2>>& lines, Time now,
                         AgentOutput& out) {
  for (std::size_t k = 0; k < who.size(); ++k) {
    const auto index = static_cast<std::size_t>(who[k] - team().data());
    const bool had = has_lines_[index];
    has_lines_[index] = !lines[k].empty();
    if (lines[k].empty()) {
      if (had && !who[k]->has_done()) order(*who[k], Hold{}, now, out);
      continue;
    }
    Survey survey = options_.survey;
    survey.lines = lines[k];
    order(*who[k], std::move(survey), now, out);
  }
}

}  // namespace skein::reasoning
