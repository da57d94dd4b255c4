// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/hmi/serve/foxglove/view.h"

#include <algorithm>
#include <utility>

#include "skein/layer/hmi/serve/foxglove/schemas.h"

namespace skein::hmi::foxglove {
namespace {

// Channels of the whole run; those of aircraft follow.
enum : std::uint32_t {
  kTransformsChannel = 1,
  kAircraftChannel,
  kBoundariesChannel,
  kBoundariesOnMapChannel,
  kZonesChannel,
  kZonesOnMapChannel,
  kPathsChannel,
  kClockChannel,
  kMetricsChannel,
  kLogChannel,
  kFirstAircraftChannel = 16
};

// Two channels each.
std::uint32_t location_of(EntityId id) {
  return kFirstAircraftChannel + 2 * id.value;
}
std::uint32_t state_of(EntityId id) {
  return location_of(id) + 1;
}

}  // namespace

View::View(Facts facts) : messages_(std::move(facts)) {
  const bool has_map = messages_.facts().frame.has_value();
  add_channel(kTransformsChannel, "/tf", "foxglove.FrameTransforms", transforms_schema());
  add_channel(kAircraftChannel, "/aircraft", "foxglove.SceneUpdate", scene_schema());
  add_channel(kBoundariesChannel, "/perimeter", "foxglove.SceneUpdate", scene_schema());
  add_channel(kZonesChannel, "/zones", "foxglove.SceneUpdate", scene_schema());
  add_channel(kPathsChannel, "/plans", "foxglove.SceneUpdate", scene_schema());
  if (has_map) {
    add_channel(kBoundariesOnMapChannel, "/perimeter/map", "foxglove.GeoJSON",
                geojson_schema());
    add_channel(kZonesOnMapChannel, "/zones/map", "foxglove.GeoJSON", geojson_schema());
  }
  add_channel(kClockChannel, "/clock", "skein.RunClock", clock_schema());
  add_channel(kMetricsChannel, "/metrics", "skein.Metrics", metrics_schema());
  add_channel(kLogChannel, "/log", "foxglove.Log", log_schema());
}

void View::add_channel(std::uint32_t id, std::string topic, const char* schema_name,
                       std::string schema) {
  channels_.push_back({id, std::move(topic), schema_name, std::move(schema)});
}

std::vector<Channel> View::take_new_channels() {
  const auto from = channels_.begin() + static_cast<std::ptrdiff_t>(announced_);
  announced_ = channels_.size();
  return {from, channels_.end()};
}

std::vector<View::Said> View::take_happened() {
  return std::exchange(happened_, {});
}

std::set<std::uint32_t> View::take_changed() {
  return std::exchange(changed_, {});
}

// What is told anew from the begin on.
void View::clear() {
  boundaries_.clear();
  zones_.clear();
  paths_.clear();
  changed_.insert({kBoundariesChannel, kBoundariesOnMapChannel, kZonesChannel,
                   kZonesOnMapChannel, kPathsChannel});
}

void View::take(const std::vector<LiveItem>& items) {
  for (const LiveItem& item : items) {
    if (const auto* live = std::get_if<LiveRecord>(&item)) {
      take_record(live->record);
    } else if (const auto* mark = std::get_if<SnapshotMark>(&item)) {
      if (mark->begins) clear();
    } else if (const auto* clock = std::get_if<RunClock>(&item)) {
      clock_ = *clock;
      changed_.insert(kClockChannel);
    } else if (const auto* fleet = std::get_if<FleetFrame>(&item)) {
      fleet_ = *fleet;
      changed_.insert({kTransformsChannel, kAircraftChannel});
      for (const VehicleView& view : fleet->vehicles)
        changed_.insert({location_of(view.id), state_of(view.id)});
    } else if (const auto* sample = std::get_if<MetricSample>(&item)) {
      happened_.push_back({kMetricsChannel, messages_.since_1970_ns(sample->time),
                           messages_.metrics(*sample)});
    }
  }
}

void View::take_record(const Record& record) {
  if (const auto* entity = std::get_if<EntityRecord>(&record)) {
    const bool is_new = names_.emplace(entity->id, entity->name).second;
    if (!is_new || entity->kind != "aircraft") return;
    const std::string topic = "/aircraft/" + entity->name;
    if (messages_.facts().frame)
      add_channel(location_of(entity->id), topic + "/location", "foxglove.LocationFix",
                  location_schema());
    add_channel(state_of(entity->id), topic + "/state", "skein.Aircraft",
                aircraft_schema());
  } else if (const auto* event = std::get_if<Event>(&record)) {
    const auto whose = names_.find(event->entity);
    happened_.push_back(
        {kLogChannel, messages_.since_1970_ns(event->time),
         messages_.log(*event, whose == names_.end() ? "" : whose->second)});
  } else if (const auto* boundary = std::get_if<PerimeterRecord>(&record)) {
    boundaries_[boundary->mission] = *boundary;
    changed_.insert({kBoundariesChannel, kBoundariesOnMapChannel});
  } else if (const auto* zone = std::get_if<ZoneRecord>(&record)) {
    if (zone->change.on)
      zones_[zone->change.zone.name] = zone->change.zone;
    else
      zones_.erase(zone->change.zone.name);
    changed_.insert({kZonesChannel, kZonesOnMapChannel});
  } else if (const auto* path = std::get_if<FlightPathRecord>(&record)) {
    paths_[path->id] = *path;
    changed_.insert(kPathsChannel);
  }
}

std::optional<View::Said> View::state(std::uint32_t channel) const {
  const Time time = clock_.time;
  const auto said = [&](std::string payload) -> std::optional<Said> {
    if (payload.empty()) return std::nullopt;
    return Said{channel, messages_.since_1970_ns(time), std::move(payload)};
  };
  switch (channel) {
    case kTransformsChannel:
      return said(messages_.transforms(fleet_, names_));
    case kAircraftChannel:
      return said(messages_.aircraft(fleet_, names_));
    case kBoundariesChannel:
      return said(messages_.boundaries(boundaries_, time));
    case kBoundariesOnMapChannel:
      return said(messages_.boundaries_on_map(boundaries_));
    case kZonesChannel:
      return said(messages_.zones(zones_, time));
    case kZonesOnMapChannel:
      return said(messages_.zones_on_map(zones_));
    case kPathsChannel:
      return said(messages_.paths(paths_, time));
    case kClockChannel:
      return said(messages_.clock(clock_));
    default:
      break;
  }
  if (channel < kFirstAircraftChannel) return std::nullopt;  // what happens
  const EntityId id{(channel - kFirstAircraftChannel) / 2};
  const auto view = std::find_if(fleet_.vehicles.begin(), fleet_.vehicles.end(),
                                 [id](const VehicleView& each) { return each.id == id; });
  if (view == fleet_.vehicles.end()) return std::nullopt;
  return said(channel == location_of(id) ? messages_.location(*view, fleet_.time)
                                         : messages_.state(*view, fleet_.time));
}

}  // namespace skein::hmi::foxglove
