// SPDX-License-Identifier: Apache-2.0
// Terrains, winds and fires: one row each.

#include <fmt/format.h>

#include "skein/assemble/kinds/kinds_of.h"
#include "skein/assemble/kinds/ranges.h"
#include "skein/layer/environment/fire/front_fire.h"
#include "skein/layer/environment/fire/thesis_fire.h"
#include "skein/layer/environment/recorded/recorded_fire.h"
#include "skein/layer/environment/terrain/raster_terrain.h"
#include "skein/layer/environment/terrain/synthetic_terrain.h"
#include "skein/layer/environment/wind/gridded_wind.h"
#include "skein/layer/environment/wind/series_wind.h"
#include "skein/layer/environment/wind/uniform_wind.h"

namespace skein::assemble {
namespace {

using namespace environment;
using scenario::Fields;
using scenario::Range;
using scenario::RuleViolation;

constexpr Range kLength{.above = 0, .at_most = 1e6};
constexpr Range kHeight{.at_least = -500, .at_most = 9000};
constexpr Range kBearing{.at_least = -360, .at_most = 360};
constexpr Range kPlace{.at_least = -7e5, .at_most = 7e5};  // within 1000 km

// Where warnings go; nowhere, if nobody asks for them.
std::vector<std::string>& warnings_of(const EnvironmentContext& context) {
  static thread_local std::vector<std::string> unasked;
  unasked.clear();
  return context.warnings != nullptr ? *context.warnings : unasked;
}

Fields<FlatTerrainOptions> flat_fields() {
  using T = FlatTerrainOptions;
  return Fields<T>().number("elevation_m", &T::elevation, "Above mean sea level.",
                            kHeight);
}

Fields<HillTerrainOptions> hill_fields() {
  using T = HillTerrainOptions;
  return Fields<T>()
      .number("elevation_m", &T::elevation, "Of the plain, above mean sea level.",
              kHeight)
      .number("height_m", &T::height, "Of the top above the plain; negative: a hollow.",
              {.at_least = -5000, .at_most = 5000})
      .number("width_m", &T::width, "From the top to where it is steepest.", kLength)
      .point("centre_m", &T::centre, "Of the top.");
}

Fields<CanyonTerrainOptions> canyon_fields() {
  using T = CanyonTerrainOptions;
  return Fields<T>()
      .number("floor_m", &T::floor, "Of the river at the origin, above mean sea level.",
              kHeight)
      .number("depth_m", &T::depth, "From the river to the plateau.", kNotNegative)
      .number("width_m", &T::width, "From the river to where the walls are steepest.",
              kLength)
      .angle_deg("bearing_deg", &T::bearing, "Towards where the river flows.", kBearing)
      .number("fall", &T::fall, "Of the river, per metre of its course.",
              {.at_least = -0.5, .at_most = 0.5})
      .number("meander_m", &T::meander, "Of the river to either side.", kNotNegative)
      .number("meander_length_m", &T::meander_length, "Between two bends to one side.",
              kLength)
      .number("ridge_m", &T::ridge, "Of the side ridges above the ravines.", kNotNegative)
      .number("ridge_spacing_m", &T::ridge_spacing, "Between two ridges on one side.",
              kLength);
}

Fields<RasterTerrainOptions> raster_fields() {
  using T = RasterTerrainOptions;
  return Fields<T>()
      .file("file", &T::file,
            "A raster of elevations; docs/environment.md has the formats.")
      .required()
      .integer("band", &T::band, "Band, when no name is given.",
               {.at_least = 1, .at_most = 10000})
      .text("band_name", &T::band_name, "Name of the band.")
      .text(
          "unit", &T::unit,
          "Unit of the elevations (m, ft, us-ft); empty: as the file says, metres where "
          "it says none.")
      .word("outside", &T::outside, "What holds where the file has no data.",
            {{"error", Outside::kError, "loading fails"},
             {"edge", Outside::kEdge, "the nearest value goes on"}})
      .number("area_m", &T::area, "Half the side of the square about the origin.",
              kLength)
      .number("spacing_m", &T::spacing, "Of the nodes kept in memory; 0: a pixel's size.",
              kNotNegative);
}

Fields<UniformWindOptions> uniform_fields() {
  using T = UniformWindOptions;
  return Fields<T>()
      .number("speed_mps", &T::speed, "Speed.", {.at_least = 0, .at_most = 150})
      .angle_deg("from_deg", &T::from, "Bearing it comes from.", kBearing);
}

Fields<SeriesWindOptions> series_fields() {
  using T = SeriesWindOptions;
  return Fields<T>()
      .file("file", &T::file,
            "CSV: t_s and either speed_mps, from_deg or north_mps, east_mps.")
      .required();
}

Fields<GriddedWindOptions> gridded_fields() {
  using T = GriddedWindOptions;
  return Fields<T>()
      .file("file", &T::file, "A raster; docs/environment.md has the formats.")
      .required()
      .file("second_file", &T::second_file,
            "Of the second quantity; empty: the same file.", {.may_be_empty = true})
      .word("holds", &T::kind, "What the two rasters hold.",
            {{"speed-and-from", WindKind::kSpeedAndFrom, "speed and direction-from"},
             {"components", WindKind::kComponents, "velocity to east and to north"}})
      .text("first", &T::first, "Name of the speed, or of the component to east.")
      .text("second", &T::second, "Name of the direction, or of the component to north.")
      .word("north", &T::north, "What directions or components refer to.",
            {{"auto", WindNorth::kAuto, "as the file says"},
             {"true", WindNorth::kTrue, "the meridian"},
             {"grid", WindNorth::kGrid, "the raster's own second axis"}})
      .text(
          "unit", &T::unit,
          "Unit of speeds and components (m/s, km/h, kt, mph); empty: as the file says, "
          "refused where it says none.")
      .duration_s("times_s", &T::times,
                  "Times of the bands, for files that do not say them.")
      .number("height_m", &T::height,
              "Use only the level nearest to this height. Null: all.", kNotNegative)
      .number("ground_msl_m", &T::ground_msl, "From where the levels' heights count.",
              kHeight)
      .number("area_m", &T::area, "Half the side of the square about the origin.",
              kLength)
      .number("spacing_m", &T::spacing,
              "Of the nodes kept in memory; 0: a quarter of a pixel.", kNotNegative)
      .boolean("extend", &T::extend, "Beyond the data the nearest values go on.");
}

std::vector<RuleViolation> thesis_errors(const ThesisFireOptions& o,
                                         const scenario::ValidValues& valid) {
  std::vector<RuleViolation> errors;
  if (valid("displacement_m", "displacement_harmonics", "start_radius_m") &&
      o.displacement_harmonics > 0 && !(o.displacement < o.start_radius))
    errors.push_back({"displacement_m",
                      fmt::format("{:.6g} must be below start_radius_m, {:.6g}.",
                                  o.displacement, o.start_radius),
                      {"start_radius_m", "displacement_harmonics"}});
  if (!valid("rate_mps", "rate_error_mps")) return errors;
  if (o.rate_error > o.rate)
    errors.push_back(
        {"rate_error_mps",
         fmt::format("{:.6g} must be at most rate_mps, {:.6g}.", o.rate_error, o.rate),
         {"rate_mps"}});
  const double min = o.rate - o.rate_error;
  if (valid("wind_mps") && min >= 0 && o.wind.norm() > 0 && o.wind.norm() >= min)
    errors.push_back(
        {"wind_mps",
         fmt::format(
             "a drift of {:.6g} m/s must be below the minimum spread, {:.6g} m/s "
             "(rate_mps - rate_error_mps): a stronger one drives the boundary over "
             "its own origin.",
             o.wind.norm(), min),
         {"rate_mps", "rate_error_mps"}});
  return errors;
}

Fields<ThesisFireOptions> thesis_fields() {
  using T = ThesisFireOptions;
  return Fields<T>()
      .point("origin_m", &T::origin, "Where bearings are taken from.", kPlace)
      .integer("points", &T::points, "Of the boundary at the start; the thesis has 60.",
               {.at_least = 8, .at_most = 100000})
      .number("start_radius_m", &T::start_radius, "Radius at the start.",
              {.above = 0, .below = 1e6})
      .number("displacement_m", &T::displacement,
              "Largest departure of the start from that circle.", kNotNegative)
      .integer("displacement_harmonics", &T::displacement_harmonics,
               "Harmonics of that departure over bearing; 0: none.",
               {.at_least = 0, .at_most = 180})
      .number("rate_mps", &T::rate, "Rate of spread.", {.at_least = 0, .at_most = 50})
      .number("rate_error_mps", &T::rate_error, "Largest departure from that rate.",
              {.at_least = 0, .at_most = 50})
      .integer("rate_harmonics", &T::rate_harmonics,
               "Harmonics of that departure over bearing; 0: none.",
               {.at_least = 0, .at_most = 180})
      .integer("rate_sectors", &T::rate_sectors,
               "Above 0: a random rate for each of so many equal sectors instead.",
               {.at_least = 0, .at_most = 3600})
      .number("harmonic_decay", &T::harmonic_decay,
              "Sizes of harmonics fall as order^-decay.", {.at_least = 0, .at_most = 10})
      .vector("wind_mps", &T::wind,
              "Drift of every boundary point, towards where it moves.",
              {.at_least = -50, .at_most = 50})
      .number("slope_weight", &T::slope_weight,
              "Effect of slope: 1 makes 30 % of rise 30 % of rate.",
              {.at_least = -1, .at_most = 1})
      .duration_s("step_s", &T::step, "Longest step of the integration.",
                  {.at_least = 0.01, .at_most = 60})
      .boolean("respace", &T::respace, "Add points where they have drawn apart.")
      .rules_of_valid(thesis_errors);
}

/// A front-tracked fire and the fuel that it burns.
struct FrontFireKind {
  FrontFireOptions fire;
  PatchyFuelOptions fuel;
};

Fields<Ignition> ignition_fields() {
  using T = Ignition;
  return Fields<T>()
      .point("point_m", &T::point, "Where.", kPlace)
      .number("radius_m", &T::radius, "What burns at once.", {.above = 0, .at_most = 1e5})
      .duration_s("delay_s", &T::delay, "After the fire's beginning.");
}

Fields<PatchyFuelOptions> fuel_fields() {
  using T = PatchyFuelOptions;
  return Fields<T>()
      .number("patch_m", &T::patch_size, "Distance over which the fuel changes.",
              {.at_least = 1, .at_most = 1e6})
      .number("variation", &T::variation,
              "Standard deviation of the logarithm of the rate's factor; 0: even fuel.",
              {.at_least = 0, .at_most = 1})
      .number("unburnable_share", &T::unburnable_share,
              "Of the area, in patches that do not burn.",
              {.at_least = 0, .at_most = 0.5});
}

std::vector<RuleViolation> front_errors(const FrontFireKind& o,
                                        const scenario::ValidValues& valid) {
  std::vector<RuleViolation> errors;
  if (!valid("marker_spacing_m")) return errors;
  // Below that the markers of a circle would fall together.
  const double min = 0.1 * o.fire.front.spacing;
  for (std::size_t i = 0; i < o.fire.ignitions.size(); ++i) {
    const std::string key = fmt::format("ignitions[{}].radius_m", i);
    if (valid(key) && !(o.fire.ignitions[i].radius >= min))
      errors.push_back({key,
                        fmt::format("{:.6g} must be at least a tenth of "
                                    "marker_spacing_m, {:.6g}.",
                                    o.fire.ignitions[i].radius, min),
                        {"marker_spacing_m"}});
  }
  return errors;
}

Fields<FrontFireKind> front_fields() {
  using T = FrontFireKind;
  return Fields<T>()
      .object(
          "ignitions", [](T & t) -> auto& { return t.fire.ignitions; }, ignition_fields(),
          "Where the fire starts.")
      .items({.at_least = 1, .at_most = 10000})
      .duration_s("age_s", [](T & t) -> auto& { return t.fire.age; },
                  "Age of the fire at the run's start.",
                  {.at_least = 0, .at_most = 30 * 86400})
      .number("rate_mps", [](T & t) -> auto& { return t.fire.spread.rate; },
              "Rate over level ground, in still air, with fuel factor 1.",
              {.at_least = 0, .at_most = 20})
      .number("wind_reduction",
              [](T & t) -> auto& { return t.fire.spread.wind_reduction; },
              "Wind at the flames over wind of the field.", {.at_least = 0, .at_most = 1})
      .number("wind_response", [](T & t) -> auto& { return t.fire.spread.wind_response; },
              "Gain of the head rate per wind at the flames, in s/m.",
              {.above = 0, .at_most = 100})
      .angle_deg("slope_doubling_deg",
                 [](T & t) -> auto& { return t.fire.spread.slope_doubling; },
                 "Slope that doubles the rate; 0: no effect.",
                 {.at_least = 0, .below = 90})
      .number("wind_height_m", [](T & t) -> auto& { return t.fire.wind_height; },
              "Above ground, where the wind is asked for.",
              {.at_least = 0, .at_most = 1000})
      .integer("max_markers", [](T & t) -> auto& { return t.fire.front.max_markers; },
               "Above this the marker spacing doubles.",
               {.at_least = 100, .at_most = 10000000})
      .number("marker_spacing_m", [](T & t) -> auto& { return t.fire.front.spacing; },
              "Between neighbouring markers of the front.",
              {.at_least = 0.1, .at_most = 1000})
      .object(
          "fuel", [](T & t) -> auto& { return t.fuel; }, fuel_fields(),
          "Smooth random patches of fuel.")
      .rules_of_valid(front_errors);
}

Fields<RecordedFireOptions> recorded_fields() {
  using T = RecordedFireOptions;
  return Fields<T>()
      .file("source", &T::path,
            "Dated perimeters (a table of files, or one file with times) or an "
            "arrival-time raster.")
      .required()
      .word("holds", &T::kind, "What the source holds.",
            {{"auto", RecordedKind::kAuto, "a raster is arrival times, else perimeters"},
             {"perimeters", RecordedKind::kPerimeters, "dated perimeters"},
             {"arrival", RecordedKind::kArrival, "a raster of arrival times"}})
      .text(
          "time_field", [](T & t) -> auto& { return t.file.time_field; },
          "Attribute or column with the time; empty: it is looked for.")
      .text(
          "incident", [](T & t) -> auto& { return t.file.incident; },
          "Name of the fire, of those that the source holds.")
      .number("utc_offset_h", [](T & t) -> auto& { return t.file.utc_offset_h; },
              "Local time minus UTC, of times without a zone.",
              {.at_least = -14, .at_most = 14})
      .word("date_order", [](T & t) -> auto& { return t.file.date_order; },
            "What stands first in dates such as 5/9/2021. Null: as the dates show.",
            {{"month-first", DateOrder::kMonthFirst, "9/5/2021 is the 5th of September"},
             {"day-first", DateOrder::kDayFirst, "5/9/2021 is"},
             {"year-first", DateOrder::kYearFirst, "21/9/5 is"}})
      .duration_s("start_s", &T::start,
                  "The run starts this long after the first perimeter.")
      .number("spacing_m", &T::spacing,
              "Of the grid in memory; 0: about 200,000 nodes, no finer than 5 m.",
              kNotNegative)
      .integer("arrival_band", &T::arrival_band, "Band of the arrival-time raster.",
               {.at_least = 1, .at_most = 10000})
      .number("arrival_unit_s", &T::arrival_unit,
              "Unit of the raster's times. Null: as the file says, seconds where it says "
              "none.",
              {.above = 0, .at_most = 1e6});
}

}  // namespace

Kinds<Terrain, EnvironmentContext> terrain_kinds() {
  Kinds<Terrain, EnvironmentContext> kinds("terrain");
  kinds.add("flat", "Level ground.", flat_fields(),
            [](const FlatTerrainOptions& o, const EnvironmentContext&) {
              return std::make_unique<FlatTerrain>(o);
            });
  kinds.add("hill", "One hill on a plain.", hill_fields(),
            [](const HillTerrainOptions& o, const EnvironmentContext&) {
              return std::make_unique<HillTerrain>(o);
            });
  kinds.add("canyon", "A winding river canyon with side ridges.", canyon_fields(),
            [](const CanyonTerrainOptions& o, const EnvironmentContext&) {
              return std::make_unique<CanyonTerrain>(o);
            });
  kinds.add("raster", "An elevation raster, reprojected into the local frame.",
            raster_fields(),
            [](const RasterTerrainOptions& o, const EnvironmentContext& c) {
              return make_raster_terrain(o, c.frame, warnings_of(c));
            });
  return kinds;
}

Kinds<WindField, EnvironmentContext> wind_kinds() {
  Kinds<WindField, EnvironmentContext> kinds("wind");
  kinds.add("uniform", "The same wind everywhere and always.", uniform_fields(),
            [](const UniformWindOptions& o, const EnvironmentContext&) {
              return std::make_unique<UniformWind>(o);
            });
  kinds.add("series", "A wind that changes with time, from a table.", series_fields(),
            [](const SeriesWindOptions& o, const EnvironmentContext&) {
              return make_series_wind(o);
            });
  kinds.add("grid", "A wind on a grid in space and time (NetCDF, GRIB, GeoTIFF).",
            gridded_fields(),
            [](const GriddedWindOptions& o, const EnvironmentContext& c) {
              GriddedWindOptions all = o;
              all.start_utc = c.start_utc;
              return make_gridded_wind(all, c.frame, warnings_of(c));
            });
  return kinds;
}

Kinds<Phenomenon, EnvironmentContext> phenomenon_kinds() {
  using Made = Result<std::unique_ptr<Phenomenon>>;
  Kinds<Phenomenon, EnvironmentContext> kinds("phenomenon");
  kinds.add(
      "front", "A front that spreads by fuel, wind and slope; merges, leaves islands.",
      front_fields(), [](const FrontFireKind& o, const EnvironmentContext& c) -> Made {
        if (const auto good = check(o.fire); !good) return good.error();
        if (const auto good = check(o.fuel); !good) return good.error();
        return std::unique_ptr<Phenomenon>(std::make_unique<FrontFire>(
            o.fire, *c.terrain, *c.wind, std::make_shared<PatchyFuel>(o.fuel, c.seed)));
      });
  kinds.add("thesis", "The thesis's fire: points run from the origin, and with the wind.",
            thesis_fields(),
            [](const ThesisFireOptions& o, const EnvironmentContext& c) -> Made {
              if (const auto good = check(o); !good) return good.error();
              return std::unique_ptr<Phenomenon>(
                  std::make_unique<ThesisFire>(o, c.seed, *c.terrain));
            });
  kinds.add("recorded", "A real fire: dated perimeters, or an arrival-time raster.",
            recorded_fields(),
            [](const RecordedFireOptions& o, const EnvironmentContext& c) {
              return make_recorded_fire(o, c.frame, *c.warnings);
            });
  return kinds;
}

}  // namespace skein::assemble
