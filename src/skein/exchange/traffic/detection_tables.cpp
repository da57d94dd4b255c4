// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/traffic/detection_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

namespace skein::exchange {
namespace {

using model::ManoeuvreKind;

struct BandKind {
  ManoeuvreKind kind;
  std::string_view name;
  double unit;  // that numbers of the table are in
};

const std::array<BandKind, model::kManoeuvreKinds> kBandKinds = {
    {{ManoeuvreKind::kTrack, "track_deg", geo::radians(1)},
     {ManoeuvreKind::kSpeed, "speed_mps", 1},
     {ManoeuvreKind::kVerticalSpeed, "vs_mps", 1},
     {ManoeuvreKind::kAltitude, "alt_m", 1}}};

constexpr std::size_t kTimedLevels = 3;  // that the table of alerts has columns for
constexpr double kInfiniteTime = std::numeric_limits<double>::infinity();

// 0 without a sign.
double unsigned_zero(double value, double resolution) {
  return std::abs(value) < resolution / 2 ? 0.0 : value;
}

void add_cell(std::string& out, double value, int decimals) {
  if (std::isinf(value))
    out += value > 0 ? ",inf" : ",-inf";
  else
    fmt::format_to(std::back_inserter(out), ",{:.{}f}",
                   unsigned_zero(value, decimals == 6 ? 1e-6 : 1e-4), decimals);
}

void add_guidance(const model::ManoeuvreBands& bands, model::AlertRegion corrective,
                  const BandKind& kind, std::string& out) {
  const model::ManoeuvreResolution found = resolution(bands, corrective);
  const auto add = [&](std::optional<double> value, double none) {
    if (!found.needed) {
      out += ',';
      return;
    }
    if (!value) return add_cell(out, none, 6);
    const bool track = kind.kind == ManoeuvreKind::kTrack;
    add_cell(out, (track ? geo::wrap_2pi(*value) : *value) / kind.unit, 6);
  };
  add(found.up, kInfiniteTime);
  add(found.down, -kInfiniteTime);
  out += found.prefer_up ? ",1" : ",0";
  using Outcome = model::BandRecovery::Outcome;
  const model::BandRecovery& recovery = bands.recovery;
  switch (recovery.outcome) {
    case Outcome::kNotNeeded:
      out += ",,,,-1\n";
      return;
    case Outcome::kFound:
      add_cell(out, recovery.time, 4);
      add_cell(out, recovery.horizontal, 4);
      add_cell(out, recovery.vertical, 4);
      break;
    case Outcome::kNoneFound:
    case Outcome::kNotKept:
      out += ",-inf,-inf,-inf";
      break;
  }
  fmt::format_to(std::back_inserter(out), ",{}\n", recovery.shrunk);
}

}  // namespace

std::string DetectionTables::alerts_header() {
  return "case,intruder,alert_level,t1_in_s,t1_out_s,t2_in_s,t2_out_s,t3_in_s,t3_out_s,"
         "last_track_s,last_speed_s,last_vs_s,last_alt_s\n";
}

std::string DetectionTables::bands_header() {
  return "case,kind,lo,hi,region\n";
}

std::string DetectionTables::guidance_header() {
  return "case,kind,resolution_up,resolution_low,prefer_up,recovery_time_s,"
         "recovery_horizontal_m,recovery_vertical_m,recovery_n\n";
}

std::string DetectionTables::timeline_header() {
  return "case,t_s,alert_level\n";
}

void DetectionTables::add_alerts(const Encounter& encounter, std::string& out) {
  const model::WellClearConfiguration& c = maker_.configuration();
  for (std::size_t i = 0; i < encounter.intruders.size(); ++i) {
    const model::Intruder& intruder = encounter.intruders[i];
    const auto& levels = c.alerters[intruder.alerter].levels;
    fmt::format_to(std::back_inserter(out), "{},{},{}", encounter.name,
                   encounter.numbers[i], alert_level(c, encounter.own, intruder));
    for (std::size_t k = 0; k < kTimedLevels; ++k) {
      const model::ConflictSpan span =
          k < levels.size() ? level_conflict(c, levels[k], encounter.own, intruder)
                            : model::ConflictSpan{};
      if (!span.conflict()) {
        out += ",,";
        continue;
      }
      add_cell(out, span.in, 6);
      add_cell(out, span.out, 6);
    }
    for (const BandKind& kind : kBandKinds)
      add_cell(out, maker_.last_time(kind.kind, encounter.own, intruder), 3);
    out += '\n';
  }
}

void DetectionTables::add_bands(const Encounter& encounter, std::string& bands,
                                std::string& guidance) {
  for (const BandKind& kind : kBandKinds) {
    const model::ManoeuvreBands& made =
        maker_.bands(kind.kind, encounter.own, encounter.intruders);
    for (const model::BandPiece& piece : made.pieces) {
      fmt::format_to(std::back_inserter(bands), "{},{}", encounter.name, kind.name);
      add_cell(bands, piece.lo / kind.unit, 6);
      add_cell(bands, piece.hi / kind.unit, 6);
      fmt::format_to(std::back_inserter(bands), ",{}\n", name_of(piece.region));
    }
    fmt::format_to(std::back_inserter(guidance), "{},{}", encounter.name, kind.name);
    add_guidance(made, maker_.configuration().corrective, kind, guidance);
  }
}

void DetectionTables::add_timeline(const Encounter& encounter, int until,
                                   std::string& out) const {
  std::vector<model::AlertHysteresis> memories(encounter.intruders.size());
  int last = -1;
  for (int t = 0; t <= until; ++t) {
    model::AircraftMotion own = encounter.own;
    own.p_N += t * own.v_N;
    int level = 0;
    for (std::size_t i = 0; i < memories.size(); ++i) {
      model::Intruder intruder = encounter.intruders[i];
      intruder.motion.p_N += t * intruder.motion.v_N;
      level =
          std::max(level, memories[i].level(maker_.configuration(), own, intruder, t));
    }
    if (level != last || t == until)
      fmt::format_to(std::back_inserter(out), "{},{},{}\n", encounter.name, t, level);
    last = level;
  }
}

int DetectionTables::usual_timeline() const {
  constexpr double kOver = 40;  // [s]
  double longest = 0;
  for (const model::Alerter& alerter : maker_.configuration().alerters)
    for (const model::AlertLevel& level : alerter.levels)
      longest = std::max(longest, level.early_alerting_time);
  return static_cast<int>(std::ceil(longest + kOver));
}

}  // namespace skein::exchange
