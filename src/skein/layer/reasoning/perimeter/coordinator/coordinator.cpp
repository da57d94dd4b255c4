// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/coordinator/coordinator.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "skein/layer/reasoning/perimeter/coordinator/deployment.h"

namespace skein::perimeter {
namespace {

constexpr double kStaleAfter =
    5;                         // nothing received for this long: predict the belief [s]
constexpr double kLevel = 50;  // zones this far above and below an aircraft count [m]
constexpr double kSoon = 60;   // zones that come into force within this count [s]
constexpr double kNewsEvery = 60;    // of one kind of warning [s]
constexpr double kAssembly = 3;      // for all to report before they are deployed [s]
constexpr double kResendAfter = 3;   // an order not confirmed by now is sent again [s]
constexpr int kResentAtOnce = 5;     // where others use the same medium
constexpr double kSurelyOut = 3;     // standard deviations of the boundary
constexpr double kFurtherOut = 200;  // further out than these nothing is expected [m]
constexpr double kAhead = 1000;  // on the present heading where no boundary is known [m]

// Where an aircraft that has not crossed for long is sure to find the boundary: from
// outside at the fire's origin, from inside beyond the nearest believed boundary.
Vec2 sure_crossing(const AircraftStatus& aircraft, const BoundaryEstimate& boundary,
                   const Vec2& origin) {
  const Vec2 here = geo::horizontal(aircraft.nav.p_N);
  if (!aircraft.inside.value_or(false)) return origin;
  const BoundaryPoint* nearest = nullptr;
  for (const auto& ring : boundary.rings)
    for (const BoundaryPoint& point : ring)
      if (!nearest || (point.position - here).squaredNorm() <
                          (nearest->position - here).squaredNorm())
        nearest = &point;
  if (!nearest) return here + kAhead * geo::unit(aircraft.nav.heading);
  return nearest->position +
         (kSurelyOut * nearest->sigma + kFurtherOut) * nearest->normal;
}

// Whether an aircraft has crossed all that may burn by what is believed.
bool has_passed(const AircraftStatus& aircraft, const BoundaryEstimate& boundary,
                const Vec2& origin) {
  const Vec2 here = geo::horizontal(aircraft.nav.p_N);
  const Vec2 out = here - origin;
  const auto* transect = std::get_if<FlyCourse>(&aircraft.task.what);
  if (!transect || out.dot(geo::unit(transect->course)) <= 0 ||
      aircraft.inside.value_or(false))
    return false;
  for (const auto& ring : boundary.rings)
    for (const BoundaryPoint& point : ring)
      if ((point.position - origin).norm() + kSurelyOut * point.sigma + kFurtherOut >
          out.norm())
        return false;
  return !boundary.rings.empty();
}

// What an aircraft says where the air has no room for all of its readings.
void hear(const FireReport& report, EntityId aircraft, std::vector<HeardReading>& out) {
  for (const BriefPlace& place : report.burning)
    out.push_back({reading_of(report, place, aircraft), Follows::kNothing});
  for (const BriefReading& each : report.readings)
    out.push_back({reading_of(report, each, aircraft),
                   each.adjacent ? Follows::kDirectly : Follows::kPerhaps});
}

void send_order(const Member& member, AgentOutput& out) {
  Message message;
  message.to = member.status.id;
  message.content = member.status.task;
  out.outbox.push_back(std::move(message));
}

}  // namespace

Coordinator::Coordinator(const CoordinatorOptions& options,
                         std::unique_ptr<PerimeterEstimator> estimator,
                         std::unique_ptr<MonitoringStrategy> strategy)
    : options_(options),
      belief_(std::move(estimator), options.late_window),
      strategy_(std::move(strategy)),
      roster_(options.team, options.lost_after),
      zones_(options.zones),
      boundary_(belief_.boundary_at(Time())) {}

void Coordinator::step(const AgentInput& in, AgentOutput& out) {
  listen(in, out);
  if ((in.now - last_heard_).seconds() > kStaleAfter) belief_.predict(in.now);
  boundary_ = belief_.boundary_at(in.now);
  deploy(in.now, out);
  force_crossings(in.now, out);
  allocate(in.now, out);
  resend_lost_orders(in, out);
  record_belief(in.now, out);
  look_ahead(in.now, out);
}

MissionDemand Coordinator::demand() const {
  MissionDemand demand;
  demand.place = options_.origin;
  return demand;
}

void Coordinator::record_belief(Time now, AgentOutput& out) {
  if (now < next_record_) return;
  next_record_ = std::max(next_record_ + options_.record_period, now);
  out.records.emplace_back(PerimeterBelief{boundary_, options_.phenomenon});
}

// Before the fire was found there is nothing to go by.
void Coordinator::look_ahead(Time now, AgentOutput& out) {
  if (allocating_ && !forecast_ && !options_.forecast.horizons.empty() &&
      now >= next_forecast_) {
    next_forecast_ = now + options_.forecast.period;
    calibration_.compare(boundary_);
    forecast_ = belief_.look_ahead(now, options_.forecast, calibration_.spread());
  }
  if (!forecast_ || !forecast_->advance()) return;
  Forecast ahead = forecast_->take();
  forecast_.reset();
  calibration_.keep(std::move(ahead.check));
  record_forecast(std::move(ahead), out);
}

void Coordinator::record_forecast(Forecast ahead, AgentOutput& out) const {
  for (BoundaryEstimate& boundary : ahead.boundaries)
    out.records.emplace_back(
        PerimeterForecast{ahead.made, std::move(boundary), options_.phenomenon});
  for (ArrivalForecast& arrival : ahead.arrivals) {
    arrival.phenomenon = options_.phenomenon;
    out.records.emplace_back(std::move(arrival));
  }
}

void Coordinator::listen(const AgentInput& in, AgentOutput& out) {
  std::vector<HeardReading> readings;
  for (const Message& message : in.inbox) {
    if (const auto* report = std::get_if<AircraftReport>(&message.content))
      roster_.take(*report, message.from, in.now);
    else if (const auto* reading = std::get_if<FireReading>(&message.content))
      readings.push_back({*reading});
    else if (const auto* several = std::get_if<FireReport>(&message.content))
      hear(*several, message.from, readings);
    else if (const auto* change = std::get_if<ZoneChange>(&message.content))
      zones_.take(*change);
  }
  if (!readings.empty()) last_heard_ = in.now;
  for (const auto& [reading, follows] : readings)
    if (Member* member = roster_.find(reading.aircraft);
        member && follows != Follows::kNothing)
      member->status.inside = reading.inside;
  for (const Crossing& crossing : belief_.take(std::move(readings)))
    note_crossing(crossing, out);
  report_confidence(in.now, out);
  for (const EntityId id : roster_.update(in.now))
    out.events.push_back({in.now, id, EventKind::kSilent, "no report for a while"});
}

bool Coordinator::Tally::is_news(int now_counted, Time now) {
  if (now_counted == reported ||
      (reported > 0 && (now - reported_at).seconds() < kNewsEvery))
    return false;
  reported = now_counted;
  reported_at = now;
  return true;
}

void Coordinator::report_confidence(Time now, AgentOutput& out) {
  if (const int count = belief_.health().outliers; outliers_.is_news(count, now))
    out.events.push_back(
        {now,
         EntityId{},
         EventKind::kOutlier,
         fmt::format("{} observations so far were all but impossible", count),
         {.value = count}});
  if (const int count = belief_.dropped(); dropped_.is_news(count, now))
    out.events.push_back({now,
                          EntityId{},
                          EventKind::kTooLate,
                          fmt::format("{} readings so far came more than {:.0f} s late",
                                      count, options_.late_window),
                          {.value = count}});
  if (const std::string_view method = belief_.health().method; method != method_) {
    if (!method_.empty())
      out.events.push_back({now, EntityId{}, EventKind::kHandOver,
                            fmt::format("the belief is made by {} now: the crossings "
                                        "contradicted {}",
                                        method, method_)});
    method_ = method;
  }
}

void Coordinator::judge(const Crossing& crossing, AgentOutput& out) {
  const auto verdict = confidence_.take(crossing, boundary_);
  if (!verdict) return;
  const bool lost = *verdict == ConfidenceMonitor::Verdict::kOverConfident;
  out.events.push_back(
      {crossing.time,
       EntityId{},
       lost ? EventKind::kOverConfident : EventKind::kTrusted,
       fmt::format("{:.0f} % of the last crossings lay outside the believed 95 % band",
                   100 * confidence_.share_outside()),
       {.value = confidence_.share_outside()}});
}

void Coordinator::note_crossing(const Crossing& crossing, AgentOutput& out) {
  Member* member = roster_.find(crossing.aircraft);
  if (!member) return;
  member->status.has_crossed = true;
  member->status.last_crossing = std::max(member->status.last_crossing, crossing.time);
  member->deploying = member->forced = false;
  member->enters.reset();
  out.records.emplace_back(crossing);
  judge(crossing, out);
  out.events.push_back({crossing.time, crossing.aircraft, EventKind::kCrossing,
                        fmt::format("{} the fire at {:.0f} m north, {:.0f} m east",
                                    crossing.entered ? "into" : "out of",
                                    crossing.point.x(), crossing.point.y())});
}

void Coordinator::order(Member& member, TaskKind what, Time now, AgentOutput& out) {
  member.status.task.number += 1;
  member.status.task.what = std::move(what);
  member.status.task_done = false;
  member.task_sent = now;
  send_order(member, out);
}

void Coordinator::deploy(Time now, AgentOutput& out) {
  begin_transects(now, out);
  bool all = true;
  int available = 0, met = 0;
  for (Member& member : roster_.members()) {
    if (!member.available) continue;
    ++available;
    if (member.status.has_crossed) ++met;
    if (!member.deploying) continue;
    all = false;
    const bool flies = member.status.task.number > 0 && !member.enters;
    if (flies && ((now - member.deployed).seconds() > options_.deployment_limit ||
                  has_passed(member.status, boundary_, options_.origin))) {
      member.deploying = false;  // the transect found nothing: the strategy decides
      out.events.push_back({now, member.status.id, EventKind::kNoCrossing,
                            "the deployment transect met no boundary"});
    }
  }
  if (available > 0 && all && !allocating_) {
    allocating_ = true;
    out.events.push_back({now, EntityId{}, EventKind::kAllocation,
                          fmt::format("{} of {} aircraft have met the boundary: "
                                      "allocation begins",
                                      met, available)});
  }
}

void Coordinator::begin_transects(Time now, AgentOutput& out) {
  if (options_.all_sides) send_to_entries(now, out);
  for (std::size_t k = 0; k < roster_.members().size(); ++k) {
    Member& member = roster_.members()[k];
    if (!member.available || !member.deploying) continue;
    // Who cannot reach its entry begins where it is.
    const bool late = (now - member.deployed).seconds() > options_.deployment_limit;
    const bool there = member.enters && (member.status.task_done || late);
    if (!there && member.status.task.number > 0) continue;
    if (options_.all_sides && !member.enters) continue;  // not sent to its entry yet
    const auto& courses = options_.entry_courses;
    const Vec2 here = geo::horizontal(member.status.nav.p_N);
    const double course = member.enters     ? *member.enters
                          : courses.empty() ? geo::bearing(options_.origin - here)
                                            : courses[k % courses.size()];
    member.enters.reset();
    member.deployed = now;
    order(member, FlyCourse{course}, now, out);
  }
}

// Those that have not been sent yet: all of them together, or one that comes later.
void Coordinator::send_to_entries(Time now, AgentOutput& out) {
  std::vector<Member*> who;
  std::vector<Vec2> places;
  for (Member& member : roster_.members())
    if (member.available && member.deploying && member.status.task.number == 0) {
      who.push_back(&member);
      places.push_back(geo::horizontal(member.status.nav.p_N));
      if (!assembled_) assembled_ = now;
    }
  if (who.empty() || (now - *assembled_).seconds() < kAssembly) return;
  const std::vector<Entry> entries = plan_entries(boundary_, options_.origin, places);
  for (std::size_t k = 0; k < who.size(); ++k) {
    who[k]->enters = entries[k].course;
    who[k]->deployed = now;
    order(*who[k], FlyTo{entries[k].place}, now, out);
    const double side = geo::wrap_2pi(entries[k].course + geo::kPi);
    out.events.push_back(
        {now, who[k]->status.id, EventKind::kEntry,
         fmt::format("enters from {:.0f} degrees, at {:.0f} m north, "
                     "{:.0f} m east",
                     geo::degrees(side), entries[k].place.x(), entries[k].place.y())});
  }
}

void Coordinator::force_crossings(Time now, AgentOutput& out) {
  if (options_.forced_crossing <= 0) return;
  const std::vector<Zone> zones = zones_in_force(now);
  for (Member& member : roster_.members()) {
    if (!member.available || member.deploying) continue;
    if (member.forced) {
      if (!member.status.task_done) continue;
      member.forced = false;  // got there without crossing: the strategy may try again
      member.deployed = now;
    }
    const Time since = std::max(member.status.last_crossing, member.deployed);
    if ((now - since).seconds() < options_.forced_crossing) continue;
    const Vec2 goal = sure_crossing(member.status, boundary_, options_.origin);
    if (std::any_of(zones.begin(), zones.end(),
                    [&](const Zone& zone) { return covers(zone, goal); }))
      continue;
    member.forced = true;
    order(member, FlyTo{goal}, now, out);
    out.events.push_back({now, member.status.id, EventKind::kForcedCrossing,
                          "no crossing for long: sent across the boundary"});
  }
}

std::vector<Zone> Coordinator::zones_in_force(Time now) const {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Member& member : roster_.members()) {
    if (!member.available) continue;
    low = std::min(low, -member.status.nav.p_N.z() - kLevel);
    high = std::max(high, -member.status.nav.p_N.z() + kLevel);
  }
  std::vector<Zone> zones;
  for (const Zone& zone : zones_.zones())
    if (concerns(zone, low, high, now.seconds(), now.seconds() + kSoon))
      zones.push_back(zone);
  return zones;
}

