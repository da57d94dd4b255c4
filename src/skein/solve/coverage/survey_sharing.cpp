// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/coverage/survey_sharing.h"

#include "skein/solve/coverage/line_sharing.h"
#include "skein/solve/path/join.h"

namespace skein::solve {

SurveyShares share_survey(std::span<const Vec2> ends,
                          const std::vector<FlightState>& starts,
                          const FlightLimits& limits, const Vec2& wind) {
  SurveyShares shares;
  shares.lines.resize(starts.size());
  shares.durations.assign(starts.size(), 0);
  std::vector<SweepLine> lines;
  for (std::size_t k = 0; k + 1 < ends.size(); k += 2)
    if ((ends[k + 1] - ends[k]).norm() > 0) lines.push_back({ends[k], ends[k + 1], 0});
  if (lines.empty() || starts.empty() || wind.norm() >= limits.airspeed) return shares;
  std::vector<RouteEnds> from(starts.size());
  for (std::size_t a = 0; a < starts.size(); ++a) from[a].start = pose_of(starts[a]);
  LineCosts costs(std::move(lines), motion_of(limits, wind), std::move(from));
  const std::vector<Route> routes = share_lines(costs, {});
  for (std::size_t a = 0; a < starts.size(); ++a) {
    int last = costs.start_of(static_cast<int>(a));
    for (const int visit : routes[a]) {
      shares.lines[a].push_back(costs.entry(visit).position);
      shares.lines[a].push_back(costs.exit(visit).position);
      shares.durations[a] += costs.cost(last, visit);
      last = visit;
    }
  }
  return shares;
}

}  // namespace skein::solve
