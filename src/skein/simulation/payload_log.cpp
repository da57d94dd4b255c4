// SPDX-License-Identifier: Apache-2.0
#include "skein/simulation/payload_log.h"

#include "skein/base/math.h"

namespace skein::simulation {
namespace {

Vec2 place_at(const NavEstimate& nav, Time time) {
  const double ago = (nav.time - time).seconds();
  return geo::horizontal(nav.p_N) - ago * geo::horizontal(nav.v_N);
}

}  // namespace

void log_payload(std::span<const SensorSample> samples, EntityId aircraft,
                 std::uint32_t sensor, const NavEstimate& nav, Recorder& recorder) {
  RangeScan scan{Time(), aircraft, sensor, {}};
  for (const SensorSample& sample : samples) {
    if (const auto* beam = std::get_if<RangeSample>(&sample)) {
      if (!scan.beams.empty() && beam->time != scan.time) {
        recorder.record(scan);
        scan.beams.clear();
      }
      scan.time = beam->time;
      scan.beams.push_back(*beam);
    } else if (const auto* found = std::get_if<DetectionSample>(&sample)) {
      recorder.record(Detection{found->time, aircraft, sensor, found->object,
                                place_at(nav, found->time) + found->position,
                                math::hypot(found->position_sd, nav.position_sd)});
    } else if (const auto* picture = std::get_if<FootprintSample>(&sample)) {
      const Vec2 place = place_at(nav, picture->time);
      Footprint footprint{picture->time, aircraft, sensor, picture->corners};
      for (Vec2& corner : footprint.corners) corner += place;
      recorder.record(footprint);
    }
  }
  if (!scan.beams.empty()) recorder.record(scan);
}

}  // namespace skein::simulation
