#include "skein/layer/hmi/serve/foxglove/view.h"

#include <algorithm>
#include <utility>

#include "skein/layer/hmi/serve/foxglove/schemas.h"

namespace skein::hmi::foxglove {
namespace {

// Channels of the whole run; those of aircraft follow.
enum : std::uint32_t {
  kTransforms = 1,
  kAircraft,
  kBoundaries,
  kBoundariesOnMap,
  kZones,
  kZonesOnMap,
  kPaths,
  kClock,
  kMetrics,
  kLog,
  kFirstOfAircraft = 16
};

// Two channels each.
std::uint32_t location_of(EntityId id) {
  return kFirstOfAircraft + 2 * id.value;
}
std::uint32_t state_of(EntityId id) {
  return location_of(id) + 1;
}

}  // namespace

View::View(Facts facts) : messages_(std::move(facts)) {
  const bool has_map = messages_.facts().frame.has_value();
  add_channel(kTransforms, "/tf", "foxglove.FrameTransforms", transforms_schema());
  add_channel(kAircraft, "/aircraft", "foxglove.SceneUpdate", scene_schema());
  add_channel(kBoundaries, "/perimeter", "foxglove.SceneUpdate", scene_schema());
  add_channel(kZones, "/zones", "foxglove.SceneUpdate", scene_schema());
  add_channel(kPaths, "/plans", "foxglove.SceneUpdate", scene_schema());
  if (has_map) {
    add_channel(kBoundariesOnMap, "/perimeter/map", "foxglove.GeoJSON", geojson_schema());
    add_channel(kZonesOnMap, "/zones/map", "foxglove.GeoJSON", geojson_schema());
  }
  add_channel(kClock, "/clock", "skein.RunClock", clock_schema());
  add_channel(kMetrics, "/metrics", "skein.Metrics", metrics_schema());
  add_channel(kLog, "/log", "foxglove.Log", log_schema());
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
  changed_.insert({kBoundaries, kBoundariesOnMap, kZones, kZonesOnMap, kPaths});
}

void View::take(const std::vector<LiveItem>& items) {
  for (const LiveItem& item : items) {
    if (const auto* live = std::get_if<LiveRecord>(&item)) {
      take(*live);
    } else if (const auto* mark = std::get_if<SnapshotMark>(&item)) {
      if (mark->begins) clear();
    } else if (const auto* clock = std::get_if<RunClock>(&item)) {
      clock_ = *clock;
      changed_.insert(kClock);
    } else if (const auto* fleet = std::get_if<FleetFrame>(&item)) {
      fleet_ = *fleet;
      changed_.insert({kTransforms, kAircraft});
      for (const VehicleView& view : fleet->vehicles)
        changed_.insert({location_of(view.id), state_of(view.id)});
    } else if (const auto* sample = std::get_if<MetricSample>(&item)) {
      happened_.push_back(
          {kMetrics, messages_.since_1970_ns(sample->time), messages_.metrics(*sample)});
    }
  }
}

void View::take(const LiveRecord& live) {
  if (const auto* entity = std::get_if<EntityRecord>(&live.record)) {
    const bool is_new = names_.emplace(entity->id, entity->name).second;
    if (!is_new || entity->kind != "aircraft") return;
    const std::string topic = "/aircraft/" + entity->name;
    if (messages_.facts().frame)
      add_channel(location_of(entity->id), topic + "/location", "foxglove.LocationFix",
                  location_schema());
    add_channel(state_of(entity->id), topic + "/state", "skein.Aircraft",
                aircraft_schema());
  } else if (const auto* event = std::get_if<Event>(&live.record)) {
    const auto whose = names_.find(event->entity);
    happened_.push_back(
        {kLog, messages_.since_1970_ns(event->time),
         messages_.log(*event, whose == names_.end() ? "" : whose->second)});
  } else if (const auto* boundary = std::get_if<PerimeterRecord>(&live.record)) {
    boundaries_[boundary->mission] = *boundary;
    changed_.insert({kBoundaries, kBoundariesOnMap});
  } else if (const auto* zone = std::get_if<ZoneRecord>(&live.record)) {
    if (zone->change.on)
      zones_[zone->change.zone.name] = zone->change.zone;
    else
      zones_.erase(zone->change.zone.name);
    changed_.insert({kZones, kZonesOnMap});
  } else if (const auto* path = std::get_if<FlightPathRecord>(&live.record)) {
    paths_[path->id] = *path;
    changed_.insert(kPaths);
  }
}

std::optional<View::Said> View::state(std::uint32_t channel) const {
  const Time time = clock_.time;
  const auto said = [&](std::string payload) -> std::optional<Said> {
    if (payload.empty()) return std::nullopt;
    return Said{channel, messages_.since_1970_ns(time), std::move(payload)};
  };
  switch (channel) {
    case kTransforms:
      return said(messages_.transforms(fleet_, names_));
    case kAircraft:
      return said(messages_.aircraft(fleet_, names_));
    case kBoundaries:
      return said(messages_.boundaries(boundaries_, time));
    case kBoundariesOnMap:
      return said(messages_.boundaries_on_map(boundaries_));
    case kZones:
      return said(messages_.zones(zones_, time));
    case kZonesOnMap:
      return said(messages_.zones_on_map(zones_));
    case kPaths:
      return said(messages_.paths(paths_, time));
    case kClock:
      return said(messages_.clock(clock_));
    default:
      break;
  }
  if (channel < kFirstOfAircraft) return std::nullopt;  // what happens
  const EntityId id{(channel - kFirstOfAircraft) / 2};
  const auto view = std::find_if(fleet_.vehicles.begin(), fleet_.vehicles.end(),
                                 [id](const VehicleView& each) { return each.id == id; });
  if (view == fleet_.vehicles.end()) return std::nullopt;
  return said(channel == location_of(id) ? messages_.location(*view, fleet_.time)
                                         : messages_.state(*view, fleet_.time));
}

}  // namespace skein::hmi::foxglove
