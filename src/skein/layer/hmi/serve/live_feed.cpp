// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/hmi/serve/live_feed.h"

#include <algorithm>
#include <utility>

namespace skein::hmi {
namespace {

constexpr auto kPeriod = std::chrono::milliseconds(100);
// More than this between two publications is told as a new state.
constexpr std::size_t kMaxItems = 20000;
constexpr std::size_t kMetricsKept = 3000;
// So long a task or zone may be refused by those whom it concerns.
constexpr double kMayBeRefused = 120;
constexpr std::size_t kObeyedKept = 100;
constexpr std::string_view kPage = "page: ";  // that senders begin with

std::string about(const Command& command) {
  if (const auto* task = std::get_if<TaskCommand>(&command)) return task->aircraft;
  if (const auto* flight = std::get_if<FlightChangeCommand>(&command))
    return flight->aircraft;
  if (std::holds_alternative<ZoneChange>(command)) return "zone";
  return {};
}

}  // namespace

LiveFeed::LiveFeed(LiveHub& hub, Time duration, double speed, bool recorded)
    : hub_(hub), recorded_(recorded) {
  clock_.duration = duration;
  clock_.wanted_speed = speed;
  reported_clock_ = clock_;
}

void LiveFeed::record(const Record& record) {
  state_.take(record);
  if (const auto* entity = std::get_if<EntityRecord>(&record))
    names_[entity->id] = entity->name;
  if (const auto* given = std::get_if<CommandRecord>(&record)) take_given(*given);
  if (const auto* boundary = std::get_if<PerimeterRecord>(&record)) fire_.take(*boundary);
  if (const auto* forecast = std::get_if<ForecastRecord>(&record)) fire_.take(*forecast);
  if (const auto* event = std::get_if<Event>(&record)) take_fate(*event);
  if (hub_.is_watched() && is_streamed(record)) add(LiveRecord{record});
}

bool LiveFeed::is_aircraft(const std::string& name) const {
  return std::any_of(names_.begin(), names_.end(),
                     [&](const auto& each) { return each.second == name; });
}

// What was given before has been obeyed when the next command is.
void LiveFeed::take_given(const CommandRecord& given) {
  if (recorded_) return;
  settle(RequestState::kAccepted);
  if (const auto* wind = std::get_if<WindCommand>(&given.command)) wind_ = *wind;
  if (const auto* flight = std::get_if<FlightChangeCommand>(&given.command);
      flight && is_aircraft(flight->aircraft)) {
    FlightChangeCommand& last = flights_[flight->aircraft];
    last.aircraft = flight->aircraft;
    if (flight->altitude_agl) last.altitude_agl = flight->altitude_agl;
    if (flight->airspeed) last.airspeed = flight->airspeed;
  }
  if (const auto* pause = std::get_if<PauseCommand>(&given.command))
    clock_.paused = pause->paused;
  if (const auto* speed = std::get_if<SpeedCommand>(&given.command))
    clock_.wanted_speed = speed->factor;
  if (awaited_.empty() || given.sender.substr(0, kPage.size()) != kPage) return;
  current_ = awaited_.front();
  current_->given = given.time;
  awaited_.pop_front();
}

void LiveFeed::add(LiveItem item) {
  if (items_.size() < kMaxItems) {
    items_.push_back(std::move(item));
  } else {
    items_.clear();
    hub_.all_behind();
  }
}

// Refusals come at once by the run itself, later by those whom a command concerns.
void LiveFeed::take_fate(const Event& event) {
  if (event.kind == EventKind::kCommandRefused)
    return settle(RequestState::kRefused, event.text);
  const auto name = names_.find(event.entity);
  const bool is_zone = event.kind == EventKind::kZoneRefused;
  const bool is_aircraft =
      event.kind == EventKind::kTaskRefused || event.kind == EventKind::kFlightRefused;
  if (!is_zone && (!is_aircraft || name == names_.end())) return;
  const std::string whose = is_zone ? "zone" : name->second;
  if (current_ && current_->about == whose)
    return settle(RequestState::kRefused, event.text);
  const auto found =
      std::find_if(obeyed_.rbegin(), obeyed_.rend(),
                   [&](const Request& request) { return request.about == whose; });
  if (found == obeyed_.rend() || (event.time - found->given).seconds() > kMayBeRefused)
    return;
  hub_.reply(found->client, {found->number, RequestState::kRefused, event.text});
  obeyed_.erase(std::next(found).base());
}

void LiveFeed::settle(RequestState state, const std::string& text) {
  if (!current_) return;
  hub_.reply(current_->client, {current_->number, state, text});
  if (state == RequestState::kAccepted && !current_->about.empty())
    obeyed_.push_back(*current_);
  if (obeyed_.size() > kObeyedKept) obeyed_.pop_front();
  current_.reset();
}

Result<void> LiveFeed::step_done(Time time) {
  settle(RequestState::kAccepted);
  clock_.time = time;
  pump();
  return {};
}

void LiveFeed::show(const RunProgress& progress) {
  clock_.time = progress.now;
  clock_.misses = progress.misses;
  clock_.headline = progress.headline;
}

void LiveFeed::show(const MetricSample& sample) {
  const std::lock_guard guard(lock_);
  new_metrics_.push_back(sample);
}

void LiveFeed::take_metrics() {
  std::vector<MetricSample> all;
  {
    const std::lock_guard guard(lock_);
    all.swap(new_metrics_);
  }
  for (MetricSample& sample : all) {
    if (hub_.is_watched()) add(sample);
    metrics_.push_back(std::move(sample));
    if (metrics_.size() > kMetricsKept) metrics_.pop_front();
  }
}

std::vector<ClientCommand> LiveFeed::take_requests() {
  pump();
  return hub_.take_commands();
}

void LiveFeed::reply(const ClientCommand& request, RequestState state,
                     const std::string& text) {
  hub_.reply(request.client, {request.number, state, text});
}

void LiveFeed::set_clock(bool paused, double wanted_speed) {
  clock_.paused = paused;
  clock_.wanted_speed = wanted_speed;
}

void LiveFeed::restart(Time at) {
  state_ = LiveState();
  fire_.clear();
  // A jump is no speed.
  measured_at_ = std::chrono::steady_clock::now();
  clock_.time = measured_from_ = at;
  items_.clear();
  take_metrics();
  metrics_.clear();
  hub_.all_behind();
}

std::vector<CommandRecord> LiveFeed::take_commands() {
  settle(RequestState::kAccepted);
  std::vector<CommandRecord> all;
  for (ClientCommand& asked : take_requests()) {
    if (const auto* question = std::get_if<PreviewQuestion>(&asked.what)) {
      preview(asked, question->task);
      continue;
    }
    auto* command = std::get_if<Command>(&asked.what);
    if (!command || clock_.over) {
      reply(asked, RequestState::kRefused,
            command ? "the run is over." : "this is no recorded run.");
      continue;
    }
    awaited_.push_back({asked.client, asked.number, about(*command), {}});
    all.push_back({Time(), std::move(asked.sender), std::move(*command)});
  }
  return all;
}

void LiveFeed::preview(const ClientCommand& asked, const TaskCommand& task) {
  const FleetFrame fleet = state_.fleet();
  const auto view = std::find_if(
      fleet.vehicles.begin(), fleet.vehicles.end(), [&](const VehicleView& each) {
        const auto name = names_.find(each.id);
        return name != names_.end() && name->second == task.aircraft;
      });
  if (!previewer_ || clock_.over || view == fleet.vehicles.end())
    return reply(asked, RequestState::kRefused,
                 view == fleet.vehicles.end() ? "no such aircraft takes part."
                                              : "the run is over.");
  PreviewOrder order{task.aircraft, task.what, clock_.time, *view, {}, wind_};
  if (const auto flight = flights_.find(task.aircraft); flight != flights_.end())
    order.flight = flight->second;
  state_.for_each([&](const Record& record) {
    if (const auto* zone = std::get_if<ZoneRecord>(&record); zone && zone->change.on)
      order.zones.push_back(zone->change.zone);
  });
  previewer_(asked.client, asked.number, std::move(order));
}

void LiveFeed::pump() {
  const Moment now = std::chrono::steady_clock::now();
  if (now < next_) return;
  next_ = now + kPeriod;
  measure_speed(now);
  publish();
}

// Over the last second or more: what the run does now, not since its start.
void LiveFeed::measure_speed(Moment now) {
  const double passed = std::chrono::duration<double>(now - measured_at_).count();
  if (passed < 1) return;
  clock_.speed = (clock_.time - measured_from_).seconds() / passed;
  measured_at_ = now;
  measured_from_ = clock_.time;
}

void LiveFeed::finish() {
  settle(RequestState::kAccepted);
  clock_.over = true;
  publish();
}

SharedBytes LiveFeed::batch(bool with_truth, bool state) const {
  std::vector<LiveItem> all;
  const auto put = [&](const Record& record) {
    if (with_truth)
      all.emplace_back(LiveRecord{record});
    else if (auto open = without_truth(record))
      all.emplace_back(LiveRecord{*std::move(open)});
  };
  if (state) {
    all.emplace_back(SnapshotMark{true});
    state_.for_each(put);
    if (with_truth) all.insert(all.end(), metrics_.begin(), metrics_.end());
  } else {
    for (const LiveItem& item : items_) {
      if (const auto* live = std::get_if<LiveRecord>(&item))
        put(live->record);
      else if (with_truth)
        all.push_back(item);  // metrics are measured against the truth
    }
  }
  all.emplace_back(clock_);
  all.emplace_back(state_.fleet());
  if (with_truth) all.emplace_back(state_.truth());
  if (state) all.emplace_back(SnapshotMark{false});
  return coded(all);
}

RunClock LiveFeed::clock() const {
  const std::lock_guard guard(lock_);
  return reported_clock_;
}

FeedSizes LiveFeed::sizes() const {
  const std::lock_guard guard(lock_);
  return reported_sizes_;
}

void LiveFeed::publish() {
  take_metrics();
  {
    const std::lock_guard guard(lock_);
    reported_clock_ = clock_;
    reported_sizes_ = {state_.size(), items_.size(), metrics_.size()};
  }
  if (!hub_.is_watched()) {
    items_.clear();
    return;
  }
  const bool state = hub_.take_state_wanted();
  LiveBatch all;
  if (hub_.wants_open()) {
    all.open = batch(false, false);
    if (state) all.open_state = batch(false, true);
  }
  if (hub_.wants_whole()) {
    all.whole = batch(true, false);
    if (state) all.whole_state = batch(true, true);
  }
  items_.clear();
  hub_.publish(std::move(all));
}

}  // namespace skein::hmi
