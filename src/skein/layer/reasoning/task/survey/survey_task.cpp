// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/task/survey/survey_task.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "skein/layer/reasoning/trajectory/grown_zone.h"
#include "skein/layer/reasoning/trajectory/steering_flight.h"
#include "skein/model/path/flight_plan.h"
#include "skein/solve/coverage/coverage.h"
#include "skein/solve/path/join.h"

namespace skein::reasoning {
namespace {

constexpr double kAside = 0.1;   // of the swath, off a line that still counts as flown
constexpr double kPassed = 1.5;  // before or after the end of a line [s]
constexpr double kSettling = 3;  // on a line's extension, after opposite turns [s]
constexpr double kBanks = 0.3;   // by less it needs no bank to speak of [rad]
constexpr double kBeside = 5;    // more than the margin, for rounded corners [m]

// How long before a line to be on it [s]: no aircraft rolls from one bank to the opposite
// one at once, and what that takes shows when the line begins right behind.
double settling(const FlightPlan& to) {
  double last = 0;  // the last turn's rate
  for (auto element = to.rbegin(); element != to.rend(); ++element) {
    const bool turns = std::abs(element->turn_rate) * element->duration > kBanks;
    if (!turns && element->duration > kSettling) return 0;
    if (!turns) continue;
    if (last != 0) return last * element->turn_rate < 0 ? kSettling : 0;
    last = element->turn_rate;
  }
  return 0;
}

}  // namespace

SurveyTask::SurveyTask(const FlightContext& context, const Survey& order)
    : PlannedTask(context, {}),
      order_(order),
      aside_(order.swath * std::max(kAside, order.overlap / 2)) {
  if (!order.lines.empty()) lines_.emplace(order.lines);
}

void SurveyTask::listen(const TaskStep& step) {
  here_ = geo::horizontal(step.in.nav->p_N);
  reach_ = aside_ + kPassed * geo::horizontal(step.in.nav->v_N).norm();
  if (!on_line_ || !lines_ || lines_->left().empty()) return;
  const SurveyLine& line = lines_->left().front();
  const Vec2 along = (line.end - line.begin).normalized();
  farthest_ = std::max(farthest_, std::abs(geo::cross(along, here_ - line.begin)));
}

// Takes from the line that is being flown what has been flown of it.
// @returns whether the aircraft is on what is left of it.
bool SurveyTask::cut_line() {
  if (!on_line_) return false;
  on_line_ = false;
  ++version_;
  if (!began_ || farthest_ > aside_) return false;
  lines_->flown_to(here_);
  return !lines_->left().empty() &&
         (lines_->left().front().begin - here_).norm() <= 2 * aside_;
}

void SurveyTask::interrupt() {
  cut_line();
  PlannedTask::interrupt();
}

bool SurveyTask::zones_changed(const TaskStep& step) {
  ZoneMonitor& zones = step.safety.zones();
  if (zones.zones().empty() && zones_.empty()) return false;
  std::vector<Zone> now = zones.counting();
  const bool same =
      std::equal(now.begin(), now.end(), zones_.begin(), zones_.end(),
                 [](const Zone& a, const Zone& b) { return a.name == b.name; });
  zones_ = std::move(now);
  return !same;
}

// Turns keep out of the margin as lines do.
std::vector<Zone> SurveyTask::grown_zones(const TaskStep& step) const {
  std::vector<Zone> all;
  for (const Zone& zone : zones_)
    all.push_back(grown(zone, step.safety.zones().margin() + kBeside, 0));
  return all;
}

// Lines are cut anew where other zones forbid them.
const FlightIntent* SurveyTask::before(const TaskStep& step, AgentOutput&) {
  if (!zones_changed(step) || !lines_) return nullptr;
  cut_line();
  lines_->regard(grown_zones(step), wide_radius(context().limits, step.in.nav->wind_N));
  ++version_;
  renew();
  return nullptr;
}

bool SurveyTask::plan_lines(const Start& start, const TaskStep& step,
                            std::string& why_not) {
  solve::CoverageQuery query;
  query.area = order_.area;
  query.holes = order_.holes;
  query.zones = grown_zones(step);
  query.swath = order_.swath;
  query.overlap = order_.overlap;
  query.altitude_msl = -start.state.p_N.z();
  query.start_time = start.time;
  query.limits = start.limits;
  query.wind = start.wind;
  query.aircraft = {{start.state, std::nullopt}};
  query.planner = context().planner.get();
  const solve::CoverageResult result = solve::plan_coverage(query);
  if (result.line_ends.empty() || result.line_ends.front().empty()) {
    why_not =
        result.reason.empty() ? std::string(name_of(result.outcome)) : result.reason;
    return false;
  }
  lines_.emplace(result.line_ends.front());
  ++version_;
  return true;
}

// To the begin of a line; after opposite turns to its extension first, unless that is a
// long way round.
FlightPlan SurveyTask::lead_to(const SurveyLine& line, const FlightState& from,
                               const Start& start, double now) {
  const model::AirMotion air = solve::motion_of(start.limits, start.wind);
  const double down = from.p_N.z();
  const FlightElement along = solve::straight(line.begin, line.end, down, air, now);
  FlightPlan direct =
      solve::join(from, {along.p_N, along.heading}, start.limits, start.wind, now);
  const double early = settling(direct);
  if (early <= 0) return direct;
  const Vec2 back = early * start.limits.airspeed * (line.begin - line.end).normalized();
  const FlightElement onto =
      solve::straight(line.begin + back, line.begin, down, air, now);
  FlightPlan settled =
      solve::join(from, {onto.p_N, onto.heading}, start.limits, start.wind, now);
  if (model::duration(settled) > model::duration(direct) + early) return direct;
  model::append(settled, {onto});
  return settled;
}

// All lines that are left, joined by the quickest connections. Around zones the
// trajectory planner leads, from one end of a line to the next.
PlannedTask::Part SurveyTask::plan_part(const Start& start, const TaskStep& step) {
  Part part;
  if (start.wind.norm() >= start.limits.airspeed) {
    part.why_not = fmt::format(
        "the wind of {:.1f} m/s is too strong to survey at "
        "{:.1f} m/s",
        start.wind.norm(), start.limits.airspeed);
    return part;
  }
  bool on_line = cut_line();
  if (!lines_ && !plan_lines(start, step, part.why_not)) {
    part.never = zones_.empty();
    return part;
  }
  const model::AirMotion air = solve::motion_of(start.limits, start.wind);
  const double down = start.state.p_N.z();
  FlightState here = start.state;
  double now = start.time;
  for (const SurveyLine& line : lines_->left()) {
    // On the line it goes on from where it is then.
    const Vec2 ahead = (line.end - line.begin).normalized();
    const double done =
        on_line ? std::max(0.0, (geo::horizontal(here.p_N) - line.begin).dot(ahead)) : 0;
    FlightElement along =
        solve::straight(line.begin + done * ahead, line.end, down, air, now);
    // On the line as it is: a connection back to its begin would be a full circle.
    const FlightPlan to =
        std::exchange(on_line, false) ? FlightPlan() : lead_to(line, here, start, now);
    part.plan.insert(part.plan.end(), to.begin(), to.end());
    if (!to.empty()) along.start = model::end_time_of(to);
    part.plan.push_back(along);
    part.milestones.push_back(along.start);
    now = along.start + along.duration;
    part.milestones.push_back(now);
    here = solve::end_state(part.plan);
  }
  part.nothing = part.plan.empty();
  return part;
}

// Begins and ends of lines, in turn. Those that a way around something leaves out are
// passed too, from afar.
void SurveyTask::pass(const TaskStep&) {
  if (lines_->left().empty()) return;
  const SurveyLine& line = lines_->left().front();
  if (!on_line_) {
    on_line_ = true;
    began_ = (here_ - line.begin).norm() <= reach_;
    farthest_ = 0;
    return;
  }
  on_line_ = false;
  ++version_;
  if (began_ && farthest_ <= aside_ && (here_ - line.end).norm() <= reach_)
    lines_->flown();
  else
    lines_->missed();
}

bool SurveyTask::finish(const TaskStep& step, AgentOutput& out) {
  if (!lines_->left().empty()) return false;
  const double forbidden = lines_->length_forbidden(),
               given_up = lines_->length_given_up();
  const double all = std::max(lines_->length(), forbidden + given_up);
  if (forbidden > 0)
    out.events.push_back(
        {step.in.now,
         context().self,
         EventKind::kSurveyIncomplete,
         fmt::format("{:.0f} % of its lines lie in no-fly zones", 100 * forbidden / all),
         {.value = forbidden / all}});
  if (given_up > 0)
    out.events.push_back(
        {step.in.now,
         context().self,
         EventKind::kSurveyIncomplete,
         fmt::format("{:.0f} % of its lines could not be flown", 100 * given_up / all),
         {.value = given_up / all}});
  return true;
}

TaskProgress SurveyTask::progress(const AgentInput& in) const {
  TaskProgress progress = PlannedTask::progress(in);
  if (lines_ && !progress.done && lines_->length() > 0)
    progress.share = std::clamp(1 - (lines_->length_left() + lines_->length_forbidden() +
                                     lines_->length_given_up()) /
                                        lines_->length(),
                                0.0, 1.0);
  return progress;
}

TaskKind SurveyTask::rest() const {
  Survey rest = order_;
  rest.lines.clear();
  if (!lines_) return rest;
  SurveyLines left = *lines_;
  if (on_line_ && began_ && farthest_ <= aside_) left.flown_to(here_);
  for (const auto* lines : {&left.left(), &left.forbidden()})
    for (const SurveyLine& line : *lines) {
      rest.lines.push_back(line.begin);
      rest.lines.push_back(line.end);
    }
  return rest;
}

}  // namespace skein::reasoning
