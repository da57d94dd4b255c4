// SPDX-License-Identifier: Apache-2.0
#include "skein/record/figures/statistics.h"

#include <algorithm>

namespace skein::record {
namespace {

// Each kind of record, and what becomes of it.
struct Taker {
  RunStatistics& statistics;

  void operator()(const EntityRecord& r) { statistics.entity(r); }
  void operator()(const TruthRecord& r) {
    statistics.separation().truth(r.time, r.id, r.state);
    statistics.traffic().truth(r.time, r.id, r.state);
    statistics.truth(r.time, r.id, r.state);
    statistics.missions().truth(r.time, r.id, r.state.p_N);
  }
  void operator()(const EstimateRecord& r) {
    statistics.estimate(
        r.nav.time, r.id, r.nav.p_N,
        r.status.follows ? std::optional(r.status.cross_track) : std::nullopt);
    statistics.reserve(r.id, r.status.reserve);
    statistics.missions().estimate(r.nav.time, r.id, r.nav.p_N, r.status.on_ground);
  }
  void operator()(const FireReading&) { statistics.reading(); }
  void operator()(const Crossing& r) { statistics.crossing(r); }
  void operator()(const MessageRecord& r) {
    statistics.radio().message(
        {r.message.from, kind_of_message(r), r.copy, r.cause, r.way.hops, r.forged});
    statistics.separation().message(r.message);
  }
  void operator()(const PerimeterRecord& r) {
    statistics.perimeter(r, TrueBoundary(r.truth));
  }
  void operator()(const Event& r) {
    statistics.event(r);
    statistics.missions().event(r);
    statistics.team().event(r);
  }
  void operator()(const GroundObject& r) { statistics.payload().object(r); }
  void operator()(const ObjectMotion& r) {
    statistics.payload().motion(r);
    statistics.missions().motion(r);
  }
  void operator()(const Detection& r) {
    statistics.payload().detection(r);
    statistics.missions().detection(r);
  }
  void operator()(const Footprint& r) {
    statistics.payload().footprint();
    statistics.missions().footprint(r);
  }
  void operator()(const ObjectBeliefRecord& r) { statistics.missions().belief(r); }
  void operator()(const MissionRecord& r) { statistics.missions().mission(r); }
  void operator()(const ForecastRecord& r) { statistics.forecasts().forecast(r); }
  void operator()(const ArrivalRecord& r) { statistics.forecasts().arrival(r); }
  void operator()(const RangeScan&) { statistics.payload().ranges(); }
  void operator()(const PhysicalObject&) { statistics.memory().physical_object(); }
  void operator()(const ObservationRecord& r) { statistics.memory().observation(r.fate); }
  void operator()(const AirTraffic& r) { statistics.traffic().aircraft(r); }
  void operator()(const TrafficMotion& r) { statistics.traffic().motion(r); }
  void operator()(const TrafficBeliefRecord& r) {
    statistics.traffic().belief(r);
    statistics.alerts().belief(r.value);
  }
  void operator()(const AlertRecord& r) { statistics.alerts().alert(r); }
  void operator()(const RecommendationRecord& r) {
    statistics.alerts().recommendation(r);
  }
  // No figures are made of these.
  void operator()(const ZoneRecord&) {}
  void operator()(const CommandRecord&) {}
  void operator()(const PluginRecord&) {}
  void operator()(const PlannerRecord&) {}
  void operator()(const BandRecord&) {}
  void operator()(const FlightPathRecord&) {}
  void operator()(const TaskReasonRecord&) {}
  void operator()(const TeamTaskRecord&) {}
  void operator()(const TeamLeadRecord& r) { statistics.team().lead(r); }
  void operator()(const TeamAllocationRecord& r) {
    statistics.team().allocation(r.value);
  }
  void operator()(const ConflictRecord& r) {
    statistics.separation().conflict(r.value);
    statistics.alerts().conflict(r);
  }
  void operator()(const SeparationLossRecord& r) { statistics.separation().loss(r); }
  void operator()(const RadioUseRecord& r) { statistics.radio().radio(r); }
  void operator()(const LinkUseRecord&) {}
  void operator()(const VehicleReportRecord&) {}
  void operator()(const MissionProgressRecord&) {}
};

}  // namespace

void RunStatistics::take(const Record& record) {
  std::visit(Taker{*this}, record);
}

void RunStatistics::entity(const EntityRecord& entity) {
  flights_[entity.id].name = entity.name;
  if (entity.kind == "aircraft") aircraft_.insert(entity.id);
  memory_.entity(entity.reality);
}

void RunStatistics::truth(Time time, EntityId id, const VehicleState& state) {
  const Vec3& p_N = state.p_N;
  last_flown_ = std::max(last_flown_, time);
  flight_statistics_.truth(time, id, state);
  Flight& flight = flights_[id];
  if (flight.last) flight.distance += (p_N - *flight.last).norm();
  flight.last = p_N;
}

void RunStatistics::crossing(const Crossing& crossing) {
  ++crossings_;
  ages_.add(crossing);
}

void RunStatistics::event(const Event& event) {
  flight_statistics_.event(event);
  memory_.event(event);
  if (event.kind == EventKind::kAllocation && !allocation_start_)
    allocation_start_ = event.time;
  if (event.kind == EventKind::kOverConfident || event.kind == EventKind::kTrusted)
    judged_ = true;
  if (event.kind == EventKind::kOverConfident && !over_confident_since_)
    over_confident_since_ = event.time;
  if (event.kind == EventKind::kTrusted && over_confident_since_) {
    over_confident_ += event.time - *over_confident_since_;
    over_confident_since_.reset();
  }
}

PerimeterMetrics RunStatistics::perimeter(const PerimeterRecord& record,
                                          const TrueBoundary& truth) {
  forecasts_.truth(record.time, record.phenomenon, truth);
  PerimeterMetrics now = perimeter_metrics(truth, record.belief);
  if (const auto ages = ages_.ages(record.time, truth, record.belief)) {
    now.latency_mean = ages->mean;
    now.latency_max = ages->max;
  }
  metrics(record.time, {record.believer, record.mission}, now);
  return now;
}

void RunStatistics::metrics(Time time, const Believer& who, const PerimeterMetrics& now) {
  auto found = std::find_if(gathered_.begin(), gathered_.end(),
                            [&](const auto& each) { return each.first == who; });
  if (found == gathered_.end())
    found = gathered_.insert(found, {who, Gathering(metric_fields().size())});
  last_metrics_ = time;
  const bool allocated = allocation_start_ && time >= *allocation_start_;
  for (std::size_t i = 0; i < metric_fields().size(); ++i) {
    Gathered& gathered = found->second[i];
    const std::optional<double> value = now.*metric_fields()[i].value;
    gathered.final = value;
    if (!value) continue;
    gathered.run.add(*value);
    if (allocated) gathered.allocation.add(*value);
  }
}

std::map<std::string, double> RunStatistics::figures() const {
  std::map<std::string, double> out;
  for (const auto& [who, gathering] : gathered_) {
    const std::string prefix =
        &gathering == &gathered_.front().second ? "" : "mission_" + who.mission + "_";
    for (std::size_t i = 0; i < gathering.size(); ++i) {
      const MetricField& field = metric_fields()[i];
      const Gathered& g = gathering[i];
      const auto put = [&](const char* part, double value) {
        out[prefix + std::string(field.name) + part + std::string(field.unit)] = value;
      };
      if (g.allocation.count > 0) put("_mean", g.allocation.sum / g.allocation.count);
      if (g.run.count > 0) put("_run_mean", g.run.sum / g.run.count);
      if (g.final) put("_final", *g.final);
    }
  }
  if (allocation_start_) out["allocation_start_s"] = allocation_start_->seconds();

  Time over_confident = over_confident_;
  if (over_confident_since_ && *over_confident_since_ < last_metrics_)
    over_confident += last_metrics_ - *over_confident_since_;
  if (judged_) out["over_confident_s"] = over_confident.seconds();

  double total = 0, flown = 0;
  for (const auto& [id, flight] : flights_) {
    if (!flight.last) continue;
    out["distance_flown_" + flight.name + "_m"] = flight.distance;
    total += flight.distance;
    flown += 1;
  }
  out["distance_flown_total_m"] = total;
  if (flown > 0) out["distance_flown_mean_m"] = total / flown;
  flight_statistics_.add_figures(out, [this](EntityId id) {
    const auto flight = flights_.find(id);
    return flight == flights_.end() ? std::to_string(id.value) : flight->second.name;
  });
  payload_.add_figures(out);
  missions_.add_figures(out);
  forecasts_.add_figures(out);
  memory_.add_figures(out);
  separation_.add_figures(out, aircraft_.size());
  team_.add_figures(out, last_flown_);
  traffic_.add_figures(out);
  alerts_.add_figures(out);
  radio_.add_figures(out);
  double said = 0;
  for (const EntityId id : aircraft_) said += static_cast<double>(radio_.sent_by(id));
  const auto aircraft = static_cast<double>(aircraft_.size());
  if (said > 0 && last_flown_ > Time())
    out["messages_per_aircraft_s"] = said / (aircraft * last_flown_.seconds());
  out["aircraft"] = aircraft;
  out["observations"] = static_cast<double>(observations_);
  out["crossings"] = static_cast<double>(crossings_);
  return out;
}

}  // namespace skein::record