void Coordinator::allocate(Time now, AgentOutput& out) {
  std::vector<AircraftStatus> ready;
  for (const Member& member : roster_.members())
    if (member.available && !member.deploying && !member.forced) {
      ready.push_back(member.status);
      NavEstimate& nav = ready.back().nav;
      nav.p_N += (now - nav.time).seconds() * nav.v_N;
      nav.time = now;
    }
  if (ready.empty()) return;
  const std::vector<Zone> zones = zones_in_force(now);
  const MonitoringSituation situation{now, &boundary_, ready, options_.origin, zones};
  for (Assignment& assignment : strategy_->assign(situation)) {
    Member* member = roster_.find(assignment.aircraft);
    if (!member) continue;
    order(*member, std::move(assignment.what), now, out);
    if (!assignment.why.empty())
      out.records.emplace_back(
          TaskReason{assignment.aircraft, std::move(assignment.why)});
  }
}

// Orders that its radio has not sent yet are not lost; a few at once leave it room.
void Coordinator::resend_lost_orders(const AgentInput& in, AgentOutput& out) {
  if (in.radio.waiting > 0) return;
  const Time now = in.now;
  int left = in.radio.shared ? kResentAtOnce : std::numeric_limits<int>::max();
  for (Member& member : roster_.members()) {
    if (left == 0) return;
    if (!member.available || member.status.task.number == 0 ||
        member.reported_task == member.status.task.number ||
        (now - member.task_sent).seconds() < kResendAfter)
      continue;
    member.task_sent = now;
    send_order(member, out);
    --left;
  }
}

}  // namespace skein::perimeter
