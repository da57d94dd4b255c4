// SPDX-License-Identifier: Apache-2.0
#include "skein/model/well_clear/band_advisor.h"

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"
#include "skein/geo/vec.h"

namespace skein::model {

std::optional<AdvisedValue> nearest_free(const ManoeuvreBands& bands,
                                         AlertRegion corrective, double goal,
                                         std::optional<bool> side) {
  const AlertRegion here = bands.region(goal);
  const bool track = bands.kind == ManoeuvreKind::kTrack;
  if (!is_corrective(here, corrective)) {
    const double value =
        track ? goal : std::clamp(goal, bands.pieces.front().lo, bands.pieces.back().hi);
    return AdvisedValue{value, here, value > goal};
  }
  std::optional<AdvisedValue> best;
  double least = track ? geo::kPi : math::kInfinity;
  for (const BandPiece& piece : bands.pieces) {
    if (is_corrective(piece.region, corrective)) continue;
    for (const bool up : {true, false}) {
      if (side && *side != up) continue;
      const double end = up ? piece.lo : piece.hi;
      const double off = track ? geo::wrap_2pi(up ? end - goal : goal - end)
                               : (up ? end - goal : goal - end);
      if (off < 0 || off > least || (best && off == least)) continue;
      least = off;
      best = AdvisedValue{track ? geo::wrap_2pi(end) : end, piece.region, up};
    }
  }
  return best;
}

AlertHysteresis& BandAdvisor::hysteresis_of(std::uint32_t number, double time) {
  const double forgotten = time - maker_.configuration().hysteresis.time;
  std::erase_if(memories_, [&](const Memory& m) { return m.last < forgotten; });
  const auto at = std::find_if(memories_.begin(), memories_.end(),
                               [&](const Memory& m) { return m.number == number; });
  Memory& memory =
      at != memories_.end() ? *at : memories_.emplace_back(Memory{number, time, {}});
  memory.last = time;
  return memory.hysteresis;
}

const BandAdvisor::Advice& BandAdvisor::watch(
    double time, const AircraftMotion& own, std::span<const TrackedIntruder> intruders) {
  intruders_.clear();
  alerts_.clear();
  advice_.alert = 0;
  for (const TrackedIntruder& each : intruders) {
    const Intruder& intruder = intruders_.emplace_back(
        Intruder{each.motion, each.alerter, sigmas_ * each.horizontal_sigma,
                 sigmas_ * each.vertical_sigma});
    alerts_.push_back(hysteresis_of(each.number, time)
                          .level(maker_.configuration(), own, intruder, time));
    advice_.alert = std::max(advice_.alert, alerts_.back());
  }
  advice_.alerts = alerts_;
  for (auto* value :
       {&advice_.track, &advice_.speed, &advice_.vertical_speed, &advice_.altitude})
    value->reset();
  return advice_;
}

AlertRegion BandAdvisor::region_of(int level, std::size_t alerter) const {
  if (level <= 0) return AlertRegion::kNone;
  const Alerter& of = maker_.configuration().alerters[alerter];
  return of.levels[static_cast<std::size_t>(level) - 1].region;
}

std::optional<AdvisedValue> BandAdvisor::value_for(ManoeuvreKind kind,
                                                   const AircraftMotion& own,
                                                   double goal) {
  const auto k = static_cast<std::size_t>(kind);
  const ManoeuvreBands& bands = maker_.bands(kind, own, intruders_);
  bands_[k] = &bands;
  const AlertRegion corrective = maker_.configuration().corrective;
  std::optional<bool>& side = side_[k];
  if (!is_corrective(bands.region(goal), corrective)) {
    side.reset();
    return nearest_free(bands, corrective, goal);
  }
  std::optional<AdvisedValue> value;
  if (side) value = nearest_free(bands, corrective, goal, side);
  if (!value) value = nearest_free(bands, corrective, goal);
  side = value ? std::optional<bool>(value->up) : std::nullopt;
  return value;
}

const BandAdvisor::Advice& BandAdvisor::advise(double time, const AircraftMotion& own,
                                               std::span<const TrackedIntruder> intruders,
                                               const FlightGoal& goal) {
  watch(time, own, intruders);
  return guide(own, goal);
}

const BandAdvisor::Advice& BandAdvisor::guide(const AircraftMotion& own,
                                              const FlightGoal& goal) {
  advice_.track = value_for(ManoeuvreKind::kTrack, own, goal.track);
  advice_.speed = value_for(ManoeuvreKind::kSpeed, own, goal.speed);
  advice_.vertical_speed =
      value_for(ManoeuvreKind::kVerticalSpeed, own, goal.vertical_speed);
  if (goal.altitude)
    advice_.altitude = value_for(ManoeuvreKind::kAltitude, own, *goal.altitude);
  return advice_;
}

}  // namespace skein::model
