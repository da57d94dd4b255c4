#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <span>
#include <thread>

#include "app/commands.h"
#include "app/common.h"
#include "app/output.h"
#include "skein/exchange/gis_writing.h"
#include "skein/geo/clip.h"
#include "skein/record/run_views.h"
#include "skein/scenario/utc.h"

namespace skein::app {
namespace {

using exchange::GisFeature;
using record::RunViews;
using record::StoredBelief;

// A place in the area burns with this probability or more: the believed boundary, moved
// outward by so many standard deviations.
struct Level {
  double probability, deviations;
};
constexpr Level kBoundary{0.5, 0};
constexpr Level kBands[] = {
    {0.975, -1.96}, {0.75, -0.6745}, kBoundary, {0.25, 0.6745}, {0.025, 1.96}};
constexpr Level kPredictions[] = {{0.95, -1.645}, kBoundary, {0.05, 1.645}};

std::string utc_at(const std::string& start, Time time) {
  const auto begin = scenario::parse_utc(start);
  if (!begin) return {};
  return scenario::utc_text(*begin +
                            static_cast<std::int64_t>(std::floor(time.seconds())));
}

// The boundary moved outward by `deviations` standard deviations.
geo::Region moved(const BoundaryEstimate& boundary, double deviations) {
  geo::Region region;
  for (const auto& points : boundary.rings) {
    if (points.size() < 3) continue;
    region.emplace_back();
    for (const BoundaryPoint& point : points)
      region.back().push_back(point.position + deviations * point.sigma * point.normal);
  }
  return geo::clean(region, geo::FillRule::kPositive);
}

double mean_sigma(const BoundaryEstimate& boundary) {
  double sum = 0;
  int count = 0;
  for (const auto& ring : boundary.rings)
    for (const BoundaryPoint& point : ring) {
      sum += point.sigma;
      ++count;
    }
  return count > 0 ? sum / count : 0;
}

GisFeature area_of(const StoredBelief& belief, const std::string& start,
                   const Level& level) {
  GisFeature feature;
  feature.rings = moved(belief.boundary, level.deviations);
  const Time time = belief.boundary.time;
  feature.fields = {{"mission", belief.who.mission},
                    {"time_utc", utc_at(start, time)},
                    {"time_s", time.seconds()},
                    {"made_utc", utc_at(start, belief.made.value_or(time))},
                    {"ahead_min", (time - belief.made.value_or(time)).seconds() / 60},
                    {"prob", level.probability},
                    {"area_ha", geo::area(feature.rings) / 1e4},
                    {"sigma_m", mean_sigma(belief.boundary)}};
  return feature;
}

Result<std::vector<GisFeature>> believed_areas(const RunViews& run, Time at,
                                               const std::string& what,
                                               const std::string& start) {
  const bool prediction = what == "prediction";
  const auto beliefs = prediction ? run.forecasts(at) : run.beliefs(at);
  if (!beliefs) return beliefs.error();
  std::vector<GisFeature> features;
  for (const StoredBelief& belief : beliefs.value()) {
    const std::span<const Level> levels =
        prediction        ? std::span<const Level>(kPredictions)
        : what == "bands" ? std::span<const Level>(kBands)
                          : std::span(&kBoundary, 1);
    for (const Level& level : levels) features.push_back(area_of(belief, start, level));
  }
  return features;
}

Result<std::vector<GisFeature>> tracks(const RunViews& run, Time at,
                                       const std::string& start) {
  const auto paths = run.paths(at);
  if (!paths) return paths.error();
  std::vector<GisFeature> features;
  for (const record::StoredPath& path : paths.value())
    features.push_back({GisFeature::Kind::kLine,
                        {path.places},
                        {{"name", path.name},
                         {"from_utc", utc_at(start, path.from)},
                         {"until_utc", utc_at(start, path.until)},
                         {"from_s", path.from.seconds()},
                         {"until_s", path.until.seconds()}}});
  return features;
}

Result<std::vector<GisFeature>> zones(const RunViews& run, Time at) {
  const auto all = run.zones(at);
  if (!all) return all.error();
  std::vector<GisFeature> features;
  for (const Zone& zone : all.value())
    features.push_back({GisFeature::Kind::kArea,
                        {outline(zone)},
                        {{"name", zone.name},
                         {"floor_m", zone.floor_msl},
                         {"ceiling_m", zone.ceiling_msl},
                         {"from_s", zone.from},
                         {"until_s", zone.until}}});
  return features;
}

Result<std::vector<GisFeature>> features_of(const RunViews& run, Time at,
                                            const std::string& what) {
  const auto start = run.start_utc();
  if (!start) return start.error();
  if (what == "tracks") return tracks(run, at, start.value());
  if (what == "zones") return zones(run, at);
  return believed_areas(run, at, what, start.value());
}

// Writes the file once.
// @returns  whether the run has ended, or an error.
Result<bool> export_once(const ExportArguments& arguments, const geo::LocalFrame& frame) {
  auto run = RunViews::open(arguments.run);
  if (!run) return run.error();
  const auto last = run.value().last();
  if (!last) return last.error();
  const auto ended = run.value().ended();
  if (!ended) return ended.error();
  const Time at = arguments.at ? Time::from_seconds(*arguments.at) : last.value();
  const auto features = features_of(run.value(), at, arguments.what);
  if (!features) return features.error();
  if (features.value().empty() && arguments.every == 0)
    return Error{ErrorCode::kNotFound, arguments.run.string(),
                 fmt::format("has no {} at {:g} s.", arguments.what, at.seconds()),
                 arguments.what == "prediction"
                     ? "Forecasts begin with the allocation phase: see `forecast` of "
                       "perimeter missions."
                     : ""};
  if (!features.value().empty()) {
    auto written =
        exchange::write_gis(features.value(), arguments.what, frame, arguments.out);
    if (!written) return written.error();
    print("Written: {} ({} at {:g} s)\n", arguments.out.string(), arguments.what,
          at.seconds());
  }
  return ended.value();
}

}  // namespace

int export_command(const ExportArguments& arguments, const std::atomic<bool>& stop) {
  assemble::KindRegistry kinds;
  const auto scenario = load_scenario(arguments.run / "scenario.yaml", {}, {}, kinds);
  if (!scenario) return kBadUsage;
  const auto frame = geo::LocalFrame::at(scenario->origin);
  if (!frame) return say_error(frame.error());
  for (;;) {
    const auto ended = export_once(arguments, frame.value());
    if (!ended) return say_error(ended.error());
    if (arguments.every == 0 || ended.value()) return kDone;
    const auto next =
        std::chrono::steady_clock::now() + std::chrono::duration<double>(arguments.every);
    while (std::chrono::steady_clock::now() < next) {
      if (stop) return kDone;
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
    }
  }
}

}  // namespace skein::app
