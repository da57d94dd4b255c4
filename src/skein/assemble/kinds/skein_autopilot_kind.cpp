// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/kinds/skein_autopilot_kind.h"

#include <fmt/format.h>

#include "skein/assemble/aircraft/gains_fields.h"
#include "skein/geo/clip.h"
#include "skein/geo/self_crossing.h"
#include "skein/layer/autopilot/skein/skein_autopilot.h"
#include "skein/role/terrain.h"

namespace skein::assemble {
namespace {

using autopilot::FailsafeRule;
using scenario::Fields;
using scenario::Range;

constexpr Range kShare{.at_least = 0, .at_most = 1};
constexpr Range kAltitude{.at_least = -500, .at_most = 30000};
constexpr Range kSd{.above = 0, .at_most = 1e4};

Fields<FailsafeRule> rule_fields() {
  using T = FailsafeRule;
  using enum FailsafeReaction;
  const auto reactions = [](Fields<T>& fields, const char* key, auto member,
                            const char* help) {
    fields.word(key, member, help,
                {{"none", kNone, "it is reported, nothing more"},
                 {"hold", kHold, "stay here"},
                 {"return", kReturn, "fly home, stay above"},
                 {"land", kLand, "fly home and land"},
                 {"descend", kDescend, "come down here"}});
  };
  Fields<T> fields;
  fields.duration_s("delay_s", &T::delay,
                    "For which it must last; silence of link or gnss for longer than "
                    "between two heartbeats or positions.",
                    {.at_least = 0, .at_most = 1e6});
  reactions(fields, "reaction", &T::reaction, "What is done.");
  fields.duration_s("escalates_after_s", &T::escalates_after,
                    "After this long the second reaction follows; 0: never.",
                    {.at_least = 0, .at_most = 1e6});
  reactions(fields, "escalates_to", &T::escalates_to,
            "The second reaction, a stronger one.");
  fields.boolean("resumes", &T::resumes,
                 "When it is over the mission goes on by itself; else it waits for a new "
                 "command.");
  return fields;
}

Fields<autopilot::FailsafeOptions> failsafe_fields() {
  using T = autopilot::FailsafeOptions;
  return Fields<T>()
      .object("link", &T::link, rule_fields(), "Nothing is received from the ground.")
      .object("battery_low", &T::battery_low, rule_fields(),
              "The charge less what it takes to get home is below battery_reserve.")
      .object("battery_critical", &T::battery_critical, rule_fields(),
              "The charge is below battery_critical.")
      .object("geofence", &T::geofence, rule_fields(),
              "The aircraft is outside the fence.")
      .object("gnss", &T::gnss, rule_fields(), "No position from satellites.")
      .object("motor", &T::motor, rule_fields(), "A motor stands under throttle.")
      .object(
          "imu", &T::imu, rule_fields(),
          "No inertial unit is received: nothing shows the attitude. The only reaction "
          "that can be flown is descend, with motors off and surfaces at trim.")
      .number("battery_reserve", &T::battery_reserve, "Of a full charge.", kShare)
      .number("battery_critical_charge", &T::battery_critical_at, "Of a full charge.",
              kShare)
      .duration_s("recovery_s", &T::recovery,
                  "For which it must be over to count as over.",
                  {.at_least = 0, .at_most = 1e6})
      .integer("max_clears", &T::max_clears,
               "In one flight, of each; after that it stays.",
               {.at_least = 0, .at_most = 1000})
      .formerly("most_clears")
      .rule("", [](const T& t) { return error_in(t).value_or(std::string()); });
}

// Where a ring crosses itself, in words; nothing when none does. It would be unclear what
// is inside.
std::string crossing_in(const std::vector<geo::Ring>& rings) {
  for (std::size_t r = 0; r < rings.size(); ++r)
    if (const auto at = geo::self_crossing(rings[r]))
      return fmt::format(
          "area {} crosses itself at {:.0f} m north, {:.0f} m east, between its corners "
          "{} and {}, and {} and {}.",
          r + 1, at->point.x(), at->point.y(), at->first + 1,
          (at->first + 1) % rings[r].size() + 1, at->second + 1,
          (at->second + 1) % rings[r].size() + 1);
  return {};
}

Fields<FenceChoice> fence_fields() {
  using T = FenceChoice;
  return Fields<T>()
      .polygon("areas_m", &T::areas, "Areas to stay in. Empty: no limit.")
      .items({.at_most = 1000})
      .rule("areas_m", [](const T& t) { return crossing_in(t.areas); })
      .number("ceiling_msl_m", &T::ceiling_msl, "Null: none.", kAltitude)
      .number("floor_msl_m", &T::floor_msl, "Null: none.", kAltitude)
      .rule("ceiling_msl_m",
            [](const T& t) {
              const bool none =
                  t.ceiling_msl && t.floor_msl && *t.ceiling_msl <= *t.floor_msl;
              return none ? std::string("must be above floor_msl_m.") : std::string();
            })
      .number("margin_m", &T::margin, "Kept from the fence.",
              {.at_least = 0, .at_most = 1e5})
      .duration_s("look_ahead_s", &T::look_ahead,
                  "Where the velocity leads in this time counts too. Null: 4 s, 1.5 s on "
                  "what can hover.",
                  {.at_least = 0, .at_most = 1000});
}

Fields<autopilot::EstimatorOptions> estimator_fields() {
  using T = autopilot::EstimatorOptions;
  return Fields<T>()
      .duration_s("period_s", &T::period, "Between two corrections.",
                  {.above = 0, .at_most = 5})
      .angle_deg("declination_deg", &T::declination, "Of the Earth's field at the site.",
                 {.at_least = -180, .at_most = 180})
      .number("wind_walk", &T::wind_walk,
              "How fast the mean wind may change, m/s/sqrt(s).", kSd)
      .number("airspeed_scale_sd", &T::airspeed_scale_sd,
              "Lasting relative error of the airspeed.", kSd)
      .number("baro_bias_sd_m", &T::baro_bias_sd, "Of the barometer.", kSd)
      .number("magnetic_bias_sd", &T::magnetic_bias_sd,
              "Of the magnetometer per axis, in field strengths.", kSd);
}

// What does not change from one aircraft of a group to the next.
Result<std::shared_ptr<const autopilot::SkeinSetup>> make_setup(
    const SkeinChoice& choice, const AircraftContext& c) {
  autopilot::SkeinOptions options = choice.options;
  const autopilot::LapGains wing = fixed_wing_gains(choice, c.gains);
  options.wing_gains = wing.wing;
  if (c.gains.rotors) options.rotor_gains = *c.gains.rotors;
  if (choice.rotor_gains) options.rotor_gains = *choice.rotor_gains;
  for (const LapGainsChoice& lap : choice.lap_gains)
    options.lap_gains.push_back(
        {lap.lateral.value_or(wing.lateral), lap.wing_gains.value_or(wing.wing)});
  if (!choice.lap_gains.empty() && !std::holds_alternative<FixedWingAirframe>(c.airframe))
    return Error{ErrorCode::kBadInput, "autopilot.lap_gains",
                 "are for fixed wings with six degrees of freedom.",
                 "Choose plant: fixed-wing, or leave them out."};
  options.watches_link = c.receives_station;
  options.watches_gnss = c.has_position;
  options.watches_sensors = c.fitted;
  options.fence = geofence_of(choice.fence, c.limits);
  if (options.fence.area.empty() && !choice.fence.areas.empty())
    return Error{ErrorCode::kBadInput, "autopilot.fence.areas_m", "enclose nothing.", ""};
  return std::shared_ptr<const autopilot::SkeinSetup>(
      std::make_shared<autopilot::SkeinSetup>(options, c.limits, c.airframe));
}

Fields<LapGainsChoice> lap_gains_fields() {
  using T = LapGainsChoice;
  return Fields<T>()
      .object("lateral", &T::lateral, lateral_fields(),
              "Lateral guidance. Null: as the autopilot's.")
      .object("wing_gains", &T::wing_gains, fixed_wing_gains_fields(),
              "Gains. Null: as the autopilot's.");
}

}  // namespace

Fields<autopilot::LateralOptions> lateral_fields() {
  using T = autopilot::LateralOptions;
  using autopilot::LateralLaw;
  return Fields<T>()
      .word("law", &T::law, "How a line is followed.",
            {{"course", LateralLaw::kCourse, "a course back to the line"},
             {"l1", LateralLaw::kL1, "a point of the line, at a fixed time and damping"},
             {"l2plus", LateralLaw::kL2Plus,
              "line of sight that grows with the speed (Curry et al. 2013)"}})
      .number("course_gain_per_s", [](T & t) -> auto& { return t.course.gain; },
              "course: rate of turn per course error.", {.above = 0, .at_most = 20})
      .duration_s("course_look_ahead_s",
                  [](T & t) -> auto& { return t.course.look_ahead; },
                  "course: flight time in which a cross-track error is taken out.",
                  {.above = 0, .at_most = 1000})
      .duration_s("l1_period_s", [](T & t) -> auto& { return t.l1.period; },
                  "l1: of the motion about a straight line.",
                  {.above = 0, .at_most = 1000})
      .number("l1_damping", [](T & t) -> auto& { return t.l1.damping; },
              "l1: of that motion.", {.above = 0, .at_most = 10})
      .duration_s("l2_time_s", [](T & t) -> auto& { return t.l2.time; },
                  "l2plus: flight time to the point aimed at.",
                  {.above = 0, .at_most = 1000})
      .number("l2_min_m", [](T & t) -> auto& { return t.l2.min; },
              "l2plus: minimum distance of that point.", {.above = 0, .at_most = 1e5})
      .formerly("l2_least_m")
      .duration_s("roll_lag_s", &T::roll_lag,
                  "From a change of the demand to the acceleration.",
                  {.at_least = 0, .at_most = 10});
}

autopilot::GeofenceOptions geofence_of(const FenceChoice& fence,
                                       const FlightLimits& limits) {
  autopilot::GeofenceOptions options;
  options.area = geo::clean(fence.areas, geo::FillRule::kNonZero);
  if (fence.ceiling_msl) options.ceiling_msl = *fence.ceiling_msl;
  if (fence.floor_msl) options.floor_msl = *fence.floor_msl;
  options.margin = fence.margin;
  // A wing turns in it, a multirotor comes to a stand.
  options.look_ahead = fence.look_ahead.value_or(limits.slowest > 0 ? 4 : 1.5);
  return options;
}

autopilot::LapGains fixed_wing_gains(const SkeinChoice& choice,
                                     const AircraftGains& of_aircraft) {
  autopilot::LapGains gains{choice.options.wing_guidance.lateral,
                            choice.options.wing_gains};
  if (of_aircraft.wing) gains.wing = *of_aircraft.wing;
  if (choice.wing_gains) gains.wing = *choice.wing_gains;
  return gains;
}

Fields<SkeinChoice> skein_fields() {
  using T = SkeinChoice;
  return Fields<T>()
      .object(
          "lateral", [](T & t) -> auto& { return t.options.wing_guidance.lateral; },
          lateral_fields(), "Lateral guidance of fixed wings.")
      .boolean(
          "rounds_corners",
          [](T & t) -> auto& { return t.options.wing_guidance.rounds_corners; },
          "Fixed wings round off the corners of a route; else they fly over them.")
      .boolean(
          "refuses", [](T & t) -> auto& { return t.options.wing_guidance.refuses; },
          "Fixed wings refuse commands that they cannot fly; else they fly them as near "
          "as "
          "they can.")
      .object(
          "failsafe", [](T & t) -> auto& { return t.options.failsafe; },
          failsafe_fields(), "What goes wrong, and what is done.")
      .object("fence", &T::fence, fence_fields(), "Where it may fly.")
      .object(
          "estimator", [](T & t) -> auto& { return t.options.estimator; },
          estimator_fields(), "What its estimator assumes.")
      .object("wing_gains", &T::wing_gains, fixed_wing_gains_fields(),
              "Gains for a fixed wing. Null: those of the aircraft file.")
      .object("rotor_gains", &T::rotor_gains, multirotor_gains_fields(),
              "Gains for a multirotor. Null: those of the aircraft file.")
      .object("lap_gains", &T::lap_gains, lap_gains_fields(),
              "Fixed wings: lap k of a route is flown with entry k, later ones with the "
              "last, everything else with the first.")
      .items({.at_most = 1000});
}

Result<std::unique_ptr<Autopilot>> make_skein(const SkeinChoice& choice,
                                              const AircraftContext& c) {
  using Setup = std::shared_ptr<const autopilot::SkeinSetup>;
  const auto make = [&](const Setup& setup) {
    const double ground = c.map->elevation_msl(geo::horizontal(c.initial.p_N));
    return std::unique_ptr<Autopilot>(std::make_unique<autopilot::SkeinAutopilot>(
        setup, c.initial, c.on_ground, ground));
  };
  if (!c.shared || !c.shared->has_value()) {
    auto made = make_setup(choice, c);
    if (!made) return made.error();
    if (!c.shared) return make(made.value());
    *c.shared = std::move(made).value();
  }
  return make(std::any_cast<const Setup&>(*c.shared));
}

}  // namespace skein::assemble
