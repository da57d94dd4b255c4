// SPDX-License-Identifier: Apache-2.0
// Recorded fires in the files that agencies publish: what they hold, and a scenario of
// it.
#include <fmt/format.h>

#include <cmath>

#include "app/common/commands.h"
#include "app/common/common.h"
#include "app/common/output.h"
#include "skein/assemble/world/recorded_scenario.h"
#include "skein/base/output_file.h"
#include "skein/exchange/gis/gis_writing.h"
#include "skein/scenario/utc.h"

namespace skein::app {
namespace {

using environment::Perimeter;
using environment::RecordedFireSummary;

std::optional<environment::DateOrder> order_of(const std::string& word) {
  if (word.empty()) return std::nullopt;
  return assemble::date_order_named(word);
}

std::string utc_of(const RecordedFireSummary& fire, double time) {
  if (!fire.start_utc) return "";
  return scenario::utc_text(
      static_cast<std::int64_t>(std::floor(*fire.start_utc + time)));
}

void print_fire(const RecordedFireSummary& fire) {
  if (fire.series.empty()) {
    print("Arrival times over {:.1f} h, {:.1f} to {:.1f} ha.\n", fire.duration / 3600,
          fire.first_area / 1e4, fire.last_area / 1e4);
  } else {
    print("{:>3} {:>9} {:>10} {:>6}  {}\n", "no", "hours", "area [ha]", "parts",
          fire.start_utc ? "UTC" : "");
    int number = 0;
    for (const Perimeter& perimeter : fire.series) {
      int parts = 0;
      for (const geo::Ring& ring : perimeter.region) parts += geo::area({ring}) > 0;
      print("{:>3} {:>9.2f} {:>10.1f} {:>6}  {}\n", number++, perimeter.time / 3600,
            geo::area(perimeter.region) / 1e4, parts, utc_of(fire, perimeter.time));
    }
  }
  const Vec2 size = fire.high - fire.low;
  print(
      "Centre {:.5f}, {:.5f}; {:.2f} km from south to north, {:.2f} km from west to "
      "east.\n",
      fire.origin.latitude_deg, fire.origin.longitude_deg, size.x() / 1000,
      size.y() / 1000);
}

Result<void> write_perimeters(const RecordedFireSummary& fire,
                              const std::filesystem::path& file) {
  if (fire.series.empty())
    return Error{ErrorCode::kBadInput, file.string(),
                 "an arrival-time raster has no perimeters to write.", ""};
  const auto frame = geo::LocalFrame::at(fire.origin);
  if (!frame) return frame.error();
  std::vector<exchange::GisFeature> features;
  for (const Perimeter& perimeter : fire.series)
    features.push_back({exchange::GisFeature::Kind::kArea,
                        perimeter.region,
                        {{"time_utc", utc_of(fire, perimeter.time)},
                         {"time_s", perimeter.time},
                         {"area_ha", geo::area(perimeter.region) / 1e4}}});
  return exchange::write_gis(features, "perimeters", frame.value(), file);
}

Result<void> write_scenario(const assemble::RecordedScenario& recorded,
                            const std::filesystem::path& file) {
  return write_file(file,
                    assemble::recorded_scenario_text(recorded, file.stem().string()));
}

}  // namespace

int fire_command(const FireArguments& arguments) {
  const auto recorded = assemble::read_recorded_scenario(
      arguments.source, {arguments.time_field, arguments.incident, arguments.utc_offset_h,
                         order_of(arguments.date_order)});
  if (!recorded) return say_error(recorded.error());
  print_fire(recorded.value().fire);
  for (const std::string& each : recorded.value().warnings) print("{}\n", each);
  if (!arguments.out.empty()) {
    if (auto done = write_perimeters(recorded.value().fire, arguments.out); !done)
      return say_error(done.error());
    print("Written: {}\n", arguments.out.string());
  }
  if (!arguments.scenario.empty()) {
    if (auto done = write_scenario(recorded.value(), arguments.scenario); !done)
      return say_error(done.error());
    print("Written: {}; fly it: skein run {} --report\n", arguments.scenario.string(),
          arguments.scenario.string());
    if (recorded.value().fire.duration > assemble::kMaxScenarioDuration)
      print(
          "The run ends after {:.0f} s of {:.0f} s: no run lasts longer; start_s takes a "
          "later part.\n",
          assemble::kMaxScenarioDuration, recorded.value().fire.duration);
  }
  return kDone;
}

}  // namespace skein::app
