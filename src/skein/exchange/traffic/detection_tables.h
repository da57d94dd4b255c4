// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "skein/exchange/traffic/encounters.h"
#include "skein/model/well_clear/bands.h"

namespace skein::exchange {

/// The tables that `skein avoid detect` answers encounters with, row by row: see
/// docs/well-clear.md for their columns.
///
/// Degrees for tracks, else SI; times with six decimals, last times and recovery as the
/// reference has them; an empty cell is no number.
class DetectionTables {
 public:
  /// @param configuration  checked.
  explicit DetectionTables(const model::WellClearConfiguration& configuration)
      : maker_(configuration) {}

  static std::string alerts_header();
  static std::string bands_header();
  static std::string guidance_header();
  static std::string timeline_header();

  /// A row for each intruder.
  void add_alerts(const Encounter& encounter, std::string& out);
  /// The pieces of all kinds, and their guidance.
  void add_bands(const Encounter& encounter, std::string& bands, std::string& guidance);
  /// Alerts with hysteresis, the highest of all intruders, of straight flight asked each
  /// second: at each change, and at the end.
  /// @param until  [s], whole.
  void add_timeline(const Encounter& encounter, int until, std::string& out) const;

  /// How long timelines are unless it is said [s]: the longest early alerting time and
  /// 40 s, time for what alerts first to be over.
  int usual_timeline() const;

 private:
  model::BandMaker maker_;
};

}  // namespace skein::exchange
