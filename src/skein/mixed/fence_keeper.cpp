// SPDX-License-Identifier: Apache-2.0
#include "skein/mixed/fence_keeper.h"

#include <fmt/format.h>

#include <utility>

namespace skein::mixed {
namespace {

constexpr double kNear = 100;       // to a zone's altitudes: it counts [m]
constexpr double kNearStill = 130;  // it goes on counting [m]
constexpr double kLead = 10;        // that zones count before they are in force [s]
const Time kBetweenUploads = Time::from_seconds(5);
const Time kAfterDenial = Time::from_seconds(30);

}  // namespace

void FenceKeeper::set_zones(std::span<const Zone> zones) {
  zones_.assign(zones.begin(), zones.end());
  counts_.assign(zones_.size(), false);
  changed_ = true;
}

void FenceKeeper::hear(const LinkChange& change) {
  switch (change.kind) {
    case LinkChange::Kind::kUp:
    case LinkChange::Kind::kRebooted:
      up_ = changed_ = supported_ = true;
      pending_ = 0;
      again_at_ = Time();
      return;
    case LinkChange::Kind::kDown:
      up_ = false;
      return;
    case LinkChange::Kind::kMismatch:
    case LinkChange::Kind::kDuplicate:
      return;
  }
}

void FenceKeeper::hear(const RequestAnswer& answer, Time now,
                       std::vector<VehicleEvent>& events) {
  if (answer.number == 0 || answer.number != pending_) return;
  pending_ = 0;
  if (answer.outcome == RequestAnswer::Outcome::kAccepted) {
    refused_.clear();
    events.push_back({EventKind::kFenceUploaded, fmt::format("zones: {}", uploaded_)});
    return;
  }
  changed_ = true;
  if (answer.outcome == RequestAnswer::Outcome::kUnsupported) supported_ = false;
  if (answer.outcome == RequestAnswer::Outcome::kDenied) again_at_ = now + kAfterDenial;
  if (std::exchange(refused_, answer.text) == answer.text) return;
  events.push_back({EventKind::kFenceRefused,
                    fmt::format("{}: {}", name_of(answer.outcome), answer.text)});
}

// Which zones count now; one that does is left later than it was taken in.
void FenceKeeper::choose(Time now, double altitude_msl) {
  const double t = now.seconds();
  for (std::size_t k = 0; k < zones_.size(); ++k) {
    const double near = counts_[k] ? kNearStill : kNear;
    const bool counts =
        concerns(zones_[k], altitude_msl - near, altitude_msl + near, t, t + kLead);
    changed_ |= counts != counts_[k];
    counts_[k] = counts;
  }
}

void FenceKeeper::step(Time now, double altitude_msl, VehiclePort& port) {
  choose(now, altitude_msl);
  if (!up_ || !changed_ || !supported_ || pending_ != 0 || now < again_at_) return;
  FenceUpload fence;
  for (std::size_t k = 0; k < zones_.size(); ++k)
    if (counts_[k]) fence.zones.push_back(zones_[k]);
  changed_ = false;
  uploaded_ = fence.zones.size();
  again_at_ = now + kBetweenUploads;
  pending_ = ++number_;
  port.send(pending_, fence);
}

}  // namespace skein::mixed
