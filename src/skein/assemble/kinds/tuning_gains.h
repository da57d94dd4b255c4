// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "skein/base/result.h"
#include "skein/layer/autopilot/skein/skein_setup.h"
#include "skein/scenario/scenario.h"

namespace skein::assemble {

/// The gains that the first aircraft of a scenario flies with.
/// Fails: kBadInput when it is no fixed wing with the autopilot skein.
Result<autopilot::LapGains> tuning_gains_of(const scenario::Scenario& scenario);

/// Gains from a file with the sections `lateral` (as in a scenario's autopilot) and
/// `fixed_wing_gains` (as in an aircraft file). What it does not say is as in `base`.
/// Fails: kBadInput with everything that is wrong with the file.
Result<autopilot::LapGains> read_tuning_gains(const std::filesystem::path& file,
                                              const autopilot::LapGains& base);

/// The gains as such a file, every key written out.
std::string write_tuning_gains(const autopilot::LapGains& gains);

/// The gains on one line, as an entry of the autopilot's `lap_gains`.
std::string lap_gains_text(const autopilot::LapGains& gains);

/// The gains with a quicker lateral response: times over `factor`, gains times it.
autopilot::LapGains quickened(const autopilot::LapGains& gains, double factor);

/// One number that the search for gains moves.
struct TuningKnob {
  const char* key;  ///< as in a file of gains
  double (*get)(const autopilot::LapGains& gains);
  void (*set)(autopilot::LapGains& gains, double value);
};

/// All of them, with the one of the lateral law that is flown. Each is above 0.
std::vector<TuningKnob> tuning_knobs(const autopilot::LapGains& gains);

}  // namespace skein::assemble
