// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/world/recorded_scenario.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "skein/geo/gdal/vector_files.h"
#include "skein/geo/vec.h"
#include "skein/scenario/utc.h"

namespace skein::assemble {
namespace {

namespace fs = std::filesystem;

// What holds the fire in a folder: a table, the vector files together, or a raster.
fs::path source_in(const fs::path& folder) {
  if (fs::exists(folder / "perimeters.csv")) return folder / "perimeters.csv";
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files)
    if (environment::is_vector_name(file)) return folder;
  for (const fs::path& file : files)
    if (geo::small_ending(file) == ".tif" && file.filename() != "elevation.tif")
      return file;
  return {};
}

// As a text of YAML in single quotes.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

// The circle of the first area.
double first_radius(const RecordedScenario& recorded) {
  return std::max(std::sqrt(recorded.fire.first_area / geo::kPi), 20.0);
}

std::string terrain_text(const RecordedScenario& recorded) {
  if (recorded.elevations.empty()) return "flat";
  const auto& fire = recorded.fire;
  const double reach = std::max({-fire.low.minCoeff(), fire.high.maxCoeff(), 500.0});
  return fmt::format("{{kind: raster, file: {}, outside: edge, area_m: {:.0f}}}",
                     quoted(recorded.elevations.string()), std::ceil(reach + 3000));
}

// Empty where scenarios cannot say it: they have dates from 1970 to 2200.
std::string start_text(const RecordedScenario& recorded) {
  const auto& start = recorded.fire.start_utc;
  if (!start) return {};
  const std::string text =
      scenario::utc_text(static_cast<std::int64_t>(std::floor(*start)));
  return scenario::parse_utc(text) ? text : std::string();
}

// Whole seconds, so that periods fit in; no more than a scenario may last.
double duration_of(const RecordedScenario& recorded) {
  return std::clamp(std::floor(recorded.fire.duration), 60.0, kMaxScenarioDuration);
}

// How a scenario says the order of dates.
struct OrderWord {
  environment::DateOrder order;
  std::string_view word;
};
constexpr OrderWord kOrders[] = {{environment::DateOrder::kMonthFirst, "month-first"},
                                 {environment::DateOrder::kDayFirst, "day-first"},
                                 {environment::DateOrder::kYearFirst, "year-first"}};

}  // namespace

Result<RecordedScenario> read_recorded_scenario(
    const fs::path& data, const environment::PerimeterFileOptions& file) {
  const fs::path whole = fs::absolute(data).lexically_normal();
  const bool folder = fs::is_directory(whole) && !environment::is_vector_name(whole);
  const fs::path source = folder ? source_in(whole) : whole;
  if (source.empty() || !fs::exists(source))
    return Error{ErrorCode::kNotFound, data.string(), "holds no recorded fire.",
                 "Needed: perimeters.csv, vector files with times, or an arrival-time "
                 "raster."};
  RecordedScenario recorded;
  recorded.source.path = source.string();
  recorded.source.file = file;
  auto found = environment::summarise_recorded_fire(recorded.source, recorded.warnings);
  if (!found) return found.error();
  recorded.fire = std::move(found).value();
  const fs::path beside = folder ? whole : source.parent_path();
  for (const fs::path& each :
       {beside / "landscape" / "elevation.tif", beside / "elevation.tif"})
    if (recorded.elevations.empty() && fs::exists(each)) recorded.elevations = each;
  return recorded;
}

std::vector<std::string> recorded_overrides(const RecordedScenario& recorded) {
  const environment::RecordedFireSummary& fire = recorded.fire;
  const double radius = first_radius(recorded);
  std::vector<std::string> overrides = {
      "environment.phenomena[0].source=" + recorded.source.path,
      fmt::format("origin.latitude_deg={:.6f}", fire.origin.latitude_deg),
      fmt::format("origin.longitude_deg={:.6f}", fire.origin.longitude_deg),
      fmt::format("duration_s={}", duration_of(recorded)),
      fmt::format("missions[0].prior.radius_m={:.0f}", radius),
      fmt::format("missions[0].prior.radius_sd_m={:.0f}", 0.4 * radius),
      fmt::format("aircraft[0].start.distance_m={:.0f}", 2 * radius + 600),
      "environment.terrain=" + terrain_text(recorded)};
  if (const std::string start = start_text(recorded); !start.empty())
    overrides.push_back("start_utc=" + start);
  return overrides;
}

std::optional<environment::DateOrder> date_order_named(std::string_view word) {
  for (const OrderWord& each : kOrders)
    if (each.word == word) return each.order;
  return std::nullopt;
}

std::string recorded_scenario_text(const RecordedScenario& recorded,
                                   const std::string& name) {
  const environment::RecordedFireSummary& fire = recorded.fire;
  const environment::PerimeterFileOptions& file = recorded.source.file;
  const double radius = first_radius(recorded);
  std::string text = fmt::format(
      "# A recorded fire of {:.1f} to {:.1f} ha as truth. Two aircraft are given "
      "roughly\n"
      "# where it is and how large, and neither wind, fuel nor rates.\n"
      "name: {}\n"
      "duration_s: {}\n"
      "origin: {{latitude_deg: {:.6f}, longitude_deg: {:.6f}}}\n",
      fire.first_area / 1e4, fire.last_area / 1e4, quoted(name), duration_of(recorded),
      fire.origin.latitude_deg, fire.origin.longitude_deg);
  if (fire.duration > kMaxScenarioDuration)
    text += fmt::format(
        "# The fire lasts {:.0f} s; a run lasts {:.0f} s at most. A later part: start_s "
        "of the\n# phenomenon below, with start_utc as much later.\n",
        fire.duration, kMaxScenarioDuration);
  if (const std::string start = start_text(recorded); !start.empty())
    text += fmt::format("start_utc: {}\n", start);
  text += fmt::format(
      "environment:\n"
      "  terrain: {}\n"
      "  phenomena:\n"
      "    - kind: recorded\n"
      "      source: {}\n",
      terrain_text(recorded), quoted(recorded.source.path));
  if (!file.time_field.empty())
    text += fmt::format("      time_field: {}\n", quoted(file.time_field));
  if (!file.incident.empty())
    text += fmt::format("      incident: {}\n", quoted(file.incident));
  if (file.utc_offset_h != 0)
    text += fmt::format("      utc_offset_h: {}\n", file.utc_offset_h);
  for (const auto& [order, word] : kOrders)
    if (file.date_order == order) text += fmt::format("      date_order: {}\n", word);
  text += fmt::format(
      "aircraft:\n"
      "  - name: scout\n"
      "    count: 2\n"
      "    start: {{placement: opposite, distance_m: {:.0f}}}\n"
      "    altitude_agl_m: 200\n"
      "missions:\n"
      "  - kind: perimeter\n"
      "    prior: {{radius_m: {:.0f}, radius_sd_m: {:.0f}, rate_mps: 0.1, rate_sd_mps: "
      "0.1, wind_sd_mps: 0.1}}\n",
      2 * radius + 600, radius, 0.4 * radius);
  return text;
}

}  // namespace skein::assemble
