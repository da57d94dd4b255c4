// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "app/common/commands.h"
#include "app/common/common.h"
#include "app/common/output.h"
#include "skein/exchange/gis/boundary_features.h"
#include "skein/exchange/gis/gis_writing.h"
#include "skein/record/store/run_views.h"
#include "skein/scenario/utc.h"

namespace skein::app {
namespace {

using exchange::GisFeature;
using record::RunViews;
using record::StoredBelief;

std::string utc_at(const std::string& start, Time time) {
  const auto begin = scenario::parse_utc(start);
  if (!begin) return {};
  return scenario::utc_text(*begin +
                            static_cast<std::int64_t>(std::floor(time.seconds())));
}

Result<std::vector<GisFeature>> believed_areas(const RunViews& run, Time at,
                                               const std::string& what,
                                               const std::string& start) {
  const bool prediction = what == "prediction";
  const auto beliefs = prediction ? run.forecasts(at) : run.beliefs(at);
  if (!beliefs) return beliefs.error();
  std::vector<GisFeature> features;
  for (const StoredBelief& belief : beliefs.value()) {
    const auto levels = prediction        ? exchange::prediction_levels()
                        : what == "bands" ? exchange::band_levels()
                                          : exchange::boundary_level();
    for (const exchange::BoundaryLevel& level : levels)
      features.push_back(exchange::boundary_feature(
          {belief.who.mission, belief.boundary, belief.made}, level,
          [&start](Time time) { return utc_at(start, time); }));
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
  if (auto good = check_run_folder(arguments.run); !good) return say_error(good.error());
  const auto scenario = load_recorded_scenario(arguments.run);
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
