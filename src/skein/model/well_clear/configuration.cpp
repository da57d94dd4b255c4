// SPDX-License-Identifier: Apache-2.0
#include "skein/model/well_clear/configuration.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "skein/geo/vec.h"

namespace skein::model {
namespace {

constexpr auto kRegionNames = names_of(static_cast<const AlertRegion*>(nullptr));

constexpr double kFoot = 0.3048, kKnot = 1852.0 / 3600, kNauticalMile = 1852;

// The well-clear volume of a level and when it alerts.
AlertLevel level(AlertRegion region, double alerting, double early, double d, double z,
                 double tau) {
  return {region, alerting, early, {d, z, tau, 0}};
}

WellClearConfiguration do_365b_no_sum() {
  constexpr auto kNone = AlertRegion::kNone, kMid = AlertRegion::kMid,
                 kNear = AlertRegion::kNear;
  WellClearConfiguration c{};
  c.name = "DO_365B_no_SUM";
  c.lookahead = 180;
  c.track = {geo::radians(1), geo::radians(3)};
  c.speed = {5 * kKnot, 2, 10 * kKnot, 700 * kKnot};
  c.vertical_speed = {100 * kFoot / 60, 0.25 * 9.80665, -6000 * kFoot / 60,
                      6000 * kFoot / 60};
  c.altitude = {100 * kFoot, 500 * kFoot / 60, 0.25 * 9.80665, 100 * kFoot,
                50000 * kFoot};
  c.recovery = {0.66 * kNauticalMile, 450 * kFoot, 3, 0.1, 500 * kFoot, 100 * kFoot};
  c.corrective = kMid;
  c.min_airspeed = 10 * kKnot;
  c.hysteresis = {5, 4, 2, 4};
  const double d1 = 0.66 * kNauticalMile, d2 = 1500 * kFoot, d3 = 2200 * kFoot;
  const double high = 700 * kFoot, low = 450 * kFoot;
  c.alerters = {{"1",
                 {level(kNone, 55, 75, d1, high, 35), level(kMid, 55, 75, d1, low, 35),
                  level(kNear, 25, 55, d1, low, 35)}},
                {"2",
                 {level(kNone, 45, 75, d2, low, 0), level(kMid, 45, 75, d2, low, 0),
                  level(kNear, 45, 75, d2, low, 0)}},
                {"3",
                 {level(kNone, 55, 110, d3, low, 0), level(kMid, 55, 110, d3, low, 0),
                  level(kNear, 25, 90, d3, low, 0)}}};
  return c;
}

WellClearConfiguration skein_suas() {
  constexpr auto kNone = AlertRegion::kNone, kMid = AlertRegion::kMid,
                 kNear = AlertRegion::kNear;
  WellClearConfiguration c{};
  c.name = "skein_suas";
  c.lookahead = 90;
  c.track = {geo::radians(1), geo::radians(12)};
  c.speed = {0.5, 1, 10, 40};
  c.vertical_speed = {0.25, 1, -4, 4};
  c.altitude = {10, 3, 1, 30, 1500};
  c.recovery = {1000 * kFoot, 150 * kFoot, 3, 0.1, 500 * kFoot, 100 * kFoot};
  c.corrective = kMid;
  c.min_airspeed = 10;
  c.hysteresis = {5, 4, 2, 4};
  const double d = 2000 * kFoot;
  c.alerters = {
      {"1",
       {level(kNone, 45, 60, d, 400 * kFoot, 0), level(kMid, 45, 60, d, 250 * kFoot, 0),
        level(kNear, 20, 35, d, 250 * kFoot, 0)}}};
  return c;
}

}  // namespace

std::optional<AlertRegion> alert_region_named(std::string_view name) {
  for (std::size_t i = 0; i < kRegionNames.size(); ++i)
    if (kRegionNames[i] == name) return static_cast<AlertRegion>(i);
  return std::nullopt;
}

std::optional<std::size_t> alerter_named(const WellClearConfiguration& configuration,
                                         std::string_view name) {
  for (std::size_t i = 0; i < configuration.alerters.size(); ++i)
    if (configuration.alerters[i].name == name) return i;
  return std::nullopt;
}

std::optional<WellClearConfiguration> well_clear_configuration(std::string_view name) {
  for (auto* make : {do_365b_no_sum, skein_suas})
    if (WellClearConfiguration made = make(); made.name == name) return made;
  return std::nullopt;
}

std::string well_clear_configuration_names() {
  return "DO_365B_no_SUM, skein_suas";
}

}  // namespace skein::model
