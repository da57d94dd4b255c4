#include "skein/assemble/recorded_scenario.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "skein/geo/vec.h"
#include "skein/layer/environment/recorded/recorded_fire.h"
#include "skein/scenario/utc.h"

namespace skein::assemble {
namespace {

namespace fs = std::filesystem;

// The file in a folder that holds the fire; empty when there is none.
fs::path source_in(const fs::path& folder) {
  if (fs::exists(folder / "perimeters.csv")) return folder / "perimeters.csv";
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const char* extension : {".geojson", ".gpkg", ".kml", ".shp", ".tif"})
    for (const fs::path& file : files)
      if (file.extension() == extension && file.filename() != "elevation.tif")
        return file;
  return {};
}

}  // namespace

Result<std::vector<std::string>> fit_recorded_scenario(const fs::path& data) {
  const fs::path whole = fs::absolute(data);
  const fs::path source = fs::is_directory(whole) ? source_in(whole) : whole;
  if (source.empty() || !fs::exists(source))
    return Error{ErrorCode::kNotFound, data.string(), "holds no recorded fire.",
                 "Needed: perimeters.csv, a vector file with times, or an arrival-time "
                 "raster."};
  environment::RecordedFireOptions options;
  options.path = source.string();
  const auto found = environment::summarise_recorded_fire(options);
  if (!found) return found.error();
  const environment::RecordedFireSummary& fire = found.value();

  const double radius = std::max(std::sqrt(fire.first_area / geo::kPi), 20.0);
  const double reach = std::max({-fire.low.minCoeff(), fire.high.maxCoeff(), 500.0});
  std::vector<std::string> overrides = {
      "environment.phenomena[0].source=" + source.string(),
      fmt::format("origin.latitude_deg={:.6f}", fire.origin.latitude_deg),
      fmt::format("origin.longitude_deg={:.6f}", fire.origin.longitude_deg),
      // Whole seconds, so that periods fit in.
      fmt::format("duration_s={}", std::floor(fire.duration)),
      fmt::format("missions[0].prior.radius_m={:.0f}", radius),
      fmt::format("missions[0].prior.radius_sd_m={:.0f}", 0.4 * radius),
      fmt::format("aircraft[0].start.distance_m={:.0f}", 2 * radius + 600)};
  if (fire.start_utc && *fire.start_utc >= 0)  // scenarios have dates from 1970 on
    overrides.push_back("start_utc=" + scenario::utc_text(static_cast<std::int64_t>(
                                           std::floor(*fire.start_utc))));
  const fs::path folder = source.parent_path();
  overrides.push_back("environment.terrain=flat");
  for (const fs::path& file :
       {folder / "landscape" / "elevation.tif", folder / "elevation.tif"})
    if (fs::exists(file)) {
      overrides.back() = fmt::format(
          "environment.terrain={{kind: raster, file: '{}', outside: edge, area_m: "
          "{:.0f}}}",
          file.string(), std::ceil(reach + 3000));
      break;
    }
  return overrides;
}

}  // namespace skein::assemble
