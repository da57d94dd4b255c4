// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/hmi/serve/live_state.h"

#include <algorithm>

#include "skein/geo/rotation.h"

namespace skein::hmi {
namespace {

// The last of what has happened that is kept, of each kind.
constexpr std::size_t kKept = 1000;
// Entities have numbers from 0 on without gaps; more than this are a mistake.
constexpr std::uint32_t kMaxEntities = 1'000'000;

float narrow(double value) {
  return static_cast<float>(value);
}

// The subject of a record, by its kind.
struct KeyFinder {
  using Key = std::optional<RecordKey>;

  Key operator()(const PerimeterRecord& r) const {
    return key(r.believer.value, r.phenomenon, r.mission);
  }
  // Each horizon has its own place: forecasts that were made at once follow each other.
  Key operator()(const ForecastRecord& r) const {
    const Time ahead = r.forecast.boundary.time - r.forecast.made;
    return key(r.forecast.phenomenon, static_cast<std::uint64_t>(ahead.ns()),
               r.forecast.mission);
  }
  Key operator()(const ArrivalRecord& r) const {
    return key(r.forecast.phenomenon, 0, r.forecast.mission + "\n" + r.forecast.place);
  }
  Key operator()(const ZoneRecord& r) const { return key(0, 0, r.change.zone.name); }
  Key operator()(const PlannerRecord& r) const {
    return key(r.id.value, static_cast<std::uint64_t>(r.value.link));
  }
  Key operator()(const ObjectMotion& r) const { return key(r.object); }
  Key operator()(const ObjectBeliefRecord& r) const {
    return key(r.id.value, r.value.object, r.value.mission);
  }
  Key operator()(const MissionRecord& r) const {
    return key(r.id.value, 0, r.value.mission);
  }
  Key operator()(const MissionProgressRecord& r) const { return key(r.id.value); }
  Key operator()(const TrafficMotion& r) const { return key(r.traffic); }
  Key operator()(const TrafficBeliefRecord& r) const {
    return key(r.id.value, r.value.track);
  }
  Key operator()(const TeamLeadRecord& r) const { return key(r.id.value); }
  Key operator()(const AlertRecord& r) const { return key(r.id.value, r.value.track); }
  Key operator()(const BandRecord& r) const { return key(r.id.value); }
  Key operator()(const RecommendationRecord& r) const { return key(r.id.value); }
  Key operator()(const TeamAllocationRecord& r) const {
    return key(r.value.proposer.value, r.value.number, r.value.team);
  }
  Key operator()(const TeamTaskRecord& r) const {
    return key(r.id.value, r.value.number);
  }
  Key operator()(const RadioUseRecord& r) const { return key(r.id.value); }
  Key operator()(const LinkUseRecord& r) const {
    return key(r.use.from.value, r.use.to.value);
  }
  Key operator()(const FlightPathRecord& r) const { return key(r.id.value); }
  Key operator()(const TaskReasonRecord& r) const { return key(r.value.aircraft.value); }
  Key operator()(const Footprint& r) const { return key(r.aircraft.value, r.sensor); }
  // An order: the newest to each aircraft is its task.
  Key operator()(const MessageRecord& r) const { return key(r.message.to.value); }
  template <class Happening>
  Key operator()(const Happening&) const {
    return std::nullopt;
  }

