// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/aircraft/gains_fields.h"

namespace skein::assemble {
namespace {

using scenario::Fields;
using scenario::Range;

constexpr Range kGain{.above = 0, .at_most = 1000};
constexpr Range kIntegral{.at_least = 0, .at_most = 1000};
constexpr Range kTurn{.above = 0, .at_most = 35};  // rad/s
constexpr Range kBankDeg{.above = 0, .below = 90};

}  // namespace

Fields<autopilot::FixedWingGains> fixed_wing_gains_fields() {
  using T = autopilot::FixedWingGains;
  return Fields<T>()
      .number("roll_gain_per_s", &T::roll_gain, "Roll rate per roll error.", kGain)
      .number("roll_rate_gain_per_s", &T::roll_rate_gain,
              "Roll acceleration per error of the roll rate.", kGain)
      .number("roll_rate_integral_per_s2", &T::roll_rate_integral,
              "And per its integral.", kIntegral)
      .number("roll_rate_limit_rad_per_s", &T::roll_rate_limit, "Largest demand.", kTurn)
      .number("bank_gain_per_s", &T::bank_gain,
              "Rate of the bank aimed at per difference to the demand.", kGain)
      .number("bank_rate_limit_rad_per_s", &T::bank_rate_limit, "Of that bank.", kTurn)
      .number("bank_acceleration_rad_per_s2", &T::bank_acceleration,
              "Of that bank, largest.", {.above = 0, .at_most = 1e5})
      .number("pitch_gain_per_s", &T::pitch_gain, "Pitch rate per pitch error.", kGain)
      .number("pitch_rate_gain_per_s", &T::pitch_rate_gain,
              "Pitch acceleration per error of the pitch rate.", kGain)
      .number("pitch_rate_integral_per_s2", &T::pitch_rate_integral,
              "And per its integral.", kIntegral)
      .number("pitch_rate_limit_rad_per_s", &T::pitch_rate_limit, "Largest demand.",
              kTurn)
      .number("load_limit", &T::load_limit, "Largest load factor asked for.",
              {.above = 1, .at_most = 50})
      .number("lift_reserve", &T::lift_reserve,
              "Maximum lift demanded, over the weight at the minimum airspeed.",
              {.at_least = 1, .at_most = 50})
      .number("flare_reserve", &T::flare_reserve, "The same, touching down.",
              {.at_least = 1, .at_most = 50})
      .number("yaw_rate_gain_per_s", &T::yaw_rate_gain,
              "Yaw acceleration per error of the yaw rate.", kIntegral)
      .number("sideslip_gain_per_s2", &T::sideslip_gain,
              "Yaw acceleration per sine of the side-slip.", kIntegral)
      .number("run_heading_gain_per_s", &T::run_heading_gain,
              "Yaw rate per heading error on the ground.", kIntegral)
      .number("align_gain_per_rad", &T::align_gain,
              "Rudder per heading error at touch-down on wheels.", kIntegral)
      .number("align_rate_gain_per_s", &T::align_rate_gain,
              "Yaw acceleration per yaw rate meanwhile.", kIntegral)
      .number("height_gain_per_s", &T::height_gain, "Climb rate per height error.", kGain)
      .number("airspeed_gain_per_s", &T::airspeed_gain,
              "Acceleration per airspeed error.", kGain)
      .number(
          "energy_rate_gain", &T::energy_rate_gain,
          "Throttle per error of the energy rate, in units of the throttle that makes "
          "up for it in level flight.",
          kIntegral)
      .number("energy_integral_per_s", &T::energy_integral, "And per its integral.",
              kIntegral)
      .number(
          "balance_gain", &T::balance_gain,
          "Path angle per error of the balance of energies, in units of the angle that "
          "makes up for it.",
          kIntegral)
      .number("balance_integral_per_s", &T::balance_integral, "And per its integral.",
              kIntegral)
      .number(
          "gust_filter_rad_per_s", &T::gust_filter,
          "Gusts along the path slower than this count as airspeed; at 15 m/s of cruise, "
          "less the faster it is.",
          kGain)
      .number("airspeed_filter_rad_per_s", &T::airspeed_filter,
              "Bandwidth of the airspeed and of its rate.", kGain)
      .number("vertical_acceleration_mps2", &T::vertical_acceleration,
              "Bounds the rate of the demanded pitch.", kGain)
      .number("throttle_rate_per_s", &T::throttle_rate, "Largest change of throttle.",
              kGain)
      .number("turn_drag", &T::turn_drag,
              "Induced drag over drag in level flight at cruise, for the throttle in "
              "turns.",
              {.at_least = 0, .at_most = 1})
      .angle_deg("climb_out_bank_deg", &T::climb_out_bank, "Largest after take-off.",
                 kBankDeg)
      .angle_deg("flare_bank_deg", &T::flare_bank, "Largest before touching down.",
                 kBankDeg);
}

Fields<autopilot::MultirotorGains> multirotor_gains_fields() {
  using T = autopilot::MultirotorGains;
  return Fields<T>()
      .number("position_gain_per_s", &T::position_gain, "Speed per horizontal error.",
              kGain)
      .number("velocity_gain_per_s", &T::velocity_gain, "Acceleration per speed error.",
              kGain)
      .number("velocity_integral_per_s2", &T::velocity_integral, "And per its integral.",
              kIntegral)
      .number("height_gain_per_s", &T::height_gain, "Climb rate per height error.", kGain)
      .number("climb_gain_per_s", &T::climb_gain,
              "Acceleration per error of the climb rate.", kGain)
      .number("climb_integral_per_s2", &T::climb_integral, "And per its integral.",
              kIntegral)
      .number("hover_learning_per_s", &T::hover_learning,
              "At which that integral becomes hover thrust.", kIntegral)
      .number("acceleration_limit_mps2", &T::acceleration_limit, "Vertical.", kGain)
      .number(
          "rate_gain_per_s", &T::rate_gain,
          "Angular acceleration per rate error; 0: as fast as the motors' lag allows.",
          kIntegral)
      .number("rate_integral", &T::rate_integral,
              "And per its integral, over the square of rate_gain.", kIntegral)
      .number("rate_derivative", &T::rate_derivative,
              "Angular acceleration per rate of the turn rates.", kIntegral)
      .number("derivative_filter_rad_per_s", &T::derivative_filter, "Its bandwidth.",
              {.above = 0, .at_most = 1e4})
      .number("tilt_gain_per_s", &T::tilt_gain,
              "Turn rate per tilt error; 0: as fast as the motors' lag allows.",
              kIntegral)
      .number("heading_gain_per_s", &T::heading_gain, "Yaw rate per heading error.",
              kGain)
      .number("yaw_rate_gain_per_s", &T::yaw_rate_gain,
              "Yaw acceleration per error of the yaw rate.", kGain)
      .number("tilt_rate_limit_rad_per_s", &T::tilt_rate_limit, "Largest demand.", kTurn)
      .number("yaw_rate_limit_rad_per_s", &T::yaw_rate_limit, "Largest demand.", kTurn)
      .number("manual_tilt_rate_rad_per_s", &T::manual_tilt_rate, "At full stick.", kTurn)
      .number("manual_yaw_rate_rad_per_s", &T::manual_yaw_rate, "At full stick.", kTurn);
}

}  // namespace skein::assemble
