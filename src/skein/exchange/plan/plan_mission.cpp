// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "skein/exchange/plan/mission.h"
#include "skein/exchange/table/writers.h"

namespace skein::exchange {
namespace {

using Json = nlohmann::ordered_json;

// A fence has no altitudes and no times: a zone that has would forbid more than it does.
bool is_fence(const Zone& zone) {
  return std::isinf(zone.floor_msl) && std::isinf(zone.ceiling_msl) &&
         std::isinf(zone.from) && std::isinf(zone.until);
}

Json fence(const Document& document) {
  const auto place = [&](const Vec2& p) {
    const geo::Geodetic at = document.frame->from_plane(p);
    return Json::array({at.latitude_deg, at.longitude_deg});
  };
  Json circles = Json::array(), polygons = Json::array();
  for (const Zone& zone : document.zones) {
    if (!is_fence(zone)) continue;
    if (const auto* disc = std::get_if<Disc>(&zone.area)) {
      Json circle = {{"center", place(disc->centre)}, {"radius", disc->radius}};
      circles.push_back({{"circle", circle}, {"inclusion", false}, {"version", 1}});
    } else {
      Json corners = Json::array();
      for (const Vec2& p : std::get<geo::Ring>(zone.area)) corners.push_back(place(p));
      polygons.push_back({{"inclusion", false}, {"polygon", corners}, {"version", 1}});
    }
  }
  return {{"circles", circles}, {"polygons", polygons}, {"version", 2}};
}

Json simple_item(const MissionItem& item, std::size_t number) {
  constexpr int kAboveSeaLevel = 2;  // the ground station's number of that altitude mode
  const bool place = item.command == 16;
  Json is = {{"type", "SimpleItem"},
             {"autoContinue", true},
             {"command", item.command},
             {"doJumpId", number},
             {"frame", item.frame}};
  Json params = Json::array();
  for (const double p : item.params) params.push_back(p);
  if (place) params[3] = nullptr;  // the yaw is the autopilot's own matter
  for (const double p : {item.latitude_deg, item.longitude_deg, item.altitude_m})
    params.push_back(p);
  is["params"] = std::move(params);
  if (place) {
    is["AMSLAltAboveTerrain"] = nullptr;
    is["Altitude"] = item.altitude_m;
    is["AltitudeMode"] = kAboveSeaLevel;
  }
  return is;
}

// The first waypoint, which stands for the place of take-off.
const MissionItem& home_of(const std::vector<MissionItem>& items) {
  for (const MissionItem& item : items)
    if (item.command == 16) return item;
  return items.front();
}

}  // namespace

Result<std::string> to_qgc_plan(const Document& document, const WritingOptions& options) {
  const auto items = to_mission(document, options);
  if (!items) return items.error();
  const MissionItem& home = home_of(items.value());
  Json list = Json::array();
  for (const MissionItem& item : items.value())
    list.push_back(simple_item(item, list.size() + 1));
  const double airspeed = document.plans[0].plan.front().airspeed;
  // Numbers of the autopilot and the vehicle: generic, fixed wing.
  Json mission = {
      {"cruiseSpeed", airspeed},
      {"firmwareType", 0},
      {"globalPlanAltitudeMode", 2},
      {"hoverSpeed", airspeed},
      {"items", list},
      {"plannedHomePosition", {home.latitude_deg, home.longitude_deg, home.altitude_m}},
      {"vehicleType", 1},
      {"version", 2}};
  const Json file = {{"fileType", "Plan"},
                     {"geoFence", fence(document)},
                     {"groundStation", "QGroundControl"},
                     {"mission", mission},
                     {"rallyPoints", {{"points", Json::array()}, {"version", 2}}},
                     {"version", 1}};
  return file.dump(4) + "\n";
}

Result<std::string> to_waypoints(const Document& document,
                                 const WritingOptions& options) {
  const auto items = to_mission(document, options);
  if (!items) return items.error();
  std::string text = "QGC WPL 110\n";
  const auto row = [&](std::size_t index, bool current, const MissionItem& item) {
    fmt::format_to(std::back_inserter(text), "{}\t{}\t{}\t{}", index, current ? 1 : 0,
                   item.frame, item.command);
    for (const double p : item.params)
      fmt::format_to(std::back_inserter(text), "\t{}", p);
    fmt::format_to(std::back_inserter(text), "\t{}\t{}\t{}\t1\n", item.latitude_deg,
                   item.longitude_deg, item.altitude_m);
  };
  // Row 0 is home, which autopilots replace by their own.
  row(0, true, home_of(items.value()));
  std::size_t index = 1;
  for (const MissionItem& item : items.value()) row(index++, false, item);
  return text;
}

}  // namespace skein::exchange
