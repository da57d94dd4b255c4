// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/alerting/traffic_alerting.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "skein/base/math.h"
#include "skein/layer/reasoning/avoidance/alerting/alert_text.h"

namespace skein::reasoning {
namespace {

using model::AdvisedValue;
using model::BandPiece;
using model::ManoeuvreBands;
using model::ManoeuvreKind;

const Time kPeriod = Time::from_seconds(1);

model::AircraftMotion motion_of(const NavEstimate& nav) {
  return {nav.p_N, nav.v_N};
}

// The value that leads out of a conflict; none where the own one need not be left.
std::optional<double> way_out(const ManoeuvreBands& bands, AlertRegion corrective,
                              const std::optional<AdvisedValue>& advised) {
  if (!advised || !model::is_corrective(bands.region(bands.own), corrective))
    return std::nullopt;
  return advised->value;
}

// Bands that say something, in the order of their values.
template <class Band>
std::vector<Band> said(const ManoeuvreBands& bands) {
  std::vector<Band> all;
  for (const BandPiece& piece : bands.pieces)
    if (piece.region != AlertRegion::kNone)
      all.push_back({piece.lo, piece.hi, piece.region});
  return all;
}

}  // namespace

void TrafficAlerting::list(Time now, std::span<const TrafficTrack> tracks) {
  intruders_.clear();
  for (const TrafficTrack& track : tracks) {
    if (!is_firm(track)) continue;
    const TrafficState state = track.filter.at(now);
    intruders_.push_back({track.number,
                          {state.p_N, state.v_N},
                          state.horizontal_sd(),
                          state.vertical_sd(),
                          0});
  }
}

void TrafficAlerting::report(EntityId self, const AgentInput& in,
                             const TrafficAlert& alert, int before,
                             AgentOutput& out) const {
  out.records.emplace_back(alert);
  if (static_cast<int>(alert.level) <= before) return;
  const Vec3& v_N = in.nav->v_N;
  out.events.push_back({in.now,
                        self,
                        EventKind::kTrafficAlert,
                        spoken(alert, geo::bearing(v_N.head<2>()), -v_N.z()),
                        {.value = alert.level}});
}

// Alerts about tracks that are no more, or of an aircraft that does not fly, are over.
void TrafficAlerting::end_lost(EntityId self, const AgentInput& in, AgentOutput& out) {
  std::erase_if(alerted_, [&](const Alerted& each) {
    const bool tracked =
        std::ranges::any_of(intruders_, [&](const model::TrackedIntruder& intruder) {
          return intruder.number == each.track;
        });
    if (tracked) return false;
    TrafficAlert over;
    over.track = each.track;
    report(self, in, over, each.level, out);
    return true;
  });
}

void TrafficAlerting::report_changes(EntityId self, const AgentInput& in,
                                     const model::BandAdvisor::Advice& advice,
                                     AgentOutput& out) {
  const auto corrective = configuration_->corrective;
  for (std::size_t k = 0; k < intruders_.size(); ++k) {
    const model::TrackedIntruder& intruder = intruders_[k];
    const int level = advice.alerts[k];
    const auto at = std::ranges::find(alerted_, intruder.number, &Alerted::track);
    const int before = at != alerted_.end() ? at->level : 0;
    if (level == before) continue;
    const Vec3 apart = intruder.motion.p_N - in.nav->p_N;
    TrafficAlert alert;
    alert.track = intruder.number;
    alert.level = static_cast<std::uint32_t>(level);
    alert.region = advisor_->region_of(level, intruder.alerter);
    alert.bearing = geo::wrap_pi(geo::bearing(apart.head<2>()) - in.nav->heading);
    alert.distance = apart.head<2>().norm();
    alert.height = -apart.z();
    if (level > 0) {
      alert.track_advised =
          way_out(advisor_->bands(ManoeuvreKind::kTrack), corrective, advice.track);
      alert.speed_advised =
          way_out(advisor_->bands(ManoeuvreKind::kSpeed), corrective, advice.speed);
      alert.vertical_speed_advised =
          way_out(advisor_->bands(ManoeuvreKind::kVerticalSpeed), corrective,
                  advice.vertical_speed);
    }
    report(self, in, alert, before, out);
    if (at == alerted_.end())
      alerted_.push_back({intruder.number, level});
    else
      at->level = level;
  }
  std::erase_if(alerted_, [](const Alerted& each) { return each.level == 0; });
}

void TrafficAlerting::report_bands(const AgentInput& in,
                                   const model::BandAdvisor::Advice& advice,
                                   AgentOutput& out) {
  const auto corrective = configuration_->corrective;
  const auto& track = advisor_->bands(ManoeuvreKind::kTrack);
  const auto& speed = advisor_->bands(ManoeuvreKind::kSpeed);
  const auto& vertical_speed = advisor_->bands(ManoeuvreKind::kVerticalSpeed);
  FlightBands bands;
  bands.level = static_cast<std::uint32_t>(advice.alert);
  bands.track = track.own;
  bands.speed = speed.own;
  bands.vertical_speed = -in.nav->v_N.z();
  bands.track_advised = way_out(track, corrective, advice.track);
  bands.speed_advised = way_out(speed, corrective, advice.speed);
  bands.vertical_speed_advised =
      way_out(vertical_speed, corrective, advice.vertical_speed);
  if (track.recovery.outcome == model::BandRecovery::Outcome::kFound)
    bands.recovery = track.recovery.time;
  bands.tracks = said<TrackBand>(track);
  bands.speeds = said<SpeedBand>(speed);
  bands.vertical_speeds = said<SpeedBand>(vertical_speed);
  bands.altitudes = said<AltitudeBand>(advisor_->bands(ManoeuvreKind::kAltitude));
  out.records.emplace_back(std::move(bands));
}

void TrafficAlerting::step(EntityId self, const AgentInput& in,
                           std::span<const TrafficTrack> tracks, bool flies,
                           const Goal& goal, AgentOutput& out) {
  if (tracks.empty() && alerted_.empty()) return;
  if (in.now < next_) return;
  next_ = std::max(next_ + kPeriod, in.now);
  const bool alert_stood = !alerted_.empty();
  list(in.now, flies ? tracks : std::span<const TrafficTrack>());
  end_lost(self, in, out);
  if (!intruders_.empty()) {
    if (!advisor_) {
      if (!configuration_)
        configuration_ = std::make_shared<const model::WellClearConfiguration>(
            *model::well_clear_configuration("skein_suas"));
      advisor_.emplace(*configuration_);
    }
    const model::AircraftMotion own = motion_of(*in.nav);
    const auto& advice = advisor_->watch(in.now.seconds(), own, intruders_);
    if (advice.alert > 0) advisor_->guide(own, goal());
    report_changes(self, in, advice, out);
    if (advice.alert > 0) report_bands(in, advice, out);
    banded_ = banded_ || advice.alert > 0;
  }
  if (!alerted_.empty()) return;
  if (std::exchange(banded_, false)) out.records.emplace_back(FlightBands{});
  if (alert_stood)
    out.events.push_back({in.now, self, EventKind::kClearOfTraffic, "clear of traffic"});
}

}  // namespace skein::reasoning
