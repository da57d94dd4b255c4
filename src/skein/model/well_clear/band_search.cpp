// SPDX-License-Identifier: Apache-2.0
#include "skein/model/well_clear/band_search.h"

#include <algorithm>
#include <numbers>

#include "skein/base/check.h"
#include "skein/base/math.h"

namespace skein::model {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

constexpr AlertRegion kRegionOf[] = {AlertRegion::kFar, AlertRegion::kMid,
                                     AlertRegion::kNear};

const AlertLevel* level_of(const Alerter& alerter, AlertRegion region) {
  for (const AlertLevel& level : alerter.levels)
    if (level.region == region) return &level;
  return nullptr;
}

}  // namespace

BandSearch::BandSearch(const WellClearConfiguration& configuration, ManoeuvreKind kind)
    : configuration_(&configuration),
      options_(configuration, kind),
      recovery_(configuration) {}

const ManoeuvreBands& BandSearch::run(const AircraftMotion& own,
                                      std::span<const Intruder> intruders) {
  options_.start(own_motion(own));
  for (std::vector<char>& red : red_) red.assign(options_.count(), 0);
  spans_.resize(options_.count());
  recovery_.start(options_.count());
  for (const Intruder& intruder : intruders) mark(own, intruder);
  bool saturated = false;
  for (std::size_t r = 0; r < kRegions; ++r)
    if (kRegionOf[r] >= configuration_->corrective && !has_free_range(red_[r]))
      saturated = true;
  bands_.kind = options_.kind();
  bands_.own = options_.own_value();
  bands_.recovery = saturated ? recovery_.search(options_) : BandRecovery{};
  list_pieces();
  return bands_;
}

// Marks the options that lead into conflict with an intruder, for each region.
void BandSearch::mark(const AircraftMotion& own, const Intruder& intruder) {
  const WellClearConfiguration& c = *configuration_;
  SKEIN_CHECK(intruder.alerter < c.alerters.size(), intruder.alerter);
  const IntruderMotion motion = intruder_motion(own, intruder);
  const WellClearVolume* surveyed = nullptr;
  for (std::size_t r = 0; r < kRegions; ++r) {
    const AlertLevel* level = level_of(c.alerters[intruder.alerter], kRegionOf[r]);
    if (!level) continue;
    if (!surveyed || !(*surveyed == level->volume))
      options_.survey(grown(level->volume, intruder), motion, c.lookahead,
                      StepRule::kUntilNext, spans_);
    surveyed = &level->volume;
    const ConflictSpan now = level_conflict(c, *level, own, intruder);
    const bool conflict = now.conflict() && now.in <= level->alerting_time;
    const double window =
        conflict ? c.lookahead : std::min(level->alerting_time, c.lookahead);
    bool any = conflict;
    for (std::size_t i = 0; i < options_.count(); ++i) {
      const OptionSpan& span = spans_[i];
      const bool red =
          span.first_step < math::kInfinity ||
          begins_within(span.straight, options_.times()[i], window, c.lookahead) ||
          begins_within(span.steady, options_.steady_times()[i], window, c.lookahead);
      if (!red) continue;
      red_[r][i] = 1;
      any = true;
    }
    if (any && kRegionOf[r] == c.corrective)
      recovery_.add(motion, intruder.horizontal_margin, intruder.vertical_margin, window,
                    options_, spans_);
  }
}

bool BandSearch::can_avoid(const AircraftMotion& own, const Intruder& intruder,
                           const WellClearVolume& volume) {
  const WellClearConfiguration& c = *configuration_;
  options_.start(own_motion(own));
  spans_.resize(options_.count());
  options_.survey(grown(volume, intruder), intruder_motion(own, intruder), c.lookahead,
                  StepRule::kInstant, spans_);
  for (const OptionSpan& span : spans_)
    if (span.first_step == math::kInfinity && !span.straight.conflict() &&
        !span.steady.conflict())
      return true;
  return false;
}

double BandSearch::last_time(const AircraftMotion& own, const Intruder& intruder) {
  constexpr double kPrecision = 0.5;  // [s]
  const WellClearConfiguration& c = *configuration_;
  SKEIN_CHECK(intruder.alerter < c.alerters.size(), intruder.alerter);
  const AlertLevel* level = level_of(c.alerters[intruder.alerter], c.corrective);
  if (!level) return math::kInfinity;
  const ConflictSpan now = level_conflict(c, *level, own, intruder);
  if (!now.conflict()) return math::kInfinity;
  double late = now.in, early = 0;
  while (late - early > kPrecision) {
    const double tried = (early + late) / 2;
    AircraftMotion then = own;
    Intruder other = intruder;
    then.p_N += tried * then.v_N;
    other.motion.p_N += tried * other.motion.v_N;
    (can_avoid(then, other, level->volume) ? early : late) = tried;
  }
  return early > 0 ? early : -math::kInfinity;
}

bool BandSearch::has_free_range(const std::vector<char>& red) const {
  for (std::size_t i = options_.first_range(); i < options_.end_of_ranges(); ++i)
    if (!red[i] && !red[i + 1]) return true;
  return false;
}

// Of the values from an option to the next.
AlertRegion BandSearch::region_between(std::size_t option) const {
  if (bands_.recovery.outcome == BandRecovery::Outcome::kFound &&
      recovery_.regains(option) && recovery_.regains(option + 1))
    return AlertRegion::kRecovery;
  for (std::size_t r = kRegions; r-- > 0;)
    if (red_[r][option] || red_[r][option + 1]) return kRegionOf[r];
  return AlertRegion::kNone;
}

void BandSearch::add_piece(double lo, double hi, AlertRegion region) {
  std::vector<BandPiece>& pieces = bands_.pieces;
  if (!pieces.empty() && pieces.back().region == region)
    pieces.back().hi = hi;
  else
    pieces.push_back({lo, hi, region});
}

void BandSearch::list_pieces() {
  bands_.pieces.clear();
  for (std::size_t i = options_.first_range(); i < options_.end_of_ranges(); ++i)
    add_piece(options_.low_end(i), options_.high_end(i), region_between(i));
  if (options_.kind() == ManoeuvreKind::kTrack) list_track_pieces();
}

// From a whole turn about the own track to [0, 2 pi].
void BandSearch::list_track_pieces() {
  turned_ = bands_.pieces;
  bands_.pieces.clear();
  if (turned_.size() == 1) return add_piece(0, kTurn, turned_[0].region);
  turned_.back().hi = turned_.front().lo + kTurn;  // they are the same track
  for (const double shift : {-kTurn, 0.0, kTurn})
    for (const BandPiece& piece : turned_)
      add_track_piece({piece.lo + shift, piece.hi + shift, piece.region});
  bands_.pieces.back().hi = kTurn;
}

// What of a piece lies in [0, 2 pi], if that is not too narrow; it begins where the last
// one ends.
void BandSearch::add_track_piece(const BandPiece& piece) {
  const double from = bands_.pieces.empty() ? 0 : bands_.pieces.back().hi;
  const double lo = std::clamp(piece.lo, 0.0, kTurn);
  const double hi = std::clamp(piece.hi, 0.0, kTurn);
  if (hi - lo > same(hi)) add_piece(from, hi, piece.region);
}

}  // namespace skein::model
