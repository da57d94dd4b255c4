// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/kinds/tuning_gains.h"

#include "skein/assemble/aircraft/gains_fields.h"
#include "skein/assemble/kinds/skein_autopilot_kind.h"
#include "skein/scenario/document.h"
#include "skein/scenario/write.h"

namespace skein::assemble {
namespace {

using autopilot::LapGains;
using autopilot::LateralLaw;

scenario::Document gains_document(const char* of_wing) {
  const auto fields =
      scenario::Fields<LapGains>()
          .object("lateral", &LapGains::lateral, lateral_fields(), "Lateral guidance.")
          .object(of_wing, &LapGains::wing, fixed_wing_gains_fields(), "Gains.");
  return {fields.description(),
          "a file of gains",
          "Give it a section lateral or fixed_wing_gains.",
          "nothing was flown",
          "Skein gains",
          ""};
}

template <double autopilot::FixedWingGains::*member>
constexpr TuningKnob of_wing(const char* key) {
  return {key, [](const LapGains& g) { return g.wing.*member; },
          [](LapGains& g, double value) { g.wing.*member = value; }};
}

using Wing = autopilot::FixedWingGains;
constexpr TuningKnob kKnobs[] = {
    {"lateral.l2_time_s", [](const LapGains& g) { return g.lateral.l2.time; },
     [](LapGains& g, double value) { g.lateral.l2.time = value; }},
    {"lateral.l1_period_s", [](const LapGains& g) { return g.lateral.l1.period; },
     [](LapGains& g, double value) { g.lateral.l1.period = value; }},
    {"lateral.course_look_ahead_s",
     [](const LapGains& g) { return g.lateral.course.look_ahead; },
     [](LapGains& g, double value) { g.lateral.course.look_ahead = value; }},
    of_wing<&Wing::roll_gain>("fixed_wing_gains.roll_gain_per_s"),
    of_wing<&Wing::roll_rate_gain>("fixed_wing_gains.roll_rate_gain_per_s"),
    of_wing<&Wing::bank_gain>("fixed_wing_gains.bank_gain_per_s"),
    of_wing<&Wing::height_gain>("fixed_wing_gains.height_gain_per_s"),
    of_wing<&Wing::airspeed_gain>("fixed_wing_gains.airspeed_gain_per_s"),
    of_wing<&Wing::energy_rate_gain>("fixed_wing_gains.energy_rate_gain"),
    of_wing<&Wing::balance_gain>("fixed_wing_gains.balance_gain"),
};
constexpr std::size_t kLaws = 3;  // the first knobs: one for each lateral law

}  // namespace

Result<LapGains> tuning_gains_of(const scenario::Scenario& scenario) {
  const auto refuse = [](const char* message, const char* hint) {
    return Error{ErrorCode::kBadInput, "aircraft[0]", message, hint};
  };
  if (scenario.aircraft.empty()) return refuse("is missing.", "Add a fixed wing.");
  const scenario::AircraftGroup& group = scenario.aircraft.front();
  if (group.plant.kind != "fixed-wing")
    return refuse("is no fixed wing with six degrees of freedom.",
                  "Choose plant: fixed-wing.");
  if (group.autopilot.kind != "skein")
    return refuse("does not fly with the autopilot skein.", "Choose autopilot: skein.");
  return fixed_wing_gains(group.autopilot.as<SkeinChoice>(), gains_of(group.plant));
}

Result<LapGains> read_tuning_gains(const std::filesystem::path& file,
                                   const LapGains& base) {
  LapGains gains = base;
  const auto reading = scenario::read_document(file, gains_document("fixed_wing_gains"),
                                               scenario::KindTable{}, {}, &gains);
  if (reading.ok()) return gains;
  std::string report = reading.report();
  report.pop_back();  // the last line feed
  return Error{ErrorCode::kBadInput, "", std::move(report), ""};
}

std::string write_tuning_gains(const LapGains& gains) {
  return scenario::write_document(gains_document("fixed_wing_gains"), &gains,
                                  scenario::KindTable{});
}

std::string lap_gains_text(const LapGains& gains) {
  const scenario::Document document = gains_document("wing_gains");
  const scenario::Type type{scenario::ObjectType{document.keys}};
  return scenario::to_inline_yaml(scenario::to_node(type, &gains, scenario::KindTable{}));
}

LapGains quickened(const LapGains& gains, double factor) {
  LapGains quick = gains;
  quick.lateral.course.gain *= factor;
  quick.lateral.course.look_ahead /= factor;
  quick.lateral.l1.period /= factor;
  quick.lateral.l2.time /= factor;
  quick.wing.bank_gain *= factor;
  quick.wing.roll_gain *= factor;
  quick.wing.roll_rate_gain *= factor;
  quick.wing.roll_rate_integral *= factor;
  return quick;
}

std::vector<TuningKnob> tuning_knobs(const LapGains& gains) {
  std::vector<TuningKnob> knobs(std::begin(kKnobs) + kLaws, std::end(kKnobs));
  knobs.insert(knobs.begin(), kKnobs[gains.lateral.law == LateralLaw::kL2Plus ? 0
                                     : gains.lateral.law == LateralLaw::kL1   ? 1
                                                                              : 2]);
  return knobs;
}

}  // namespace skein::assemble