  Key key(std::uint64_t a, std::uint64_t b = 0, std::string name = {}) const {
    return RecordKey{kind, a, b, std::move(name)};
  }
  std::size_t kind;
};

template <class T>
constexpr bool kIsThing =
    std::is_same_v<T, EntityRecord> || std::is_same_v<T, GroundObject> ||
    std::is_same_v<T, AirTraffic> || std::is_same_v<T, PhysicalObject>;

// How something was that is no more.
bool is_over(const Record& record) {
  if (const auto* zone = std::get_if<ZoneRecord>(&record)) return !zone->change.on;
  if (const auto* alert = std::get_if<AlertRecord>(&record))
    return alert->value.level == 0;
  if (const auto* bands = std::get_if<BandRecord>(&record))
    return bands->value.level == 0;
  return false;
}

}  // namespace

std::optional<RecordKey> key_of(const Record& record) {
  return std::visit(KeyFinder{record.index()}, record);
}

bool is_streamed(const Record& record) {
  if (const auto* message = std::get_if<MessageRecord>(&record))
    return std::holds_alternative<Task>(message->message.content) && !message->lost;
  return !std::holds_alternative<TruthRecord>(record) &&
         !std::holds_alternative<EstimateRecord>(record) &&
         !std::holds_alternative<VehicleReportRecord>(record) &&
         !std::holds_alternative<RangeScan>(record) &&
         !std::holds_alternative<PluginRecord>(record);
}

std::optional<Record> without_truth(const Record& record) {
  if (const auto* perimeter = std::get_if<PerimeterRecord>(&record)) {
    PerimeterRecord belief = *perimeter;
    belief.truth.clear();
    return belief;
  }
  if (std::holds_alternative<TruthRecord>(record) ||
      std::holds_alternative<ObjectMotion>(record) ||
      std::holds_alternative<TrafficMotion>(record) ||
      std::holds_alternative<AirTraffic>(record) ||
      std::holds_alternative<SeparationLossRecord>(record) ||
      std::holds_alternative<PhysicalObject>(record))
    return std::nullopt;
  return record;
}

LiveState::Seen& LiveState::seen(EntityId id) {
  if (id.value >= seen_.size()) seen_.resize(id.value + 1);
  return seen_[id.value];
}

void LiveState::take_message(const MessageRecord& message) {
  const Message& said = message.message;
  if (message.lost || !stations_.contains(said.to) || said.from.value >= kMaxEntities)
    return;
  Seen& by = seen(said.from);
  by.heard = message.arrived;
  const auto* report = std::get_if<AircraftReport>(&said.content);
  if (!report) return;
  by.task_number = report->task_number;
  by.task_state = report->task_state;
  by.task_share = report->task_share;
  by.task_time_to_go = report->task_time_to_go;
}

void LiveState::keep(RecordKey key, const Record& record) {
  const std::size_t kind = key.kind;
  const auto [at, is_new] =
      current_.insert_or_assign(std::move(key), Current{record, ++heard_});
  if (is_new && ++subjects_[kind] > kMaxSubjects) drop_oldest(kind);
}

// A quarter at once, so that the search for them is rare.
void LiveState::drop_oldest(std::size_t kind) {
  const auto begin = current_.lower_bound(RecordKey{kind});
  const auto end = current_.lower_bound(RecordKey{kind + 1});
  std::vector<std::uint64_t> heard;
  for (auto at = begin; at != end; ++at) heard.push_back(at->second.heard);
  const auto quarter = heard.begin() + static_cast<std::ptrdiff_t>(heard.size() / 4);
  std::nth_element(heard.begin(), quarter, heard.end());
  const std::uint64_t oldest_kept = *quarter;
  for (auto at = begin; at != end;)
    at = at->second.heard < oldest_kept ? current_.erase(at) : std::next(at);
  subjects_[kind] = heard.size() - heard.size() / 4;
}

std::size_t LiveState::size() const {
  std::size_t sum = things_.size() + current_.size();
  for (const auto& [kind, records] : recent_) sum += records.size();
  return sum;
}

void LiveState::take(const Record& record) {
  if (const auto* truth = std::get_if<TruthRecord>(&record)) {
    if (truth->id.value >= kMaxEntities) return;
    const VehicleState& s = truth->state;
    now_ = truth->time;
    seen(truth->id).truth = {
        truth->id, narrow(s.p_N.x()), narrow(s.p_N.y()), narrow(-s.p_N.z()),
        narrow(geo::degrees(geo::wrap_2pi(geo::to_euler(s.q_NB).yaw)))};
    return;
  }
  if (const auto* estimate = std::get_if<EstimateRecord>(&record)) {
    if (estimate->id.value >= kMaxEntities) return;
    Seen& by = seen(estimate->id);
    by.estimate = *estimate;
    by.estimate.status.refused = {};  // its text lives only until the next command
    by.known = true;
    return;
  }
  if (const auto* entity = std::get_if<EntityRecord>(&record))
    if (entity->kind == "station") stations_.insert(entity->id);
  if (const auto* message = std::get_if<MessageRecord>(&record)) take_message(*message);
  if (!is_streamed(record)) return;
  if (std::visit([]<class T>(const T&) { return kIsThing<T>; }, record)) {
    if (things_.size() < kMaxThings) things_.push_back(record);
  } else if (auto key = key_of(record)) {
    if (!is_over(record))
      keep(*std::move(key), record);
    else if (current_.erase(*key) > 0)
      --subjects_[record.index()];
  } else {
    std::deque<Record>& all = recent_[record.index()];
    all.push_back(record);
    if (all.size() > kKept) all.pop_front();
  }
}

FleetFrame LiveState::fleet() const {
  FleetFrame frame;
  frame.time = now_;
  for (const Seen& by : seen_) {
    if (!by.known) continue;
    const NavEstimate& nav = by.estimate.nav;
    const AutopilotStatus& status = by.estimate.status;
    VehicleView& view = frame.vehicles.emplace_back();
    view.id = by.estimate.id;
    view.north = narrow(nav.p_N.x());
    view.east = narrow(nav.p_N.y());
    view.altitude_msl = narrow(-nav.p_N.z());
    view.velocity_north = narrow(nav.v_N.x());
    view.velocity_east = narrow(nav.v_N.y());
    view.climb = narrow(-nav.v_N.z());
    view.heading_deg = narrow(geo::degrees(geo::wrap_2pi(nav.heading)));
    view.roll_deg = narrow(geo::degrees(nav.roll));
    view.position_sd = narrow(nav.position_sd);
    view.cross_track = narrow(status.cross_track);
    view.time_error = narrow(status.time_error);
    view.charge = narrow(status.charge);
    view.endurance = status.endurance;
    view.age = narrow((now_ - nav.time).seconds());
    view.heard = by.heard;
    view.mode = status.mode;
    view.failsafe = status.trigger;
    view.reaction = status.reaction;
    view.on_ground = status.on_ground;
    view.task_number = by.task_number;
    view.task_state = by.task_state;
    view.task_share = narrow(by.task_share);
    view.task_time_to_go = by.task_time_to_go;
  }
  return frame;
}

TruthFrame LiveState::truth() const {
  TruthFrame frame;
  frame.time = now_;
  for (const Seen& by : seen_)
    if (by.truth) frame.places.push_back(*by.truth);
  return frame;
}

}  // namespace skein::hmi
